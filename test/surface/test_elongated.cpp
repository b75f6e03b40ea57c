// Single elongated summits, up to 1:20 in curvature, against elements on the same points.
#include "check.hpp"
#include "problem/bodies.hpp"
#include "support/height_maps.hpp"
#include "support/paths.hpp"
#include "surface/detection.hpp"
#include "surface/synthesis.hpp"

namespace test_elongated {

using namespace rsc;

TEST(all_elongated) {
    constexpr double E = 1e5, height = 0.01, step = 1.0 / 200;
    for (const double ratio : {1.0, 5.0, 20.0}) {
        const double narrow = std::sqrt(ratio);
        const int half = 100, short_half = int(half / narrow);
        const auto wave = [](double x) { return std::cos(2 * pi * x); };
        HeightMap map = height_map(2 * half + 1, 2 * short_half + 1, step, step, [&](int i, int j) {
            return 0.5 * height *
                   (wave((i - half) * step) + wave(narrow * (j - short_half) * step));
        });
        map.x0 = -half * step;
        map.y0 = -short_half * step;
        const Asperities summit =
            find_asperities(map, Curvature::geometric, nullptr, 1, Detail::subgrid);
        CHECK(summit.size() == 1);
        CHECK_RELATIVE(summit.kappa1[0] / summit.kappa2[0], ratio, 1e-3);
        SolverOptions options{.law = LawKind::fourth_order, .max_iterations = 500};
        const Indenter ball{E, Shape(1000), 0, 0};
        Path one = asperity_path(summit, ball, options);
        const auto points = make_element_contact(map, ball, options);
        for (const double Z0 : {0.9 * height, 0.6 * height}) {
            const Level model = one.at_separation(Z0), truth = points->at_separation(Z0);
            // The round profile in place of the ellipse's carries 13 % too much, on an area 79 %
            // too large, at 1:20.
            CHECK_RELATIVE(model.force, truth.force, 0.015);
            CHECK_RELATIVE(model.area, truth.area, 0.08);
        }
    }
}

// Maps with a lay carry what their mirror images carry, a contact that has reached the trough of
// its profile (seed 2), too: there a rounding error of the argument was one of 1e-8 of the force.
TEST(mirrored) {
    for (const int seed : {1, 2, 3}) {
        const HeightMap z = synthesize({.L = 1.28,
                                        .L_lambda_l = 2,
                                        .L_lambda_s = 30,
                                        .sigma = 1e-3,
                                        .aspect = 3,
                                        .direction = 30},
                                       128, Normalise::sample, seed, 1);
        const auto force = [&](bool mirrored) {
            Case c;
            c.solver.tolerance = 1e-12;
            c.solids.R[1] = 5;
            c.asperities.law = LawKind::fourth_order;
            c.solver.model = ModelKind::asperities;
            Surface surface;
            surface.map = height_map(97, 99, 0.01, 0.01,
                                     [&](int i, int j) { return z(mirrored ? 96 - i : i, j); });
            surface.sigma = 1e-3;
            const SurfaceModel model = make_surface_model(surface, c, 1);
            return make_contact(model, indenter_of(c, model.domain), solver_of(c, model.domain))
                ->at_separation(5e-4)
                .force;
        };
        constexpr double kMirrored = 1e-12;
        CHECK_RELATIVE(force(true), force(false), kMirrored);
    }
}

}  // namespace test_elongated
