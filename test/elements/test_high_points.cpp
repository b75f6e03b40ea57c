// Heights that elements do not read are not kept (problem/bodies.hpp, make_element_surface): levels
// are the same, bit for bit.
#include "check.hpp"
#include "physics/indenter/shapes.hpp"
#include "run/realize.hpp"

namespace test_high_points {

using namespace rsc;

Case pressed() {
    Case c;
    c.surface.L_lambda_l = 4;
    c.surface.L_lambda_s = 32;
    c.solver.model = ModelKind::elements;
    c.indentation.levels = {1.5, 0.5, 1.0};
    return c;
}

TEST(test_levels) {
    long compared = 0;
    for (const double points : {8.0, 4.0}) {  // the grid that checks them is coarser, or finer
        Case c = pressed();
        c.solids.R[1] = 1;  // few contacts at the border
        c.elements.points_per_wave = points;
        c.indentation.centre[0] = 0.3;
        c.indentation.centre[1] = 0.65;
        CHECK(reads_high_points(c));
        Case all = c;
        all.output.heights = true;
        CHECK(!reads_high_points(all));
        const Realization kept = realize(prepare(all), 1, 1);
        for (const int threads : {1, 2}) {
            const Realization some = realize(prepare(c), 1, threads);
            for (const auto k : indices(kept.levels)) {
                const Level &a = some.levels[k], &b = kept.levels[k];
                CHECK(a.contacts > 0 && a.force == b.force && a.area == b.area &&
                      a.energy == b.energy && a.pixels.index == b.pixels.index);
                // Missing in both where contacts lie at the border.
                CHECK(
                    (a.force_error_expected == b.force_error_expected ||
                     (std::isnan(a.force_error_expected) && std::isnan(b.force_error_expected))) &&
                    a.doubts == b.doubts && a.status == b.status && a.stiffness == b.stiffness);
                compared += !std::isnan(a.force_error_expected);
            }
            CHECK(some.statistics.m2_grid == kept.statistics.m2_grid &&
                  some.statistics.m4_grid == kept.statistics.m4_grid);
        }
    }
    CHECK(compared > 0);
}

TEST(test_heights) {
    const Case c = pressed();
    const Job job = prepare(c);
    const HeightMap all = make_element_surface(c, 1, 2).map;
    const Moments grid = grid_moments(all), sums = *make_element_surface(c, 1, 1).differences;
    CHECK_RELATIVE(sums.m2, grid.m2, 1e-12);
    CHECK_RELATIVE(sums.m4, grid.m4, 1e-12);
    for (const double level :
         {0.5, 2.0, 100.0}) {  // the last above all points, of which the highest is kept
        const std::vector<double> levels = {level * job.sigma};
        const HeightMap some = make_element_surface(c, 1, 2, &job.indenter, levels).map;
        double top = -1, top_all = -1;
        long missing = 0;
        for (const int j : indices(all.ny))
            for (const int i : indices(all.nx)) {
                const auto clearance = [&](const HeightMap& map) {
                    return job.indenter.clearance(i * map.dx, j * map.dy, map(i, j));
                };
                CHECK(some(i, j) == all(i, j) || (some(i, j) == 0 && clearance(all) <= levels[0]));
                missing += some(i, j) != all(i, j);
                top = std::max(top, clearance(some));
                top_all = std::max(top_all, clearance(all));
            }
        CHECK(top == top_all && missing > all.nx * all.ny / 2);
    }
    // A cone over a valley touches below the mean plane, where heights of 0 would be too high: all
    // are kept.
    int i = 0, j = 0;
    for (const int k : indices(all.nx * all.ny))
        if (all(k % all.nx, k / all.nx) < all(i, j)) {
            i = k % all.nx;
            j = k / all.nx;
        }
    Case sharp = c;
    sharp.indenter.slope = 100;
    sharp.indenter.shape = shape_number("cone");
    const Indenter cone{1.0, shape_of(sharp), i * all.dx, j * all.dy};
    const std::vector<double> levels = {job.sigma};
    const HeightMap some = make_element_surface(c, 1, 2, &cone, levels).map;
    for (const int k : indices(all.nx * all.ny))
        CHECK(some(k % all.nx, k / all.nx) == all(k % all.nx, k / all.nx));
}

}  // namespace test_high_points
