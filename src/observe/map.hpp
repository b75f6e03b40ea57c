// Coarse maps of area fraction and pressure, and their radial means (paper, section 5).
#pragma once

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

// Radial means of a coarse map about the tip (paper, section 5): bicubic Bezier interpolation between cell centres, averaged
// over circles.

// Interpolation on n equispaced nodes 0, 1, ..., n-1 at a position s, as weights of `count` nodes from `first` on.
//
// Between nodes i and i+1 the curve is a cubic Bezier with control points f_i, f_i + t_i/3, f_(i+1) - t_(i+1)/3, f_(i+1). The
// tangents are those of Catmull and Rom, t_i = (f_(i+1) - f_(i-1))/2, inside, and the slopes of the parabola through the three
// outermost nodes at the two ends. Both are exact for parabolas, so the curve reproduces them everywhere; it is continuously
// differentiable, and linear in the data. Beyond the end nodes the end piece is extended (a map reaches half a cell beyond its
// outermost centres). Two nodes give the line, one the constant.
struct BezierWeights {
    int first = 0, count = 0;
    std::array<double, 4> weight{};
};
BezierWeights bezier_weights(int n, double s);

// The map's value at a point: tensor product of the above along x and y. `values` has grid.cells() entries.
double interpolate(const MapGrid& grid, const std::vector<double>& values, double px, double py);

// Means over circles about a point, for many maps of one grid. Since they are linear in the map they are prepared once, and the
// mean over realizations of radial means is the radial mean of the mean map.
class RadialMean {
public:
    // `bins` rings of equal width between the centre (x0, y0) and the largest circle inside the map; a mean is taken on the
    // circle in the middle of its ring. No ring at all if the centre lies outside the map or on its edge.
    RadialMean(const MapGrid& grid, double x0, double y0, int bins);

    const std::vector<double>& radii() const { return radii_; }  // middle of the rings [length]
    double ring_width() const { return ring_width_; }            // [length]
    // Mean of a map (grid.cells() values) over each circle: over equispaced angles, at least 64 and at least 8 a cell side, which
    // is exact for parabolic maps. Added up in the order of the cells; those that hold nothing cost nothing.
    std::vector<double> operator()(const double* values) const;

private:
    std::vector<double> radii_;
    double ring_width_ = 0;
    // Contribution of a cell to the means: weight_[k] of its value to the mean over circle circle_[k], k in [start_[cell], start_[cell+1]).
    std::vector<std::size_t> start_;
    std::vector<int> circle_;
    std::vector<double> weight_;
};

}  // namespace rsc
