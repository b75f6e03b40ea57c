// Asperities that stick (physics/adhesion/adhesive_contact.hpp), against closed forms, scalar
// equations, and a slow minimiser of the energy.
#include "base/error.hpp"
#include "physics/adhesion/sticking.hpp"
#include "support/adhesive_paths.hpp"
#include "support/bodies.hpp"

namespace test_adhesion {

using namespace rsc;

// Johnson, Kendall and Roberts on a sphere, by the radius of the contact.
struct Jkr {
    double r, w;
    double u(double a) const { return a * a / r - std::sqrt(2 * pi * w * a / kE); }
    double f(double a) const {
        return 4 * kE * a * a * a / (3 * r) - std::sqrt(8 * pi * w * kE * a * a * a);
    }
    // Maugis: elastic energy of a punch pressed by u on a sphere, less w pi a^2.
    double energy(double a) const {
        const double d = u(a);
        return kE * (d * d * a - 2.0 / 3 * d * a * a * a / r + std::pow(a, 5) / (5 * r * r)) -
               w * pi * a * a;
    }
    double least() const { return std::cbrt(pi * w * r * r / (8 * kE)); }
    double touching() const { return std::cbrt(2 * pi * w * r * r / kE); }
};

// The largest root of a function that rises from `low` on.
double root(const std::function<double(double)>& rising, double low) {
    double high = 2 * low;
    while (rising(high) < 0) high *= 2;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (rising(middle) < 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

SolverOptions sticky(double w, LawKind law = LawKind::hertz) {
    return {.law = law, .tolerance = 1e-12, .physics = bodies_with(Adhesion{.work = w})};
}

// The whole loop of one asperity: it attaches where it touches and lets go at u_c, neither sooner
// nor later.
TEST(test_one) {
    for (double w : {1e-6, 0.01, 0.3}) {
        const Jkr jkr{0.7, w};
        const Asperities a = asperities_at({{0.5, 0.5, 0.1, jkr.r}});
        const auto contact = under_flat(a, sticky(w));
        const double unit = pi * w * jkr.r, length = -jkr.u(jkr.least());
        const auto check = [&](double u, bool attached, const char*) {
            const Level level = contact->at_separation(0.1 - u);
            CHECK(level.converged);
            CHECK(level.contacts == (attached ? 1 : 0));
            const double radius = root([&](double x) { return jkr.u(x) - u; }, jkr.least());
            CHECK_CLOSE(level.force, attached ? jkr.f(radius) : 0.0,
                        1e-10 * std::max(unit, std::abs(level.force)));
            CHECK_CLOSE(contact->energy(), attached ? jkr.energy(radius) : 0.0,
                        1e-9 * std::max(unit * length, std::abs(contact->energy())));
            if (attached) CHECK_RELATIVE(level.a.at(0), radius, 1e-9);
            return level;
        };
        check(-length, false, "far");
        check(-1e-7 * length, false, "just above");
        const Level touched = check(1e-7 * length, true, "just below");
        CHECK(touched.jumps == 1);
        const double first_loss = -jkr.energy(jkr.touching());
        CHECK_RELATIVE(touched.energy_lost, first_loss, 1e-7);
        for (double u : {0.5, 2.0, 0.1, 7.0, 30.0, 3.0, 0.0, -0.5, -0.9, -0.2, -0.99, -1 + 1e-6})
            CHECK(check(u * length, true, "on the way").jumps == 0);
        const Level away = check(-(1 + 1e-6) * length, false, "away");
        CHECK(away.jumps == 1);
        CHECK_RELATIVE(away.energy_lost, first_loss + jkr.energy(jkr.least()), 1e-7);
        CHECK_RELATIVE(away.least_force, -1.5 * unit, 1e-9);
        // Of one step from deep in contact to just before it lets go, too.
        const auto other = under_flat(a, sticky(w));
        (void)other->at_separation(0.1 - 30 * length);
        const Level pulled = other->at_separation(0.1 + (1 - 1e-6) * length);
        CHECK_RELATIVE(pulled.least_force, -1.5 * unit, 1e-9);
    }
}

// Two that let go together while a third one far away, a little higher, is nearer to the state in
// which it lets go alone: it stays until then.
TEST(test_third_stays) {
    constexpr double distance = 0.2, far = 1e6, later = 1e-4;
    const Jkr jkr{0.5, 0.01};
    const auto g0 = [&](double radius) {
        return jkr.u(radius) + jkr.f(radius) / (pi * kE * distance);
    };
    double least = 0;
    for (double radius = jkr.least(); radius < 10 * jkr.least(); radius *= 1.0001)
        least = std::min(least, g0(radius));
    const double height = -least * (1 + later) + jkr.u(jkr.least());
    const Asperities a =
        asperities_at({{0, 0, 0, jkr.r}, {distance, 0, 0, jkr.r}, {far, 0, height, jkr.r}});
    const auto contact = under_flat(a, sticky(jkr.w));
    CHECK(contact->at_separation(-0.001).contacts == 3);
    CHECK(contact->at_separation(-least * (1 - 0.1 * later)).contacts == 3);
    const Level one = contact->at_separation(-least * (1 + 0.1 * later));
    CHECK(one.contacts == 1 && one.jumps == 1);
    CHECK(contact->at_separation(-least * (1 + 2 * later)).contacts == 0);
}

// Contact of radius c at a penetration u: the force, its slope at a given radius, and how fast the
// energy grows with the area.
struct JkrEdge {
    const Asperities& a;
    double w;
    double force(std::size_t i, double c, double u, double& slope) const {
        slope = 2 * kE * c;
        return slope * (u - c * c / (3 * a.radius[i]));
    }
    double growth(std::size_t i, double c, double u) const {
        const double s = u - c * c / a.radius[i];
        return w - kE * s * s / (2 * pi * c);
    }
    double touches() const { return 0; }
    double start(std::size_t i, double u) const {
        return std::sqrt(a.radius[i] * u);
    }  // as without adhesion
    double seed(std::size_t i) const {
        return 1e-3 * std::cbrt(pi * w * a.radius[i] * a.radius[i] / kE);
    }
};

TEST(test_minimiser) {
    for (unsigned seed = 1; seed <= 7; ++seed) {
        const RandomAsperities system = random_asperities(2 + int(seed % 7), seed, 0.2);
        PathMinimiser slow(system.asperities, kE, JkrEdge{system.asperities, system.w});
        const auto contact = under_flat(system.asperities, sticky(system.w));
        const double length = reach(system.w);
        slow.Z = 0.02;
        for (int k = 0; k <= 60; ++k) {
            const double depth = 0.02 + length,
                         down = k <= 30 ? k / 30.0 : 2 - k / 30.0;  // down and up
            const double Z = k <= 30 ? 0.0201 - depth * down
                                     : 0.02 + 2.5 * length - (depth + 2.5 * length) * down;
            slow.go_to(Z, 0.02 * length);
            const Level level = contact->at_separation(Z);
            CHECK(level.contacts == slow.attached());
            CHECK_CLOSE(level.force, slow.force(),
                        1e-7 * std::max(std::abs(level.force), system.w));
        }
    }
}

// Two flats that repeat, pressed and pulled apart: each detachment changes the separation at which
// the others detach, and a tension raises the points far from it. One level passes all of them.
TEST(test_flats_apart) {
    const RandomAsperities system = random_asperities(8, 101, 0.14);
    const Kernel kernel(Interaction::point, Substrate(kE), {1, 1});
    PathMinimiser slow(system.asperities, kE, JkrEdge{system.asperities, system.w}, &kernel);
    const auto contact = make_asperity_contact(system.asperities, {kE, kInfinity, 0.5, 0.5, {1, 1}},
                                               sticky(system.w));
    slow.Z = 0.05;
    const double length = reach(system.w);
    for (const double Z : {-0.5 * length, 0.01 + length, 0.01 + 1.4 * length}) {
        slow.go_to(Z, 0.03 * length);
        const Level level = contact->at_separation(Z);
        CHECK(level.contacts == slow.attached());
        CHECK_CLOSE(level.force, slow.force(), 1e-6 * std::max(std::abs(level.force), system.w));
    }
}

// Force control ends at the first state of the force that the path from no contact meets, also
// where later ones have the same force, because each attachment lowers it.
TEST(test_first_state) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        RandomAsperities system = random_asperities(6, 200 + seed, 0.2);
        system.w = 1e-4;  // they attach one after the other
        const double length = reach(system.w), step = 0.03 * length;
        for (const double share : {1.5, 6.0}) {
            const double N = share * pi * system.w * 0.25;
            PathMinimiser slow(system.asperities, kE, JkrEdge{system.asperities, system.w});
            slow.Z = 0.03;
            double before = 0, now = 0;
            for (int attached = -1; !(attached == slow.attached() && before < N && now >= N);) {
                attached = slow.attached();
                before = now;
                slow.go_to(slow.Z - step, step);
                now = slow.force();
            }
            const auto contact = under_flat(system.asperities, sticky(system.w));
            const Level level = contact->at_force(N);
            CHECK(level.contacts == slow.attached());
            CHECK(level.separation >= slow.Z && level.separation < slow.Z + step);
        }
    }
}

// A spherical tip that moves over attached asperities at one separation, to and fro.
TEST(test_moves) {
    int jumps = 0;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const RandomAsperities system = random_asperities(2 + int(seed % 5), seed, 0.2);
        const Indenter tip{kE, 10.0, 0.5, 0.5};
        const double length = reach(system.w);
        Asperities under = system.asperities;
        set_clearances(under, system.asperities, tip, 0.5, 0.5);
        const double top = *std::ranges::max_element(under.z), Z = top - 3 * length;
        PathMinimiser slow(under, kE, JkrEdge{under, system.w});
        slow.Z = top;
        slow.go_to(Z, 0.02 * length);
        const auto contact = make_asperity_contact(system.asperities, tip, sticky(system.w));
        double x = 0.5, y = 0.5, lost = contact->at_separation(Z).energy_lost;
        for (const Vec2 to : {Vec2{0.9, 0.6}, Vec2{0.2, 0.3}, Vec2{0.5, 0.5}}) {
            constexpr int parts = 10, fine = 40;
            const Vec2 from{x, y};
            for (int k = 1; k <= parts * fine; ++k) {
                const double share = double(k) / (parts * fine);
                x = from.x + share * (to.x - from.x);
                y = from.y + share * (to.y - from.y);
                set_clearances(under, system.asperities, tip, x, y);
                slow.Z = std::nextafter(Z, 1.0);
                slow.go_to(Z, 1.0);
                if (k % fine != 0) continue;
                contact->move_tip(x, y);
                const Level level = contact->at_separation(Z);
                if (slow.attached() == 0 || level.contacts == 0) {  // the next approach begins anew
                    CHECK(slow.attached() == level.contacts);
                    continue;
                }
                jumps += level.jumps;
                CHECK(level.contacts == slow.attached());
                CHECK_CLOSE(level.force, slow.force(),
                            1e-7 * std::max(std::abs(level.force), system.w));
                CHECK(level.energy_lost >= lost && (level.jumps > 0 || level.energy_lost == lost));
                lost = level.energy_lost;
            }
        }
    }
    CHECK(jumps > 10);
}

