// Fits of distributions (paper, section 5): Rayleigh, exponential and generalised gamma. Values
// that cannot be fitted (no contacts, too few bins) are NaN.
#pragma once

#include "base/std.hpp"

namespace rsc {

inline constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

// A distribution with one scale: Rayleigh, density (x/s^2) exp(-x^2/(2 s^2)), or exponential,
// density exp(-x/s)/s.
struct ScaleFit {
    double scale = kAbsent;
    double scale_error = kAbsent;  // standard error
    double ks_distance = kAbsent;  // Kolmogorov-Smirnov distance at the bin edges
};

// Density gamma x^alpha exp(-(x/delta)^beta) on x > 0, with gamma = beta / (delta^(alpha+1)
// Gamma((alpha+1)/beta)).
struct GammaFit {
    double alpha = kAbsent, beta = kAbsent, delta = kAbsent, gamma = kAbsent;
    double alpha_error = kAbsent, beta_error = kAbsent, delta_error = kAbsent,
           gamma_error = kAbsent;  // standard errors
    double ks_distance = kAbsent;
};

// Binned data: bins of equal width from 0, and the overflow beyond the last.
struct Binned {
    double width = 0;
    std::vector<double> weight;  // count or area of each bin
    double overflow = 0;
    double total() const;  // of the bins and the overflow
};

// Maximum-likelihood fits from the power sums of all values, independent of the bins: s^2 = <x^2>/2
// with error s/(2 sqrt(n)), s = <x> with error s/sqrt(n).
ScaleFit fit_rayleigh(double count, double sum_of_squares, const Binned& binned);
ScaleFit fit_exponential(double count, double sum, const Binned& binned);

// Maximum-likelihood fit to the binned data with the exact probabilities of the bins and the
// overflow, so that the bin width causes no bias. Fisher scoring starts from the paper's exponents
// alpha = 2/3, beta = 3/2 and the delta that follows from the mean. `independent` is the effective
// number of independent observations, from which the standard errors follow. The result is NaN if
// fewer than 5 bins are not empty, for fewer than 10 independent observations, or if the scoring
// does not converge.
GammaFit fit_generalised_gamma(const Binned& binned, double mean, double independent);

// Cumulative generalised gamma distribution.
double generalised_gamma_cdf(double x, double alpha, double beta, double delta);

}  // namespace rsc
