// Observations: closed forms, maps, radial means, distributions and fits, and their addition over
// realizations.
#include "check.hpp"
#include "observe/distributions.hpp"
#include "observe/map.hpp"
#include "observe/record.hpp"
#include "observe/regimes.hpp"

using namespace rsc;
using std::numbers::pi;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-13;  // a few hundred operations on numbers of order one

// The nearest level, the first of two that are equally near: rounding does not decide.
TEST(test_nearest_level) {
    for (const double rounding : {-1e-14, 0.0, 1e-14}) {
        CHECK(nearest_level({4, 3 + rounding, 2 - rounding, 1}, 2.5) == 1);
        CHECK(nearest_level({1, 2 - rounding, 3 + rounding, 2, 1}, 2.5) == 1 &&
              nearest_level({3, 1 + rounding, 1}, 1) == 1);
    }
    CHECK(nearest_level({3, 2, 1}, 2.4) == 1 && nearest_level({3, 2, 1}, 2.6) == 0 &&
          nearest_level({}, 1) == -1);
}

// A point on the border of two cells, as grid points are, belongs to the upper one, whatever its
// coordinate rounds to.
TEST(test_borders_of_cells) {
    for (const double L : {0.3, 0.7, 1.1, 2.9})
        for (const int cells : {7, 12, 49}) {
            const MapGrid grid = make_map_grid(0, 0, L, L, cells);
            const double dx = L / (3 * cells);
            for (int i = 0; i < 3 * cells; ++i) CHECK(grid.cell(i * dx, 0) == i / 3);
        }
}

// On a surface that is no whole number of cells long nothing is lost: a uniform pressure on all of
// its pixels adds up to the force and the area, and every radial mean is that pressure. Tolerance:
// rounding of sums over 510 pixels and their shares.
TEST(test_oblong_maps) {
    const double dx = 0.3, dy = 0.2, p = 2.5;
    Level level;
    level.pixels.columns = 30, level.pixels.dx = dx, level.pixels.dy = dy;
    for (int k = 0; k < 30 * 17; ++k)
        level.pixels.index.push_back(k), level.pixels.contact.push_back(0),
            level.pixels.pressure.push_back(p);
    const double Lx = 30 * dx, Ly = 17 * dy, force = p * Lx * Ly;
    level.add_contact(0, 0.5 * Lx, 0.99 * Ly, force, std::sqrt(Lx * Ly / pi), 1);
    for (const int cells : {1, 2, 3, 4, 7, 30, 45}) {
        const MapGrid grid = make_map_grid(0, 0, Lx, Ly, cells);
        const MapLevel map = map_level(grid, level);
        CHECK_RELATIVE(std::accumulate(map.force.begin(), map.force.end(), 0.0), force, 1e-13);
        CHECK_RELATIVE(std::accumulate(map.area.begin(), map.area.end(), 0.0), Lx * Ly, 1e-13);
        CHECK(map.outside == 0);
        std::vector<double> pressure(static_cast<std::size_t>(grid.cells()));
        for (std::size_t k = 0; k < map.cell.size(); ++k)
            pressure[static_cast<std::size_t>(map.cell[k])] =
                map.force[k] / (grid.side * grid.side);
        const RadialMean mean(grid, 0.5 * Lx, 0.5 * Ly, 9);
        CHECK_RELATIVE(mean.radii().back(), 0.5 * Ly * 17 / 18, 1e-13);
        for (const double value : mean(pressure.data())) CHECK_RELATIVE(value, p, 1e-12);
    }
}

// n values at the quantiles (i - 1/2)/n, through the same counting as contacts.
Distributions quantiles(const PdfBins& bins, int n, bool pressure, double scale) {
    Level level;
    for (int i = 0; i < n; ++i) {
        const double q = -std::log1p(-(i + 0.5) / n);
        const double area = pressure ? 1e-4 : scale * q,
                     p = pressure ? scale * std::sqrt(2 * q) : 1;
        level.asperity.push_back(i);
        level.a.push_back(std::sqrt(area / pi));
        level.f.push_back(p * area);
    }
    return distributions_of(bins, level, 0);
}

TEST(test_scale_fits) {
    const int n = 20000;
    const PdfBins bins{60, 5.0, 8.0};
    // Midpoint quantiles miss the moments by O(log n / n) and the cumulative by 1/(2n).
    const FittedDistributions rayleigh = fit_distributions(bins, quantiles(bins, n, true, 0.8));
    CHECK_RELATIVE(rayleigh.rayleigh.scale, 0.8, 5e-5);
    CHECK_RELATIVE(rayleigh.rayleigh.scale_error, 0.8 / (2 * std::sqrt(n)), 1e-4);
    CHECK(rayleigh.rayleigh.ks_distance < 1e-4);
    CHECK_CLOSE(rayleigh.mean_pressure_moments.skewness, 0.6311,
                2e-3);  // 2 sqrt(pi) (pi - 3)/(4 - pi)^(3/2)
    CHECK_CLOSE(rayleigh.mean_pressure_moments.kurtosis, 3.2451, 1e-2);
    const FittedDistributions exponential = fit_distributions(bins, quantiles(bins, n, false, 0.6));
    CHECK_RELATIVE(exponential.exponential.scale, 0.6, 5e-5);
    CHECK_RELATIVE(exponential.exponential.scale_error, 0.6 / std::sqrt(n), 1e-4);
    CHECK(exponential.exponential.ks_distance < 1e-4);
    // The distance sees a wrong law: exponential values against Rayleigh (0.2 or so).
    const Binned wrong{8.0 / 60, quantiles(bins, n, false, 0.6).spot_area.weight, 0};
    CHECK(fit_rayleigh(n, 2 * 0.36 * n, wrong).ks_distance > 0.1);
    // No contacts: absent, not zero.
    const FittedDistributions none = fit_distributions(bins, distributions_of(bins, Level{}, 0));
    CHECK(std::isnan(none.rayleigh.scale) && std::isnan(none.gamma.alpha) &&
          std::isnan(none.mean_pressure_pdf[0]));
}

