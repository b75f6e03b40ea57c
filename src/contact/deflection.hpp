// Deflection of the surface by contact forces, next to and under the spots.
#pragma once

#include "contact/level.hpp"
#include "interaction/kernel.hpp"

namespace rsc {

// Deflection [length] of the half-space E* under a Hertz pressure of force f and radius a > 0, at
// distance d >= 0 from the centre. Inside, d <= a: 3f/(8 E* a)(2 - d^2/a^2); outside (Johnson 1985,
// eq. 3.42): 3f/(4 pi E* a) [(2 - d^2/a^2) asin(a/d) + sqrt(d^2/a^2 - 1)], which tends to f/(pi E*
// d)(1 + a^2/(10 d^2) + ...). Accurate to rounding everywhere.
double spot_deflection(double force, double radius, double distance, double E_star);

// Deflection [length] at the distance d by the tension of an adhesive asperity, of total force f
// (negative): in contact up to the radius a, it attracts up to c >= a. If c = a > 0 (JKR) the
// traction is that of a flat punch, f/(2 pi a^2)/sqrt(1 - d^2/a^2), and the deflection is f/(2 E*
// a) inside and f/(pi E* a) asin(a/d) outside. If c > a >= 0 (Maugis-Dugdale) the traction is a
// uniform -s0 in the ring, and -(2 s0/pi) atan(sqrt((c^2 - a^2)/(a^2 - d^2))) in the contact; the
// deflection follows from its Abel transform, which is constant up to a and proportional to
// sqrt(c^2 - t^2) in the ring, by elliptic integrals.
double tension_deflection(double force, double a, double c, double distance, double E_star);

// Deflection at (x, y) [length], positive downwards, by all contacts and attracted places of a
// level. Spots of the laws 'elliptic' and 'fourth_order' are approximated by the pressures of
// spheres over circles of the same area, which is exact far away. Pixels use Love's solution. The
// effect of layers is that of a point force. With periodic boundaries, images act as points and the
// mean deflection is 0.
double deflection(const Level& level, const Kernel& kernel, double x, double y);

}  // namespace rsc
