// Distributions the paper fits to its contacts (section 5): Rayleigh, exponential, and the generalised gamma of the full
// pressure. A value that cannot be fitted (no contacts, too few bins) is NaN: absent.
#pragma once

#include "std.hpp"

namespace rsc {

inline constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

// A distribution with one scale: Rayleigh, density (x/s^2) exp(-x^2/(2 s^2)), or exponential, density exp(-x/s)/s.
struct ScaleFit {
    double scale = kAbsent;
    double scale_error = kAbsent;  // standard error
    double ks_distance = kAbsent;  // Kolmogorov-Smirnov distance at the bin edges
};

// gamma x^alpha exp(-(x/delta)^beta) on x > 0, gamma = beta / (delta^(alpha+1) Gamma((alpha+1)/beta)).
struct GammaFit {
    double alpha = kAbsent, beta = kAbsent, delta = kAbsent, gamma = kAbsent;
    double alpha_error = kAbsent, beta_error = kAbsent, delta_error = kAbsent, gamma_error = kAbsent;  // standard errors
    double ks_distance = kAbsent;
};

// Binned data: bins of equal width from 0, and the overflow beyond the last.
struct Binned {
    double width = 0;
    std::vector<double> weight;  // of each bin: counts, or areas
    double overflow = 0;
    double total() const;  // of the bins and the overflow
};

// Maximum likelihood from the power sums of all values (no binning enters): s^2 = <x^2>/2 with error s/(2 sqrt(n)), s = <x> with
// error s/sqrt(n).
ScaleFit fit_rayleigh(double count, double sum_of_squares, const Binned& binned);
ScaleFit fit_exponential(double count, double sum, const Binned& binned);

// Maximum likelihood of the binned data (each bin, and the overflow, with its exact probability: the bin width biases nothing),
// by Fisher scoring from alpha = 2/3, beta = 3/2, the paper's exponents, and delta of the mean. `independent` is the number of
// independent observations the weights stand for; the standard errors are those of so many draws. Absent when fewer than 5 bins
// hold anything, for fewer than 10 independent observations, or when the scoring does not converge.
GammaFit fit_generalised_gamma(const Binned& binned, double mean, double independent);

// Cumulative distribution of the fitted law.
double generalised_gamma_cdf(double x, double alpha, double beta, double delta);

// Regularised incomplete gamma functions, P + Q = 1, a > 0, x >= 0 (Abramowitz and Stegun 6.5.29 and 6.5.31).
struct IncompleteGamma {
    double P = 0, Q = 1;
};
IncompleteGamma incomplete_gamma(double a, double x);

}  // namespace rsc
