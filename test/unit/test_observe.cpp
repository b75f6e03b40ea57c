// Observations: closed forms, maps, radial means, distributions and fits, and their addition over realizations.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "check.hpp"
#include "contact/equivalent.hpp"
#include "error.hpp"
#include "observe/exact_sum.hpp"
#include "observe/radial.hpp"
#include "observe/record.hpp"
#include "observe/regimes.hpp"

using namespace rsc;
using std::numbers::pi;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-13;  // a few hundred operations on numbers of order one

void test_two_bodies() {
    // Steel on steel, by hand: E/(2 (1 - nu^2)) = 210000/1.82 = 115384.615...
    CHECK_RELATIVE(equivalent_modulus({210e3, 210e3}, {0.3, 0.3}), 115384.61538461539, 1e-14);
    CHECK_RELATIVE(equivalent_modulus({78e3, kInf}, {0.42, 0.0}), 78e3 / (1 - 0.1764), 1e-15);
    CHECK_RELATIVE(equivalent_radius({2.0, 3.0}), 1.2, 1e-15);
    CHECK(equivalent_radius({kInf, 2.5}) == 2.5);
    CHECK(equivalent_radius({kInf, kInf}) == kInf);
    CHECK_THROWS(equivalent_modulus({kInf, kInf}, {0.3, 0.3}), Error);
    CHECK_THROWS(equivalent_modulus({-1.0, 1.0}, {0.3, 0.3}), Error);
    CHECK_THROWS(equivalent_modulus({1.0, 1.0}, {0.6, 0.3}), Error);
    CHECK_THROWS(equivalent_modulus({1.0, std::nan("")}, {0.3, 0.3}), Error);
    CHECK_THROWS(equivalent_radius({0.0, 1.0}), Error);
}

void test_hertz() {
    // By hand: R = 2, E* = 3, N = 32: a^3 = 3*32*2/12 = 16; a = 2.519842..., delta = a^2/2, p0 = 48/(pi a^2).
    const Hertz h = hertz_contact(32, 2, 3);
    CHECK_RELATIVE(h.radius, 2.5198420997897464, 1e-15);
    CHECK_RELATIVE(h.penetration, 3.1748021039363990, 1e-15);
    CHECK_RELATIVE(h.peak, 48 / (pi * 6.3496042078727980), 1e-14);
    CHECK_RELATIVE(h.area(), pi * 6.3496042078727980, 1e-14);
    CHECK_RELATIVE(h.pressure(0.6 * h.radius), 0.8 * h.peak, 1e-14);
    CHECK(h.pressure(h.radius) == 0 && h.pressure(2 * h.radius) == 0);
    // The pressure carries the force (midpoint rule with the substitution r = a sin t, smooth integrand).
    double force = 0;
    for (int k = 0; k < 1000; ++k) {
        const double t = (k + 0.5) * pi / 2000;
        force += h.pressure(h.radius * std::sin(t)) * 2 * pi * h.radius * std::sin(t) * h.radius * std::cos(t) * pi / 2000;
    }
    CHECK_RELATIVE(force, 32.0, 1e-6);
    const Hertz none = hertz_contact(0, 2, 3);
    CHECK(none.radius == 0 && none.peak == 0 && none.pressure(0) == 0);
    CHECK_THROWS(hertz_contact(-1, 2, 3), Error);
    CHECK_THROWS(hertz_contact(1, kInf, 3), Error);
}

void test_regimes() {
    const Moments m{1e-4, 0.02, 30.0};
    const double E = 9e4;
    // The paper's constant, printed to five digits.
    const double N = transition_force(m, E);
    CHECK_RELATIVE(N, 212.66 * std::pow(m.m2, 1.5) * E / m.m4, 3e-5);
    // Both regimes meet there, for any prefactor.
    CHECK_RELATIVE(area_one_asperity(N, m.mean_radius(), E), area_proportional(N, m.m2, E), 1e-13);
    const double N3 = transition_force(m, E, 0.3);
    CHECK_RELATIVE(area_one_asperity(N3, m.mean_radius(), E), area_proportional(N3, m.m2, E, 0.3), 1e-13);
    // By hand: N = 4, r_g = 9, E* = 3.375: (3*9*4/(13.5))^(2/3) = 8^(2/3) = 4.
    CHECK_RELATIVE(area_one_asperity(4, 9, 3.375), 4 * pi, 1e-14);
    // By hand: 0.2 sqrt(2 pi) 10 / (sqrt(2*0.5) 2) = sqrt(2 pi).
    CHECK_RELATIVE(area_proportional(10, 0.5, 2), std::sqrt(2 * pi), 1e-14);
}

