#include "interaction/line_kernel.hpp"

#include <boost/math/special_functions/bessel.hpp>

namespace rsc {

double LineKernel::images(double across, double along) const {
    const double x = std::abs(across) / period_, y = along / period_;
    return ((x < 0.5 ? near(x, y) : far(x, y)) + constant_) / period_;
}

// Period 1. The first images one by one, the others by Euler and Maclaurin's formula.
double LineKernel::near(double x, double y) const {
    constexpr int first = 24;
    double sum = 0;
    for (int n = first; n >= 1; --n)
        sum += 1 / std::hypot(x, y + n) + 1 / std::hypot(x, n - y) - 2.0 / n;
    const double a = first + 0.5;
    // Of t = a + y and t = a - y: the integral of 1/sqrt(x^2 + t^2) from there on, less that of
    // 1/t, and its first and third derivatives.
    double rest = 2 * std::log(2 * a), slope = 2 / (a * a), third = 12 / (a * a * a * a);
    for (const double t : {a + y, a - y}) {
        const double r = std::hypot(x, t), r3 = r * r * r, r7 = r3 * r3 * r;
        rest -= std::log(t + r);
        slope -= t / r3;
        third -= 3 * t * (2 * t * t - 3 * x * x) / r7;
    }
    return sum + rest + slope / 24 - 7 * third / 5760;
}

// Period 1: Lekner's sum, as near() without the constant of the reference.
double LineKernel::far(double x, double y) const {
    constexpr double gamma = std::numbers::egamma, smallest = 1e-17;
    double sum = 0;
    for (int m = 1;; ++m) {
        const double wave = boost::math::cyl_bessel_k(0, 2 * pi * m * x);
        sum += 4 * wave * std::cos(2 * pi * m * y);
        if (wave < smallest) break;
    }
    return sum - 2 * (std::log(0.5 * x) + gamma) - 1 / std::hypot(x, y);
}

}  // namespace rsc
