// Summits of three neighbouring rows of heights: the inner loop of asperity detection.
#pragma once

#include "rough/asperities.hpp"

namespace rsc {

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
