// Power spectral density of an isotropic self-affine surface and its spectral moments (paper, section 2).
#pragma once

#include <memory>
#include <vector>

namespace rsc {

// A power spectral density that is known at some wavenumbers: linear in logarithms between them, zero outside, and zero between two of
// which one has none.
class SpectrumTable {
public:
    // wavenumber [1/length], psd [length^4], of any unit as long as it is one. Throws Error(bad_input) naming the entry unless there are two
    // or more of each, finite, wavenumbers positive and rising, psd not negative and somewhere positive between two entries that are.
    SpectrumTable(std::vector<double> wavenumber, std::vector<double> psd);
    double operator()(double k) const;
    double lowest() const { return k_.front(); }
    double highest() const { return k_.back(); }
    double largest() const { return largest_; }  // psd
    // Integral of k^power Phi(k) dk, exact for what the table means.
    double integral(double power) const;
    double sigma() const;  // rms height: the square root of the integral of 2 pi k Phi

private:
    std::vector<double> k_, psd_, log_k_, log_psd_;
    double largest_ = 0;
};

// What defines the statistics of a synthetic rough surface on a square L x L.
struct Spectrum {
    double L = 1.0;             // side of the square [length]
    double hurst = 0.8;         // Hurst exponent H, 0 <= H <= 1
    double L_lambda_l = 24.0;   // L / lambda_l: lower cutoff kl = 2 pi / lambda_l
    double L_lambda_s = 512.0;  // L / lambda_s: upper cutoff ks = 2 pi / lambda_s
    bool plateau = false;       // PSD = Phi0 between 2 pi / L and kl (otherwise 0 there)
    double sigma = 0.01;        // rms height [length]
    // If there is one, it is the spectrum, scaled to sigma; hurst and plateau mean nothing then, and the cutoffs are its ends.
    std::shared_ptr<const SpectrumTable> table = nullptr;
};

// The spectrum of a table on a square of side L.
Spectrum tabulated_spectrum(std::shared_ptr<const SpectrumTable> table, double L, double sigma);

// One-dimensional profile moments m0, m2, m4 of an isotropic surface; m_p has the unit length^(2-p).
struct Moments {
    double m0 = 0, m2 = 0, m4 = 0;
    double nayak() const { return m0 * m4 / (m2 * m2); }  // Nayak's alpha
    double rms_slope() const;                             // rms gradient sqrt(2 m2)
    double summit_density() const;                        // D = sqrt(3) m4 / (18 pi m2) [1/length^2]
    double mean_spacing() const;                          // <d> = 1/sqrt(D) [length]
    double mean_radius() const;                           // the paper's r_g = 1/<kappa_g> = 0.737/sqrt(m4) [length]
};

// Throws Error(bad_input) naming the member unless L > 0, 0 <= hurst <= 1, 1 <= L_lambda_l <= L_lambda_s (strictly less without
// the plateau), sigma > 0, all finite, and at least one mode lies in the band.
void validate(const Spectrum& spectrum);

// Closed forms of the continuous spectrum, a table's included, scaled so that m0 = sigma^2. Throws as validate().
Moments theoretical_moments(const Spectrum& spectrum);

// The same of the modes a periodic L x L square has (integer wavevectors), scaled so that m0 = sigma^2: what the sampled
// moments are in expectation. A sum over all modes: takes time in proportion to L_lambda_s^2. Throws as validate().
Moments discrete_moments(const Spectrum& spectrum);

// Relative PSD (Phi / Phi0; Phi over its largest value of a table) of the mode with integer wavevector of squared length q2 (K = (2 pi / L) sqrt(q2));
// 0 outside the band. A mode exactly at K = kl (or ks) belongs to the surface either way, to a relative 1e-12 of q2.
double relative_psd(const Spectrum& spectrum, double q2);

// The band in integer wavevectors, the tolerance at its ends included.
struct Band {
    double lowest_q2 = 0;          // smallest q2 of the power law
    double highest_q2 = 0;         // largest q2 of all
    int highest_kx = 0;            // floor(sqrt(highest_q2))
    int highest_ky(int kx) const;  // largest ky with kx^2 + ky^2 <= highest_q2
};
Band band(const Spectrum& spectrum);

}  // namespace rsc
