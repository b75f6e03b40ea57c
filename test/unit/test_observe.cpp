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

// A level of random contacts; the answer need not be one of a solver.
struct Sample {
    Asperities asperities;
    std::vector<Level> levels;
};

Sample random_sample(unsigned seed, int steps) {
    std::mt19937 random(seed);
    const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0; };
    Sample s;
    for (int i = 0; i < 400; ++i) {
        s.asperities.x.push_back(uniform() * 1.1);  // one in ten outside the map
        s.asperities.y.push_back(uniform());
        s.asperities.z.push_back(0);
        s.asperities.radius.push_back(1e-3);
    }
    for (int k = 0; k < steps; ++k) {
        Level level;
        level.separation = 4.0 - k;
        for (int i = 0; i < 400; ++i) {
            if (uniform() > 0.1 * (k + 1)) continue;
            const double a = 0.01 * uniform(), f = 2.5 * pi * a * a * (0.05 + uniform());
            const auto p = static_cast<std::size_t>(i);
            level.add_contact(i, s.asperities.x[p], s.asperities.y[p], f, a, 0);
            level.force += level.f.back();
            level.area += pi * level.a.back() * level.a.back();
        }
        s.levels.push_back(level);
    }
    return s;
}

ObserveOptions sample_options() {
    ObserveOptions options;
    options.tip_x = options.tip_y = 0.5;
    options.map = make_map_grid(0, 0, 1, 1, 10);
    options.radial_bins = 8;
    options.pdf_levels = {2.1, -5.0};
    options.pdf = {40, 2.0, 2e-4};  // some contacts lie beyond, on purpose
    return options;
}

// Pixels that are no squares carry p dx dy each, and share the area of their contact.
void test_pixels_on_a_map() {
    Level level;
    level.pixels = {4, 0.05, 0.1, 0.1, 0.2, {0, 1, 4, 15}, {0, 0, 0, 1}, {1, 2, 3, 4}};
    level.add_contact(0, 0.1, 0.15, 6 * 0.02, 0.13, 0), level.add_contact(15, 0.35, 0.7, 4 * 0.02, 0.08, 0);
    const MapLevel map = map_level(make_map_grid(0, 0, 0.8, 0.8, 2), level);
    CHECK((map.cell == std::vector<std::int32_t>{0, 2}));
    CHECK_RELATIVE(map.force[0], 6 * 0.02, 1e-14);
    CHECK_RELATIVE(map.force[1], 4 * 0.02, 1e-14);
    CHECK_RELATIVE(map.area[0], pi * 0.13 * 0.13, 1e-14);
    CHECK_RELATIVE(map.area[1], pi * 0.08 * 0.08, 1e-14);
}

void test_maps_conserve() {
    const ObserveOptions options = sample_options();
    Sample s = random_sample(7, 4);
    const RealizationRecord record = observe(options, 1, {}, s.levels);
    for (std::size_t k = 0; k < 4; ++k) {
        double area = 0, force = 0, area_outside = 0, force_outside = 0;
        int outside = 0;
        for (double a : record.maps[k].area) area += a;
        for (double f : record.maps[k].force) force += f;
        for (std::size_t c = 0; c < s.levels[k].asperity.size(); ++c) {
            if (s.asperities.x[static_cast<std::size_t>(s.levels[k].asperity[c])] <= 1) continue;
            ++outside;
            area_outside += pi * s.levels[k].a[c] * s.levels[k].a[c];
            force_outside += s.levels[k].f[c];
        }
        CHECK(outside > 0 && record.levels[k].outside_map == outside);
        CHECK_RELATIVE(area + area_outside, s.levels[k].area, kRounding);
        CHECK_RELATIVE(force + force_outside, s.levels[k].force, kRounding);
    }
    // One contact of known place and size: A' = pi a^2 / w^2, p = f / w^2.
    Sample one;
    Level level;
    level.add_contact(0, 0.37, 0.81, 3, 0.0251, 0);  // pi a^2/w^2 = 0.1979 > pi/16
    level.force = 3, level.area = pi * 0.0251 * 0.0251;
    one.levels = {level};
    Accumulators sums(options, 1);
    const RealizationRecord r = observe(options, 5, {}, one.levels);
    CHECK(r.levels[0].crowded_cells == 1);
    sums.add(r);
    const Observations o = sums.finish();
    CHECK_RELATIVE(o.map_area_fraction[83], pi * 0.0251 * 0.0251 / 0.01, 1e-14);
    CHECK_RELATIVE(o.map_pressure[83], 300.0, 1e-14);
    one.levels[0].a[0] = 0.0249;  // 0.1948 < pi/16
    CHECK(observe(options, 5, {}, one.levels).levels[0].crowded_cells == 0);
    one.levels[0].f[0] = std::nan("");
    CHECK_THROWS(observe(options, 5, {}, one.levels), Error);
}

