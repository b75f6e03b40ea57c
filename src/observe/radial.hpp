// Radial means of a coarse map about the tip (paper, section 5): bicubic Bezier interpolation between cell centres, averaged
// over circles.
#pragma once

#include <array>
#include <vector>

#include "observe/map.hpp"

namespace rsc {

// Interpolation on n equispaced nodes 0, 1, ..., n-1 at a position s, as weights of `count` nodes from `first` on.
//
// Between nodes i and i+1 the curve is a cubic Bezier with control points f_i, f_i + t_i/3, f_(i+1) - t_(i+1)/3, f_(i+1). The
// tangents are those of Catmull and Rom, t_i = (f_(i+1) - f_(i-1))/2, inside, and the slopes of the parabola through the three
// outermost nodes at the two ends. Both are exact for parabolas, so the curve reproduces them everywhere; it is continuously
// differentiable, and linear in the data. Beyond the end nodes the end piece goes on (a map reaches half a cell beyond its
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
    // What a cell adds to the means: weight_[k] of its value to that over circle circle_[k], k in [start_[cell], start_[cell+1]).
    std::vector<std::size_t> start_;
    std::vector<int> circle_;
    std::vector<double> weight_;
};

}  // namespace rsc
