// Closed-form solutions for comparison with a rough sphere: the smooth sphere (Hertz) and the two
// regimes of the paper's section 5.
#pragma once

#include "surface/spectrum.hpp"

namespace rsc {

// A smooth sphere of radius R pressed by a force N into a half-space of modulus E* (Hertz; Johnson
// 1985, section 4.2).
struct Hertz {
    double radius = 0;       // contact radius a = (3 N R / (4 E*))^(1/3) [length]
    double penetration = 0;  // delta = a^2 / R [length]
    double peak = 0;         // peak pressure p0 = 3 N / (2 pi a^2) [force/length^2]
    double area() const;     // pi a^2 [length^2]
    // p(r) = p0 sqrt(1 - r^2/a^2), 0 outside the contact [force/length^2].
    double pressure(double r) const;
};

// Throws Error(bad_input) unless N >= 0, and R and E* are positive and finite.
Hertz hertz_contact(double force, double R, double E_star);

// The paper's prefactor of the second regime.
inline constexpr double kRegimeBeta = 0.2;

// First regime, one asperity of mean radius r_g carries the load: A_I = pi (3 r_g N / (4 E*))^(2/3)
// [length^2].
double area_one_asperity(double force, double r_g, double E_star);

// Second regime, area proportional to the load: A_II = beta sqrt(2 pi) N / (sqrt(2 m2) E*)
// [length^2].
double area_proportional(double force, double m2, double E_star, double beta = kRegimeBeta);

// Force at which A_I = A_II, with r_g from the moments: 212.66 m2^(3/2) E* / m4 for beta = 0.2
// [force].
double transition_force(const Moments& moments, double E_star, double beta = kRegimeBeta);

// Area fractions of two flats under the nominal pressure p, with p* = p/(E* sqrt(2 m2)).
double area_persson(double p_star);  // Persson 2001: erf(sqrt(2) p*)
double area_bgt(double p_star);      // the asymptote of Bush, Gibson, Thomas 1975: sqrt(2 pi) p*

// Summits in the Greenwood-Williamson model (1966): equal radii, Gaussian heights.
struct FlatSummits {
    double density;    // [1/length^2]
    double radius;     // [length]
    double deviation;  // of the heights [length]
    bool usable() const { return density > 0 && radius > 0 && deviation > 0; }
};
// The variance of summit heights is m0 - kSummitVariance m2^2/m4 (Nayak 1971; Greenwood 2006).
inline constexpr double kSummitVariance = 0.8968;
// Area fraction A/A0 = pi D R s F_1(h), with h from p/E* = (4/3) D sqrt(R) s^(3/2) F_{3/2}(h),
// F_n(h) = int_h^inf (t - h)^n phi(t) dt.
double area_gw(double p_over_E_star, const FlatSummits& summits);

}  // namespace rsc