// A move cut into several ends in the same state with the same energy lost; for one asperity this
// energy is that of a path of separations with the same clearances.
TEST(test_moves_cut) {
    const RandomAsperities system = random_asperities(12, 21, 0.2);
    const Indenter tip{kE, 10.0, 0.5, 0.5};
    Level whole;
    for (int cuts : {1, 10, 100}) {
        const auto contact = make_asperity_contact(system.asperities, tip, sticky(system.w));
        (void)contact->at_separation(-0.005);
        for (int k = 1; k <= cuts; ++k)
            contact->move_tip(0.5 + 0.3 * k / cuts, 0.5 - 0.2 * k / cuts);
        const Level level = contact->at_separation(-0.005);
        if (cuts == 1) whole = level;
        CHECK(level.contacts == whole.contacts && level.jumps == whole.jumps && level.jumps > 0);
        CHECK_RELATIVE(level.force, whole.force, 1e-8);
        CHECK_RELATIVE(level.energy_lost, whole.energy_lost, 1e-5);
    }
    // A memory belongs to its own position of the tip.
    const auto first = make_asperity_contact(system.asperities, tip, sticky(system.w)),
               second = make_asperity_contact(system.asperities, tip, sticky(system.w));
    (void)first->at_separation(-0.005);
    first->move_tip(0.8, 0.3);
    second->restore(first->state());
    CHECK(second->indenter().x0 == 0.8);
    CHECK_RELATIVE(second->at_separation(-0.005).force, whole.force, 1e-8);
    Path::State other_bodies = second->state();
    other_bodies.history = {1.0, 2.0};
    CHECK_THROWS(second->restore(other_bodies), Error);
    const Asperities two = asperities_at({{0.3, 0.5, 0, 0.5}, {0.7, 0.5, 0.001, 0.5}});
    SolverOptions alone = sticky(1e-3);
    alone.interaction = Interaction::none;
    const auto moved = make_asperity_contact(two, {kE, 10.0, 0.3, 0.5}, alone);
    const double Z = -0.002;  // the second is 0.008 lower under the first position of the tip
    (void)moved->at_separation(Z);
    moved->move_tip(0.7, 0.5);
    moved->move_tip(0.3, 0.5);
    const Jkr jkr{0.5, 1e-3};
    const Level end = moved->at_separation(Z);
    CHECK(end.contacts == 1 && end.jumps == 4);
    CHECK_RELATIVE(end.energy_lost,
                   3 * (0 - jkr.energy(jkr.touching())) + 2 * jkr.energy(jkr.least()), 1e-6);
}

