// Periods in two directions.
#pragma once

#include "std.hpp"

namespace rsc {

struct Period {
    double x = std::numeric_limits<double>::infinity(), y = std::numeric_limits<double>::infinity();  // [length]; Infinity: not periodic

    bool finite() const { return std::isfinite(x) && std::isfinite(y); }
    double area() const { return x * y; }
    // Difference of two coordinates, to the nearest image.
    double nearest_x(double dx) const { return std::isfinite(x) ? std::remainder(dx, x) : dx; }
    double nearest_y(double dy) const { return std::isfinite(y) ? std::remainder(dy, y) : dy; }
};

}  // namespace rsc
