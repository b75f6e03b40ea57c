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
double union_area(const std::vector<Spot>& spots);

}  // namespace rsc