void test_grid() {
    const MapGrid grid = make_map_grid(0, 0, 1, 1, 50);
    CHECK(grid.nx == 50 && grid.ny == 50);
    CHECK(grid.cell(0, 0) == 0);
    CHECK(grid.cell(0.5, 0.5) == 25 * 50 + 25);  // a cell owns its lower edges
    CHECK(grid.cell(1, 1) == 2499);              // the far edges belong to the last cells
    CHECK(grid.cell(-1e-12, 0.5) == -1 && grid.cell(0.5, 1.0000001) == -1);
    CHECK(grid.cell(std::nan(""), 0.5) == -1);
    const MapGrid shifted = make_map_grid(-3, 2, 6, 1.5, 12);  // rows of 0.5: three fit
    CHECK(shifted.ny == 3 && shifted.cell(-3, 2) == 0 && shifted.cell(2.99, 3.49) == 35);
    CHECK(make_map_grid(0, 0, 1, 0.3, 10).ny == 3);  // 0.3/0.1 is 2.9999999999999996
    CHECK(make_map_grid(0, 0, 1, 0.29, 10).ny == 2);
    CHECK_THROWS(make_map_grid(0, 0, 1, 0.05, 10), Error);
    CHECK_THROWS(make_map_grid(0, 0, 1, 1, 0), Error);
    CHECK_THROWS(make_map_grid(0, 0, 0, 1, 10), Error);
}

// A parabolic map with all six terms, and its exact mean over a circle.
struct Parabola {
    double c0, cx, cy, cxx, cxy, cyy;
    double operator()(double x, double y) const { return c0 + cx * x + cy * y + cxx * x * x + cxy * x * y + cyy * y * y; }
    double circle_mean(double x, double y, double r) const { return (*this)(x, y) + (cxx + cyy) * r * r / 2; }
};

std::vector<double> sample(const MapGrid& grid, const Parabola& f) {
    std::vector<double> values;
    for (int j = 0; j < grid.ny; ++j)
        for (int i = 0; i < grid.nx; ++i) values.push_back(f(grid.x(i), grid.y(j)));
    return values;
}

