// A point of a grid of heights and its eight neighbours. Rows are given by pointers, `below` (smaller y), `z` and `above`; the point is in
// column i, its neighbours along the row are in columns l and r, which at the seam of a periodic map are not i - 1 and i + 1.
#pragma once

#include "rough/dispatch.hpp"

namespace rsc {

// Strictly above all eight. Without branches, so that a loop over points can be vectorised.
RSC_ALWAYS_INLINE bool above_neighbours(const double* below, const double* z, const double* above, int l, int i, int r) {
    const double h = z[i];
    return (h > z[l]) & (h > z[r]) & (h > below[l]) & (h > below[i]) & (h > below[r]) & (h > above[l]) & (h > above[i]) & (h > above[r]);
}

// Derivatives at the point by central differences; x and y in grid steps.
struct Differences {
    double zx = 0, zy = 0, zxx = 0, zxy = 0, zyy = 0;
    double determinant() const { return zxx * zyy - zxy * zxy; }
    // Newton's step to the place where the gradient of the paraboloid with these derivatives vanishes, times the determinant.
    double step_x() const { return zxy * zy - zyy * zx; }
    double step_y() const { return zxy * zx - zxx * zy; }
};

RSC_ALWAYS_INLINE Differences differences(const double* below, const double* z, const double* above, int l, int i, int r) {
    const double h = z[i];
    return {0.5 * (z[r] - z[l]), 0.5 * (above[i] - below[i]), (z[l] - h) + (z[r] - h),
            0.25 * ((above[r] - above[l]) - (below[r] - below[l])), (below[i] - h) + (above[i] - h)};
}

}  // namespace rsc
