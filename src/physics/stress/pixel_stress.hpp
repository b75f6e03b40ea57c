// Stresses under a uniform traction on a rectangle of the surface of a half-space.
#pragma once

#include "physics/stress/stress.hpp"

namespace rsc {

// A function of which the stress under a rectangle |x| < a, |y| < b is an alternating sum,
//   s(x + a, y + b) - s(x + a, y - b) - s(x - a, y + b) + s(x - a, y - b),
// for a pressure of 1 together with the traction `sliding` on the surface (Love 1929; Cerruti's
// solution for the traction, Johnson 1985, equations 3.19 and 3.76, integrated in closed form).
// z >= 0 is the depth and nu the Poisson ratio. At z = 0 neither x nor y may be 0.
StressTensor corner_stress(double x, double y, double z, double nu, const SlidingTraction& sliding);

// The stress at (x, y, z) under a pressure of 1 on the rectangle [1].
StressTensor pixel_stress(double x, double y, double z, double a, double b, double nu,
                          const SlidingTraction& sliding);

}  // namespace rsc
