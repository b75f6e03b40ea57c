// Point forces that repeat along one axis: line contact.
#pragma once

#include "base/std.hpp"

namespace rsc {

// pi E* times the deflection of a half-space at an offset (across, along) from a unit force and its
// images at multiples of the period L along one axis, without 1/d of the force itself:
//   sum over n /= 0 of [1/sqrt(across^2 + (along + n L)^2) - 1/(|n| L)] + (2/L) [ln(D/(2L)) +
// gamma]. A line load has no absolute approach: the sum converges up to a constant, which is chosen
// so that a uniform line load lowers nothing at the distance D, the reference. Far across the
// deflection is that of a line load, -(2/L) ln(|across|/D) - 1/d, with waves along it that fall
// like exp(-2 pi |across|/L) (Lekner, Physica A 176, 1991). Relative to 1/L the error is below
// 1e-12 for |along| <= L/2.
class LineKernel {
public:
    LineKernel(double period, double reference)
        : period_(period),
          constant_(2 * (std::log(0.5 * reference / period) + std::numbers::egamma)) {}
    double images(double across, double along) const;  // [1/length]

private:
    double near(double across, double along) const;
    double far(double across, double along) const;

    double period_;
    double constant_;  // for period 1
};

}  // namespace rsc
