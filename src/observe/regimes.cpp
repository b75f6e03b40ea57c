#include "observe/regimes.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include "base/error.hpp"

namespace rsc {

double Hertz::area() const { return pi * radius * radius; }

double Hertz::pressure(double r) const {
    if (!(std::abs(r) < radius)) return 0;
    const double s = r / radius;
    return peak * std::sqrt((1 - s) * (1 + s));
}

Hertz hertz_contact(double force, double R, double E_star) {
    if (!(force >= 0) || !std::isfinite(force))
        bad_input("Hertz contact: the force must be finite and not negative");
    if (!(R > 0) || !std::isfinite(R))
        bad_input("Hertz contact: the radius must be positive and finite");
    if (!(E_star > 0) || !std::isfinite(E_star))
        bad_input("Hertz contact: E* must be positive and finite");
    Hertz h;
    h.radius = std::cbrt(3 * force * R / (4 * E_star));
    h.penetration = h.radius * h.radius / R;
    h.peak =
        2 * E_star * h.radius / (pi * R);  // = 3 N / (2 pi a^2), and 0 rather than 0/0 without load
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
    // A_I = A_II solved for N: N^(1/3) = pi (3 r_g / (4 E*))^(2/3) sqrt(2 m2) E* / (beta sqrt(2
    // pi)).
    const double r_g = moments.mean_radius();
    const double root = std::sqrt(pi * moments.m2) / beta;  // pi sqrt(2 m2) / (beta sqrt(2 pi))
    return 9.0 / 16.0 * r_g * r_g * root * root * root * E_star;
}

double area_persson(double p_star) { return std::erf(std::sqrt(2.0) * p_star); }

double area_bgt(double p_star) { return std::sqrt(2 * pi) * p_star; }

namespace {

// F_n(h) by a Gauss rule in w, t = h + w^2, whose integrand is smooth for n = 1 and 3/2.
double greenwood_williamson(double n, double h) {
    return boost::math::quadrature::gauss<double, 60>::integrate(
        [&](double w) {
            const double t = h + w * w;
            return 2 * std::pow(w, 2 * n + 1) * std::exp(-t * t / 2) / std::sqrt(2 * pi);
        },
        0.0, std::sqrt(std::max(0.0, -h) + 9));
}

}  // namespace

double area_gw(double p_over_E_star, const FlatSummits& s) {
    if (!(p_over_E_star > 0)) return 0;
    const double unit =
        4.0 / 3 * s.density * std::sqrt(s.radius) * s.deviation * std::sqrt(s.deviation);
    double low = -50, high = 12;
    for (int k = 0; k < 60; ++k) {
        const double h = 0.5 * (low + high);
        (unit * greenwood_williamson(1.5, h) > p_over_E_star ? low : high) = h;
    }
    return pi * s.density * s.radius * s.deviation * greenwood_williamson(1, low);
}

}  // namespace rsc
