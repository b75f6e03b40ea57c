#include "observe/fits.hpp"

#include <boost/math/special_functions/gamma.hpp>

namespace rsc {
namespace {

// Largest difference between the cumulative weights and a cumulative distribution at the bin edges.
template <typename Cdf>
double ks_distance(const Binned& binned, Cdf cdf) {
    const double total = binned.total();
    if (!(total > 0)) return kAbsent;
    double below = 0, distance = 0;
    for (std::size_t b = 0; b < binned.weight.size(); ++b) {
        below += binned.weight[b];
        distance = std::max(
            distance, std::abs(below / total - cdf(binned.width * static_cast<double>(b + 1))));
    }
    return distance;
}

// Regularised incomplete gamma functions P and Q = 1 - P, each accurate where it is small; NaN
// instead of exceptions.
std::array<double, 2> gamma_tails(double a, double x) {
    using namespace boost::math::policies;
    using Quiet = policy<domain_error<ignore_error>, overflow_error<ignore_error>,
                         evaluation_error<ignore_error>, promote_double<false>>;
    if (!(x > 0)) return {0, 1};
    if (std::isinf(x)) return {1, 0};
    return {boost::math::gamma_p(a, x, Quiet()), boost::math::gamma_q(a, x, Quiet())};
}

// Upper bound of the shape (alpha + 1)/beta, so that std::tgamma does not overflow (std::lgamma
// writes a global variable).
constexpr double kLargestShape = 150;

// Unbounded parameters for Fisher scoring: log(alpha + 1), log(beta), log(delta / unit).
using Parameters = std::array<double, 3>;

// Probabilities of the bins and of the overflow.
std::vector<double> probabilities(const Parameters& theta, std::size_t bins, double width) {
    const double a = std::exp(theta[0] - theta[1]), beta = std::exp(theta[1]),
                 delta = std::exp(theta[2]);
    std::vector<double> p(bins + 1);
    std::array<double, 2> low{0, 1};
    for (std::size_t b = 0; b <= bins; ++b) {
        const std::array high = gamma_tails(
            a, b < bins ? std::pow(width * static_cast<double>(b + 1) / delta, beta) : HUGE_VAL);
        p[b] = low[0] < 0.5
                   ? high[0] - low[0]
                   : low[1] - high[1];  // difference of the smaller tails, to avoid cancellation
        low = high;
    }
    return p;
}

double log_likelihood(const std::vector<double>& weight, const std::vector<double>& p) {
    double sum = 0;
    for (std::size_t b = 0; b < p.size(); ++b)
        if (weight[b] > 0)
            sum += weight[b] * std::log(p[b]);  // -inf or NaN if p vanishes; rejected by the caller
    return sum;
}

struct Score {
    std::array<double, 3> gradient{};
    std::array<std::array<double, 3>, 3> information{};
};

Score score(const Parameters& theta, const std::vector<double>& weight,
            const std::vector<double>& p, double width) {
    // truncation and rounding errors of the central difference are both near 1e-10
    constexpr double h = 1e-5;
    const std::size_t bins = weight.size() - 1;
    std::array<std::vector<double>, 3> slope;
    for (std::size_t i = 0; i < 3; ++i) {
        Parameters up = theta, down = theta;
        up[i] += h, down[i] -= h;
        slope[i] = probabilities(up, bins, width);
        const std::vector<double> lower = probabilities(down, bins, width);
        for (std::size_t b = 0; b <= bins; ++b) slope[i][b] = (slope[i][b] - lower[b]) / (2 * h);
    }
    Score s;
    for (std::size_t b = 0; b <= bins; ++b) {
        if (!(p[b] > 1e-290)) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            s.gradient[i] += weight[b] / p[b] * slope[i][b];
            for (std::size_t j = 0; j < 3; ++j)
                s.information[i][j] += slope[i][b] * slope[j][b] / p[b];
        }
    }
    return s;
}

using Matrix = std::array<std::array<double, 3>, 3>;

// Inverse of a symmetric positive definite 3 x 3 matrix by cofactors; false if it is singular.
bool invert(const Matrix& m, Matrix& inverse) {
    const auto minor = [&m](std::size_t i, std::size_t j) {
        const std::size_t r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (j + 1) % 3, c1 = (j + 2) % 3;
        return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];  // cyclic indices include the sign
    };
    const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    if (!(det > 1e-14 * m[0][0] * m[1][1] * m[2][2])) return false;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) inverse[j][i] = minor(i, j) / det;
    return true;
}

double gamma_normalisation(const Parameters& theta) {
    const double alpha1 = std::exp(theta[0]), beta = std::exp(theta[1]), delta = std::exp(theta[2]);
    return beta / (std::pow(delta, alpha1) * std::tgamma(alpha1 / beta));
}

