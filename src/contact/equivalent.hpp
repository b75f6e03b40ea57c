// Two elastic bodies in frictionless contact become one elastic body and one rigid one.
#pragma once

namespace rsc {

// E* of two bodies, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [force/length^2] (Johnson 1985, section 4.2). E = Infinity is rigid.
// Throws Error(bad_input): a modulus that is not positive, a Poisson's ratio outside [-1, 0.5], two rigid bodies.
double equivalent_modulus(const double (&E)[2], const double (&nu)[2]);

// R* of two spheres, 1/R* = 1/R1 + 1/R2 [length]. R = Infinity is flat; two flat bodies give Infinity.
// Throws Error(bad_input): a radius that is not positive.
double equivalent_radius(const double (&R)[2]);

// m = 4 G*/E* of two bodies, 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2, G = E/(2 (1 + nu)): the tangential stiffness of any of their contacts
// over the normal one (Johnson 1985, section 7.3); 2 (1 - nu)/(2 - nu) for like bodies. Throws as equivalent_modulus.
double tangential_ratio(const double (&E)[2], const double (&nu)[2]);

}  // namespace rsc
