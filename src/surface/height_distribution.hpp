// Non-Gaussian height distributions, and surfaces with a given one and an unchanged spectrum.
#pragma once

#include "base/std.hpp"

namespace rsc {

// Skewness and kurtosis of heights, by default of Gaussian ones.
struct HeightShape {
    double skewness = 0, kurtosis = 3;
};

// A distribution of mean 0 and variance 1, represented as an increasing function of a standard
// normal variable.
class HeightDistribution {
public:
    // Interpolates heights at increasing normal scores linearly and extrapolates linearly. Throws
    // Error(bad_input) unless heights increase.
    static HeightDistribution of_quantiles(const std::vector<double>& scores,
                                           const std::vector<double>& heights);

    double operator()(double normal) const;
    HeightShape shape() const;

private:
    explicit HeightDistribution(std::vector<double> values);
    std::vector<double> values_;  // at equally spaced normal scores
};

struct Spectrum;

// Changes only the phases of a surface's modes until its heights have the skewness and kurtosis, or
// the distribution, given in the Spectrum: by Newton's method for both moments, at first of the
// waves that hold 92 % of the mean square height, then of 98.5 % or all.
// Towards a measured distribution heights are replaced by rank and the amplitudes of the modes
// restored (Schreiber and Schmitz, Phys.
// Rev. Lett. 77, 1996, 635) before the last rounds. columns: the coefficients of kx = 0, 1, ...
// highest_kx, `stride` apart, index ky mod n, n > 2 highest_ky; changed in place. The result
// depends only on the modes, not on n. Returns the final skewness and kurtosis. Throws
// Error(no_memory).
HeightShape reshape_heights(const Spectrum& spectrum, std::complex<double>* columns,
                            std::ptrdiff_t stride, int n);

// Quantiles of a sample of heights (in any order) at normal scores: a share of erfc(-score/sqrt
// 2)/2 of the sample lies below each.
std::vector<double> quantiles(std::vector<double> heights, const std::vector<double>& scores);

}  // namespace rsc
