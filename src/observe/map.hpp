// Coarse maps of area fraction and pressure (paper, section 5): contacts are sorted into square cells by their (x, y).
#pragma once

#include <cstdint>
#include <vector>

#include "contact/level.hpp"

namespace rsc {

// nx x ny square cells of side `side` from the corner (x0, y0); cell (i, j) is number j*nx + i, its centre at
// (x0 + (i + 1/2) side, y0 + (j + 1/2) side).
struct MapGrid {
    double x0 = 0, y0 = 0;  // [length]
    double side = 0;        // [length]
    int nx = 0, ny = 0;
    int cells() const { return nx * ny; }
    double x(int i) const { return x0 + (i + 0.5) * side; }
    double y(int j) const { return y0 + (j + 0.5) * side; }
    double Lx() const { return nx * side; }
    double Ly() const { return ny * side; }
    // The cell in which a point lies, -1 outside. A cell owns its lower edges; the far edges of the map belong to its last cells.
    int cell(double px, double py) const;
};

// `cells` cells along x over a surface Lx x Ly from (x0, y0), and as many rows of the same cells as fit into Ly.
// Throws Error(bad_input) if sides or cells are not positive, or if no row fits (Ly < Lx/cells).
MapGrid make_map_grid(double x0, double y0, double Lx, double Ly, int cells);

// The cells of one level that hold contacts, by increasing cell number. Most cells of most levels are empty, and a campaign
// holds many of these at a time.
struct MapLevel {
    std::vector<std::int32_t> cell;
    std::vector<double> area;   // contact area in the cell [length^2]
    std::vector<double> force;  // sum of f in the cell [force]
    std::int32_t outside = 0;   // contacts outside the map: in the level's sums, in no cell
};

// Contacts go to the cell of their place, elliptic spots with what is theirs alone of the area of their union; pixels of a level that has
// them are shared by the cells they lie in.
MapLevel map_level(const MapGrid& grid, const Level& level);

// The area fraction beyond which a cell of contacts counts as crowded: spots in a square array touch at pi/4; interaction by
// point forces is trusted to a quarter of that, pi/16 = 19.6 %.
inline constexpr double kCrowdedFraction = 0.19634954084936207;

std::int32_t count_crowded_cells(const MapGrid& grid, const MapLevel& map);

}  // namespace rsc
