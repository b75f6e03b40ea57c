// A tip that moves: each level starts from those of the last places, and must be the one of a
// contact without a past.
#include "check.hpp"
#include "contact/make.hpp"
#include "support/asperities.hpp"

namespace test_moved_tip {

using namespace rsc;

// Under a large ball, a flat, and a small ball that leaves most asperities outside, to which a high
// one comes up on the way; deep and shallow.
TEST(test_way) {
    Asperities asperities = random_asperities(800, 0.01, 0.01, 0.05, 0.3, 7);
    const SolverOptions options;
    // Straight on with equal and other steps, aside, back, far away, and without a move.
    const double way[][2] = {{0.5, 0.5},       {0.5001, 0.5001}, {0.5002, 0.5002}, {0.5003, 0.5003},
                             {0.5005, 0.5005}, {0.5005, 0.502},  {0.503, 0.502},   {0.501, 0.502},
                             {0.7, 0.3},       {0.7, 0.3},       {0.71, 0.3},      {0.72, 0.3}};
    for (const double R : {2.0, kInfinity, 0.3}) {
        if (R < 1) {
            asperities.x[17] = asperities.y[17] = 0.49;
            asperities.z[17] = 0.05;
        }
        const Indenter tip{1, R, 0.5, 0.5};
        const auto moving = make_asperity_contact(asperities, tip, options);
        for (const bool forces : {false, true})
            for (const double depth : {0.02, 0.002}) {
                const double value = forces ? moving->at_separation(-depth).force : -depth;
                for (const auto& place : way) {
                    Indenter there = tip;
                    there.move(place[0], place[1]);
                    moving->move_tip(place[0], place[1]);
                    const auto fresh = make_asperity_contact(asperities, there, options);
                    const Level a = forces ? moving->at_force(value) : moving->at_separation(value);
                    const Level b = forces ? fresh->at_force(value) : fresh->at_separation(value);
                    CHECK(a.status == b.status && a.contacts > 0 && a.candidates == b.candidates &&
                          a.asperity == b.asperity);
                    CHECK(moving->first_touch() == fresh->first_touch());
                    CHECK_RELATIVE(a.force, b.force, 10 * options.tolerance);
                    CHECK_RELATIVE(a.area, b.area, 10 * options.tolerance);
                    for (std::size_t k = 0; k < std::min(a.f.size(), b.f.size()); ++k)
                        CHECK(std::abs(a.f[k] - b.f[k]) < 10 * options.tolerance * b.force);
                }
            }
    }
}

// Straight on with equal steps a level takes fewer products than without an extrapolation.
TEST(test_products) {
    const Asperities asperities = random_asperities(800, 0.01, 0.01, 0.05, 0.3, 7);
    const auto count = [&](bool straight) {
        const auto contact = make_asperity_contact(asperities, {1, 2, 0.5, 0.5}, {});
        const double force = contact->at_separation(-0.02).force;
        std::int64_t products = 0;
        for (int k = 1; k < 40; ++k) {
            contact->move_tip(0.5 + 1e-4 * (straight ? k : k % 4 / 2),
                              0.5 + 1e-4 * (straight ? 0 : (k + 1) % 4 / 2));
            products += contact->at_force(force).products;
        }
        return products;
    };
    CHECK(2 * count(true) < count(false));
}

// A force near first touch does not start from the slope of an earlier, far larger one.
TEST(forces_far_apart) {
    const Asperities asperities = random_asperities(800, 0.01, 0.01, 0.05, 0.3, 7);
    const auto contact = make_asperity_contact(asperities, {1, 2, 0.5, 0.5}, {});
    const double deep = contact->at_separation(-0.02).force;
    (void)contact->at_force(0.9 * deep);
    (void)contact->at_force(0.8 * deep);
    const Level shallow = contact->at_separation(contact->first_touch() - 1e-6);
    CHECK(shallow.contacts == 1 && contact->at_force(10 * shallow.force).products < 30);
}

// Where levels are not unique, a force at a new place costs less than two levels at its separation.
TEST(not_unique) {
    const Asperities asperities = random_asperities(800, 0.01, 0.01, 0.3, 0.3, 7);
    const auto moved = [&](bool force) {
        const auto contact = make_asperity_contact(asperities, {1, 2, 0.5, 0.5}, {});
        const Level before = contact->at_separation(-0.01);
        CHECK(!before.unique);
        contact->move_tip(0.5001, 0.5);
        return force ? contact->at_force(before.force) : contact->at_separation(-0.01);
    };
    CHECK(moved(true).products < 2 * moved(false).products);
}

// Of two summits so close that either keeps the other out of contact, a new contact finds the one
// nearer to the tip. A tip that passes over them in small steps follows that, cheaply, and is at
// the other one before penetrations have changed by some per cent.
TEST(one_of_two) {
    constexpr double between = 0.001, Z0 = -1e-4, step = 1e-4, late = 3e-3;
    const Asperities pair =
        asperities_at({{0.5 - 0.5 * between, 0.5, 0, 1}, {0.5 + 0.5 * between, 0.5, 0, 1}});
    const auto at = [&](Path& contact, double x, bool force, double value) {
        contact.move_tip(x, 0.5);
        return force ? contact.at_force(value) : contact.at_separation(value);
    };
    for (const bool force : {false, true}) {
        const auto moving = make_asperity_contact(pair, {1, 2, 0.49, 0.5}, {});
        const double value = force ? moving->at_separation(Z0).force : Z0;
        for (double x = 0.49; x < 0.51; x += step) {
            const Level level = at(*moving, x, force, value);
            const auto fresh = make_asperity_contact(pair, {1, 2, x, 0.5}, {});
            const Level alone = force ? fresh->at_force(value) : fresh->at_separation(value);
            CHECK(alone.contacts == 1 && (alone.asperity[0] == 1) == (x > 0.5));
            if (std::abs(x - 0.5) < late) continue;
            CHECK(level.asperity == alone.asperity && level.status == alone.status);
            CHECK_RELATIVE(force ? level.separation : level.force,
                           force ? alone.separation : alone.force, 1e-5);
        }
    }
}

}  // namespace test_moved_tip
