// Distributions of heights that are not Gaussian.
#pragma once

#include <vector>

namespace rsc {

// A distribution of mean 0 and variance 1, as the rising function of a standard normal variable that has it.
class HeightDistribution {
public:
    // The member of Johnson's system (Biometrika 36, 1949) with this skewness and kurtosis: SU, SB or, between them, the lognormal one.
    // Throws Error(bad_input) naming the bound unless skewness^2 + 1 < kurtosis <= 100, or when they lie so near to the bound that nearly
    // all heights would have one of two values.
    static HeightDistribution of_moments(double skewness, double kurtosis);

    // That of a sample of heights in any unit. Throws Error(bad_input) for less than two values or values that are all the same.
    static HeightDistribution of_sample(std::vector<double> heights);

    double operator()(double normal) const;

private:
    explicit HeightDistribution(std::vector<double> values);
    std::vector<double> values_;  // at equally spaced normal scores
};

}  // namespace rsc
