#include "rough/height_distribution.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include "error.hpp"
#include "format.hpp"

namespace rsc {
namespace {

// Heights are tabulated at normal scores from -kEnd to kEnd and extrapolated linearly beyond (one point in 10^9).
constexpr double kEnd = 6, kStep = 0.005;
constexpr int kValues = 2 * static_cast<int>(kEnd / kStep) + 1;
constexpr double kMostKurtosis = 100;

double score(int i) { return -kEnd + i * kStep; }

// Johnson's SU (sinh) or SB (logistic) function of x = u/delta + shift, u being a normal variable. Both are skewed to the right for shift >
// 0 and approach the lognormal distribution as the shift grows.
struct Johnson {
    bool bounded = false;
    double delta = 1, shift = 0;
    double operator()(double u) const { return bounded ? 1 / (1 + std::exp(shift - u / delta)) : std::sinh(u / delta + shift); }
};

struct Shape {
    double mean = 0, deviation = 1, skewness = 0, kurtosis = 3;
};

// Moments by the trapezoidal rule, which converges exponentially under the normal density.
template <class Function>
Shape shape_of(const Function& of, double step = 0.025) {
    constexpr double end = 9.5;
    const int most = static_cast<int>(end / step);
    double total = 0, m1 = 0, m2 = 0, m3 = 0, m4 = 0;
    const double at = of(0.0);  // near the mean, to avoid cancellation
    for (int i = -most; i <= most; ++i) {
        const double u = i * step, w = std::exp(-0.5 * u * u), d = of(u) - at;
        total += w, m1 += w * d, m2 += w * d * d, m3 += w * d * d * d, m4 += w * d * d * d * d;
    }
    m1 /= total, m2 /= total, m3 /= total, m4 /= total;
    const double variance = m2 - m1 * m1, deviation = std::sqrt(variance);
    return {at + m1, deviation, (m3 - 3 * m1 * m2 + 2 * m1 * m1 * m1) / (variance * deviation),
            (m4 - 4 * m1 * m3 + 6 * m1 * m1 * m2 - 3 * m1 * m1 * m1 * m1) / (variance * variance)};
}

// Shape of SU in closed form (Johnson 1949, w = exp(1/delta^2)), of SB by a quadrature with few points, since it is analytic within pi
// delta of the real axis.
Shape shape_of(const Johnson& j) {
    if (j.bounded) return shape_of<Johnson>(j, std::clamp(0.4 * j.delta, 0.02, 0.2));
    const double less = std::expm1(1 / (j.delta * j.delta)), w = 1 + less, s = j.shift;
    const double variance = 0.5 * less * (w * std::cosh(2 * s) + 1);
    const double m3 = 0.25 * std::sqrt(w) * less * less * (w * (w + 2) * std::sinh(3 * s) + 3 * std::sinh(s));
    const double m4 =
        0.125 * less * less *
        (w * w * (((w + 2) * w + 3) * w * w - 3) * std::cosh(4 * s) + 4 * w * w * (w + 2) * std::cosh(2 * s) + 3 * (2 * w + 1));
    return {std::sqrt(w) * std::sinh(s), std::sqrt(variance), m3 / (variance * std::sqrt(variance)), m4 / (variance * variance)};
}

// Root of a function between `low` and `high`; if the function has the same sign at both, the end with the smaller absolute value.
template <class Function>
double root(const Function& f, double low, double high) {
    const double at_low = f(low), at_high = f(high);
    if (at_low * at_high >= 0) return std::abs(at_low) < std::abs(at_high) ? low : high;
    std::uintmax_t steps = 60;
    const auto [a, b] =
        boost::math::tools::toms748_solve(f, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(20), steps);
    return 0.5 * (a + b);
}

// The shift for which a distribution of this delta has the skewness; at most kMostShift, the lognormal limit.
constexpr double kMostShift = 30;
Johnson skewed(bool bounded, double delta, double skewness) {
    Johnson j{bounded, delta, 0};
    if (skewness > 0)
        j.shift = root([&](double shift) { return shape_of(Johnson{bounded, delta, shift}).skewness - skewness; }, 0, kMostShift);
    return j;
}

// Delta of the lognormal distribution with a skewness > 0: (w - 1)(w + 2)^2 = skewness^2 with w = exp(1/delta^2).
double lognormal_delta(double skewness) {
    const double w = root([&](double x) { return (x - 1) * (x + 2) * (x + 2) - skewness * skewness; }, 1, 2 + skewness * skewness);
    return 1 / std::sqrt(std::log(w));
}

[[noreturn]] void refuse(double skewness, double kurtosis, const std::string& bound) {
    throw Error(Failure::bad_input, "surface: kurtosis = " + text_of(kurtosis) + " with skewness = " + text_of(skewness) +
                                        ": no height distribution has these values; " + bound);
}

}  // namespace

HeightDistribution::HeightDistribution(std::vector<double> values) : values_(std::move(values)) {}

HeightDistribution HeightDistribution::of_moments(double skewness, double kurtosis) {
    const double s = std::abs(skewness), least = s * s + 1;
    if (!(kurtosis > least)) refuse(skewness, kurtosis, "the kurtosis must be greater than skewness^2 + 1 = " + text_of(least));
    if (!(kurtosis <= kMostKurtosis)) refuse(skewness, kurtosis, "the kurtosis must be at most 100");
    // Skewness 0: the normal distribution is the limit of large delta.
    constexpr double normal = 1000, smallest_bounded = 0.05, smallest_unbounded = 0.45;
    const double lognormal = s > 1e-6 ? std::min(normal, lognormal_delta(s)) : normal;
    const double w = std::exp(1 / (lognormal * lognormal));
    const bool bounded = kurtosis < ((w + 2) * w + 3) * w * w - 3;
    const double smallest = std::min(bounded ? smallest_bounded : smallest_unbounded, 0.5 * lognormal);
    const Johnson found = skewed(
        bounded, root([&](double delta) { return shape_of(skewed(bounded, delta, s)).kurtosis - kurtosis; }, smallest, lognormal), s);
    const Shape shape = shape_of(found);
    constexpr double near = 1e-3;
    if (!(std::abs(shape.skewness - s) <= near && std::abs(shape.kurtosis - kurtosis) <= near * kurtosis))
        refuse(skewness, kurtosis, "the kurtosis is too close to its bound skewness^2 + 1 = " + text_of(least));
    std::vector<double> values(kValues);
    for (int i = 0; i < kValues; ++i) {
        const double value = (found(score(i)) - shape.mean) / shape.deviation;
        values[static_cast<std::size_t>(skewness < 0 ? kValues - 1 - i : i)] = skewness < 0 ? -value : value;
    }
    return HeightDistribution(std::move(values));
}

HeightDistribution HeightDistribution::of_quantiles(const std::vector<double>& scores, const std::vector<double>& heights) {
    bool rising = scores.size() == heights.size() && scores.size() >= 2 && heights.front() < heights.back();
    for (std::size_t i = 1; rising && i < scores.size(); ++i) rising = scores[i] > scores[i - 1] && heights[i] >= heights[i - 1];
    if (!rising) throw Error(Failure::bad_input, "the distribution of heights: heights must increase with the normal score");
    std::vector<double> values(kValues);
    for (int i = 0; i < kValues; ++i) {
        const double u = std::clamp(score(i), scores.front(), scores.back());
        const auto k = static_cast<std::size_t>(std::upper_bound(scores.begin() + 1, scores.end() - 1, u) - scores.begin());
        values[static_cast<std::size_t>(i)] = std::lerp(heights[k - 1], heights[k], (u - scores[k - 1]) / (scores[k] - scores[k - 1]));
    }
    HeightDistribution distribution(std::move(values));
    const Shape shape = shape_of(distribution);
    for (double& value : distribution.values_) value = (value - shape.mean) / shape.deviation;
    return distribution;
}

std::vector<double> quantiles(std::vector<double> heights, const std::vector<double>& scores) {
    std::sort(heights.begin(), heights.end());
    const double count = static_cast<double>(heights.size());
    std::vector<double> found;
    for (const double u : scores) {
        const double p = 0.5 * boost::math::erfc(-u / std::numbers::sqrt2);
        const double place = std::clamp(p * count - 0.5, 0.0, count - 1);
        const auto k = static_cast<std::size_t>(place);
        found.push_back(std::lerp(heights[k], heights[std::min(k + 1, heights.size() - 1)], place - static_cast<double>(k)));
    }
    return found;
}

HeightShape HeightDistribution::shape() const {
    const Shape found = shape_of(*this);
    return {found.skewness, found.kurtosis};
}

double HeightDistribution::normal(double value) const {
    const auto k = static_cast<std::size_t>(std::upper_bound(values_.begin() + 1, values_.end() - 1, value) - values_.begin());
    const double width = values_[k] - values_[k - 1];
    return score(static_cast<int>(k) - 1) + (width > 0 ? kStep * (value - values_[k - 1]) / width : 0);
}

double HeightDistribution::operator()(double normal) const {
    const double place = (normal + kEnd) / kStep;
    const int k = std::clamp(static_cast<int>(place), 0, kValues - 2);
    const auto i = static_cast<std::size_t>(k);
    return values_[i] + (values_[i + 1] - values_[i]) * (place - k);
}

}  // namespace rsc
