#include "contact/mesh_split.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace rsc {

namespace {

constexpr double kPi = std::numbers::pi;

// I0(sqrt(z)) for z >= 0 by its power series, whose terms are all positive.
double bessel_i0_of_root(double z) {
    double term = 1, sum = 1;
    for (int k = 1; term > 1e-18 * sum; ++k) {
        term *= z / (4.0 * k * k);
        sum += term;
    }
    return sum;
}

double bell(double beta, double t) { return bessel_i0_of_root(beta * beta * std::max(0.0, 1 - t * t)); }

// Gauss-Legendre rule on [0, 1].
struct Rule {
    static constexpr int kPoints = 40;
    double x[kPoints], w[kPoints];
    Rule() {
        for (int i = 0; i < kPoints; ++i) {
            long double z = std::cos(std::numbers::pi_v<long double> * (i + 0.75L) / (kPoints + 0.5L)), slope = 1;
            for (int pass = 0; pass < 8; ++pass) {
                long double p = 1, before = 0;
                for (int k = 0; k < kPoints; ++k) {
                    const long double next = ((2 * k + 1) * z * p - k * before) / (k + 1);
                    before = p;
                    p = next;
                }
                slope = kPoints * (z * p - before) / (z * z - 1);
                z -= p / slope;
            }
            x[i] = static_cast<double>((1 + z) / 2);
            w[i] = static_cast<double>(1 / ((1 - z * z) * slope * slope));
        }
    }
};

const Rule& rule() {
    static const Rule rule;
    return rule;
}

template <class Function>
double integral(double a, double b, Function function) {
    double sum = 0;
    for (int i = 0; i < Rule::kPoints; ++i) sum += rule().w[i] * function(a + (b - a) * rule().x[i]);
    return (b - a) * sum;
}

// Coefficients of t^k, t in [-1, 1], of the Chebyshev interpolant of a function, cut where what follows is below `tolerance`.
std::vector<long double> polynomial(const std::function<double(double)>& function, double tolerance, int largest_degree) {
    constexpr int kNodes = 48;
    long double value[kNodes], chebyshev[kNodes];
    for (int i = 0; i < kNodes; ++i) value[i] = function(std::cos(kPi * (i + 0.5) / kNodes));
    for (int k = 0; k < kNodes; ++k) {
        long double sum = 0;
        for (int i = 0; i < kNodes; ++i) sum += value[i] * std::cos(std::numbers::pi_v<long double> * k * (i + 0.5L) / kNodes);
        chebyshev[k] = sum * (k == 0 ? 1 : 2) / kNodes;
    }
    int degree = largest_degree;
    long double tail = 0;
    while (degree > 1 && (tail += std::abs(chebyshev[degree])) < tolerance) --degree;
    std::vector<long double> sum(static_cast<std::size_t>(degree) + 1), t0(sum.size()), t1(sum.size()), t2(sum.size());
    t0[0] = 1, t1[1] = 1;
    for (int k = 0; k <= degree; ++k) {
        for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += chebyshev[k] * t0[m];
        for (std::size_t m = 0; m < sum.size(); ++m) t2[m] = (m > 0 ? 2 * t1[m - 1] : 0) - t0[m];
        t0.swap(t1), t1.swap(t2);
    }
    return sum;
}

constexpr MeshDesign kDesigns[] = {
    {3.0e-4, 4, 2.5, 10.14, 5.85},   {4.4e-5, 5, 3.0, 11.89, 7.61},   {7.0e-6, 6, 3.5, 13.48, 9.38},
    {1.2e-6, 7, 4.0, 15.05, 11.10},  {2.8e-7, 7, 5.0, 15.59, 12.91},  {8.9e-8, 8, 5.0, 16.81, 13.82},
    {5.7e-9, 9, 6.0, 19.53, 16.19},  {3.0e-10, 11, 7.0, 23.7, 19.3},  {2.0e-11, 13, 8.0, 28.0, 22.4},
};

}  // namespace

