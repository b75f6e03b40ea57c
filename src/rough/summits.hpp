// Summits of three neighbouring rows of heights: the inner loop of asperity detection.
#pragma once

#include <vector>

#include "rough/asperities.hpp"

namespace rsc {

// Where a row lies and how its ends are treated.
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

}  // namespace rsc
