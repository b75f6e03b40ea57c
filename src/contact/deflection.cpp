#include "contact/deflection.hpp"

namespace rsc {
namespace {

// (2 - 1/s^2) asin(s) + sqrt(1/s^2 - 1) = (4/3) s (1 + s^2/10 + 9 s^4/280 + ...), s = a/d: coefficients from the series of asin(s) and
// sqrt(1 - s^2) with b_n = (2n)!/(4^n n!^2).
constexpr int kTerms = 8;  // s^16 is below rounding for s < kFar
constexpr double kFar = 0.1;
constexpr std::array<double, kTerms> kSeries = [] {
    std::array<double, kTerms> series{};
    double before = 1;  // b_(n-1)
    for (int n = 1; n <= kTerms; ++n) {
        const double b = before * (2 * n - 1) / (2 * n);
        series[static_cast<std::size_t>(n - 1)] = 0.75 * (2 * before / (2 * n - 1) - b * 4 * n / (4.0 * n * n - 1));
        before = b;
    }
    return series;
}();

}  // namespace

double spot_deflection(double force, double radius, double distance, double E_star) {
    const double s = radius / distance, near = Substrate(E_star).near();
    if (s >= 1) {
        const double t = distance / radius;
        return 0.375 * std::numbers::pi * near * force / radius * (2 - t * t);
    }
    if (s >= kFar) {
        const double t2 = 1 / (s * s);
        return 0.75 * near * force / radius * ((2 - t2) * std::asin(s) + std::sqrt(t2 - 1));
    }
    double sum = 0;  // series, because the two terms above cancel
    for (std::size_t n = kTerms; n-- > 0;) sum = sum * s * s + kSeries[n];
    return near * force / distance * sum;
}

double deflection(const Level& level, const Kernel& kernel, double x, double y) {
    const Period period = kernel.period();
    const Substrate& body = kernel.substrate();
    const auto images = [&](double dx, double dy) { return kernel.lattice() ? body.near() * kernel.lattice()->rest(dx, dy) : 0.0; };
    double sum = 0;
    const LevelPixels& pixels = level.pixels;
    for (std::size_t k = 0; k < pixels.index.size(); ++k) {
        const double dx = period.nearest_x(x - pixels.x(k)), dy = period.nearest_y(y - pixels.y(k));
        sum += pixels.pressure[k] * (body.under_pixel(dx, dy, pixels.dx, pixels.dy) + pixels.dx * pixels.dy * images(dx, dy));
    }
    if (!pixels.index.empty()) return sum;
    for (std::size_t k = 0; k < level.f.size(); ++k) {
        const double dx = period.nearest_x(x - level.x[k]), dy = period.nearest_y(y - level.y[k]), d = std::sqrt(dx * dx + dy * dy);
        sum += spot_deflection(level.f[k], level.a[k], d, body.modulus()) + level.f[k] * (body.smooth_at(d) + images(dx, dy));
    }
    return sum;
}

}  // namespace rsc
