// Adhesive elements on layered bodies (physics/adhesion/adhesive_elements.hpp,
// interaction/layers.hpp), free and between flats.
#include "check.hpp"
#include "contact/make.hpp"
#include "interaction/kernel.hpp"
#include "support/adhesive_paths.hpp"
#include "support/height_maps.hpp"

namespace test_adhesive_layers {

using namespace rsc;

constexpr int kSide = 40;
constexpr double kStep = 0.025, kWork = 0.01, kRange = 0.06;

HeightMap bumps() {
    return height_map(kSide, kSide, kStep, kStep, [](int i, int j) {
        return 0.01 * (std::cos(0.9 * i + 0.3 * j) + std::cos(0.5 * i - 0.8 * j + 1));
    });
}

Indenter over(const LayeredBody& body, bool flats) {
    const Layer top = body.count > 0 ? body.layer[0] : Layer{1, body.E, body.nu};
    Indenter tip{top.E / (1 - top.nu * top.nu), flats ? kInfinity : 1.0, 0.5, 0.5, {}};
    if (flats) tip.period = {kSide * kStep, kSide * kStep};
    tip.layers = body;
    return tip;
}

LayeredBody body_of(const Layer& layer, double E, double nu) { return {1, {layer}, E, nu}; }

// From where nothing attracts into contact and back.
constexpr int kLevels = 7;
double separation(bool flats, int k, int levels = kLevels) {
    const double low = flats ? 0.005 : -0.06, high = 0.13;
    return high + (low - high) * (1 - std::abs(2.0 * k / (levels - 1) - 1));
}

// Conditions of every point, with deflections by direct sums of the free kernel; the work of the
// levels is the energy lost.
void test_conditions(bool flats, const LayeredBody& body, bool fine) {
    const HeightMap map = bumps();
    const Indenter tip = over(body, flats);
    const auto contact = make_element_contact(map, tip, sticky(kWork, kRange));
    const Substrate substrate = substrate_of(tip);
    std::vector<double> kernel;
    for (const int i : indices(kSide * kSide))
        kernel.push_back(substrate.under_pixel(i % kSide * kStep, i / kSide * kStep, kStep, kStep));
    const double s0 = kWork / kRange;
    Level before = contact->at_separation(separation(flats, 0));
    CHECK(before.force == 0);
    for (int k = 1; k < kLevels; ++k) {
        const Level level = contact->at_separation(separation(flats, k));
        CHECK(level.converged);
        CHECK(level.energy_lost >= 0);
        before = level;
        if (flats) continue;
        std::vector<double> p(kSide * kSide, 0.0);
        std::vector<char> contacts(p.size(), 0);
        for (const auto m : indices(level.pixels.index)) {
            const auto i = level.pixels.index[m];
            p[i] = level.pixels.pressure[m];
            contacts[i] = 1;
            CHECK(p[i] >= -s0);
        }
        for (const auto m : indices(level.pixels.cohesive))
            p[level.pixels.cohesive[m]] = level.pixels.attraction[m];
        for (int i = 0; i < kSide * kSide; i += 3) {
            double gap = level.separation - tip.clearance(i % kSide * kStep, i / kSide * kStep,
                                                          map(i % kSide, i / kSide));
            for (const int j : indices(kSide * kSide))
                gap += p[j] * kernel[std::abs(i / kSide - j / kSide) * kSide +
                                     std::abs(i % kSide - j % kSide)];
            // The gap is linear between points: a part of s0 acts where a neighbour is within the
            // range, all of it where all are.
            const double own = p[i];
            if (contacts[i])
                CHECK_CLOSE(gap, 0, 1e-5 * kRange);
            else
                CHECK(gap > -1e-5 * kRange && own <= 0 && own >= -s0 * (1 + 1e-9));
            if (gap < kRange * (1 - 1e-5)) CHECK(own > -s0 * (1 + 1e-9) && own != 0);
            if (own == 0) CHECK(gap > kRange * (1 - 1e-5));
        }
    }
    CHECK(before.force == 0 && contact->energy() == 0);
    if (!fine) return;
    // Many levels: the area of the loop, to what is resolved of the attraction's work.
    const auto again = make_element_contact(map, tip, sticky(kWork, kRange));
    constexpr int many = 121;
    double work = 0;
    Level last = again->at_separation(separation(flats, 0));
    for (int k = 1; k < many; ++k) {
        const Level level = again->at_separation(separation(flats, k, many));
        work += 0.5 * (last.force + level.force) * (last.separation - level.separation);
        last = level;
    }
    for (const Level& end : {last, before}) CHECK_CLOSE(end.energy_lost, work, 1e-3 * kWork);
}

TEST(adhesive_layers) {
    for (const bool flats : {false, true}) {
        test_conditions(flats, body_of({0.1, 1, 0.3}, 10, 0.3), false);
        test_conditions(flats, body_of({0.1, 10, 0.3}, 1, 0.3), false);
        test_conditions(flats, body_of({0.1, 1, 0.5}, kInfinity, 0.3),
                        flats);  // bulges around pressure
    }
}

}  // namespace test_adhesive_layers
