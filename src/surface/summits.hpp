// Summits of the grid: comparison of points with their eight neighbours, and detection in rows.
#pragma once

#include "base/dispatch.hpp"
#include "surface/asperities.hpp"

namespace rsc {

// A grid point in column i of row `z`, between the rows `below` (smaller y) and `above`. Its
// neighbours are in columns l and r, which differ from i - 1 and i + 1 at the ends of the rows of a
// periodic map.

// True if the point is strictly above all eight neighbours. Without branches, so that loops over
// points vectorise.
RSC_ALWAYS_INLINE bool above_neighbours(const double* below, const double* z, const double* above,
                                        int l, int i, int r) {
    const double h = z[i];
    return (h > z[l]) & (h > z[r]) & (h > below[l]) & (h > below[i]) & (h > below[r]) &
           (h > above[l]) & (h > above[i]) & (h > above[r]);
}

// Derivatives at the point by central differences, in units of grid steps.
struct PointDifferences {
    double zx = 0, zy = 0, zxx = 0, zxy = 0, zyy = 0;
    double determinant() const { return zxx * zyy - zxy * zxy; }
    // Newton step to the stationary point of the paraboloid with these derivatives, times the
    // determinant.
    double step_x() const { return zxy * zy - zyy * zx; }
    double step_y() const { return zxy * zx - zxx * zy; }
};

RSC_ALWAYS_INLINE PointDifferences differences(const double* below, const double* z,
                                               const double* above, int l, int i, int r) {
    const double h = z[i];
    return {0.5 * (z[r] - z[l]), 0.5 * (above[i] - below[i]), (z[l] - h) + (z[r] - h),
            0.25 * ((above[r] - above[l]) - (below[r] - below[l])),
            (below[i] - h) + (above[i] - h)};
}

// Detection of summits in a row: the inner loop of asperity detection.

// Position of a row and treatment of its ends.
struct RowPlace {
    int nx = 0;
    double x0 = 0, dx = 0, dy = 0;  // x of point 0; grid steps
    double y = 0;                   // y of the row
    bool periodic = false;  // the ends of the row are neighbours; otherwise they are never summits
};

// Appends the summits of row z, between the rows below (y - dy) and above (y + dy), to `found`.
// Returns the number of saddles, which are not appended. All rows hold place.nx heights.
long append_summits(const RowPlace& place, const double* below, const double* z,
                    const double* above, Curvature curvature, Asperities& found);

// Start of the search for a summit between grid points: a grid maximum, or a point whose paraboloid
// through the neighbours has its top a fraction of a step away. The latter find summits next to
// higher ones, which have no grid maximum.
struct Start {
    int column = 0;
    bool maximum = false;
};

// Finds the starts in row z by increasing column. The ends of the row are tested only if it is
// periodic.
void find_starts(const RowPlace& place, const double* below, const double* z, const double* above,
                 std::vector<Start>& starts);

// Halves of the second derivatives at a summit: a = zxx/2, b = zyy/2, c = zxy/2.
struct SecondOrder {
    double a = 0, b = 0, c = 0;
};

// Appends a summit with its curvatures (paper, section 3, but kappa_a = |a + b|: the paper's factor
// 1/2 is an error). Returns false and appends nothing if it is a saddle, a pit, or not finite (at
// the border of a body above).
bool append_summit(double x, double y, double z, const SecondOrder& second, Curvature curvature,
                   Asperities& found);

}  // namespace rsc
