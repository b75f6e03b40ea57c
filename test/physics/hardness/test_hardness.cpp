// Asperities that yield (physics/hardness/hardness.hpp), against closed forms, against the work
// they take, and against a slow solver of its own.
#include "check.hpp"
#include "physics/hardness/hardness.hpp"
#include "support/asperities.hpp"
#include "support/bodies.hpp"
#include "support/paths.hpp"
#include "support/simpson.hpp"
#include "surface/detection.hpp"

namespace test_hardness {

using namespace rsc;

constexpr double kE = 94.0e3;

// A Hertz asperity that yields, written down once more, in long double.
struct Yielding {
    long double r, H, deepest = 0;
    long double yield() const {
        return std::pow(3 * std::numbers::pi_v<long double> * H / (4 * kE), 2.0L) * r;
    }
    long double loading_area(long double u) const {
        return std::numbers::pi_v<long double> * r * (2 * u - yield());
    }
    struct Answer {
        long double force, area;
    };
    Answer at(long double u) const {
        const long double uc = yield(), p = std::numbers::pi_v<long double>;
        if (u > std::max(uc, deepest)) return {H * loading_area(u), loading_area(u)};
        if (deepest <= uc)
            return u > 0 ? Answer{4.0L / 3 * kE * std::sqrt(r) * std::pow(u, 1.5L), p * r * u}
                         : Answer{0, 0};
        const long double area = loading_area(deepest), f = H * area, a = std::sqrt(area / p),
                          R = 4 * kE * a * a * a / (3 * f);
        const long double whole = a * a / R, x = u - (deepest - whole);
        // No more work comes back than was done: f whole/(1 + m).
        const long double spent =
                              2 * H * p * r * uc * uc / 5 + H * p * r * (deepest - uc) * deepest,
                          m = std::max(1.5L, f * whole / spent - 1);
        return x > 0 ? Answer{f * std::pow(x / whole, m), p * R * x} : Answer{0, 0};
    }
};

constexpr double kRadius = 0.004;
const Asperities kOne = asperities_at({{0.5, 0.5, 0, kRadius}});
// A bent one, of the biharmonic `flattening` times 10^4 of its curvatures.
Asperities bent(double flattening) {
    return curved(kOne, 1.6, 0.3, 1e4 * flattening * (1.6 + 1 / 1.6) / kRadius);
}

SolverOptions options_with(double H0, double length = 0) {
    return {.tolerance = 1e-13, .physics = bodies_with(Hardness{H0, length})};
}

// Of every law: force, area and work continuous where yielding begins, slope and work the
// derivative and the integral of the force. The flattest profile passes its highest mean pressure
// (law.cpp) within the penetrations asked for, the others do not.
TEST(test_laws) {
    const int i = 0;
    for (const auto kind : {LawKind::hertz, LawKind::elliptic, LawKind::fourth_order})
        for (const double flattening : {8.0, -5.0, 0.01, 300.0}) {
            const Asperities a = bent(flattening);
            const auto elastic = make_law(kind, a, kE);
            const auto law = make_yielding(make_law(kind, a, kE), a, {4000, 0});
            for (Law* l : {elastic.get(), static_cast<Law*>(law.get())}) l->prepare({&i, 1});
            const double uc = elastic->capabilities().truncation->yield_penetration(0, 4000);
            CHECK_RELATIVE(elastic->force(0, uc), 4000 * elastic->area(0, uc), 1e-12);
            CHECK_RELATIVE(law->force(0, uc * (1 + 1e-12)), elastic->force(0, uc), 1e-10);
            CHECK_RELATIVE(law->area(0, uc * (1 + 1e-12)), elastic->area(0, uc), 1e-10);
            const auto ask = [&](double at) {
                std::array<double, 3> answer;
                law->respond(1, &i, &at, &answer[0], &answer[1], &answer[2]);
                return answer;
            };
            for (int pass = 0; pass < 2;
                 ++pass) {            // virgin, then after having been pressed to 8 u_c
                double greatest = 0;  // slope up to there
                for (const double times : {0.5, 0.9, 1.5, 4.0, 7.5, 7.9, 9.0, 20.0}) {
                    const double u = times * uc, h = 1e-5 * u;
                    const auto low = ask(u - h), now = ask(u), high = ask(u + h);
                    CHECK_CLOSE(now[0], law->force(0, u), 1e-14 * now[0]);
                    // Central differences of smooth functions: the error is some h^2/u^2 of the
                    // value; zero before the unloaded summit touches.
                    const double scale = std::max(now[0], 4000 * pi * 1e-9);
                    CHECK_CLOSE(now[1], (high[0] - low[0]) / (2 * h), 1e-6 * scale / u);
                    CHECK_CLOSE(now[0], (high[2] - low[2]) / (2 * h), 1e-6 * scale);
                    if (now[0] > 0)
                        CHECK(now[0] <= 4000 * law->area(0, u) * (1 + 1e-12) || pass == 1);
                    greatest = std::max(greatest, now[1]);
                    CHECK(greatest <= law->steepest(0, u) * (1 + 1e-12));
                }
                // No work is spent where one way of answering gives way to the next.
                const double change = pass == 0 ? uc : 8 * uc;
                CHECK_RELATIVE(ask(change * (1 + 1e-9))[2], ask(change * (1 - 1e-9))[2], 1e-7);
                const double deep = 8 * uc;
                law->commit(1, &i, &deep);
                CHECK(law->force(0, deep) > 0 &&
                      std::abs(law->force(0, deep) / (4000 * law->area(0, deep)) - 1) < 1e-12);
            }
        }
}

// fourth_order on a sphere: the summit pressed flat sinks in, a^2 = a_c^2 + 2 r [u - u_c - k (a -
// a_c)], k = 4 H/(pi E*).
TEST(test_sinking) {
    const double r = kRadius, H = 3000;
    SolverOptions options = options_with(H);
    options.law = LawKind::fourth_order;
    const Asperities round = curved(kOne, 1);
    Path contact = asperity_path(round, {kE, kInfinity, 0.5, 0.5}, options);
    const double uc = std::pow(3 * pi * H / (4 * kE), 2) * r, ac = std::sqrt(r * uc),
                 b = r * 4 * H / (pi * kE);
    for (const double times : {1.001, 1.5, 4.0, 30.0}) {
        const Level level = contact.at_separation(-times * uc);
        const double radius = std::sqrt((b + ac) * (b + ac) + 2 * r * uc * (times - 1)) - b;
        CHECK_RELATIVE(level.area, pi * radius * radius, 1e-12);
        CHECK_RELATIVE(level.force, H * level.area, 1e-12);
        CHECK(level.area < pi * r * uc * (2 * times - 1));
    }
}

// A cycle of one asperity, pressed to any depth: what the loop encloses is the work lost, and never
// less than nothing.
TEST(test_cycle) {
    const int i = 0;
    for (const auto kind : {LawKind::hertz, LawKind::elliptic, LawKind::fourth_order})
        for (const double flattening : {30.0, -5.0}) {
            const Asperities a = bent(flattening);
            for (const double times : {1.0001, 1.1, 1.3, 1.5, 3.0, 20.0}) {
                const auto elastic = make_law(kind, a, kE);
                const auto law = make_yielding(make_law(kind, a, kE), a, {16000, 0});
                for (Law* l : {elastic.get(), static_cast<Law*>(law.get())}) l->prepare({&i, 1});
                const double deepest =
                    times * elastic->capabilities().truncation->yield_penetration(0, 16000);
                const auto work = [&] {  // int f du to `deepest`, with u = deepest (1 - x^2)
                    return simpson(0, 1, 4000, [&](double x) {
                        return law->force(0, deepest * (1 - x * x)) * 2 * x * deepest;
                    });
                };
                const double spent = work();
                law->commit(1, &i, &deepest);
                CHECK(law->work_lost() >= 0);
                CHECK(times < 2 || law->work_lost() > 0.1 * spent);
                CHECK_CLOSE(spent - work(), law->work_lost(),
                            1e-6 * spent);  // of the rule, at kinks
            }
        }
}

Asperities few(std::mt19937& random, int n) {
    std::uniform_real_distribution<double> uniform(0, 1);
    Asperities a;
    for (int i = 0; i < n; ++i) {
        a.x.push_back(uniform(random));
        a.y.push_back(uniform(random));
        a.z.push_back(0.01 * uniform(random));
        a.radius.push_back(0.01 * (0.5 + uniform(random)));
    }
    return a;
}

// u_i + sum B_ij f_j(u_j) = g0_i by bisection of one asperity after the other until nothing moves:
// slow, and nothing of Newton's.
std::vector<long double> solve_slowly(const Asperities& a, const std::vector<Yielding>& laws,
                                      double Z0) {
    const std::size_t n = a.size();
    std::vector<long double> f(n, 0), u(n, 0);
    for (int sweep = 0; sweep < 3000; ++sweep) {
        long double moved = 0, largest = 0;
        for (const std::size_t i : indices(n)) {
            long double lowered = 0;
            for (const std::size_t j : indices(n))
                if (j != i)
                    lowered += f[j] / (std::numbers::pi_v<long double> * kE *
                                       std::hypot(static_cast<long double>(a.x[i]) - a.x[j],
                                                  static_cast<long double>(a.y[i]) - a.y[j]));
            u[i] = static_cast<long double>(a.z[i]) - Z0 - lowered;
            const long double fresh = laws[i].at(u[i]).force;
            moved += std::abs(fresh - f[i]);
            largest += std::abs(fresh);
            f[i] = fresh;
        }
        if (moved <= 1e-17L * largest) break;
    }
    return u;
}

TEST(test_independent) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    int compared = 0;
    double worst = 0;
    for (const int system : indices(120)) {
        const int n = 2 + system % 7;
        const Asperities a = few(random, n);
        const double H0 = 200 * std::pow(100.0, uniform(random)),
                     length = system % 2 == 0 ? 0 : 0.005;
        const Method method = system % 3 == 0   ? Method::dgesv
                              : system % 3 == 1 ? Method::direct
                                                : Method::mesh;
        SolverOptions options = options_with(H0, length);
        options.surface.sigma = 0.01;
        options.method = method;
        if (method == Method::mesh) options.tolerance = 1e-11;
        Path contact = asperity_path(a, {kE, kInfinity, 0.5, 0.5}, options);
        std::vector<Yielding> laws;
        for (double r : a.radius)
            laws.push_back({r, H0 * std::sqrt(1 + static_cast<long double>(length) / r)});
        std::pair<double, double> most{0, 0};
        for (int step = 0; step < 6; ++step) {  // up and down as it comes
            const double Z0 = 0.007 - 0.012 * uniform(random);
            const Level level = contact.at_separation(Z0);
            CHECK(level.converged);
            const auto u = solve_slowly(a, laws, Z0);
            long double N = 0, A = 0;
            for (const auto i : indices(u)) {
                N += laws[i].at(u[i]).force;
                A += laws[i].at(u[i]).area;
                laws[i].deepest = std::max(laws[i].deepest, u[i]);
            }
            if (!(N > 0)) continue;
            // Errors count against the largest so far: close to where an unloaded summit lets go
            // they are those of its depth.
            most = {std::max(most.first, double(N)), std::max(most.second, double(A))};
            worst = std::max({worst, std::abs(level.force - double(N)) / most.first,
                              std::abs(level.area - double(A)) / most.second});
            ++compared;
        }
    }
    CHECK(compared > 300 &&
          worst < 1e-10);  // tolerance 1e-11 to 1e-13 of the residual, six levels of history
}

