#include "contact/interaction/love.hpp"

namespace rsc {
namespace {

// d^2/ds dt of corner() is 1/sqrt(s^2 + t^2): the integral over the rectangle is the alternating sum over its corners.
double corner(double s, double t) {
    double sum = 0;
    if (t != 0) sum += t * std::asinh(s / std::abs(t));
    if (s != 0) sum += s * std::asinh(t / std::abs(s));
    return sum;
}

}  // namespace

double love(double x, double y, double a, double b) {
    return corner(x + a, y + b) - corner(x + a, y - b) - corner(x - a, y + b) + corner(x - a, y - b);
}

}  // namespace rsc