// Performs one step of Fisher scoring, halved until the likelihood does not decrease. Returns false
// if no step succeeds.
bool improve(Parameters& theta, std::vector<double>& p, double& likelihood,
             const std::vector<double>& weight, double width, double& size) {
    const Score s = score(theta, weight, p, width);
    Matrix inverse;
    if (!invert(s.information, inverse)) return false;
    Parameters step{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) step[i] += inverse[i][j] * s.gradient[j];
    size = std::max({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])});
    if (!std::isfinite(size)) return false;
    double factor = std::min(1.0, 1.0 / std::max(size, 1e-300));  // limits the change to a factor e
    for (int halving = 0; halving < 40; ++halving, factor /= 2) {
        Parameters trial = theta;
        for (std::size_t i = 0; i < 3; ++i) trial[i] += factor * step[i];
        if (std::exp(trial[0] - trial[1]) > kLargestShape) continue;
        std::vector<double> q = probabilities(trial, weight.size() - 1, width);
        const double value = log_likelihood(weight, q);
        if (!(value >= likelihood - 1e-14 * std::abs(likelihood))) continue;
        theta = trial, p = std::move(q), likelihood = value;
        return true;
    }
    return false;
}

}  // namespace

double Binned::total() const {
    double sum = 0;
    for (double w : weight) sum += w;
    return sum + overflow;
}

ScaleFit fit_rayleigh(double count, double sum_of_squares, const Binned& binned) {
    ScaleFit fit;
    if (!(count > 0)) return fit;
    const double s2 = sum_of_squares / (2 * count);
    fit.scale = std::sqrt(s2);
    fit.scale_error = fit.scale / (2 * std::sqrt(count));
    fit.ks_distance =
        ks_distance(binned, [s2](double x) { return -std::expm1(-x * x / (2 * s2)); });
    return fit;
}

ScaleFit fit_exponential(double count, double sum, const Binned& binned) {
    ScaleFit fit;
    if (!(count > 0)) return fit;
    const double s = sum / count;
    fit.scale = s;
    fit.scale_error = s / std::sqrt(count);
    fit.ks_distance = ks_distance(binned, [s](double x) { return -std::expm1(-x / s); });
    return fit;
}

double generalised_gamma_cdf(double x, double alpha, double beta, double delta) {
    return gamma_tails((alpha + 1) / beta, std::pow(std::max(x, 0.0) / delta, beta))[0];
}

GammaFit fit_generalised_gamma(const Binned& binned, double mean, double independent) {
    GammaFit fit;
    const double total = binned.total();
    const auto filled =
        std::count_if(binned.weight.begin(), binned.weight.end(), [](double w) { return w > 0; });
    if (!(total > 0) || !(mean > 0) || filled < 5 || !(independent >= 10)) return fit;

    // In units of the mean all numbers below are of order one.
    const double width = binned.width / mean;
    std::vector<double> weight;
    for (double w : binned.weight) weight.push_back(w / total);
    weight.push_back(binned.overflow / total);

    // <x> = delta Gamma((alpha+2)/beta) / Gamma((alpha+1)/beta)
    const double alpha = 2.0 / 3.0, beta = 1.5;
    Parameters theta{std::log(alpha + 1), std::log(beta),
                     std::log(std::tgamma((alpha + 1) / beta) / std::tgamma((alpha + 2) / beta))};
    std::vector<double> p = probabilities(theta, binned.weight.size(), width);
    double likelihood = log_likelihood(weight, p), size = 1;
    if (!std::isfinite(likelihood)) return fit;
    bool converged = false;
    for (int iteration = 0; iteration < 200 && !converged; ++iteration) {
        if (!improve(theta, p, likelihood, weight, width, size)) break;
        converged = size < 1e-9;
    }
    if (!converged && !(size < 1e-6)) return fit;  // rounding may stop the iteration before 1e-9
    Matrix covariance;
    if (!invert(score(theta, weight, p, width).information, covariance)) return fit;
    for (auto& row : covariance)
        for (double& c : row) c /= independent;

    fit.alpha = std::exp(theta[0]) - 1;
    fit.beta = std::exp(theta[1]);
    fit.delta = std::exp(theta[2]) * mean;
    fit.alpha_error = std::exp(theta[0]) * std::sqrt(covariance[0][0]);
    fit.beta_error = fit.beta * std::sqrt(covariance[1][1]);
    fit.delta_error = fit.delta * std::sqrt(covariance[2][2]);

    Parameters physical = theta;
    physical[2] += std::log(mean);
    fit.gamma = gamma_normalisation(physical);
    std::array<double, 3> slope{};  // derivatives of gamma, for error propagation
    for (std::size_t i = 0; i < 3; ++i) {
        constexpr double h = 1e-5;
        Parameters up = physical, down = physical;
        up[i] += h, down[i] -= h;
        slope[i] = (gamma_normalisation(up) - gamma_normalisation(down)) / (2 * h);
    }
    double variance = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) variance += slope[i] * covariance[i][j] * slope[j];
    fit.gamma_error = std::sqrt(variance);
    fit.ks_distance = ks_distance(binned, [&fit](double x) {
        return generalised_gamma_cdf(x, fit.alpha, fit.beta, fit.delta);
    });
    return fit;
}

}  // namespace rsc
