// Coarse maps of area fraction and pressure, and their radial means (paper, section 5).
#pragma once

#include "contact/level.hpp"

namespace rsc {

// nx x ny square cells of side `side` from the corner (x0, y0); cell (i, j) is number j*nx + i, its
// centre at (x0 + (i + 1/2) side, y0 + (j + 1/2) side).
struct MapGrid {
    double x0 = 0, y0 = 0;  // [length]
    double side = 0;        // [length]
    int nx = 0, ny = 0;
    double Ly = 0;        // side of the surface [length], beyond which the last row may extend
    double last_row = 1;  // share of the last row that lies on the surface
    int cells() const { return nx * ny; }
    double x(int i) const { return x0 + (i + 0.5) * side; }
    double y(int j) const { return y0 + (j + 0.5) * side; }
    double Lx() const { return nx * side; }
    // Index of the cell that contains a point, -1 outside. Lower edges belong to a cell; the upper
    // edges of the map belong to its last cells.
    int cell(double px, double py) const;
};

// Grid over a surface Lx x Ly from (x0, y0): `cells` cells along x, and as many rows of these cells
// as cover Ly; the last one may extend beyond the surface. Throws Error(bad_input) if sides or
// cells are not positive.
MapGrid make_map_grid(double x0, double y0, double Lx, double Ly, int cells);

// Cells of one level that hold contacts, by increasing cell number. It is sparse, because most
// cells are empty and a campaign stores many maps.
struct MapLevel {
    std::vector<std::int32_t> cell;
    std::vector<double> area;  // contact area in the cell [length^2]
    // Sum of f in the cell, with adhesion also of places that attract without contact [force].
    std::vector<double> force;
    // contacts outside the map: included in the sums of the level, but in no cell
    std::int32_t outside = 0;
};

// Coarse map of a level. A contact is assigned to the cell of its centre, with its area (for
// elliptic spots its own part of their union).
// If the level has pixels, these are distributed over the cells that they overlap.
MapLevel map_level(const MapGrid& grid, const Level& level);

// Area fraction beyond which a cell counts as crowded. Spots in a square array touch at pi/4; point
// forces describe their interaction well up to a quarter of that, pi/16 = 19.6 %.
inline constexpr double kCrowdedFraction = 0.19634954084936207;

std::int32_t count_crowded_cells(const MapGrid& grid, const MapLevel& map);

// Radial means of a coarse map about the tip (paper, section 5) by bicubic Bezier interpolation
// between cell centres.

// Interpolation on n equispaced nodes 0, 1, ..., n-1 at a position s, as weights of `count` nodes
// from `first` on.
//
// Between nodes i and i+1 the curve is a cubic Bezier with control points f_i, f_i + t_i/3, f_(i+1)
// - t_(i+1)/3, f_(i+1). The tangents are those of Catmull and Rom, t_i = (f_(i+1) - f_(i-1))/2, at
// inner nodes, and the slopes of the parabola through the three outermost nodes at the two ends.
// The interpolation is continuously differentiable, linear in the data and exact for parabolas. It
// is extrapolated beyond the end nodes, because a map extends half a cell beyond its outermost
// centres. Two nodes define a line, one node a constant.
struct BezierWeights {
    int first = 0, count = 0;
    std::array<double, 4> weight{};
};
BezierWeights bezier_weights(int n, double s);

// Means over circles about a point, for many maps of one grid. They are linear in the map: their
// weights are computed once, and the mean of radial means over realizations is the radial mean of
// the mean map.
class RadialMean {
public:
    // `bins` rings of equal width between the centre (x0, y0) and the largest circle on the
    // surface; a mean is taken over the circle in the middle of its ring. The last row counts with
    // its mean over the part on the surface. There are no rings if the centre lies outside the map
    // or on its edge.
    RadialMean(const MapGrid& grid, double x0, double y0, int bins);

    const std::vector<double>& radii() const { return radii_; }  // middle of the rings [length]
    // Mean of a map (grid.cells() values) over each circle, at equispaced angles (at least 64, and
    // at least 8 per cell side), exact for parabolic maps. Cells are summed in order; empty cells
    // are skipped.
    std::vector<double> operator()(const double* values) const;

private:
    std::vector<double> radii_;
    // A cell contributes `weight` times its value to the mean over a circle.
    struct Part {
        std::uint32_t cell, circle;
        double weight;
    };
    std::vector<Part> parts_;         // in the order of the cells
    std::vector<std::size_t> first_;  // part of each cell, and the end
};

}  // namespace rsc