// Past the smallest force of two that interact, found on the way between two of its steps, the
// stiffness is that of the state at its end.
TEST(test_stiffness_past_the_fold) {
    const Asperities two = asperities_at({{0.25, 0.5, 0, 1}, {0.75, 0.5, 0, 1}});
    const auto contact = under_flat(two, sticky(0.05 * kE / 1e3));
    for (double Z = 1e-3; Z < 1e-2; Z += 3e-4) {
        contact->forget();
        (void)contact->at_separation(-0.002);
        constexpr double h = 1e-7, of_differences = 1e-4;
        const double force = contact->at_separation(Z - h).force;
        (void)contact->at_separation(Z);
        const double stiffness = contact->stiffness();
        const Level after = contact->at_separation(Z + h);
        if (after.contacts < 2) break;
        CHECK_CLOSE(stiffness, (after.force - force) / (2 * h), of_differences * kE);
    }
}

// However the way down and up is cut, it ends in the same state, with the same loss; also on a
// stiff coat, where what a force does to its own place shifts the detachment.
TEST(test_cutting) {
    Indenter coated{kE, kInfinity, 0.5, 0.5};
    constexpr double nu = 0.3, E = kE * (1 - nu * nu);
    coated.layers.count = 1;
    coated.layers.layer[0] = {0.02, E, nu};
    coated.layers.E = E / 3;
    coated.layers.nu = nu;
    for (const auto& [seed, indenter] :
         {std::pair{21u, Indenter{kE, kInfinity, 0.5, 0.5}}, {22u, coated}}) {
        const RandomAsperities system = random_asperities(12, seed, 0.2);
        double force = 0, lost = 0;
        for (int cuts : {1, 10, 100}) {
            const auto contact =
                make_asperity_contact(system.asperities, indenter, sticky(system.w));
            Level level;
            for (int k = 1; k <= cuts; ++k) level = contact->at_separation(0.02 - 0.03 * k / cuts);
            const double pressed = level.force;
            for (int k = 1; k <= cuts; ++k)
                level = contact->at_separation(-0.01 + 0.018 * k / cuts);
            const double loss = level.energy_lost;
            if (cuts == 1) {
                force = level.force + pressed;
                lost = loss;
            }
            CHECK_RELATIVE(level.force + pressed, force, 1e-8);
            CHECK_RELATIVE(loss, lost, 3e-6);
        }
    }
}

