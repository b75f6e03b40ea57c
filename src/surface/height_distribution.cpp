#include "surface/height_distribution.hpp"

#include <boost/math/special_functions/erf.hpp>

#include "base/error.hpp"

namespace rsc {
namespace {

// Heights are tabulated at normal scores from -kEnd to kEnd and extrapolated linearly beyond (one
// point in 10^9).
constexpr double kEnd = 6, kStep = 0.005;
constexpr int kValues = 2 * int(kEnd / kStep) + 1;

double score(int i) { return -kEnd + i * kStep; }

struct Shape {
    double mean = 0, deviation = 1, skewness = 0, kurtosis = 3;
};

// Moments by the trapezoidal rule, which converges exponentially under the normal density.
Shape shape_of(const HeightDistribution& of) {
    constexpr double end = 9.5, step = 0.025;
    constexpr int most = int(end / step);
    double total = 0, m1 = 0, m2 = 0, m3 = 0, m4 = 0;
    const double at = of(0.0);  // near the mean, to avoid cancellation
    for (int i = -most; i <= most; ++i) {
        const double u = i * step, w = std::exp(-0.5 * u * u), d = of(u) - at;
        total += w;
        m1 += w * d;
        m2 += w * d * d;
        m3 += w * d * d * d;
        m4 += w * d * d * d * d;
    }
    m1 /= total;
    m2 /= total;
    m3 /= total;
    m4 /= total;
    const double variance = m2 - m1 * m1, deviation = std::sqrt(variance);
    return {at + m1, deviation, (m3 - 3 * m1 * m2 + 2 * m1 * m1 * m1) / (variance * deviation),
            (m4 - 4 * m1 * m3 + 6 * m1 * m1 * m2 - 3 * m1 * m1 * m1 * m1) / (variance * variance)};
}

}  // namespace

HeightDistribution::HeightDistribution(std::vector<double> values) : values_(std::move(values)) {}

HeightDistribution HeightDistribution::of_quantiles(const std::vector<double>& scores,
                                                    const std::vector<double>& heights) {
    bool rising =
        scores.size() == heights.size() && scores.size() >= 2 && heights.front() < heights.back();
    for (std::size_t i = 1; rising && i < scores.size(); ++i)
        rising = scores[i] > scores[i - 1] && heights[i] >= heights[i - 1];
    if (!rising)
        bad_input("the distribution of heights: heights must increase with the normal score");
    std::vector<double> values(kValues);
    for (const int i : indices(kValues)) {
        const double u = std::clamp(score(i), scores.front(), scores.back());
        const auto k =
            at(std::upper_bound(scores.begin() + 1, scores.end() - 1, u) - scores.begin());
        values[at(i)] = std::lerp(heights[k - 1], heights[k],
                                  (u - scores[k - 1]) / (scores[k] - scores[k - 1]));
    }
    HeightDistribution distribution(std::move(values));
    const Shape shape = shape_of(distribution);
    for (double& value : distribution.values_) value = (value - shape.mean) / shape.deviation;
    return distribution;
}

std::vector<double> quantiles(std::vector<double> heights, const std::vector<double>& scores) {
    std::sort(heights.begin(), heights.end());
    const double count = double(heights.size());
    std::vector<double> found;
    for (const double u : scores) {
        const double p = 0.5 * boost::math::erfc(-u / std::numbers::sqrt2);
        const double place = std::clamp(p * count - 0.5, 0.0, count - 1);
        const auto k = at(place);
        found.push_back(
            std::lerp(heights[k], heights[std::min(k + 1, heights.size() - 1)], place - double(k)));
    }
    return found;
}

HeightShape HeightDistribution::shape() const {
    const Shape found = shape_of(*this);
    return {found.skewness, found.kurtosis};
}

double HeightDistribution::operator()(double normal) const {
    const double place = (normal + kEnd) / kStep;
    const int k = std::clamp(int(place), 0, kValues - 2);
    const auto i = at(k);
    return values_[i] + (values_[i + 1] - values_[i]) * (place - k);
}

}  // namespace rsc
