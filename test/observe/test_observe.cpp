// Observations: closed forms, maps, radial means, distributions, and their addition over
// realizations.
#include "check.hpp"
#include "observe/distributions.hpp"
#include "observe/fields.hpp"
#include "observe/map.hpp"
#include "observe/record.hpp"
#include "observe/regimes.hpp"
#include "support/asperities.hpp"
#include "support/height_maps.hpp"

namespace test_observe {

using namespace rsc;

constexpr double kRounding = 1e-13;  // a few hundred operations on numbers of order one

// The nearest level, the first of two that are equally near: rounding does not decide.
TEST(test_nearest_level) {
    for (const double rounding : {-1e-14, 0.0, 1e-14}) {
        CHECK(nearest_level({4, 3 + rounding, 2 - rounding, 1}, 2.5) == 1);
        CHECK(nearest_level({1, 2 - rounding, 3 + rounding, 2, 1}, 2.5) == 1 &&
              nearest_level({3, 1 + rounding, 1}, 1) == 1);
    }
    CHECK(nearest_level({3, 2, 1}, 2.4) == 1 && nearest_level({3, 2, 1}, 2.6) == 0 &&
          nearest_level({}, 1) == -1);
}

// A point on the border of two cells, as grid points are, belongs to the upper one, whatever its
// coordinate rounds to.
TEST(test_borders_of_cells) {
    for (const double L : {0.3, 0.7, 1.1, 2.9})
        for (const int cells : {7, 12, 49}) {
            const MapGrid grid = make_map_grid(0, 0, L, L, cells);
            const double dx = L / (3 * cells);
            for (const int i : indices(3 * cells)) CHECK(grid.cell(i * dx, 0) == i / 3);
        }
}

// On a surface that is no whole number of cells long nothing is lost: a uniform pressure on all of
// its pixels adds up to the force and the area, and every radial mean is that pressure. Tolerance:
// rounding of sums over 510 pixels and their shares.
TEST(test_oblong_maps) {
    const double dx = 0.3, dy = 0.2, p = 2.5;
    Level level;
    level.pixels.columns = 30;
    level.pixels.dx = dx;
    level.pixels.dy = dy;
    for (const int k : indices(30 * 17)) {
        level.pixels.index.push_back(k);
        level.pixels.contact.push_back(0);
        level.pixels.pressure.push_back(p);
    }
    const double Lx = 30 * dx, Ly = 17 * dy, force = p * Lx * Ly;
    level.add_contact(0, 0.5 * Lx, 0.99 * Ly, force, std::sqrt(Lx * Ly / pi), 1);
    for (const int cells : {1, 2, 3, 4, 7, 30, 45}) {
        const MapGrid grid = make_map_grid(0, 0, Lx, Ly, cells);
        const MapLevel map = map_level(grid, level);
        CHECK_RELATIVE(sum_of(map.force), force, 1e-13);
        CHECK_RELATIVE(sum_of(map.area), Lx * Ly, 1e-13);
        CHECK(map.outside == 0);
        std::vector<double> pressure(grid.cells());
        for (const auto k : indices(map.cell))
            pressure[map.cell[k]] = map.force[k] / (grid.side * grid.side);
        const RadialMean mean(grid, 0.5 * Lx, 0.5 * Ly, 9);
        CHECK_RELATIVE(mean.radii().back(), 0.5 * Ly * 17 / 18, 1e-13);
        for (const double value : mean(pressure.data())) CHECK_RELATIVE(value, p, 1e-12);
    }
}

// Of two spots one is under tension: it has an area, but no place among the pressures. Without
// contacts numbers are absent, not zero.
TEST(test_tension) {
    Level level;
    level.least_force = -1;
    level.add_contact(0, 0, 0, 1, 1, 0);
    level.add_contact(1, 0, 0, -0.1, 0.5, 0);
    const PdfBins bins = make_pdf_bins(10, 1, 1, 1, 1);
    const ShownDistributions fit = shown_distributions(bins, distributions_of(bins, level, 0));
    CHECK_RELATIVE(fit.spot_area_moments.mean, pi * 1.25 / 2, 1e-14);
    CHECK_RELATIVE(fit.mean_pressure_moments.mean, 1 / pi, 1e-14);
    const ShownDistributions none = shown_distributions(bins, distributions_of(bins, Level{}, 0));
    CHECK(std::isnan(none.spot_area_moments.mean) && std::isnan(none.mean_pressure_pdf[0]));
}

// Flattened summits lower the points around them, on periodic surfaces also across the border: as
// all points and their images tried one by one.
TEST(test_lowered_summits) {
    const int nx = 12, ny = 9;
    const HeightMap map = height_map(
        nx, ny, 0.5, 0.4, [](int i, int j) { return 1 + 0.3 * std::sin(5.0 * i + 3.0 * j); });
    const std::vector<std::array<double, 2>> places{
        {0.1, 1.7}, {5.4, 0.2}, {2.6, 3.1}, {5.3, 1.9}, {2.9, 1.3}};
    const double radius = 1.2, depth = 0.45, z = 1.3;
    for (const bool repeats : {false, true})
        for (const auto& [x, y] : places) {
            std::vector<double> got(nx * ny), expected(nx * ny);
            const ResidualProfile lowered =
                lowered_summits(map, repeats, asperities_at({{x, y, z, radius}}), {depth});
            for (const auto k : indices(lowered.depth))
                got[at(std::lround(lowered.y[k] / 0.4) * nx + std::lround(lowered.x[k] / 0.5))] +=
                    lowered.depth[k];
            for (const int k : indices(9 * nx * ny)) {
                const int image = k / (nx * ny), i = k % nx, j = k / nx % ny;
                const double dx = map.x(i + nx * (image % 3 - 1)) - x,
                             dy = map.y(j + ny * (image / 3 - 1)) - y;
                if ((repeats || image == 4) && dx * dx + dy * dy < 2 * radius * depth)
                    expected[at(j * nx + i)] += std::max(0.0, map(i, j) - (z - depth));
            }
            CHECK(sum_of(expected) > 0 && got == expected);
        }
}

}  // namespace test_observe
