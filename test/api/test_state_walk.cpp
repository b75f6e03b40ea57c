// The state of a contact as a value: two twins go the same random way through the calls of rsc.h,
// and one of them is again and again replaced by its copy, by what a file gives back, or rolled
// back after trials. Both answer the same to the last bit, on bodies of every kind.
#include "check.hpp"
#include "support/library.hpp"
#include "support/temporary_folder.hpp"

namespace test_state_walk {

using Random = std::mt19937_64;
using Answers = std::vector<double>;

int below(Random& random, int n) { return int(random() % std::uint64_t(n)); }
double uniform(Random& random) { return double(random() >> 11) * 0x1p-53; }

bool same_bits(const Answers& a, const Answers& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

// What a contact says without being changed; `asked`: also what it computes when it is asked.
Answers answers(rsc_contact* contact, bool asked) {
    Answers all;
    const auto note = [&](std::int32_t status, std::initializer_list<double> values) {
        all.push_back(status);
        for (const double v : values) all.push_back(std::isnan(v) ? std::nan("") : v);
    };
    double x = 0, y = 0, touch = 0, Z0 = 0, N = 0, A = 0, residual = 0;
    std::int64_t n = 0, candidates = 0, iterations = 0, overlapping = 0;
    std::int32_t level = 0;
    note(rsc_contact_tip(contact, &x, &y), {x, y});
    note(rsc_contact_first_touch(contact, &touch), {touch});
    note(rsc_contact_result(contact, &Z0, &N, &A, &n), {Z0, N, A, double(n)});
    note(rsc_contact_level(contact, &level, &candidates, &iterations, &overlapping, &residual),
         {double(level), double(candidates), double(iterations), double(overlapping), residual});
    if (N != 0) {
        const double at_x[] = {0.5, 0.63}, at_y[] = {0.5, 0.4};
        double w[2] = {};
        note(rsc_contact_deflection(contact, 2, at_x, at_y, w), {w[0], w[1]});
        std::vector<double> f(std::size_t(n), 0.0), a = f, u = f;
        std::vector<std::int32_t> index(std::size_t(n), 0);
        note(rsc_contact_spots(contact, n, index.data(), f.data(), a.data(), u.data()), {});
        for (const auto* values : {&f, &a, &u})
            all.insert(all.end(), values->begin(), values->end());
    }
    for (const char* name : {"energy", "lateral_force_x", "moment_y", "plastic_work", "energy_lost",
                             "worn_volume", "time", "distance", "least_force", "jumps",
                             "cohesive_area", "force_error_expected", "products"}) {
        double found = 0;
        note(rsc_contact_value(contact, name, &found), {found});
    }
    if (!asked) return all;
    double stiffness = 0, conductance = 0;
    note(rsc_contact_stiffness(contact, &stiffness), {stiffness});
    note(rsc_contact_value(contact, "conductance_length", &conductance), {conductance});
    return all;
}

// One call that changes the contact. Returns its answers.
Answers go(rsc_contact* contact, Random& random, double depth, double& clock) {
    double given = 0, touch = 0;
    std::int32_t status = 0;
    switch (below(random, 9)) {
        case 0: {
            // sometimes over the border of a surface that repeats
            const double far = below(random, 3) == 0 ? 1.1 : 0.01;
            const double x = 0.5 + far * (uniform(random) - 0.5), y = 0.5 + far * uniform(random);
            status = rsc_contact_move_tip(contact, x, y);
            break;
        }
        case 1:
        case 2: {
            clock += uniform(random);
            status =
                rsc_contact_set_time(contact, clock) + rsc_contact_set_distance(contact, clock);
            break;
        }
        case 3:
        case 4: {
            const double force = std::exp(8 * uniform(random) - 6);
            status = rsc_contact_press(contact, force, &given);
            break;
        }
        default: {
            const double share = 1.1 * uniform(random) - 0.1;
            (void)rsc_contact_first_touch(contact, &touch);
            status = rsc_contact_indent(contact, touch - share * depth, &given);
        }
    }
    Answers all = {double(status), given};
    const Answers more = answers(contact, below(random, 3) == 0);
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

// Two twins on the way of `go`, whose calls change them and return answers.
template <class Twin, class Copy, class Save, class Restore, class Commit, class Rollback, class Go>
void walk_twins(Twin one, Twin twin, int steps, std::size_t seed, const char* name, Copy&& copy,
                Save&& save, Restore&& restore, Commit&& commit, Rollback&& rollback, Go&& go) {
    const Folder folder;
    const std::string file = folder / "save";
    Random random(seed);
    double clock = 0;
    for (const int step : indices(steps)) {
        const int kind = below(random, 8);
        Twin other;
        if (kind == 0) OK(copy(&other, twin));
        if (kind == 1) {
            OK(save(twin, file.c_str()));
            OK(restore(&other, file.c_str()));
        }
        if (kind < 2) twin = std::move(other);
        if (kind == 2) {
            Random trial(random());
            double then = clock;
            for (auto* of : {one.get(), twin.get()}) OK(commit(of));
            for (int k = 0; k < 3; ++k) (void)go(twin, trial, then);
            OK(rollback(twin));
        }
        if (kind == 3)
            for (auto* of : {one.get(), twin.get()}) OK(rollback(of));
        Random again = random;
        double then = clock;
        const Answers here = go(one, random, clock), there = go(twin, again, then);
        const bool same = same_bits(here, there);
        if (!same) std::printf("step %d, kind %d of %s\n", step, kind, name);
        CHECK(same);
        if (!same) return;
    }
}

const std::string kSurface = "&surface n=64 L_lambda_l=4 L_lambda_s=16 L=1 sigma=0.01 / ";

void walk(const std::string& keys, int steps = 20, const std::string& surface = kSurface) {
    constexpr double depth = 0.01;
    const Made made(surface + "&solids E=1e3,Infinity nu=0.3,0 " + keys);
    const auto restore = [&](rsc_contact** contact, const char* file) {
        return rsc_contact_restore(contact, made.asperities, file);
    };
    walk_twins(contact_on(made.asperities, made.c), contact_on(made.asperities, made.c), steps,
               keys.size(), keys.c_str(), rsc_contact_copy, rsc_contact_save, restore,
               rsc_contact_commit, rsc_contact_rollback,
               [&](rsc_contact* contact, Random& random, double& clock) {
                   return go(contact, random, depth, clock);
               });
}

// One call that changes a contact with friction, and what it says then.
Answers slide(rsc_friction* friction, Random& random, double&) {
    const double x = 1e-4 * uniform(random), y = 1e-4 * uniform(random);
    double N = 0, Qx = 0, Qy = 0, lost = 0, xx = 0, xy = 0, yx = 0, yy = 0;
    std::int32_t status = 0;
    const int kind = below(random, 4);
    if (kind == 0)
        status = rsc_friction_move_tip(friction, 0.5 + 100 * x, 0.5 + 100 * y);
    else if (kind == 1)
        status = rsc_friction_stiffness(friction, &xx, &xy, &yx, &yy);
    else
        status = rsc_friction_update(friction, 0.012 * uniform(random), x, y, &N, &Qx, &Qy, &lost);
    Answers all = {double(status), N, Qx, Qy, lost, xx, xy, yx, yy};
    FrictionState s;
    all.push_back(rsc_friction_state(friction, &s.Z, &s.x, &s.y, &s.N, &s.Qx, &s.Qy, &s.normal,
                                     &s.tangential, &s.lost, &s.stick));
    all.insert(all.end(),
               {s.Z, s.x, s.y, s.N, s.Qx, s.Qy, s.normal, s.tangential, s.lost, s.stick});
    if (!(s.N > 0) || below(random, 3) > 0) return all;
    double at[] = {1e-5, 3e-5}, force[2] = {};
    all.push_back(rsc_friction_first_loading(friction, 2, at, force, nullptr));
    all.insert(all.end(), {force[0], force[1]});
    return all;
}

void walk_with_friction(const std::string& keys, int steps = 40) {
    const Made made(kSurface + keys);
    ContactHandle contact;
    OK(rsc_contact_create(&contact, made.asperities, 1e5, 2.5, 0.5, 0.5, made.c));
    FrictionHandle one, twin;
    OK(rsc_friction_create(&one, contact, 0.3, 0.8));
    OK(rsc_friction_create(&twin, contact, 0.3, 0.8));
    const auto restore = [&](rsc_friction** friction, const char* file) {
        return rsc_friction_restore(friction, made.asperities, file);
    };
    walk_twins(std::move(one), std::move(twin), steps, keys.size(), keys.c_str(), rsc_friction_copy,
               rsc_friction_save, restore, rsc_friction_commit, rsc_friction_rollback, slide);
}

TEST(state_walk) {
    const std::string ball = "R=Infinity,2.5 ", flats = "R=Infinity,Infinity ",
                      elements = " / &solver model='elements' /",
                      periodic = elements + " &indentation boundary='periodic' /",
                      relaxing = "relaxation_share=0.4,0.3 relaxation_time=1,20 ";
    for (const std::string law : {"hertz", "elliptic", "fourth_order"}) {
        const std::string by = " / &asperities law='" + law + "' /";
        for (const std::string& more :
             {std::string(), std::string("hardness=15 "), relaxing, std::string("adhesion=0.001 ")})
            walk(ball + more + by);
        walk_with_friction(by.substr(3));
    }
    walk(flats + "/ &indentation boundary='periodic' / &asperities law='elliptic' /", 10);
    walk(ball + "layer_thickness=0.05 layer_E=4e3 layer_nu=0.2 /");
    walk(ball + "adhesion=0.001 adhesion_range=1e-4 / &asperities law='hertz' /");
    walk(ball + "/ &solver method='mesh' /");
    walk(ball + "/ &solver method='dgesv' /");
    walk(
        "/ &indenter shape='paraboloid' radii=2.5, Infinity / &indentation boundary='periodic_y' "
        "/ &solver model='elements' /");
    walk_with_friction("&solver model='elements' /");
    for (const std::string& more : {std::string(), std::string("hardness=100 "), relaxing,
                                    std::string("wear_coefficient=1e-5 ")})
        for (const std::string& bodies : {ball, flats})
            walk(bodies + more + (bodies == ball ? elements : periodic), 10);
    for (const std::string& range : {std::string(), std::string("adhesion_range=3e-3 ")})
        for (const std::string& bodies : {ball, flats})
            walk(bodies + "adhesion=0.01 " + range + (bodies == ball ? elements : periodic), 4,
                 "&surface n=32 L_lambda_l=2 L_lambda_s=8 L=1 sigma=0.01 / ");
}

}  // namespace test_state_walk
