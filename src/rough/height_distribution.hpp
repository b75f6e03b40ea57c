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
    // The member of Johnson's system (Biometrika 36, 1949) with this skewness and kurtosis: SU, SB or, between them, the lognormal one.
    // Throws Error(bad_input) with the bound unless skewness^2 + 1 < kurtosis <= 100, and if the kurtosis is so close to the lower bound
    // that nearly all heights would take one of two values.
    static HeightDistribution of_moments(double skewness, double kurtosis);

    // Interpolates heights at increasing normal scores linearly and extrapolates linearly. Throws Error(bad_input) unless heights increase.
    static HeightDistribution of_quantiles(const std::vector<double>& scores, const std::vector<double>& heights);

    double operator()(double normal) const;
    double normal(double value) const;  // the inverse of operator()
    HeightShape shape() const;

private:
    explicit HeightDistribution(std::vector<double> values);
    std::vector<double> values_;  // at equally spaced normal scores
};

// Quantiles of a sample of heights (in any order) at normal scores: a share of erfc(-score/sqrt 2)/2 of the sample lies below each.
std::vector<double> quantiles(std::vector<double> heights, const std::vector<double>& scores);

}  // namespace rsc