// So strong an attraction that a jump reaches asperities which were too low to be considered at the
// level before: the loss by one long level and by twelve. (Their penetrations before the jump have
// to be found during it.)
TEST(test_far_jumps) {
    for (unsigned seed : {51u, 53u}) {
        const RandomAsperities system = random_asperities(60, seed, 0.06);
        std::vector<double> lost;
        for (int cuts : {1, 12}) {
            const auto contact = under_flat(system.asperities, sticky(3e-3));
            for (int k = 1; k < cuts; ++k) (void)contact->at_separation(0.03 - 0.018 * k / cuts);
            lost.push_back(contact->at_separation(0.012).energy_lost);
        }
        CHECK_RELATIVE(lost[1], lost[0], 1e-6);
    }
}

// A contact that goes on from a memory gives the bits of one that was not interrupted.
TEST(test_interrupted) {
    const RandomAsperities system = random_asperities(60, 51, 0.06);
    const auto make = [&] { return under_flat(system.asperities, sticky(3e-3)); };
    const auto whole = make();
    for (int k = 0; k <= 24; ++k) {
        const auto other = make();
        if (k > 0) other->restore(whole->state());
        const double Z = 0.03 - 0.0015 * std::min(k, 24 - k);
        const Level level = whole->at_separation(Z), again = other->at_separation(Z);
        CHECK(level.force == again.force && level.energy_lost == again.energy_lost &&
              level.jumps == again.jumps);
        CHECK(whole->stiffness() == other->stiffness() && whole->energy() == other->energy() &&
              whole->state().history == other->state().history);
    }
}

// The work of a closed cycle is the energy lost.
TEST(test_work) {
    for (unsigned seed : {31u, 32u}) {
        const RandomAsperities system = random_asperities(5, seed, 0.2);
        const auto contact = under_flat(system.asperities, sticky(system.w));
        check_work_of_cycle(*contact, 0.05, -0.01);
    }
}