void test_histograms() {
    const ObserveOptions options = sample_options();
    const Sample s = random_sample(3, 4);
    const RealizationRecord record = observe(options, 1, {}, s.levels);
    CHECK(record.distributions[0].step == 2);  // separation 2 is nearest to 2.1
    CHECK(record.distributions[1].step == 3);  // the deepest is nearest to -5
    for (const Distributions& d : record.distributions) {
        const Level& level = s.levels[static_cast<std::size_t>(d.step)];
        const auto contacts = static_cast<std::int64_t>(level.asperity.size());
        CHECK(d.mean_pressure.total() == contacts && d.mean_pressure.overflow > 0);
        CHECK(d.spot_area.total() == contacts && d.spot_area.overflow > 0);
        double area = d.pressure.overflow;
        for (double a : d.pressure.area) area += a;
        CHECK_RELATIVE(area, level.area, kRounding);
        // The mean point pressure is the force over the area, whatever the bins.
        CHECK_RELATIVE(moments_of(d.pressure.total, d.pressure.power).mean, level.force / level.area, kRounding);
    }
    // One contact: bins hold (p_b+1^2 - p_b^2)/p0^2 of its area.
    Level one;
    one.asperity = {0}, one.a = {0.1}, one.f = {0.7 * pi * 0.01};
    const Distributions d = distributions_of({10, 1.0, 1.0}, one, 0);  // pressure bins of 0.15 to 1.5, p0 = 1.05
    CHECK_RELATIVE(d.pressure.area[0], pi * 0.01 * (0.15 / 1.05) * (0.15 / 1.05), 1e-13);
    CHECK_RELATIVE(d.pressure.area[6], pi * 0.01 * (1 - 0.9 * 0.9 / (1.05 * 1.05)), 1e-12);
    CHECK(d.pressure.area[7] == 0 && d.pressure.overflow == 0);
    CHECK_RELATIVE(d.pressure.power[1], pi * 0.01 * 1.05 * 1.05 / 2, 1e-13);  // <p^2> = p0^2/2
    // It yields: the same pressure everywhere.
    one.yields = {1};
    const Distributions y = distributions_of({10, 1.0, 1.0}, one, 0);
    CHECK_RELATIVE(y.pressure.area[4], pi * 0.01, 1e-13);
    CHECK_RELATIVE(y.pressure.total, pi * 0.01, 1e-13);
    CHECK_RELATIVE(y.pressure.squares, d.pressure.squares, 1e-13);
    CHECK_RELATIVE(y.pressure.power[1], pi * 0.01 * 0.49, 1e-13);
    // Where pressures are bounded, bins end there.
    CHECK(make_pdf_bins(60, 1e5, 0.01, 100, 500).pressure_max == 500);
    CHECK(make_pdf_bins(60, 1e5, 0.01, 100, 1e9).pressure_max == make_pdf_bins(60, 1e5, 0.01, 100, kInf).pressure_max);
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

// Standard errors against the scatter of fits to many drawn samples: 200 samples give their deviation to 5 %, so a factor 1.25 is
// 5 sigma.
void test_gamma_errors() {
    const double alpha = 2.0 / 3, beta = 1.5, delta = 1.0;
    std::mt19937 random(11);
    std::gamma_distribution<double> gamma((alpha + 1) / beta);
    const int samples = 200, n = 5000;
    // alpha, beta, delta, gamma
    const double truth[4] = {alpha, beta, delta, beta / (std::pow(delta, alpha + 1) * std::tgamma((alpha + 1) / beta))};
    std::array<double, 4> sum{}, squares{}, error{};
    for (int s = 0; s < samples; ++s) {
        Binned binned{0.08, std::vector<double>(40), 0};
        double first = 0;
        for (int i = 0; i < n; ++i) {
            const double x = delta * std::pow(gamma(random), 1 / beta);
            first += x;
            const auto b = static_cast<std::size_t>(x / binned.width);
            b < 40 ? binned.weight[b] += 1 : binned.overflow += 1;
        }
        const GammaFit fit = fit_generalised_gamma(binned, first / n, n);
        const double value[4] = {fit.alpha, fit.beta, fit.delta, fit.gamma};
        const double stated[4] = {fit.alpha_error, fit.beta_error, fit.delta_error, fit.gamma_error};
        for (std::size_t p = 0; p < 4; ++p) sum[p] += value[p], squares[p] += value[p] * value[p], error[p] += stated[p];
    }
    for (std::size_t p = 0; p < 4; ++p) {
        const double mean = sum[p] / samples, deviation = std::sqrt(squares[p] / samples - mean * mean), stated = error[p] / samples;
        CHECK(deviation / stated < 1.25 && stated / deviation < 1.25);
        CHECK_CLOSE(mean, truth[p], 5 * stated / std::sqrt(samples) + 0.01);  // the bias of maximum likelihood at this n is below 0.01
    }
}

void test_accumulation() {
    const ObserveOptions options = sample_options();
    Accumulators sums(options, 4);
    std::vector<RealizationRecord> records;
    for (unsigned k = 1; k <= 3; ++k) {
        const Sample s = random_sample(k, 4);
        SurfaceStatistics surface;
        surface.m2 = 0.1 * k;
        records.push_back(observe(options, k, surface, s.levels));
        sums.add(records.back());
    }
    const Observations o = sums.finish();
    CHECK(o.realizations == 3 && o.surface[2].m2 == 0.1 * 3 && o.rows.size() == 12);
    // Means of the file are the means of the singles.
    const double f0 = records[0].levels[2].force, f1 = records[1].levels[2].force, f2 = records[2].levels[2].force;
    const double mean = (f0 + f1 + f2) / 3;
    CHECK_RELATIVE(o.force.mean[2], mean, 1e-15);
    CHECK_RELATIVE(o.force.deviation[2], std::sqrt(((f0 - mean) * (f0 - mean) + (f1 - mean) * (f1 - mean) + (f2 - mean) * (f2 - mean)) / 2),
                   1e-14);
    std::vector<double> radial(o.radii.size());
    std::int64_t contacts = 0;
    for (const RealizationRecord& r : records) {
        Accumulators single(options, 4);
        single.add(r);
        const Observations s = single.finish();
        CHECK(std::isnan(s.force.deviation[0]));  // no scatter from one
        for (std::size_t b = 0; b < radial.size(); ++b) radial[b] += s.radial_pressure[3 * radial.size() + b] / 3;
        contacts += r.levels[2].contacts;
    }
    for (std::size_t b = 0; b < radial.size(); ++b) CHECK_CLOSE(o.radial_pressure[3 * radial.size() + b], radial[b], kRounding);
    CHECK(o.distributions[0].sum.mean_pressure.total() == contacts);
    CHECK_RELATIVE(o.distributions[0].sum.separation, 6.0, 1e-15);
    double integral = 0;
    for (double p : o.distributions[0].mean_pressure_pdf) integral += p * options.pdf.mean_pressure_width();
    integral += static_cast<double>(o.distributions[0].sum.mean_pressure.overflow) / static_cast<double>(contacts);
    CHECK_CLOSE(integral, 1.0, kRounding);
    // Records out of order would change the bits: refused.
    CHECK_THROWS(sums.add(records[0]), Error);
    Accumulators other(options, 5);
    CHECK_THROWS(other.add(records[0]), Error);
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

int main() {
    test_two_bodies();
    test_hertz();
    test_regimes();
    test_grid();
    test_radial();
    test_pixels_on_a_map();
    test_maps_conserve();
    test_histograms();
    test_scale_fits();
    test_gamma_fit();
    test_gamma_errors();
    test_accumulation();
    test_exact_sums();
    return check::summary();
}