// The work of a closed cycle is what was lost; energy is what comes back; no trial leaves a trace;
// and how far the path is cut.
TEST(test_path) {
    std::mt19937 random(3);
    const Asperities a = few(random, 30);
    const Indenter flat{kE, kInfinity, 0.5, 0.5};
    const double top = 0.011, bottom = 0.002;
    Path contact = asperity_path(a, flat, options_with(2000));
    // Simpson over each half of the cycle; kinks where asperities touch and yield leave
    // some 1e-4 of the work at this step.
    Level level;
    const auto force = [&](double Z0) {
        level = contact.at_separation(Z0);
        return level.force;
    };
    const double spent = -simpson(top, bottom, 800, force);
    CHECK_RELATIVE(spent, contact.energy() + level.plastic_work, 2e-4);
    CHECK(contact.energy() < 0.9 * spent);
    const double work = spent - simpson(bottom, top, 800, force);
    CHECK(level.plastic_work > 0.1 * spent && level.force == 0);
    CHECK_RELATIVE(work, level.plastic_work, 2e-3);

    // The same end by 10, 100 and 1000 levels, and by one.
    const auto end = [&](int levels) {
        Path c = asperity_path(a, flat, options_with(2000));
        Level last;
        for (int k = 1; k <= levels; ++k) last = c.at_separation(top + (bottom - top) * k / levels);
        return last;
    };
    const Level fine = end(1000);
    for (const int levels : {10, 100}) {
        const Level coarse = end(levels);
        CHECK_RELATIVE(coarse.force, fine.force, 1e-6);
        CHECK_RELATIVE(coarse.area, fine.area, 1e-6);
    }
    // Pressing with a force visits many separations; the state afterwards is that of the last
    // alone.
    Path pressed = asperity_path(a, flat, options_with(2000)),
         indented = asperity_path(a, flat, options_with(2000));
    const Level by_force = pressed.at_force(0.7 * fine.force);
    indented.at_separation(by_force.separation);
    const double back = by_force.separation + 2e-4;
    CHECK_RELATIVE(pressed.at_separation(back).force, indented.at_separation(back).force, 1e-11);
    // Without its past a contact is a new one.
    pressed.forget();
    CHECK(pressed.at_separation(top).plastic_work == 0);
    const Level again = pressed.at_separation(bottom);
    CHECK(again.force == end(1).force && again.plastic_work == end(1).plastic_work);
}

TEST(test_limits) {
    std::mt19937 random(5);
    const Asperities a = few(random, 40);
    const Indenter tip{kE, 3.0, 0.5, 0.5};
    Path elastic = asperity_path(a, tip, options_with(kInfinity)),
         hard = asperity_path(a, tip, options_with(1e30)),
         soft = asperity_path(a, tip, options_with(1e-3));
    for (const double Z0 : {0.008, 0.004, 0.006, 0.0}) {
        const Level e = elastic.at_separation(Z0), h = hard.at_separation(Z0),
                    s = soft.at_separation(Z0);
        CHECK(e.f == h.f && e.a == h.a);  // no asperity ever yields: the same bits
        CHECK(e.plastic_contacts == 0 && std::isnan(e.plastic_work) && h.plastic_work == 0);
        // All that touches yields at once: A = N/H on the way down.
        if (s.plastic_contacts > 0 && s.plastic_contacts == s.contacts)
            CHECK_RELATIVE(s.area, s.force / 1e-3, 1e-12);
    }
}

}  // namespace test_hardness