// Without interaction the loss of a cycle is the sum of the asperities' own, also where it is far
// below the rounding of the energies, and where forces are so large beside the attraction that the
// default tolerance is coarse for it. For a weak attraction the loss with interaction is nearly the
// same.
TEST(test_loss_under_load) {
    const RandomAsperities system = random_asperities(12, 61, 0.1);
    for (double w : {1e-8, 1e-11}) {
        const auto lost = [&](Interaction interaction, double tolerance) {
            SolverOptions options = sticky(w);
            options.tolerance = tolerance;
            options.interaction = interaction;
            const auto contact = under_flat(system.asperities, options);
            for (double Z : {0.02, -0.03}) (void)contact->at_separation(Z);
            return contact->at_separation(0.03).energy_lost;
        };
        double alone = 0;
        for (double r : system.asperities.radius) {
            const Jkr jkr{r, w};
            alone += jkr.energy(jkr.least()) - jkr.energy(jkr.touching());
        }
        CHECK_RELATIVE(lost(Interaction::none, 1e-6), alone, 1e-6);
        CHECK_RELATIVE(lost(Interaction::point, 1e-6), lost(Interaction::point, 1e-10), 1e-8);
        CHECK_RELATIVE(lost(Interaction::point, 1e-6), alone, 1e-3);
    }
}

// Spots that overlap so much that no stable state can be found: the level has no values, and the
// path goes on from the last accepted state.
TEST(test_lost) {
    for (double range : {0.0, 0.003}) {
        const RandomAsperities system = random_asperities(8, 9, 0.03);
        SolverOptions options = sticky(system.w);
        options.physics.of<Adhesion>().range = range;
        const auto contact = under_flat(system.asperities, options);
        const Level lost = contact->at_separation(0);
        CHECK(!lost.converged && std::isnan(lost.force) && std::isnan(contact->energy()));
        const Level away = contact->at_separation(0.05);
        CHECK(away.converged && away.force == 0 && away.energy_lost == 0);
    }
}

// Under a given force, in either direction; beyond the smallest one it holds there and says so, and
// goes on from there.
TEST(test_force) {
    const Jkr jkr{0.7, 0.01};
    const Asperities a = asperities_at({{0.5, 0.5, 0.1, jkr.r}});
    const auto contact = under_flat(a, sticky(jkr.w));
    const double unit = pi * jkr.w * jkr.r;
    for (double N : {2.0, 20.0, 0.0, -1.0, -1.499, 0.5}) {
        const Level level = contact->at_force(N * unit);
        CHECK(level.converged);
        CHECK_CLOSE(level.force, N * unit, 1e-9 * std::max(std::abs(N), 1.0) * unit);
        // Johnson, Kendall, Roberts: a^3 = (3 r/(4 E*)) (N + 3 pi w r + sqrt(6 pi w r N + (3 pi w
        // r)^2)).
        const double cube = 0.75 * jkr.r / kE * unit * (N + 3 + std::sqrt(6 * N + 9));
        CHECK_RELATIVE(level.a.at(0), std::cbrt(cube), 1e-6);
    }
    const Level held = contact->at_force(-2 * unit);
    CHECK(!held.converged && held.fallback == Fallback::held);
    CHECK_RELATIVE(held.force, -1.5 * unit, 1e-6);
    CHECK_CLOSE(contact->at_force(0).force, 0.0, 1e-9 * unit);
}

// With w falling the elastic answer, of each law: N differs by 3 sqrt(2) (w/w_0)^(1/2) at most.
TEST(test_elastic_limit) {
    const Asperities asperities = curved(random_asperities(12, 51, 0.2).asperities, 1.4, 0.3, 400);
    for (LawKind law : {LawKind::hertz, LawKind::elliptic, LawKind::fourth_order}) {
        double before = 1;
        for (double w : {1e-6, 1e-8, 1e-10, 1e-12}) {
            const Indenter tip{kE, kInfinity, 0.5, 0.5};
            const Level e =
                make_asperity_contact(asperities, tip, sticky(0, law))->at_separation(0.004);
            const auto contact = make_asperity_contact(asperities, tip, sticky(w, law));
            const Level s = contact->at_separation(0.004);
            CHECK(s.contacts >= e.contacts);
            const double apart = std::abs(s.force / e.force - 1);
            CHECK(apart < 0.15 * before);  // the root of w: a tenth
            before = apart;
        }
        CHECK(before < 1e-4);
    }
}

}  // namespace test_adhesion
