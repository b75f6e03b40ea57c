// Overlaps and areas of contact spots.
//
// Geometry libraries compute unions of polygons, or unions of ellipses in exact arithmetic, which
// is much slower than this code.
#pragma once

#include "interaction/period.hpp"

namespace rsc {

// Number of pairs of overlapping contact spots: d < a_i + a_j, with d to the nearest image.
long count_overlapping(const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<double>& a, const Period& period = {});

// A spot as an ellipse.
struct Spot {
    double x, y;          // centre [length]
    double major, minor;  // semi-axes [length]
    double angle;         // direction of the major semi-axis from x
    // 1 at the centre, 0 at the rim, negative outside: a Hertz pressure is in proportion to its
    // square root.
    double inside(double at_x, double at_y) const {
        const double c = std::cos(angle), s = std::sin(angle), dx = at_x - x, dy = at_y - y;
        const double p = (dx * c + dy * s) / major, q = (dy * c - dx * s) / minor;
        return 1 - p * p - q * q;
    }
    bool contains(double at_x, double at_y) const { return inside(at_x, at_y) > 0; }
};

// Area of the union of spots [length^2], exact to rounding; spots without area are allowed. `close`
// (optional) receives the result of count_overlapping() for circles of the same areas, `own`
// (optional) the area of each spot that is not covered by earlier ones. With periodic boundaries,
// spots must be narrower than half a period.
double union_area(const std::vector<Spot>& spots, long* close = nullptr, const Period& period = {},
                  std::vector<double>* own = nullptr);

}  // namespace rsc
