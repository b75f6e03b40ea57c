#include "asperities/ellipse.hpp"

#include "base/error.hpp"

namespace rsc {
namespace {

// K, B = [E - (1 - k^2) K]/k^2 and D = (K - E)/k^2 of modulus k, which are finite and accurate at
// k = 0.
struct Elliptic {
    double K, B, D;
};

// By the arithmetic-geometric mean of 1 and the complementary modulus: K = pi/(2 a) of its limit a,
// and D = K sum 2^(n-1) c_n^2/k^2 with c_0 = k and c_n+1 = c_n^2/(4 a_n+1) half the difference of
// the two means.
Elliptic elliptic(double complementary) {
    double arithmetic = 0.5 * (1 + complementary);
    double geometric = std::sqrt(complementary);
    double half = 0.5 * (1 - complementary);
    double term = 0.5 * half / (1 + complementary);
    double sum = 0.5;
    while (sum + term > sum) {
        sum += term;
        const double next = 0.5 * (arithmetic + geometric);
        geometric = std::sqrt(arithmetic * geometric);
        arithmetic = next;
        const double shrink = half / (4 * arithmetic);
        half *= shrink;
        term *= 2 * shrink * shrink;
    }
    const double K = pi / (2 * arithmetic), D = K * sum;
    return {K, K - D, D};
}

}  // namespace

EllipseFactors ellipse_factors(double ratio) {
    if (!(ratio >= 1) || !std::isfinite(ratio)) {
        throw Error(
            Failure::bad_input,
            "the ratio of the principal curvatures of a summit must be finite and at least 1");
    }
    // ln ratio as a function of ln axes is nearly a straight line of slope -3/2 (Johnson, eq.
    // 4.28): kappa1/kappa2 = [(a/b)^2 E - K]/[K - E].
    // Newton's method with dK = -B and d(B + axes^2 D) = axes^2 D for a change of ln axes by 1.
    constexpr double nearly_round = 1e-9;
    const double log_ratio = std::log(ratio);
    double x = -2.0 / 3 * log_ratio;
    if (log_ratio > nearly_round) {
        constexpr int most = 50;
        for (int k = 0; k < most; ++k) {
            const double square = std::exp(2 * x);
            const Elliptic e = elliptic(std::exp(x));
            const double dD = -(e.B - square * e.D) / -std::expm1(2 * x), dB = -e.B - dD;
            const double step =
                (std::log(e.B / (square * e.D)) - log_ratio) / (dB / e.B - dD / e.D - 2);
            x -= step;
            if (std::abs(step) < 1e-8 * std::abs(x)) break;  // the next would be its square
        }
    }
    EllipseFactors f;
    f.axes = std::exp(x);
    const Elliptic e = elliptic(f.axes);
    // F1 of eq. 4.30 with the powers of e^2 cancelled, since [(a/b)^2 E - K][K - E] = e^4 B D
    // (a/b)^2.
    f.F1 = std::cbrt(4 / pi) * std::sqrt(f.axes) * std::pow(e.B * e.D / (f.axes * f.axes), 1.0 / 6);
    f.F2 = 2 / pi * std::sqrt(f.axes) * e.K / f.F1;
    return f;
}

}  // namespace rsc
