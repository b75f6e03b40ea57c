// A tip that moves sideways over attached asperities that interact: its work over a closed cycle is
// the energy lost.
#include "check.hpp"
#include "contact/answers.hpp"
#include "contact/make.hpp"
#include "support/adhesive_paths.hpp"
#include "support/bodies.hpp"

namespace test_adhesive_moves {

using namespace rsc;

// Moves the tip along x at the separation Z, and returns the work of the lateral force. Where no
// asperity attaches or detaches, the work of a step is also the change of the energy. Jumps are
// found by going back to the memory and halving the way.
double work_of_move(Path& contact, double Z, double end, int& jumps) {
    double work = 0;
    constexpr double longest = 4e-3, least = 1e-9, precise = 1e-10;
    const auto force_at = [&](double x, Level& level) {
        contact.move_tip(x, 0.5);
        level = contact.at_separation(Z);
        return -lateral_force(contact.indenter(), level).x;
    };
    const std::function<void(double, int)> go = [&](double to, int depth) {
        const double from = contact.indenter().x0, middle = 0.5 * (from + to), width = to - from;
        const Path::State memory = contact.state();
        Level begin, half, last;
        const double f = force_at(from, begin), energy = contact.energy(), g = force_at(to, last),
                     change = contact.energy() - energy;
        const bool jump = last.energy_lost != begin.energy_lost;
        contact.restore(memory);
        if (jump && std::abs(width) < least) {
            work += 0.5 * width * (f + g);
            (void)force_at(to, last);
            ++jumps;
            return;
        }
        const double m = force_at(middle, half), simpson = width * (f + 4 * m + g) / 6;
        if (jump || (std::abs(simpson - 0.5 * width * (f + g)) > precise && depth < 30)) {
            contact.restore(memory);
            go(middle, depth + 1);
            go(to, depth + 1);
            return;
        }
        CHECK_CLOSE(simpson, change, 0.1 * precise);
        work += simpson;
        (void)force_at(to, last);
    };
    while (contact.indenter().x0 != end) {
        const double rest = end - contact.indenter().x0;
        go(std::abs(rest) < longest ? end : contact.indenter().x0 + std::copysign(longest, rest),
           0);
    }
    return work;
}

TEST(test_cycle) {
    for (const double range : {0.0, 0.002}) {
        const RandomAsperities system = random_asperities(6, 31, 0.2);
        SolverOptions options{.tolerance = 1e-12,
                              .physics = bodies_with(Adhesion{system.w, range})};
        const auto contact =
            make_asperity_contact(system.asperities, {5.0, 5.0, 0.1, 0.5}, options);
        const double Z = 0.006;
        (void)contact->at_separation(Z);
        int jumps = 0;
        (void)work_of_move(*contact, Z, 0.9, jumps);
        (void)work_of_move(*contact, Z, 0.1, jumps);
        const double energy = contact->energy(), lost = contact->at_separation(Z).energy_lost;
        jumps = 0;
        const double work =
            work_of_move(*contact, Z, 0.9, jumps) + work_of_move(*contact, Z, 0.1, jumps);
        CHECK(jumps >= 2);
        CHECK_RELATIVE(contact->energy(), energy, 1e-7);
        CHECK_RELATIVE(work, contact->at_separation(Z).energy_lost - lost, 1e-5);
    }
}

// A steep tip that moves away from the one asperity it holds lets go of it: nothing is left, and
// the level is that of a new contact there.
TEST(test_lets_go) {
    const Asperities one = curved(asperities_at({{0.5, 0.5, 0, 0.05}}), 1);
    SolverOptions options{.law = LawKind::elliptic,
                          .physics = bodies_with(Adhesion{1e-3, 0}),
                          .surface = {.gentlest_slope = 0.1}};
    const auto held = make_asperity_contact(one, {5.0, 0.1, 0.5, 0.5}, options);
    const double Z = held->first_touch() + 1e-4;
    (void)held->at_separation(Z - 1e-3);
    CHECK(held->at_separation(Z).force < 0);
    held->move_tip(0.56, 0.5);
    const Level level = held->at_separation(Z);
    CHECK(level.contacts == 0 && level.force == 0 && held->energy() == 0 && level.jumps == 1);
    CHECK(level.energy_lost > 0);
    const auto other = make_asperity_contact(one, {5.0, 0.1, 0.56, 0.5}, options);
    CHECK_RELATIVE(held->first_touch(), other->first_touch(), 1e-9);
}

}  // namespace test_adhesive_moves