void test_radial() {
    const Parabola f{0.7, -0.4, 0.9, 1.3, -0.8, 0.5};
    for (const MapGrid& grid : {make_map_grid(0, 0, 1, 1, 50), make_map_grid(-0.3, 0.2, 1, 0.6, 20), make_map_grid(0, 0, 1, 1, 3),
                                make_map_grid(0, 0, 1, 1, 4)}) {
        const std::vector<double> values = sample(grid, f);
        // Everywhere in the map, up to its outermost edge, half a cell beyond the last centres.
        for (double u : {0.0, 0.003, 0.2, 0.5, 0.77, 1.0})
            for (double v : {0.0, 0.4, 0.991, 1.0}) {
                const double x = grid.x0 + u * grid.Lx(), y = grid.y0 + v * grid.Ly();
                CHECK_CLOSE(interpolate(grid, values, x, y), f(x, y), kRounding);
            }
        const double tip_x = grid.x0 + 0.45 * grid.Lx(), tip_y = grid.y0 + 0.52 * grid.Ly();
        const RadialMean mean(grid, tip_x, tip_y, 30);
        const std::vector<double> radial = mean(values.data());
        CHECK(radial.size() == 30);
        for (std::size_t b = 0; b < radial.size(); ++b) CHECK_CLOSE(radial[b], f.circle_mean(tip_x, tip_y, mean.radii()[b]), kRounding);
        const double largest = std::min({0.45 * grid.Lx(), 0.48 * grid.Ly()});
        CHECK_RELATIVE(mean.radii().back() + mean.ring_width() / 2, largest, 1e-12);
    }
    // The largest circle in the map, whichever border is the nearest one.
    for (const auto& [x, y] : {std::pair{0.1, 0.5}, {0.9, 0.45}, {0.45, 0.1}, {0.5, 0.9}}) {
        const RadialMean mean(make_map_grid(-0.3, 0.2, 1, 1, 20), x - 0.3, y + 0.2, 4);
        CHECK_RELATIVE(mean.radii().back() + mean.ring_width() / 2, 0.1, 1e-12);
    }
    // Re (x + iy)^m about the tip is harmonic: its mean over any circle about it is 0, which no few directions give. The interpolation
    // leaves errors of fourth order in the cell.
    for (int m : {4, 8, 12, 16}) {
        const MapGrid grid = make_map_grid(-1, -1, 2, 2, 200);
        std::vector<double> values;
        for (int j = 0; j < grid.ny; ++j)
            for (int i = 0; i < grid.nx; ++i)
                values.push_back(std::pow(std::hypot(grid.x(i), grid.y(j)), m) * std::cos(m * std::atan2(grid.y(j), grid.x(i)) + 0.4));
        const RadialMean mean(grid, 0, 0, 10);
        const std::vector<double> radial = mean(values.data());
        for (std::size_t b = 0; b < radial.size(); ++b) CHECK_CLOSE(radial[b], 0, 2e-3 * std::pow(mean.radii()[b], m) + 1e-9);
    }
    // Nodes are reproduced, and the curve is smooth across them: equal slopes from both sides.
    const std::vector<double> f1{0.3, -1.0, 2.0, 0.5, 0.1, 0.9};
    const auto at = [&](double s) {
        const BezierWeights w = bezier_weights(6, s);
        double sum = 0;
        for (int k = 0; k < w.count; ++k) sum += w.weight[static_cast<std::size_t>(k)] * f1[static_cast<std::size_t>(w.first + k)];
        return sum;
    };
    for (int i = 0; i < 6; ++i) CHECK_CLOSE(at(i), f1[static_cast<std::size_t>(i)], kRounding);
    for (int i = 1; i < 5; ++i) CHECK_CLOSE((at(i + 1e-6) - at(i)) / 1e-6, (at(i) - at(i - 1e-6)) / 1e-6, 1e-4);  // O(step)
    // Two cells give the plane, one the constant; no ring about a tip outside.
    const MapGrid two = make_map_grid(0, 0, 1, 1, 2);
    CHECK_CLOSE(interpolate(two, {1, 2, 3, 4}, 0.5, 0.5), 2.5, kRounding);
    CHECK_CLOSE(interpolate(make_map_grid(0, 0, 1, 1, 1), {7}, 0.1, 0.9), 7.0, kRounding);
    CHECK(RadialMean(two, 1.5, 0.5, 10).radii().empty() && RadialMean(two, 0, 0.5, 10).radii().empty());
}

// n values at the quantiles (i - 1/2)/n, through the same counting as contacts.
Distributions quantiles(const PdfBins& bins, int n, bool pressure, double scale) {
    Level level;
    for (int i = 0; i < n; ++i) {
        const double q = -std::log1p(-(i + 0.5) / n);
        const double area = pressure ? 1e-4 : scale * q, p = pressure ? scale * std::sqrt(2 * q) : 1;
        level.asperity.push_back(i);
        level.a.push_back(std::sqrt(area / pi));
        level.f.push_back(p * area);
    }
    return distributions_of(bins, level, 0);
}

void test_scale_fits() {
    const int n = 20000;
    const PdfBins bins{60, 5.0, 8.0};
    // Midpoint quantiles miss the moments by O(log n / n) and the cumulative by 1/(2n).
    const FittedDistributions rayleigh = fit_distributions(bins, quantiles(bins, n, true, 0.8));
    CHECK_RELATIVE(rayleigh.rayleigh.scale, 0.8, 5e-5);
    CHECK_RELATIVE(rayleigh.rayleigh.scale_error, 0.8 / (2 * std::sqrt(n)), 1e-4);
    CHECK(rayleigh.rayleigh.ks_distance < 1e-4);
    CHECK_CLOSE(rayleigh.mean_pressure_moments.skewness, 0.6311, 2e-3);  // 2 sqrt(pi) (pi - 3)/(4 - pi)^(3/2)
    CHECK_CLOSE(rayleigh.mean_pressure_moments.kurtosis, 3.2451, 1e-2);
    const FittedDistributions exponential = fit_distributions(bins, quantiles(bins, n, false, 0.6));
    CHECK_RELATIVE(exponential.exponential.scale, 0.6, 5e-5);
    CHECK_RELATIVE(exponential.exponential.scale_error, 0.6 / std::sqrt(n), 1e-4);
    CHECK(exponential.exponential.ks_distance < 1e-4);
    // The distance sees a wrong law: exponential values against Rayleigh (0.2 or so).
    Binned wrong{8.0 / 60, {}, 0};
    for (std::int64_t c : quantiles(bins, n, false, 0.6).spot_area.count) wrong.weight.push_back(static_cast<double>(c));
    CHECK(fit_rayleigh(n, 2 * 0.36 * n, wrong).ks_distance > 0.1);
    // No contacts: absent, not zero.
    const FittedDistributions none = fit_distributions(bins, distributions_of(bins, Level{}, 0));
    CHECK(std::isnan(none.rayleigh.scale) && std::isnan(none.gamma.alpha) && std::isnan(none.mean_pressure_pdf[0]));
}

