// Deflection of the surface by the contact forces, between and under the spots.
#pragma once

#include "contact/interaction/kernel.hpp"
#include "contact/level.hpp"

namespace rsc {

// Lowering of the half-space E* by a Hertz pressure of force f over a circle of radius a > 0, at distance d >= 0 from its centre
// [length]. Inside, d <= a: 3f/(8 E* a)(2 - d^2/a^2); outside (Johnson 1985, eq. 3.42): 3f/(4 pi E* a) [(2 - d^2/a^2) asin(a/d) +
// sqrt(d^2/a^2 - 1)]. Value and slope are continuous at d = a; far away f/(pi E* d)(1 + a^2/(10 d^2) + ...). To rounding everywhere.
double spot_deflection(double force, double radius, double distance, double E_star);

// The sum over the contacts of a level at (x, y) [length], positive down. Spots that are no circles, and pressures that are not
// Hertz's (laws 'elliptic', 'fourth_order'), are taken as Hertz's over the circle of the same area: exact far away. Of pixels it is Love's. Layers are
// felt by a spot as by a point.
// With periodic boundaries images act as points, and the deflection is measured from the mean plane: its mean is 0.
double deflection(const Level& level, const Kernel& kernel, double x, double y);

}  // namespace rsc
