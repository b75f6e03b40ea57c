// Contact spots as ellipses.
#pragma once

#include <vector>

namespace rsc {

struct Spot {
    double x, y;          // centre [length]
    double major, minor;  // semi-axes [length]
    double angle;         // direction of the major one from x
};

// Area of the union of the spots [length^2]: what several share is counted once. Exact to rounding; spots without area are allowed.
// `close` (optional) receives the number of pairs with d < a_i + a_j, the radii of circles of the spots' areas.
double union_area(const std::vector<Spot>& spots, long* close = nullptr);

}  // namespace rsc
