// Observations: closed forms, maps, radial means, distributions, and their addition over
// realizations.
#include "check.hpp"
#include "observe/distributions.hpp"
#include "observe/map.hpp"
#include "observe/record.hpp"
#include "observe/regimes.hpp"

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

__extension__ using Wide = __int128;

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

// Against integers: in any order, in any groups.
TEST(test_exact_sums) {
    constexpr double kScale = 1e-3;
    const double quantum = quantum_of(kScale, 64);
    std::mt19937_64 random(7);
    std::vector<double> values(5000);
    for (double& v : values)
        v = kScale *
            std::exp2(-40.0 * std::generate_canonical<double, 53>(random));  // of very unlike sizes
    Wide truth = 0;
    for (double v : values) {
        CHECK(std::abs(exact_term(v, quantum).high - v) <= quantum / 2);
        truth += static_cast<Wide>(exact_term(v, quantum).high / quantum);
    }
    for (int trial = 0; trial < 5; ++trial) {
        ExactSum whole, group;
        for (const auto k : indices(values)) {
            group.add(exact_term(values[k], quantum));
            if (random() % 10 == 0 || k + 1 == values.size()) {
                whole.add(group);
                group = {};
            }
        }
        const Wide high = static_cast<Wide>(whole.high / quantum);
        CHECK(high + static_cast<Wide>(whole.low / quantum) == truth);
        CHECK(whole.high == double(truth) * quantum);  // the nearest double
        std::shuffle(values.begin(), values.end(), random);
    }
    // Where the quantum would leave the range of doubles, and of nothing.
    CHECK(exact_term(1e-305, quantum_of(1e-300, 64)).high == 1e-305);
    CHECK(exact_term(0.3, quantum_of(0, 0)).high == 0.3);
}

}  // namespace test_observe