// Integral of the density over [x0, x1] by composite Simpson in u = x^(1/3): independent of the incomplete gamma function. Not
// normalised.
double simpson(double x0, double x1, double alpha, double beta, double delta) {
    const double u0 = std::cbrt(x0), h = (std::cbrt(x1) - u0) / 200;
    const auto f = [&](double u) { return std::pow(u * u * u, alpha) * std::exp(-std::pow(u * u * u / delta, beta)) * 3 * u * u; };
    double sum = 0;
    for (int k = 0; k < 200; k += 2) sum += f(u0 + k * h) + 4 * f(u0 + (k + 1) * h) + f(u0 + (k + 2) * h);
    return sum * h / 3;
}

void test_gamma_fit() {
    // Known values: P(1, x) = 1 - exp(-x), P(1/2, x) = erf(sqrt(x)).
    for (double x : {1e-6, 0.3, 1.0, 1.9, 2.5, 7.0, 40.0}) {
        CHECK_RELATIVE(incomplete_gamma(1, x).P, -std::expm1(-x), 1e-13);
        CHECK_RELATIVE(incomplete_gamma(1, x).Q, std::exp(-x), 1e-12);
        CHECK_RELATIVE(incomplete_gamma(0.5, x).P, std::erf(std::sqrt(x)), 1e-13);
        CHECK_RELATIVE(incomplete_gamma(0.5, x).Q, std::erfc(std::sqrt(x)), 1e-11);
    }
    for (const auto& [alpha, beta, delta] : {std::array{2.0 / 3, 1.5, 300.0}, {1.0, 2.0, 50.0}, {0.2, 1.0, 2.0}, {1.8, 3.0, 0.01}}) {
        Binned binned{delta / 12, {}, 0};
        double total = 0, first = 0;
        for (int b = 0; b < 600; ++b) {
            const double w = simpson(b * binned.width, (b + 1) * binned.width, alpha, beta, delta);
            (b < 30 ? binned.weight.push_back(w) : void(binned.overflow += w));  // the tail goes into the overflow
            total += w;
            first += w * (b + 0.5) * binned.width;
        }
        const GammaFit fit = fit_generalised_gamma(binned, first / total, 1e4);
        // Simpson's rule and the derivative by differences leave some 1e-8.
        CHECK_CLOSE(fit.alpha, alpha, 1e-6);
        CHECK_RELATIVE(fit.beta, beta, 1e-6);
        CHECK_RELATIVE(fit.delta, delta, 1e-6);
        CHECK_RELATIVE(fit.gamma, 1 / total, 1e-6);  // the normalisation
        CHECK(fit.ks_distance < 1e-7);
        CHECK(fit.alpha_error > 0 && fit.beta_error > 0 && fit.delta_error > 0 && fit.gamma_error > 0);
    }
    Binned few{1, {1, 2, 3, 0, 0, 0}, 0};
    CHECK(std::isnan(fit_generalised_gamma(few, 1.5, 6).alpha));
}

