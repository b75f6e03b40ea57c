// Contact spots: which overlap, and their area.
//
// By hand: libraries for geometry give the area of a union of polygons; that of ellipses they give by exact arithmetic only, which is much
// slower than the doubles used here.
#pragma once

#include "contact/period.hpp"

namespace rsc {

// Number of pairs with d < a_i + a_j, d to the nearest image: contact spots that overlap.
long count_overlapping(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& a, const Period& period = {});

// A spot as an ellipse.
struct Spot {
    double x, y;          // centre [length]
    double major, minor;  // semi-axes [length]
    double angle;         // direction of the major one from x
};

// Area of the union of the spots [length^2]: what several share is counted once. Exact to rounding; spots without area are allowed.
// `close` (optional) receives what count_overlapping gives for circles of the spots' areas.
// `own` (optional) receives for each spot the area that those before it do not cover.
// With periodic boundaries, spots must be narrower than half a period.
double union_area(const std::vector<Spot>& spots, long* close = nullptr, const Period& period = {}, std::vector<double>* own = nullptr);

}  // namespace rsc
