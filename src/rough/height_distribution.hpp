// Non-Gaussian height distributions.
#pragma once

#include "std.hpp"

namespace rsc {

// Skewness and kurtosis of heights, by default of Gaussian ones.
struct HeightShape {
    double skewness = 0, kurtosis = 3;
};

// A distribution of mean 0 and variance 1, represented as an increasing function of a standard normal variable.
class HeightDistribution {
public:
    // Interpolates heights at increasing normal scores linearly and extrapolates linearly. Throws Error(bad_input) unless heights increase.
    static HeightDistribution of_quantiles(const std::vector<double>& scores, const std::vector<double>& heights);

    double operator()(double normal) const;
    HeightShape shape() const;

private:
    explicit HeightDistribution(std::vector<double> values);
    std::vector<double> values_;  // at equally spaced normal scores
};

// Quantiles of a sample of heights (in any order) at normal scores: a share of erfc(-score/sqrt 2)/2 of the sample lies below each.
std::vector<double> quantiles(std::vector<double> heights, const std::vector<double>& scores);

}  // namespace rsc