// Where a map ends, its grid does; ranges of bins by their formulas; what is refused just beyond its bound.
void test_bounds() {
    const MapGrid grid = make_map_grid(-3, 2, 6, 1.6, 12);  // three rows of 0.5, and 0.1 that belongs to none
    CHECK(grid.nx == 12 && grid.ny == 3 && grid.cell(-1.4, 3.5) == 2 * 12 + 3 && grid.cell(3, 2.6) == 12 + 11);
    CHECK(grid.cell(-1.4, 3.55) == -1 && grid.cell(3.01, 2.6) == -1 && grid.cell(-3.01, 2.6) == -1 && grid.cell(0, 1.99) == -1);
    CHECK(make_map_grid(0, 0, 1, 1, 10000).ny == 10000);
    CHECK_THROWS(make_map_grid(0, 0, 1, 1, 10001), Error);
    for (const double bad : {0.0, -1.0, kInf, std::nan("")}) {
        CHECK_THROWS(make_map_grid(0, 0, bad, 1, 3), Error);
        CHECK_THROWS(make_map_grid(0, 0, 1, bad, 3), Error);
        CHECK_THROWS(make_pdf_bins(3, bad, 2, 3, kInf), Error);
        CHECK_THROWS(make_pdf_bins(3, 5, bad, 3, kInf), Error);
        CHECK_THROWS(make_pdf_bins(3, 5, 2, bad, kInf), Error);
    }
    CHECK_THROWS(make_pdf_bins(0, 5, 2, 3, kInf), Error);
    const PdfBins one = make_pdf_bins(1, 5, 2, 3, kInf), soft = make_pdf_bins(7, 5, 2, 3, 2.5);
    CHECK(one.bins == 1 && soft.bins == 7 && soft.pressure_max == 2.5);
    CHECK_RELATIVE(one.pressure_max, 1.2 * 5 * std::sqrt(6.0), kRounding);
    CHECK_RELATIVE(one.area_max, 20.0 / 3, kRounding);
    CHECK_RELATIVE(soft.pressure_width(), 1.5 * 2.5 / 7, kRounding);
    // Of two levels equally near the first; of none none.
    std::vector<Level> levels(3);
    levels[0].separation = 5, levels[1].separation = 3, levels[2].separation = 3;
    CHECK(nearest_level(levels, 4) == 0 && nearest_level(levels, 3.5) == 1 && nearest_level(levels, -9) == 1 && nearest_level({}, 1) == -1);
    // Equal values have neither skewness nor kurtosis, no values not even a mean.
    const DistributionMoments equal = moments_of(4, {12, 36, 108, 324}), none = moments_of(0, {0, 0, 0, 0});
    CHECK(equal.mean == 3 && equal.deviation == 0 && std::isnan(equal.skewness) && std::isnan(equal.kurtosis) && std::isnan(none.mean));
    // 1, 2, 2, 5.
    const DistributionMoments m = moments_of(4, {10, 34, 142, 658});
    CHECK_RELATIVE(m.mean, 2.5, kRounding);
    CHECK_RELATIVE(m.deviation, 1.5, kRounding);
    CHECK_RELATIVE(m.skewness, (std::pow(-1.5, 3) + 2 * std::pow(-0.5, 3) + std::pow(2.5, 3)) / 4 / std::pow(1.5, 3), 1e-12);
    CHECK_RELATIVE(m.kurtosis, (std::pow(1.5, 4) + 2 * std::pow(0.5, 4) + std::pow(2.5, 4)) / 4 / std::pow(1.5, 4), 1e-12);
}

