// Two elastic bodies in frictionless contact become one elastic body and one rigid one.
#pragma once

namespace rsc {

// E* of two bodies, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [force/length^2] (Johnson 1985, section 4.2). E = Infinity is rigid.
// Throws Error(bad_input): a modulus that is not positive, a Poisson's ratio outside [-1, 0.5], two rigid bodies.
double equivalent_modulus(const double (&E)[2], const double (&nu)[2]);

// R* of two spheres, 1/R* = 1/R1 + 1/R2 [length]. R = Infinity is flat; two flat bodies give Infinity.
// Throws Error(bad_input): a radius that is not positive.
double equivalent_radius(const double (&R)[2]);

}  // namespace rsc
