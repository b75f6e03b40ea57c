// Tangential displacements of a half-space by tractions on rectangles (Cerruti; Johnson 1985,
// section 3.6).
//
// Two elastic bodies whose surfaces carry equal and opposite tractions q move against each other by
//   u_i = 1/(pi E*) int (delta_ij/r + c x_i x_j/r^3) q_j dA,   c = (E*/2) (nu1/G1 + nu2/G2),
// if the normal and the tangential problem are not coupled (Dundurs' beta is 0). The first term is
// that of pressures; c = nu/(1 - nu) for equal bodies, and c = 2/m - 2 for any with the ratio m of
// tangential_ratio(). A wave exp(i k x) of tractions along k moves the surface by 2/(E* |k|) times
// itself, one across k by 1 + c times as much.
#pragma once

#include "base/std.hpp"

namespace rsc {

// Integral of X^2/R^3 (`xx`) or X Y/R^3 (`xy`) over the rectangle |x'| < a, |y'| < b, where (X, Y)
// = (x - x', y - y') [length].
double cerruti_xx(double x, double y, double a, double b);
double cerruti_xy(double x, double y, double a, double b);

// A plane of these forces that repeats along y with the period L: the sums of the two integrals
// over a rectangle and its images at y + n L. A uniform line of tractions moves the points at all
// distances from it by the same amount through the first, 2/L each; this is subtracted, so that the
// displacement is counted from the distance of LineKernel.
struct LineCerruti {
    double period;
    double xx(double x, double y, double a, double b) const;
    double xy(double x, double y, double a, double b) const;
};

}  // namespace rsc
