#include "contact/law/ellipse.hpp"

#include "error.hpp"

namespace rsc {
namespace {

// Complete elliptic integrals of modulus k: K, and B = [E - (1 - k^2) K]/k^2, D = (K - E)/k^2, which are finite and accurate at k = 0.
struct Elliptic {
    double K, B, D;
};

// By the arithmetic-geometric mean (Abramowitz and Stegun 17.6) from the complementary modulus k' = sqrt(1 - k^2): K = pi/(2 a_n), K - E =
// K (c_0^2 + 2 c_1^2 + 4 c_2^2 + ...)/2, c_0 = k.
Elliptic elliptic(double complementary) {
    double a = 1, b = complementary;
    double c = 0.5 * (1 - b), term = 0.25 * (1 - b) / (1 + b), sum = 0.5;  // c_1; 2^(n-1) c_n^2/k^2
    for (int n = 1; n < 20 && term > 1e-18; ++n) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
        sum += term;
        const double shrinks = c / (2 * (a + b));  // c_(n+1) = c_n^2/(4 a_(n+1))
        term *= 2 * shrinks * shrinks;
        c *= shrinks;
    }
    const double K = std::numbers::pi / (a + b), D = K * sum;
    return {K, K - D, D};
}

// Ratio kappa1/kappa2 for the axis ratio b/a, e^2 = 1 - (b/a)^2: [(a/b)^2 E - K]/[K - E] = B/((b/a)^2 D).
double curvature_ratio(double axes) {
    const Elliptic e = elliptic(axes);
    return e.B / (axes * axes * e.D);
}

}  // namespace

double complete_K(double complementary) { return elliptic(complementary).K; }

EllipseFactors ellipse_factors(double ratio) {
    if (!(ratio >= 1) || !std::isfinite(ratio)) {
        throw Error(Failure::bad_input, "the ratio of the principal curvatures of a summit must be finite and at least 1");
    }
    // Secant method on ln ratio as a function of ln axes, which is nearly a straight line of slope -3/2 (Johnson, eq. 4.28).
    const double wanted = std::log(ratio);
    double x = -2.0 / 3 * wanted, slope = -1.5;
    double miss = std::log(curvature_ratio(std::exp(x))) - wanted;
    for (int i = 0; i < 60 && std::abs(miss) > 4e-15 * (1 + wanted); ++i) {
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
    const Elliptic e = elliptic(f.axes);
    // F1 of eq. 4.30 with the powers of e^2 cancelled, since [(a/b)^2 E - K][K - E] = e^4 B D (a/b)^2.
    f.F1 = std::cbrt(4 / std::numbers::pi) * std::sqrt(f.axes) * std::pow(e.B * e.D / (f.axes * f.axes), 1.0 / 6);
    f.F2 = 2 / std::numbers::pi * std::sqrt(f.axes) * e.K / f.F1;
    return f;
}

}  // namespace rsc
