#include "observe/map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "error.hpp"

namespace rsc {

int MapGrid::cell(double px, double py) const {
    const double u = (px - x0) / side, v = (py - y0) / side;
    if (!(u >= 0 && u <= nx && v >= 0 && v <= ny)) return -1;
    const int i = std::min(static_cast<int>(u), nx - 1), j = std::min(static_cast<int>(v), ny - 1);
    return j * nx + i;
}

MapGrid make_map_grid(double x0, double y0, double Lx, double Ly, int cells) {
    if (!(Lx > 0) || !(Ly > 0) || !std::isfinite(Lx) || !std::isfinite(Ly))
        throw Error(Failure::bad_input, "coarse map: the sides of the surface must be positive and finite");
    if (cells < 1) throw Error(Failure::bad_input, "coarse map: at least one cell is needed, not " + std::to_string(cells));
    MapGrid grid{x0, y0, Lx / cells, cells, 0};
    // A rectangle that is a whole number of cells up to rounding keeps its last row.
    const double rows = std::floor(Ly / grid.side * (1 + 8 * std::numeric_limits<double>::epsilon()));
    if (rows < 1)
        throw Error(Failure::bad_input, "coarse map: a cell of side " + std::to_string(grid.side) +
                                            " is larger than the surface's extent " + std::to_string(Ly) + " along y; take more map_cells");
    if (rows * cells > 1e8) throw Error(Failure::bad_input, "coarse map: more than 1e8 cells; take fewer map_cells");
    grid.ny = static_cast<int>(rows);
    return grid;
}

MapLevel map_level(const MapGrid& grid, const Level& level) {
    struct Entry {
        std::int32_t cell;
        std::size_t place;
    };
    MapLevel map;
    std::vector<Entry> entries;
    // What a level puts on the map: its pixels where it has them, each with its share of its contact's area, or its contacts.
    const LevelPixels& pixels = level.pixels;
    const bool by_pixels = !pixels.index.empty();
    const std::size_t n = by_pixels ? pixels.index.size() : level.asperity.size();
    entries.reserve(n);
    for (std::size_t k = 0; k < n; ++k) {
        const int cell = by_pixels ? grid.cell(pixels.x(k), pixels.y(k)) : grid.cell(level.x[k], level.y[k]);
        if (cell >= 0) entries.push_back({cell, k});
    }
    for (std::size_t k = 0; k < level.asperity.size(); ++k) map.outside += grid.cell(level.x[k], level.y[k]) < 0;
    std::vector<double> share(by_pixels ? level.a.size() : 0, 0.0);
    for (std::size_t k = 0; k < pixels.index.size(); ++k) share[static_cast<std::size_t>(pixels.contact[k])] += 1;
    const auto area_of = [&](std::size_t contact) { return std::numbers::pi * level.a[contact] * level.a[contact]; };
    for (std::size_t c = 0; c < share.size(); ++c) share[c] = area_of(c) / share[c];
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.cell < b.cell; });
    for (const Entry& e : entries) {
        if (map.cell.empty() || map.cell.back() != e.cell) {
            map.cell.push_back(e.cell);
            map.area.push_back(0);
            map.force.push_back(0);
        }
        map.area.back() += by_pixels ? share[static_cast<std::size_t>(pixels.contact[e.place])] : area_of(e.place);
        map.force.back() += by_pixels ? pixels.pressure[e.place] * pixels.dx * pixels.dy : level.f[e.place];
    }
    return map;
}

std::int32_t count_crowded_cells(const MapGrid& grid, const MapLevel& map) {
    const double limit = kCrowdedFraction * grid.side * grid.side;
    return static_cast<std::int32_t>(std::count_if(map.area.begin(), map.area.end(), [&](double area) { return area > limit; }));
}

}  // namespace rsc
