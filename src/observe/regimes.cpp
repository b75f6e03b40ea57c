#include "observe/regimes.hpp"

#include <cmath>
#include <numbers>

#include "error.hpp"

namespace rsc {

using std::numbers::pi;

double Hertz::area() const { return pi * radius * radius; }

double Hertz::pressure(double r) const {
    if (!(std::abs(r) < radius)) return 0;
    const double s = r / radius;
    return peak * std::sqrt((1 - s) * (1 + s));
}

Hertz hertz_contact(double force, double R, double E_star) {
    if (!(force >= 0) || !std::isfinite(force)) throw Error(Failure::bad_input, "Hertz contact: the force must be finite, at least 0");
    if (!(R > 0) || !std::isfinite(R)) throw Error(Failure::bad_input, "Hertz contact: the radius must be positive and finite");
    if (!(E_star > 0) || !std::isfinite(E_star)) throw Error(Failure::bad_input, "Hertz contact: E* must be positive and finite");
    Hertz h;
    h.radius = std::cbrt(3 * force * R / (4 * E_star));
    h.penetration = h.radius * h.radius / R;
    h.peak = 2 * E_star * h.radius / (pi * R);  // = 3 N / (2 pi a^2), and 0 rather than 0/0 without load
    return h;
}

double area_one_asperity(double force, double r_g, double E_star) {
    const double a = std::cbrt(3 * r_g * force / (4 * E_star));
    return pi * a * a;
}

double area_proportional(double force, double m2, double E_star, double beta) {
    return beta * std::sqrt(2 * pi) * force / (std::sqrt(2 * m2) * E_star);
}

double transition_force(const Moments& moments, double E_star, double beta) {
    // A_I = A_II solved for N: N^(1/3) = pi (3 r_g / (4 E*))^(2/3) sqrt(2 m2) E* / (beta sqrt(2 pi)).
    const double r_g = moments.mean_radius();
    const double root = std::sqrt(pi * moments.m2) / beta;  // pi sqrt(2 m2) / (beta sqrt(2 pi))
    return 9.0 / 16.0 * r_g * r_g * root * root * root * E_star;
}

}  // namespace rsc
