// Point forces that repeat along one axis: line contact.
#pragma once

#include "base/std.hpp"

namespace rsc {

// pi E* times the deflection of a half-space at an offset (across, along) from a unit force and its
// images at multiples of the period L along one axis, without 1/d of the force itself:
//   sum over n /= 0 of [1/sqrt(across^2 + (along + n L)^2) - 1/(|n| L)].
// The constants make the sum converge (a line load has no absolute approach), and the separations
// of line contact count from them. Relative to 1/L the error is below 1e-12 for |along| <= L/2. Far
// across it is that of a line load, -(2/L) [ln(|across|/(2L)) + gamma] - 1/d, with waves along it
// that fall like exp(-2 pi |across|/L) (Lekner, Physica A 176, 1991).
class LineKernel {
public:
    explicit LineKernel(double period) : period_(period) {}
    double images(double across, double along) const;  // [1/length]

private:
    double near(double across, double along) const;
    double far(double across, double along) const;

    double period_;
};

}  // namespace rsc