const MeshDesign& mesh_design(double relative_error) {
    for (const MeshDesign& design : kDesigns)
        if (design.error <= relative_error) return design;
    return kDesigns[std::size(kDesigns) - 1];
}

NearKernel near_kernel(const MeshDesign& design, double cutoff) {
    NearKernel kernel;
    kernel.reach = cutoff;
    kernel.cutoff2 = cutoff * cutoff;
    const double whole = integral(0, 1, [&](double t) { return bell(design.beta, t); });
    // As a function of s = 1 - (d/cutoff)^2 in [0, 1]; at d = 0 the limit, through the mean of the bell over [0, d].
    const auto smooth = [&](double s) {
        const double d = std::sqrt(std::max(0.0, 1 - s));
        return integral(0, 1, [&](double t) { return bell(design.beta, t * d); }) / whole;
    };
    const auto p = polynomial([&](double t) { return smooth((t + 1) / 2); }, 0.1 * design.error, kNearDegree);
    // From powers of t = 2 s - 1 to powers of s, and then of cutoff^2 - d^2 = cutoff^2 s.
    std::vector<long double> q(p.size());
    for (std::size_t k = p.size(); k-- > 0;) {
        for (std::size_t m = q.size() - 1; m > 0; --m) q[m] = 2 * q[m - 1] - q[m];
        q[0] = -q[0] + p[k];
    }
    kernel.degree = static_cast<int>(p.size()) - 1;
    long double unit = cutoff;
    for (std::size_t k = 0; k < q.size(); ++k) {
        kernel.c[k] = static_cast<double>(q[k] / unit);
        unit *= static_cast<long double>(cutoff) * cutoff;
    }
    return kernel;
}

MeshWindow mesh_window(const MeshDesign& design) {
    MeshWindow window;
    window.width = design.width;
    const double scale = 1 / bell(design.shape, 0);
    std::vector<std::vector<long double>> pieces;
    for (int m = 0; m < design.width; ++m) {
        const auto piece = [&](double t) { return scale * bell(design.shape, (2 * m + t + 1) / design.width - 1); };
        pieces.push_back(polynomial(piece, 0.1 * design.error, kWindowDegree));
        window.degree = std::max(window.degree, static_cast<int>(pieces.back().size()) - 1);
    }
    for (std::size_t m = 0; m < pieces.size(); ++m)
        for (std::size_t k = 0; k < pieces[m].size(); ++k) window.c[k][m] = static_cast<double>(pieces[m][k]);
    return window;
}

double window_transform(const MeshDesign& design, double k) {
    const double z = design.shape * design.shape - std::pow(design.width * k / 2, 2), root = std::sqrt(std::abs(z));
    const double value = root < 1e-6 ? 1 : z > 0 ? std::sinh(root) / root : std::sin(root) / root;
    return design.width * value / bell(design.shape, 0);
}

double window_alias_sum(const MeshDesign& design, double k) {
    double sum = 0;
    for (int m = -2; m <= 2; ++m) sum += std::pow(window_transform(design, k + 2 * kPi * m), 2);
    return sum;
}

double periodic_square(const MeshDesign& design, double x, double period, double bend) {
    // The smallest square distance to a multiple of the period, with its kink at period/2 smoothed by the bell over +- bend. Around the
    // kink it is x^2 - 2 period (x - period/2)_+, and the bell turns the ramp into its mean.
    x = std::abs(std::remainder(x, period));
    const double from = (x - period / 2) / bend;  // in [-period/(2 bend), 0]
    if (from <= -1) return x * x;
    const double whole = integral(-1, 1, [&](double t) { return bell(design.beta, t); });
    const double ramp = integral(-1, from, [&](double t) { return bell(design.beta, t) * (from - t); }) / whole;
    return x * x - 2 * period * bend * ramp;
}

}  // namespace rsc
