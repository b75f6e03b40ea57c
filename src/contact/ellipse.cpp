#include "contact/ellipse.hpp"

#include <cmath>
#include <numbers>

#include "error.hpp"

namespace rsc {
namespace {

// Complete elliptic integrals of the modulus k: K, and B = [E - (1 - k^2) K]/k^2, D = (K - E)/k^2, which stay finite and exact at k = 0.
struct Elliptic {
    double K, B, D;
};

// `k2` is k^2, `rest` is 1 - k^2, given apart because one of them may be tiny.
Elliptic elliptic(double k2, double rest) {
    const double k = std::sqrt(k2);
    if (k2 > 0.2) {
        // Near k = 1 the library's argument cannot hold 1 - k^2; K is then its logarithmic expansion.
        if (rest < 1e-7) {
            const double L = std::log(4 / std::sqrt(rest));
            const double K = L + 0.25 * rest * (L - 1), E = 1 + 0.5 * rest * (L - 0.5);
            return {K, (E - rest * K) / k2, (K - E) / k2};
        }
        const double K = std::comp_ellint_1(k), E = std::comp_ellint_2(k);
        return {K, (E - rest * K) / k2, (K - E) / k2};
    }
    double D = 0, term = std::numbers::pi / 4;  // (pi/4) 2F1(3/2, 1/2; 2; k^2)
    for (int m = 0; m < 60 && term > 1e-17; ++m) {
        D += term;
        term *= (1.5 + m) * (0.5 + m) / ((2.0 + m) * (1.0 + m)) * k2;
    }
    const double K = std::comp_ellint_1(k);
    return {K, K - D, D};
}

// kappa1/kappa2 of the ellipse with e^2 = 1 - (b/a)^2: [(a/b)^2 E - K]/[K - E] = B/((b/a)^2 D).
double curvature_ratio(double axes) {
    const double rest = axes * axes;
    const Elliptic e = elliptic(1 - rest, rest);
    return e.B / (rest * e.D);
}

}  // namespace

EllipseFactors ellipse_factors(double ratio) {
    if (!(ratio >= 1) || !std::isfinite(ratio)) {
        throw Error(Failure::bad_input, "the ratio of the principal curvatures of a summit must be finite and at least 1");
    }
    // Secant steps on ln ratio against ln axes, nearly a straight line of slope -3/2 (Johnson, eq. 4.28).
    const double wanted = std::log(ratio);
    double x = -2.0 / 3 * wanted, slope = -1.5;
    double miss = std::log(curvature_ratio(std::exp(x))) - wanted;
    for (int i = 0; i < 60 && std::abs(miss) > 1e-15 * (1 + wanted); ++i) {
        const double next = std::min(0.0, x - miss / slope);
        const double next_miss = std::log(curvature_ratio(std::exp(next))) - wanted;
        if (next == x) break;
        const double s = (next_miss - miss) / (next - x);
        if (s < -0.5 && s > -5) slope = s;
        x = next;
        miss = next_miss;
    }
    EllipseFactors f;
    f.axes = std::exp(x);
    const double rest = f.axes * f.axes;
    const Elliptic e = elliptic(1 - rest, rest);
    // F1 of eq. 4.30 with the powers of e^2 cancelled: {[(a/b)^2 E - K][K - E]} = e^4 B D (a/b)^2.
    f.F1 = std::cbrt(4 / std::numbers::pi) * std::sqrt(f.axes) * std::pow(e.B * e.D / rest, 1.0 / 6);
    f.F2 = 2 / std::numbers::pi * std::sqrt(f.axes) * e.K / f.F1;
    return f;
}

}  // namespace rsc
