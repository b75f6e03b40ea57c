// Hertz contact of a summit with unequal curvatures (Johnson 1985, section 4.2, eqs 4.25 to 4.32),
// by exact elliptic integrals.
#pragma once

namespace rsc {

// Factors of force (4/3) E* sqrt(R_e) (delta/F2)^(3/2) and area pi F1^2 R_e delta/F2, with R_e =
// 1/sqrt(kappa1 kappa2).
struct EllipseFactors {
    double axes = 1;  // b/a, minor over major semi-axis
    double F1 = 1, F2 = 1;
};

// Factors for the ratio kappa1/kappa2 of the principal curvatures, with relative errors of about
// 1e-13. Throws Error(bad_input) unless the ratio is finite and at least 1.
EllipseFactors ellipse_factors(double ratio);

}  // namespace rsc
