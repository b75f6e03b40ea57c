// Elements that yield (elements/element_model.hpp): the elastic and the plastic limit, work and
// energy along a path. Against a slow solver: test_element_levels.
#include "asperities/ranking.hpp"
#include "base/error.hpp"
#include "check.hpp"
#include "contact/quantities.hpp"
#include "interaction/pixel_kernels.hpp"
#include "physics/hardness/hardness.hpp"
#include "support/asperities.hpp"
#include "support/bodies.hpp"
#include "support/height_maps.hpp"
#include "support/paths.hpp"
#include "support/simpson.hpp"
#include "surface/synthesis.hpp"

namespace test_hardness_elements {

using namespace rsc;

constexpr double kE = 94706.168;
constexpr double kSigma = 0.01;
const Indenter kTip{kE, 2.5, 0.47, 0.52};

SolverOptions options(double H0, double tolerance = 1e-10) {
    return {
        .tolerance = tolerance,
        .max_iterations = 400,
        .physics = bodies_with(Hardness{.H0 = H0}),
    };
}

HeightMap rough(int n, double L_lambda_s, std::int64_t seed) {
    Spectrum spectrum{.L_lambda_l = 4, .L_lambda_s = L_lambda_s, .sigma = kSigma};
    return synthesize(spectrum, n, Normalise::sample, seed, 1);
}

double yielding_share(Path& contact, Level level, double H0) {
    const SolverOptions bodies = options(H0);
    LevelSource source{contact, level};
    source.physics = &bodies.physics;
    find_quantity("yielding_share")->quantity->compute(source);
    return level.yielding_share;
}

TEST(test_limits) {
    const HeightMap map = rough(96, 12, 1);
    const auto elastic = make_element_contact(map, kTip, options(kInfinity)),
               hard = make_element_contact(map, kTip, options(1e30)),
               soft = make_element_contact(map, kTip, options(1e-3));
    CHECK(!elastic->path_dependent() && hard->path_dependent());
    for (const double z : {1.5, 0.7, 1.1, 0.0}) {
        const Level e = elastic->at_separation(z * kSigma), h = hard->at_separation(z * kSigma);
        CHECK(e.pixels.pressure == h.pixels.pressure && e.f == h.f && e.a == h.a &&
              e.force == h.force && e.area == h.area);
        CHECK(elastic->energy() == hard->energy() && elastic->stiffness() == hard->stiffness());
        CHECK(e.plastic_contacts == 0 && std::isnan(e.plastic_work) && h.plastic_contacts == 0 &&
              h.plastic_work == 0);
        CHECK(e.yields.empty() && h.yields.size() == h.f.size());
        CHECK(std::isnan(yielding_share(*elastic, e, kInfinity)) &&
              yielding_share(*hard, h, 1e30) == 0);
    }
    CHECK(hard->remains(Level{}).residual_profile.depth.empty());
    for (const double z : {1.5, 0.7, 0.0}) {
        const Level s = soft->at_separation(z * kSigma);
        CHECK(s.plastic_contacts == s.contacts && s.contacts > 0);
        CHECK_RELATIVE(s.area, s.force / 1e-3, 1e-12);
        CHECK_RELATIVE(s.area, s.area_pixels, 1e-12);
        CHECK(yielding_share(*soft, s, 1e-3) == 1);
    }
    // The share that yields carries H times its area, and the rest less than that.
    const double H = 1000;
    const auto some = make_element_contact(map, kTip, options(H));
    const Level level = some->at_separation(0.7 * kSigma);
    const double share = yielding_share(*some, level, H);
    CHECK(share > 0 && share < 1 && share * H * level.area_pixels < level.force &&
          level.force < H * level.area_pixels);
    SolverOptions scaled = options(1000);
    scaled.physics.of<Hardness>().length = 1e-3;
    CHECK_THROWS(make_element_contact(map, kTip, scaled), Error);
    scaled.physics.of<Hardness>().H0 = kInfinity;
    CHECK(make_element_contact(map, kTip, scaled)->at_separation(kSigma).force > 0);
}

// A smooth sphere yields where its highest pressure 2 E* a/(pi R) reaches H, at the depth (pi H/(2
// E*))^2 R.
TEST(test_sphere) {
    const double R = 2.5, H = 60, depth = std::pow(pi * H / (2 * kE), 2) * R,
                 a = std::sqrt(R * depth);
    double fine = 0, counted_fine = 0;
    for (const double cells :
         {15.0, 40.0,
          10.0}) {  // pixels a radius at the first yield, the finest of the loaded ones first
        const double h = a / cells;
        const int n = int(7 * cells);
        const HeightMap map = flat_map(n, n, h, h);
        const Indenter tip{kE, R, (0.5 * n + 0.31) * h, (0.5 * n - 0.17) * h};
        const auto contact = make_element_contact(map, tip, options(H, 1e-8));
        if (cells == 15.0) {
            // Pixels know the peak of the pressure to some h^2/a^2.
            CHECK(contact->at_separation(-0.99 * depth).plastic_contacts == 0);
            CHECK(contact->at_separation(-1.01 * depth).plastic_contacts == 1);
            continue;
        }
        const Level level = contact->at_separation(-6 * depth);
        if (cells == 40.0) {
            fine = level.area;
            counted_fine = level.area_pixels;
            continue;
        }
        // The area is nearer to the finer grid's than the count is.
        CHECK(std::abs(level.area / fine - 1) < 0.045 / cells);
        CHECK(level.area_pixels / counted_fine - 1 > 0.025 / cells);
    }
    CHECK(counted_fine > fine);
    // The law of asperities that goes for the truth, fourth_order, on the same sphere; bounds as
    // hardness.hpp has them, in u_c = 9/4 of that depth.
    const double h = a / 16;
    const int n = 16 * 16;
    const HeightMap map = flat_map(n, n, h, h);
    const auto contact = make_element_contact(
        map, {kE, R, (0.5 * n + 0.31) * h, (0.5 * n - 0.17) * h}, options(H, 1e-8));
    const Asperities one = curved(asperities_at({{0.5 * n * h, 0.5 * n * h, 0, R}}), 1);
    SolverOptions law = options(H);
    law.law = LawKind::fourth_order;
    Path asperity = asperity_path(one, {kE, kInfinity, 0.5 * n * h, 0.5 * n * h}, law);
    const struct {
        double times, off;  // of u_c
    } bounds[] = {{0.44, 0.005}, {1, 0.06}, {2, 0.03}, {5, 0.015}};
    for (const auto& [times, off] : bounds) {
        const double Z0 = -times * 2.25 * depth;
        const Level truth = contact->at_separation(Z0), model = asperity.at_separation(Z0);
        CHECK_RELATIVE(model.force, truth.force, off);
        CHECK_RELATIVE(model.area, truth.area, 0.06);
    }
}

// N = -dW/dZ0 and S = -dN/dZ0 on the way back; work put in = elastic energy + work lost; the loop's
// area = work lost.
TEST(test_work) {
    const HeightMap map = rough(64, 8, 3);
    const double H = 6000, top = 2.2 * kSigma, bottom = 0.2 * kSigma;
    const auto contact = make_element_contact(map, kTip, options(H, 1e-9));
    CHECK(contact->at_separation(top).force == 0);
    Level level;
    const auto force = [&](double Z0) {
        level = contact->at_separation(Z0);
        return level.force;
    };
    // Simpson, with kinks where pixels touch and yield, and levels 1/200 of the way apart.
    const double spent = -simpson(top, bottom, 200, force), lost = level.plastic_work;
    CHECK_RELATIVE(spent, contact->energy() + lost, 2e-4);
    CHECK(contact->energy() < 0.9 * spent && contact->energy() > 0.1 * spent);
    // From the deepest point back: what yielded is elastic at once, and stiffer than while it
    // yields. One-sided differences of second order.
    const double S = contact->stiffness(), W = contact->energy(), N = level.force,
                 d = 1e-4 * kSigma;
    const double N1 = force(bottom + d), W1 = contact->energy(), N2 = force(bottom + 2 * d);
    CHECK_RELATIVE((-1.5 * N + 2 * N1 - 0.5 * N2) / d, S, 1e-3);
    CHECK_RELATIVE((W - W1) / d, 0.5 * (N + N1), 1e-4);
    const double work = spent - simpson(bottom, top, 200, force);
    CHECK(lost > 0.1 * spent);
    CHECK_CLOSE(work, level.plastic_work, 2e-4 * spent);
    CHECK(contact->energy() == 0 && contact->stiffness() == 0);
}

// On a ramp as many points as yield span the depth that a force as large again goes down, wherever
// the ramp is.
TEST(test_further_approach) {
    const SolverOptions hard = options(2);
    const double step = 0.25;
    Level level;
    level.plastic_contacts = 1;
    level.pixels.pressure.assign(100, 1.0);
    std::fill_n(level.pixels.pressure.begin(), 30, 2.0);
    for (const double base : {0.0, 5.0}) {
        const HeightMap ramp =
            height_map(40, 5, 1, 1, [&](int i, int j) { return base + step * (i + 40 * j); });
        CHECK_RELATIVE(kHardness.further_approach(level, ramp, {kE, kInfinity}, hard.physics),
                       30 * step, 1e-12);
    }
}

}  // namespace test_hardness_elements