// Integral of the density over [x0, x1] by composite Simpson in u = x^(1/3): independent of the
// incomplete gamma function. Not normalised.
double simpson(double x0, double x1, double alpha, double beta, double delta) {
    const double u0 = std::cbrt(x0), h = (std::cbrt(x1) - u0) / 200;
    const auto f = [&](double u) {
        return std::pow(u * u * u, alpha) * std::exp(-std::pow(u * u * u / delta, beta)) * 3 * u *
               u;
    };
    double sum = 0;
    for (int k = 0; k < 200; k += 2)
        sum += f(u0 + k * h) + 4 * f(u0 + (k + 1) * h) + f(u0 + (k + 2) * h);
    return sum * h / 3;
}

TEST(test_gamma_fit) {
    // Known values: the exponential distribution, and erf(x).
    for (double x : {1e-6, 0.3, 1.0, 1.9, 2.5, 7.0, 40.0}) {
        CHECK_RELATIVE(generalised_gamma_cdf(x, 0, 1, 1), -std::expm1(-x), 1e-13);
        CHECK_RELATIVE(generalised_gamma_cdf(x, 0, 2, 1), std::erf(x), 1e-13);
    }
    for (const auto& [alpha, beta, delta] :
         {std::array{2.0 / 3, 1.5, 300.0}, {1.0, 2.0, 50.0}, {0.2, 1.0, 2.0}, {1.8, 3.0, 0.01}}) {
        Binned binned{delta / 12, {}, 0};
        double total = 0, first = 0;
        for (int b = 0; b < 600; ++b) {
            const double w = simpson(b * binned.width, (b + 1) * binned.width, alpha, beta, delta);
            (b < 30 ? binned.weight.push_back(w)
                    : void(binned.overflow += w));  // the tail goes into the overflow
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
    }
    Binned few{1, {1, 2, 3, 0, 0, 0}, 0};
    CHECK(std::isnan(fit_generalised_gamma(few, 1.5, 6).alpha));
}

// Standard errors of the generalised gamma against Fisher's information in (alpha, beta, delta)
// themselves, and of gamma by its own derivatives: other parameters than those of the fit.
TEST(test_gamma_information) {
    const double alpha = 0.9, beta = 1.3, delta = 2.5, n = 7000;
    constexpr std::size_t bins = 25;
    const double width = 0.3;
    const auto probability = [&](std::array<double, 3> q, std::size_t b) {
        const auto cdf = [&](double x) { return generalised_gamma_cdf(x, q[0], q[1], q[2]); };
        const double low = cdf(width * static_cast<double>(b));
        return (b < bins ? cdf(width * static_cast<double>(b + 1)) : 1) - low;
    };
    const auto norm = [](std::array<double, 3> q) {
        return q[1] / (std::pow(q[2], q[0] + 1) * std::tgamma((q[0] + 1) / q[1]));
    };
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
        for (std::size_t i = 0; i < 3; ++i)
            s[i] = slope([&](std::array<double, 3> q) { return probability(q, b); }, i);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) information[i][j] += n * s[i] * s[j] / p;
    }
    for (std::size_t i = 0; i < 3; ++i) gradient[i] = slope(norm, i);
    // g' I^-1 g by Cramer's rule, for unit vectors and the gradient.
    const auto det = [](const double(&m)[3][3]) {
        return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
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
    // of the derivatives, ill-conditioned by the parameters' likeness
    constexpr double kDifferences = 1e-5;
    CHECK_RELATIVE(fit.alpha_error, error({1, 0, 0}), kDifferences);
    CHECK_RELATIVE(fit.beta_error, error({0, 1, 0}), kDifferences);
    CHECK_RELATIVE(fit.delta_error, error({0, 0, 1}), kDifferences);
    CHECK_RELATIVE(fit.gamma_error, error({gradient[0], gradient[1], gradient[2]}), kDifferences);
    // Absent for fewer than ten draws, or fewer than five bins with anything in them.
    CHECK(!std::isnan(fit_generalised_gamma(binned, mean, 10).alpha) &&
          std::isnan(fit_generalised_gamma(binned, mean, 9.99).alpha));
    CHECK(std::isnan(fit_generalised_gamma(Binned{1, {3, 4, 0, 2, 1}, 0}, 1.5, 100).alpha));
}

__extension__ using Wide = __int128;

// Of two spots one is under tension: it has an area, but no place among the pressures.
TEST(test_tension) {
    Level level;
    level.least_force = -1;
    level.add_contact(0, 0, 0, 1, 1, 0), level.add_contact(1, 0, 0, -0.1, 0.5, 0);
    const PdfBins bins = make_pdf_bins(10, 1, 1, 1, 1);
    const FittedDistributions fit = fit_distributions(bins, distributions_of(bins, level, 0));
    CHECK_RELATIVE(fit.spot_area_moments.mean, std::numbers::pi * 1.25 / 2, 1e-14);
    CHECK_RELATIVE(fit.mean_pressure_moments.mean, 1 / std::numbers::pi, 1e-14);
}

// Against integers: in any order, in any groups.
TEST(test_exact_sums) {
    constexpr double kScale = 1e-3;
    const double quantum = quantum_of(kScale, 64);
    std::mt19937_64 random(7);
    std::vector<double> values(5000);
    for (double& v : values)
        v = kScale *
            std::exp2(-40.0 * std::generate_canonical<double, 53>(random));  // of very unlike sizes
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
