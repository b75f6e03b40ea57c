// A point of a grid of heights and its eight neighbours. Rows are given by pointers, `below` (smaller y), `z` and `above`; the point is in
// column i, its neighbours along the row are in columns l and r, which at the seam of a periodic map are not i - 1 and i + 1.
#pragma once

#include "rough/asperities.hpp"
#include "rough/dispatch.hpp"

namespace rsc {

// Strictly above all eight. Without branches, so that a loop over points can be vectorised.
RSC_ALWAYS_INLINE bool above_neighbours(const double* below, const double* z, const double* above, int l, int i, int r) {
    const double h = z[i];
    return (h > z[l]) & (h > z[r]) & (h > below[l]) & (h > below[i]) & (h > below[r]) & (h > above[l]) & (h > above[i]) & (h > above[r]);
}

// Derivatives at the point by central differences; x and y in grid steps.
struct PointDifferences {
    double zx = 0, zy = 0, zxx = 0, zxy = 0, zyy = 0;
    double determinant() const { return zxx * zyy - zxy * zxy; }
    // Newton's step to the place where the gradient of the paraboloid with these derivatives vanishes, times the determinant.
    double step_x() const { return zxy * zy - zyy * zx; }
    double step_y() const { return zxy * zx - zxx * zy; }
};

RSC_ALWAYS_INLINE PointDifferences differences(const double* below, const double* z, const double* above, int l, int i, int r) {
    const double h = z[i];
    return {0.5 * (z[r] - z[l]), 0.5 * (above[i] - below[i]), (z[l] - h) + (z[r] - h),
            0.25 * ((above[r] - above[l]) - (below[r] - below[l])), (below[i] - h) + (above[i] - h)};
}

// Summits of three neighbouring rows of heights: the inner loop of asperity detection.

// Position of a row, and the treatment of its ends.
struct RowPlace {
    int nx = 0;
    double x0 = 0, dx = 0, dy = 0;  // x of point 0; grid steps
    double y = 0;                   // y of the row
    bool periodic = false;          // the row's ends are neighbours; otherwise they are no summits
};

// Appends the summits of the row z, between the rows below (y - dy) and above (y + dy), to `found`; returns the number of
// saddles left out. All rows hold place.nx heights.
long append_summits(const RowPlace& place, const double* below, const double* z, const double* above, Curvature curvature,
                    Asperities& found);

// Starts of the search for summits between the points: the maxima of the grid, and the points from which a paraboloid through the
// neighbours has its top a fraction of a step away. The latter know of summits beside a higher one that no point is a maximum of.
struct Start {
    int column = 0;
    bool maximum = false;
};

// The starts of that row by increasing column. The row's ends are tested when it is periodic.
void find_starts(const RowPlace& place, const double* below, const double* z, const double* above, std::vector<Start>& starts);

// Halves of the second derivatives at a summit: a = zxx/2, b = zyy/2, c = zxy/2.
struct SecondOrder {
    double a = 0, b = 0, c = 0;
};

// Appends a summit with the curvatures of the paper's section 3 (with kappa_a = |a + b|: the paper's factor 1/2 is a slip);
// false, and nothing appended, if it is a saddle.
bool append_summit(double x, double y, double z, const SecondOrder& second, Curvature curvature, Asperities& found);

}  // namespace rsc
