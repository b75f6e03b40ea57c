#include "interaction/cerruti.hpp"

namespace rsc {
namespace {

// d^2/dx dy of corner() is x^2/r^3 but for functions of one coordinate, which cancel in the
// alternating sum over the corners of a rectangle.
double corner_xx(double x, double y) { return y == 0 ? 0.0 : y * std::asinh(x / std::abs(y)); }
double corner_xy(double x, double y) { return -std::hypot(x, y); }

template <class Corner>
double over_rectangle(double x, double y, double a, double b, Corner&& corner) {
    return corner(x + a, y + b) - corner(x + a, y - b) - corner(x - a, y + b) +
           corner(x - a, y - b);
}

// Images up to this distance in sides of the rectangle are exact, others those of points, whose
// relative error is below 1e-7 of the rectangle's own displacement.
constexpr double kExact = 96;
constexpr int kPoints = 24;  // images of points one by one, those beyond by their integral

// The sum over the images of a rectangle: exact(y) of the near ones, point(y) of those farther
// away, and tail(t): the integral of point from t to infinity.
template <class Exact, class Point, class Tail>
double sum_of_images(double y, double L, double side, Exact&& exact, Point&& point, Tail&& tail) {
    const int near = 1 + int(std::ceil(kExact * side / L)), last = near + kPoints;
    double sum = 0;
    for (int n = -near; n <= near; ++n) sum += exact(y + n * L);
    for (int n = last; n > near; --n) sum += point(y + n * L) + point(y - n * L);
    const double end = (last + 0.5) * L;
    return sum + (tail(end + y) - tail(-end + y)) / L;
}

}  // namespace

double cerruti_xx(double x, double y, double a, double b) {
    return over_rectangle(x, y, a, b, corner_xx);
}

double cerruti_xy(double x, double y, double a, double b) {
    return over_rectangle(x, y, a, b, corner_xy);
}

double LineCerruti::xx(double x, double y, double a, double b) const {
    const double area = 4 * a * b;
    const auto point = [&](double t) {
        const double d = std::hypot(x, t);
        return area * x * x / (d * d * d);
    };
    // Of t < 0 the integral from -infinity, with its sign changed.
    const auto tail = [&](double t) {
        const double d = std::hypot(x, t);
        return std::copysign(area * x * x / (d * (d + std::abs(t))), t);
    };
    return sum_of_images(
               y, period, 2 * std::max(a, b), [&](double t) { return cerruti_xx(x, t, a, b); },
               point, tail) -
           2 * area / period;
}

double LineCerruti::xy(double x, double y, double a, double b) const {
    const double area = 4 * a * b;
    return sum_of_images(
        y, period, 2 * std::max(a, b), [&](double t) { return cerruti_xy(x, t, a, b); },
        [&](double t) {
            const double d = std::hypot(x, t);
            return area * x * t / (d * d * d);
        },
        [&](double t) { return area * x / std::hypot(x, t); });
}

}  // namespace rsc
