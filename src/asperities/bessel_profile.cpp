#include "asperities/bessel_profile.hpp"

namespace rsc {
namespace {

// The functions of t by their definitions.
template <class T>
BesselProfile::Values<T> defined(T t) {
    const T root = std::sqrt(std::abs(t));
    const T half = t > 0 ? std::asin(std::min(root, T(1))) : std::asinh(root);  // |q| a/2
    const T G = root > T(1e-6) ? half / root : 1 + t / 6;
    const T x2 = t > 0 ? 4 * half * half : -4 * half * half;  // q^2 a^2
    // Load 3 (sin x - x cos x)/x^3 and work 15 (x/2 + x cos(2x)/4 - 3 sin(2x)/8)/x^5, relative to a
    // paraboloid of the same a.
    T load = 0, work = 0;
    if (std::abs(x2) <
        1) {  // series, since the closed forms would cancel; its error is below 1e-21
        T load_term = T(1) / 3,
          work_term = T(1) / 120;  // 2 (-x2)^(m-1)/(2m+1)!, (-4 x2)^(m-1)/(2m+3)!
        for (int m = 1; m < 14; ++m) {
            load += 3 * m * load_term;
            work += 120 * m * work_term;
            load_term *= -x2 / ((2 * m + 2) * (2 * m + 3));
            work_term *= -4 * x2 / ((2 * m + 4) * (2 * m + 5));
        }
    } else {
        const T x = 2 * half, x3 = x * x * x, sign = t > 0 ? T(1) : T(-1);
        const T s = t > 0 ? std::sin(x) : std::sinh(x), c = t > 0 ? std::cos(x) : std::cosh(x);
        load = 3 * sign * (s - x * c) / x3;
        work = 15 * (x / 2 + x * (2 * c * c - 1) / 4 - 3 * s * c / 4) / (x3 * x * x);
    }
    const T G3 = G * G * G;
    return {G, G3 * load, G3 * G * G * work};
}

// Even and odd powers are summed separately, which halves the dependency chain.
template <std::size_t N>
double evaluate(const std::array<double, N>& c, double s) {
    static_assert(N % 2 == 1);
    const double s2 = s * s;
    double even = c[N - 1], odd = c[N - 2];
    for (std::size_t k = N - 3; k > 0; k -= 2) {
        even = even * s2 + c[k];
        odd = odd * s2 + c[k - 1];
    }
    return even * s2 + c[0] + odd * s;
}

// Coefficients (in powers of s) of the interpolating polynomial through y at the nodes s, by
// divided differences.
template <std::size_t N>
std::array<double, N> interpolate(const std::array<long double, N>& s,
                                  std::array<long double, N> y) {
    for (std::size_t order = 1; order < N; ++order) {
        for (std::size_t k = N - 1; k >= order; --k)
            y[k] = (y[k] - y[k - 1]) / (s[k] - s[k - order]);
    }
    std::array<long double, N> c{};
    for (std::size_t k = N; k-- > 0;) {  // c <- c (s - s_k) + y_k
        for (std::size_t m = N - 1; m > 0; --m) c[m] = c[m - 1] - s[k] * c[m];
        c[0] = y[k] - s[k] * c[0];
    }
    std::array<double, N> rounded;
    std::transform(c.begin(), c.end(), rounded.begin(), [](long double x) { return double(x); });
    return rounded;
}

}  // namespace

BesselProfile::BesselProfile() {
    std::array<long double, kTerms> s, radius, load, work;
    for (const int k : indices(kTerms)) {  // Chebyshev nodes
        s[static_cast<std::size_t>(k)] =
            std::cos(std::numbers::pi_v<long double> * (k + 0.5L) / kTerms);
    }
    for (const int cell : indices(kCells)) {
        for (std::size_t k = 0; k < kTerms; ++k) {
            const long double along = (1 + s[k]) / 2,
                              w = (cell - kCellsOfT + along) / kCellsPerUnit;
            const auto value = defined<long double>(
                cell < kCellsOfT ? kFirst + (cell + along) / kCellsPerUnit : 1 - w * w);
            radius[k] = value.radius;
            load[k] = value.load;
            work[k] = value.work;
        }
        cells_[static_cast<std::size_t>(cell)] = {interpolate(s, radius), interpolate(s, load),
                                                  interpolate(s, work)};
    }
}

BesselProfile::Shape BesselProfile::at(double t) const {
    if (!(t >= kFirst)) return defined<double>(t);
    const bool of_t = t < kMiddle;
    const double along = kCellsPerUnit * (of_t ? t - kFirst : std::sqrt(std::max(1 - t, 0.0)));
    const int number = std::min(int(along), of_t ? kCellsOfT - 1 : kCells - kCellsOfT - 1);
    const Cell& cell = cells_[static_cast<std::size_t>(of_t ? number : kCellsOfT + number)];
    const double s = 2 * (along - number) - 1;
    return {evaluate(cell.radius, s), evaluate(cell.load, s), evaluate(cell.work, s)};
}

const BesselProfile& BesselProfile::table() {
    static const BesselProfile one;
    return one;
}

}  // namespace rsc
