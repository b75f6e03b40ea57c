#include "contact/interaction/mesh_split.hpp"
#include "std.hpp"

#include <boost/math/quadrature/gauss.hpp>

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

template <class Function>
double integral(double a, double b, Function function) {
    return boost::math::quadrature::gauss<double, 40>::integrate(function, a, b);
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

// By falling error: the larger of those measured on 1600 random points with forces of random sign and of one sign, beta and the
// shape of the window being searched for the least of it.
constexpr MeshDesign kDesigns[] = {
    {6.6e-04, 4, 2.0, 8.27, 5.53},    {3.8e-04, 4, 2.5, 8.34, 6.65},    {2.0e-04, 4, 3.0, 10.26, 6.48},   {7.3e-05, 6, 2.5, 10.45, 7.71},
    {2.3e-05, 6, 3.0, 12.05, 8.72},   {9.2e-06, 6, 3.5, 13.12, 9.69},   {4.4e-06, 7, 3.5, 13.73, 10.42},  {2.6e-06, 8, 3.5, 14.06, 10.83},
    {8.0e-07, 8, 4.0, 15.48, 11.92},  {2.7e-07, 8, 4.5, 16.23, 13.03},  {1.2e-07, 8, 5.0, 16.95, 13.90},  {6.1e-08, 8, 5.5, 18.00, 14.46},
    {3.3e-08, 8, 6.0, 18.68, 14.98},  {9.9e-09, 10, 5.5, 19.59, 16.19}, {4.2e-09, 10, 6.0, 20.67, 17.07}, {1.2e-09, 12, 6.0, 21.74, 18.27},
    {4.9e-10, 12, 6.5, 23.64, 19.20}, {1.6e-10, 12, 7.0, 24.35, 20.17}, {5.9e-11, 12, 7.5, 24.93, 21.15}, {2.5e-11, 12, 8.0, 25.28, 22.11},
};

// Points that lie more evenly than at random have the smaller potentials, and the larger relative errors.
constexpr double kMargin = 0.6;

}  // namespace

const MeshDesign& mesh_design(double relative_error) {
    for (const MeshDesign& design : kDesigns)
        if (design.error <= kMargin * relative_error) return design;
    return kDesigns[std::size(kDesigns) - 1];
}

namespace {

// F for a cutoff of 1.
NearKernel unit_kernel(const MeshDesign& design) {
    const double whole = integral(0, 1, [&](double t) { return bell(design.beta, t); });
    // As a function of s = 1 - d^2 in [0, 1]: the mean of the bell over [0, d], which has a limit at d = 0.
    const auto smooth = [&](double s) {
        const double d = std::sqrt(std::max(0.0, 1 - s));
        return integral(0, 1, [&](double t) { return bell(design.beta, t * d); }) / whole;
    };
    const auto p = polynomial([&](double t) { return smooth((t + 1) / 2); }, 0.1 * design.error, kNearDegree);
    std::vector<long double> q(p.size());  // from powers of t = 2 s - 1 to powers of s
    for (std::size_t k = p.size(); k-- > 0;) {
        for (std::size_t m = q.size() - 1; m > 0; --m) q[m] = 2 * q[m - 1] - q[m];
        q[0] = -q[0] + p[k];
    }
    NearKernel kernel;
    kernel.degree = static_cast<int>(q.size()) - 1;
    std::copy(q.begin(), q.end(), kernel.c);
    return kernel;
}

MeshWindow make_window(const MeshDesign& design) {
    MeshWindow window;
    window.width = design.width;
    const double scale = 1 / bell(design.shape, 0);
    for (int m = 0; m < design.width; ++m) {
        const auto piece = [&](double t) { return scale * bell(design.shape, (2 * m + t + 1) / design.width - 1); };
        const auto p = polynomial(piece, 0.1 * design.error, kWindowDegree);
        window.degree = std::max(window.degree, static_cast<int>(p.size()) - 1);
        for (std::size_t k = 0; k < p.size(); ++k) window.c[k][m] = static_cast<double>(p[k]);
    }
    return window;
}

// Made once a design: operators are made anew whenever the points change.
struct Tables {
    std::once_flag made;
    NearKernel kernel;
    MeshWindow window;
};

const Tables& tables(const MeshDesign& design) {
    static Tables all[std::size(kDesigns)];
    Tables& mine = all[&design - kDesigns];
    std::call_once(mine.made, [&] { mine.kernel = unit_kernel(design), mine.window = make_window(design); });
    return mine;
}

}  // namespace

NearKernel near_kernel(const MeshDesign& design, double cutoff) {
    NearKernel kernel = tables(design).kernel;
    kernel.reach = cutoff;
    kernel.cutoff2 = cutoff * cutoff;
    double unit = cutoff;
    for (int k = 0; k <= kernel.degree; ++k, unit *= kernel.cutoff2) kernel.c[k] /= unit;
    return kernel;
}

MeshWindow mesh_window(const MeshDesign& design) { return tables(design).window; }

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
    // The smallest square distance to a multiple of the period, with its kink at period/2 smoothed by the bell over +- bend.
    // Around the kink it is x^2 - 2 period (x - period/2)_+, and the bell turns the ramp into its mean.
    x = std::abs(std::remainder(x, period));
    const double from = (x - period / 2) / bend;  // in [-period/(2 bend), 0]
    if (from <= -1) return x * x;
    const double whole = integral(-1, 1, [&](double t) { return bell(design.beta, t); });
    const double ramp = integral(-1, from, [&](double t) { return bell(design.beta, t) * (from - t); }) / whole;
    return x * x - 2 * period * bend * ramp;
}

}  // namespace rsc
