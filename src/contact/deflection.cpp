#include "contact/deflection.hpp"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/special_functions/ellint_d.hpp>

namespace rsc {
namespace {

constexpr int kTerms = 8;  // s^16 is below rounding for s = a/d < kFar
constexpr double kFar = 0.1;

}  // namespace

double spot_deflection(double force, double radius, double distance, double E_star) {
    const double s = radius / distance, near = Substrate(E_star).near();
    if (s >= 1) {
        const double t = distance / radius;
        return 0.375 * pi * near * force / radius * (2 - t * t);
    }
    if (s >= kFar) {
        const double t2 = 1 / (s * s);
        return 0.75 * near * force / radius * ((2 - t2) * std::asin(s) + std::sqrt(t2 - 1));
    }
    // the hypergeometric series F(1/2, 1/2; 5/2; s^2), because the two terms above cancel
    double sum = 1;
    for (int n = kTerms - 1; n-- > 0;)
        sum = 1 + (n + 0.5) * (n + 0.5) / ((n + 2.5) * (n + 1)) * s * s * sum;
    return near * force / distance * sum;
}

double tension_deflection(double force, double a, double c, double d, double E_star) {
    const double near = Substrate(E_star).near(), e = std::sqrt((c - a) * (c + a));
    // Integral of the Abel transform, which is 1 up to a.
    const double whole = e > 0 ? 0.5 * (a + c * c * std::atan2(e, a) / e) : a,
                 inside = 0.5 * pi * near * force / whole;
    if (d <= a) return inside;
    double sum = std::asin(a / d);
    if (e > 0 && d <= c) {
        const double k = d / c;
        sum += c / e * (boost::math::ellint_2(k) - boost::math::ellint_2(k, sum));
    } else if (e > 0) {
        const double k = c / d, begin = std::asin(a / c);
        sum += c * k / e *
               (boost::math::ellint_1(k) - boost::math::ellint_d(k) -
                boost::math::ellint_1(k, begin) + boost::math::ellint_d(k, begin));
    }
    return 2 / pi * inside * sum;
}

double deflection(const Level& level, const Kernel& kernel, double x, double y) {
    const Period period = kernel.period();
    const Substrate& body = kernel.substrate();
    const auto images = [&](double dx, double dy) {
        return kernel.lattice() ? body.near() * kernel.lattice()->rest(dx, dy) : 0.0;
    };
    double sum = 0;
    const LevelPixels& pixels = level.pixels;
    pixels.each([&](std::int32_t index, double pressure, int) {
        const double dx = period.nearest_x(x - pixels.x_of(index)),
                     dy = period.nearest_y(y - pixels.y_of(index));
        sum += pressure * (body.under_pixel(dx, dy, pixels.dx, pixels.dy) +
                           pixels.dx * pixels.dy * images(dx, dy));
    });
    if (!pixels.index.empty()) return sum;
    const auto add_spot = [&](double at_x, double at_y, double force, auto&& own) {
        const double dx = period.nearest_x(x - at_x), dy = period.nearest_y(y - at_y),
                     d = std::sqrt(dx * dx + dy * dy);
        sum += own(d) + force * (body.smooth_at(d) + images(dx, dy));
    };
    const LevelTractions& t = level.tractions;
    for (const auto k : indices(t.x))
        add_spot(t.x[k], t.y[k], t.pressed[k] + t.pulled[k], [&](double d) {
            return (t.a[k] > 0 ? spot_deflection(t.pressed[k], t.a[k], d, body.modulus()) : 0.0) +
                   tension_deflection(t.pulled[k], t.a[k], t.c[k], d, body.modulus());
        });
    if (!t.x.empty()) return sum;
    for (const auto k : indices(level.f))
        add_spot(level.x[k], level.y[k], level.f[k], [&](double d) {
            return spot_deflection(level.f[k], level.a[k], d, body.modulus());
        });
    return sum;
}

}  // namespace rsc
