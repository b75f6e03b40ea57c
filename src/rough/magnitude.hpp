// The numbers rsc works with. Moments and forces are made of squares and powers of lengths and moduli: beyond these bounds they would
// overflow a double, whatever the units.
#pragma once

#include <cmath>

namespace rsc {

inline constexpr double kLargestNumber = 1e50;
inline constexpr const char* kNumberBounds = "must be finite, 1e50 at most";
inline constexpr const char* kPositiveBounds = "must be from 1e-50 to 1e50";

// A number that may be 0, of either sign; so small a one is as good as 0.
inline bool usable(double v) noexcept { return std::abs(v) <= kLargestNumber; }  // false for NaN
inline bool usable_positive(double v) noexcept { return v >= 1 / kLargestNumber && v <= kLargestNumber; }

}  // namespace rsc
