// Two directions in which everything may repeat.
#pragma once

#include "std.hpp"

namespace rsc {

struct Period {
    double x = std::numeric_limits<double>::infinity(), y = std::numeric_limits<double>::infinity();  // [length]; Infinity: repeats nowhere

    bool finite() const { return std::isfinite(x) && std::isfinite(y); }
    double area() const { return x * y; }
    // The difference of two coordinates to the nearest of all images.
    double nearest_x(double dx) const { return std::isfinite(x) ? std::remainder(dx, x) : dx; }
    double nearest_y(double dy) const { return std::isfinite(y) ? std::remainder(dy, y) : dy; }
};

}  // namespace rsc
