// Periods in two directions.
#pragma once

#include "base/std.hpp"

namespace rsc {

struct Period {
    double x = kInfinity, y = kInfinity;  // [length]; Infinity: not periodic
    // Of line contact: the distance from a uniform line load at which it lowers nothing [length];
    // 0: the side of the surface across the line. A line load on a half-space has no absolute
    // approach.
    double reference = 0;

    bool finite() const { return std::isfinite(x) && std::isfinite(y); }
    // One of them is finite: line contact.
    bool along_x() const { return std::isfinite(x) && !std::isfinite(y); }
    bool along_y() const { return std::isfinite(y) && !std::isfinite(x); }
    bool line() const { return along_x() || along_y(); }
    double length() const { return along_x() ? x : y; }  // of a line contact
    double area() const { return x * y; }
    // Difference of two coordinates, to the nearest image.
    double nearest_x(double dx) const { return 2 * std::abs(dx) <= x ? dx : std::remainder(dx, x); }
    double nearest_y(double dy) const { return 2 * std::abs(dy) <= y ? dy : std::remainder(dy, y); }
};

}  // namespace rsc
