// Equivalent contact of two elastic bodies: one elastic body and one rigid indenter.
#pragma once

namespace rsc {

// E* of two bodies, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [force/length^2] (Johnson 1985, section
// 4.2). E = Infinity is rigid. Throws
// Error(bad_input) if a modulus is not positive, a Poisson's ratio is outside [-1, 0.5], or both
// bodies are rigid.
double equivalent_modulus(const double (&E)[2], const double (&nu)[2]);

// R* of two spheres, 1/R* = 1/R1 + 1/R2 [length]. R = Infinity is flat, a negative radius is that
// of a concave body; two flat bodies give Infinity. Throws Error(bad_input) if a radius is 0, or if
// the bodies, not both flat, do not touch at one point: 1/R1 + 1/R2 <= 0.
double equivalent_radius(const double (&R)[2]);

// Ratio m = 4 G*/E* of tangential to normal contact stiffness of two bodies (Johnson 1985, section
// 7.3), 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2, G = E/(2 (1 + nu)); 2 (1 - nu)/(2 - nu) for equal
// materials. Throws as equivalent_modulus().
double tangential_ratio(const double (&E)[2], const double (&nu)[2]);

}  // namespace rsc
