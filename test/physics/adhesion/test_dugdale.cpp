// Asperities that attract within a range (physics/adhesion/sticking.hpp): against Maugis's
// equations, and JKR as its limit.
#include "base/error.hpp"
#include "support/adhesive_paths.hpp"

namespace test_dugdale {

using namespace rsc;

// The loop of one asperity: at the penetrations of Maugis's states it carries his force; the
// energy's derivative is the force; it attaches at u = -z0; the work of a cycle is the energy lost.
TEST(test_one) {
    for (double lambda : {0.1, 1.0, 5.0}) {
        const Maugis truth{0.7, 0.01, lambda, kE};
        const double unit = pi * truth.w * truth.r, range = truth.range();
        const Asperities a = asperities_at({{0.5, 0.5, 0, truth.r}});
        const auto contact = under_flat(a, sticky(truth.w, range));
        CHECK(contact->at_separation(range * (1 + 1e-7)).force == 0);
        CHECK(contact->at_separation(range * (1 - 1e-7)).force < 0);
        for (double m = 1 + 0.01 / lambda; m < 30; m *= 1.02) {
            const Maugis::State state = truth.at(m);
            if (truth.at(1.02 * m).u > state.u - 1e-3 * range) break;  // near the last stable one
            const Level level = contact->at_separation(-state.u);
            if (level.contacts == 0) continue;
            CHECK_CLOSE(level.force, state.f, 1e-8 * std::max(unit, std::abs(state.f)));
            CHECK_CLOSE(level.a.at(0), state.a, 1e-7 * state.a + 1e-9 * truth.r);
            const double step = 1e-5 * range, energy = contact->energy();
            (void)contact->at_separation(-state.u - step);
            const double change = contact->energy() - energy;
            (void)contact->at_separation(-state.u);
            CHECK_CLOSE(change / step, level.force, 2e-3 * std::max(unit, std::abs(state.f)));
        }
    }
}

// A weak attraction of long range: an asperity attaches and lets go at almost the same penetration.
// It does so once each in a cycle, and the loss does not depend on the number of levels. (The
// distance to the detachment point at which an asperity lets go was once larger than that
// difference: it attached again at once, a thousand times.)
TEST(test_narrow_loop) {
    const Maugis weak{0.7, 0.01, 0.04, kE};
    const Asperities a = asperities_at({{0.5, 0.5, 0, weak.r}});
    const double range = weak.range();
    std::vector<double> lost;
    for (const int levels : {1, 7, 200}) {
        const auto contact = under_flat(a, sticky(weak.w, range));
        int jumps = 0;
        Level level;
        for (int k = -levels; k <= levels; ++k) {
            level = contact->at_separation(range * (3.0 * std::abs(k) / levels - 1));
            jumps += level.jumps;
        }
        CHECK(jumps == 2 && level.force == 0 && level.energy_lost > 0);
        lost.push_back(level.energy_lost);
    }
    CHECK_RELATIVE(lost[0], lost[2], 1e-6);
    CHECK_RELATIVE(lost[1], lost[2], 1e-6);
}

// With a range that goes to 0 the answer is JKR's, for circular and elliptic contacts and many of
// them.
TEST(test_limit) {
    const Asperities a = curved(random_asperities(12, 3, 0.1).asperities, 1.4, 0.3, 400);
    for (LawKind law : {LawKind::hertz, LawKind::elliptic}) {
        double before = 1;
        for (double range : {3e-4, 1e-4, 3e-5}) {
            SolverOptions with = sticky(1e-3, range), jkr = sticky(1e-3, 0);
            with.law = jkr.law = law;
            const auto one = under_flat(a, with), other = under_flat(a, jkr);
            (void)one->at_separation(-0.01);
            (void)other->at_separation(-0.01);
            const double there = other->at_separation(0.005).force,
                         apart = std::abs(one->at_separation(0.005).force / there - 1);
            CHECK(apart < 0.6 * before);
            before = apart;
        }
        CHECK(before < 0.01);
    }
    SolverOptions refused = sticky(1e-3, 1e-4);
    refused.law = LawKind::fourth_order;
    CHECK_THROWS((void)under_flat(a, refused), Error);
}

}  // namespace test_dugdale