// Standard errors of the generalised gamma against Fisher's information in (alpha, beta, delta) themselves, and of gamma by its own
// derivatives: other parameters than those of the fit.
void test_gamma_information() {
    const double alpha = 0.9, beta = 1.3, delta = 2.5, n = 7000;
    constexpr std::size_t bins = 25;
    const double width = 0.3;
    const auto probability = [&](std::array<double, 3> q, std::size_t b) {
        const auto cdf = [&](double x) { return generalised_gamma_cdf(x, q[0], q[1], q[2]); };
        const double low = cdf(width * static_cast<double>(b));
        return (b < bins ? cdf(width * static_cast<double>(b + 1)) : 1) - low;
    };
    const auto norm = [](std::array<double, 3> q) { return q[1] / (std::pow(q[2], q[0] + 1) * std::tgamma((q[0] + 1) / q[1])); };
    const std::array<double, 3> truth{alpha, beta, delta};
    const auto slope = [&](auto of, std::size_t i) {
        constexpr double h = 1e-5;
        std::array<double, 3> up = truth, down = truth;
        up[i] += h, down[i] -= h;
        return (of(up) - of(down)) / (2 * h);
    };
    Binned binned{width, {}, 0};
    double information[3][3] = {}, gradient[3] = {};
    for (std::size_t b = 0; b <= bins; ++b) {
        const double p = probability(truth, b);
        b < bins ? binned.weight.push_back(3 * p) : void(binned.overflow = 3 * p);
        double s[3];
        for (std::size_t i = 0; i < 3; ++i) s[i] = slope([&](std::array<double, 3> q) { return probability(q, b); }, i);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) information[i][j] += n * s[i] * s[j] / p;
    }
    for (std::size_t i = 0; i < 3; ++i) gradient[i] = slope(norm, i);
    // g' I^-1 g by Cramer's rule, for unit vectors and the gradient.
    const auto det = [](const double(&m)[3][3]) {
        return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    };
    const auto error = [&](const double(&g)[3]) {
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
            double replaced[3][3];
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) replaced[i][j] = j == k ? g[i] : information[i][j];
            sum += g[k] * det(replaced) / det(information);
        }
        return std::sqrt(sum);
    };
    const double mean = delta * std::tgamma((alpha + 2) / beta) / std::tgamma((alpha + 1) / beta);
    const GammaFit fit = fit_generalised_gamma(binned, mean, n);
    constexpr double kDifferences = 1e-5;  // of the derivatives, ill-conditioned by the parameters' likeness
    CHECK_RELATIVE(fit.alpha, alpha, kDifferences);
    CHECK_RELATIVE(fit.beta, beta, kDifferences);
    CHECK_RELATIVE(fit.delta, delta, kDifferences);
    CHECK_RELATIVE(fit.gamma, norm(truth), kDifferences);
    CHECK_RELATIVE(fit.alpha_error, error({1, 0, 0}), kDifferences);
    CHECK_RELATIVE(fit.beta_error, error({0, 1, 0}), kDifferences);
    CHECK_RELATIVE(fit.delta_error, error({0, 0, 1}), kDifferences);
    CHECK_RELATIVE(fit.gamma_error, error({gradient[0], gradient[1], gradient[2]}), kDifferences);
    // Absent for fewer than ten draws, or fewer than five bins with anything in them.
    CHECK(!std::isnan(fit_generalised_gamma(binned, mean, 10).alpha) && std::isnan(fit_generalised_gamma(binned, mean, 9.99).alpha));
    CHECK(std::isnan(fit_generalised_gamma(Binned{1, {3, 4, 0, 2, 1}, 0}, 1.5, 100).alpha));
}

__extension__ using Wide = __int128;

// Against integers: in any order, in any groups.
void test_exact_sums() {
    constexpr double kScale = 1e-3;
    const double quantum = quantum_of(kScale, 64);
    std::mt19937_64 random(7);
    std::vector<double> values(5000);
    for (double& v : values) v = kScale * std::exp2(-40.0 * std::generate_canonical<double, 53>(random));  // of very unlike sizes
    Wide truth = 0;
    for (double v : values) {
        CHECK(std::abs(exact_term(v, quantum).high - v) <= quantum / 2);
        truth += static_cast<Wide>(exact_term(v, quantum).high / quantum);
    }
    for (int trial = 0; trial < 5; ++trial) {
        ExactSum whole, group;
        for (std::size_t k = 0; k < values.size(); ++k) {
            group.add(exact_term(values[k], quantum));
            if (random() % 10 == 0 || k + 1 == values.size()) {
                whole.add(group);
                group = {};
            }
        }
        const Wide high = static_cast<Wide>(whole.high / quantum);
        CHECK(high + static_cast<Wide>(whole.low / quantum) == truth);
        CHECK(whole.high == static_cast<double>(truth) * quantum);  // the nearest double
        std::shuffle(values.begin(), values.end(), random);
    }
    // Where the quantum would leave the range of doubles, and of nothing.
    CHECK(exact_term(1e-305, quantum_of(1e-300, 64)).high == 1e-305);
    CHECK(exact_term(0.3, quantum_of(0, 0)).high == 0.3);
}

}  // namespace

TESTS {
    test_two_bodies();
    test_hertz();
    test_regimes();
    test_grid();
    test_radial();
    test_scale_fits();
    test_gamma_fit();
    test_bounds();
    test_gamma_information();
    test_exact_sums();
}
