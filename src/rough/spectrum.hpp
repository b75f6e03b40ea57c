// Power spectral density of a self-affine surface and its spectral moments (paper, section 2).
#pragma once

#include "rough/height_distribution.hpp"

namespace rsc {

// A power spectral density that is known at some wavenumbers: linear in logarithms between them, zero outside, and zero between two of
// which one has none.
class SpectrumTable {
public:
    // wavenumber [1/length], psd [length^4], in any consistent unit. Throws Error(bad_input) naming the entry unless there are two
    // or more of each, finite, wavenumbers positive and rising, psd not negative and somewhere positive between two entries that are.
    SpectrumTable(std::vector<double> wavenumber, std::vector<double> psd);
    double operator()(double k) const;
    double lowest() const { return k_.front(); }
    double highest() const { return k_.back(); }
    double largest() const { return largest_; }  // psd
    // Integral of k^power Phi(k) dk, exact for the interpolated table.
    double integral(double power) const;
    double sigma() const;  // rms height: the square root of the integral of 2 pi k Phi

private:
    std::vector<double> k_, psd_, log_k_, log_psd_;
    double largest_ = 0;
};

// A power spectral density that depends on the direction, known at rings of wavenumbers and at equally spaced angles: linear in logarithms
// between rings, linear between angles, zero below the first ring and above the last.
class PlaneSpectrum {
public:
    // wavenumber [1/length]; psd [length^4], [ring][angle] at the angles 0, 180/angles, ... degrees from the x axis towards the y axis, the
    // other half plane being the mirror image. Throws Error(bad_input) unless wavenumbers are positive and rise, densities are finite and not
    // negative, there are two rings and two angles or more, and something is positive.
    PlaneSpectrum(std::vector<double> wavenumber, std::size_t angles, std::vector<double> psd);
    double operator()(double kx, double ky) const;
    double lowest() const { return k_.front(); }
    double highest() const { return k_.back(); }
    double largest() const { return largest_; }  // psd
    // Integral of kx^p ky^q Phi over the plane, p + q even.
    double integral(int p, int q) const;
    double sigma() const;  // rms height

private:
    double along(std::size_t ring, double turn) const;  // at an angle in steps of the table
    std::vector<double> k_, psd_;
    std::size_t angles_;
    double largest_ = 0;
};

// The parameters of a synthetic rough surface on a square L x L.
struct Spectrum {
    double L = 1.0;             // side of the square [length]
    double hurst = 0.8;         // Hurst exponent H, 0 <= H <= 1
    double L_lambda_l = 24.0;   // L / lambda_l: lower cutoff kl = 2 pi / lambda_l
    double L_lambda_s = 512.0;  // L / lambda_s: upper cutoff ks = 2 pi / lambda_s
    bool plateau = false;       // PSD = Phi0 between 2 pi / L and kl (otherwise 0 there)
    double sigma = 0.01;        // rms height [length]
    // Anisotropy (Peklenik): the ratio of the correlation lengths along and across `direction`. Wave vectors are stretched before the
    // spectrum is read: Phi(sqrt(aspect k1^2 + k2^2/aspect)), k1 along the direction, k2 across it. 1: isotropic.
    double aspect = 1.0;
    double direction = 0.0;  // of the long correlation length, from the x axis towards the y axis [degree]
    // Heights that are not Gaussian, by skewness and kurtosis, or by their distribution if there is one (rough/reshape.hpp).
    HeightShape shape = {};
    std::shared_ptr<const HeightDistribution> heights = nullptr;
    bool gaussian() const { return !heights && shape.skewness == 0 && shape.kurtosis == 3; }
    // If set, the spectrum, scaled to sigma; hurst and plateau are then not used, and the cutoffs are its ends.
    std::shared_ptr<const SpectrumTable> table = nullptr;
    // The same by direction, instead of the table.
    std::shared_ptr<const PlaneSpectrum> plane = nullptr;
    bool tabulated() const { return table || plane; }
    bool directional() const { return aspect != 1 || plane; }
};

// The spectrum of a table on a square of side L.
Spectrum tabulated_spectrum(std::shared_ptr<const SpectrumTable> table, double L, double sigma);
Spectrum tabulated_spectrum(std::shared_ptr<const PlaneSpectrum> plane, double L, double sigma);

// Moments of the surface by direction: m_pq is the integral of kx^p ky^q Phi over the plane, m20 = <(dz/dx)^2>, m11 = <dz/dx dz/dy>, m40 = <(d2z/dx2)^2>, ... [length^(2-p-q)].
struct MomentTensor {
    double m20 = 0, m11 = 0, m02 = 0;
    double m40 = 0, m31 = 0, m22 = 0, m13 = 0, m04 = 0;
    // Half the trace <|grad z|^2>: the m2 of an isotropic surface of the same rms slope.
    double m2() const { return (m20 + m02) / 2; }
    // From <(nabla^2 z)^2>, which does not depend on the axes: the m4 of an isotropic surface of the same mean square curvature.
    double m4() const { return 3.0 / 8.0 * (m40 + 2 * m22 + m04); }
    MomentTensor transposed() const { return {m02, m11, m20, m04, m13, m22, m31, m40}; }
};

// One-dimensional profile moments m0, m2, m4 of an isotropic surface; m_p has the unit length^(2-p).
struct Moments {
    double m0 = 0, m2 = 0, m4 = 0;
    MomentTensor tensor;                                  // the same by direction
    HeightShape heights;                                  // of a surface made with heights that are not Gaussian
    double nayak() const { return m0 * m4 / (m2 * m2); }  // Nayak's alpha
    double rms_slope() const;                             // rms gradient sqrt(2 m2)
    double summit_density() const;                        // D = sqrt(3) m4 / (18 pi m2) [1/length^2]
    double mean_spacing() const;                          // <d> = 1/sqrt(D) [length]
    double mean_radius() const;                           // the paper's r_g = 1/<kappa_g> = 0.737/sqrt(m4) [length]
};

// The moments of an isotropic surface of moments m2, m4 after stretching and rotation.
MomentTensor directional_moments(double m2, double m4, double aspect, double direction);

// Throws Error(bad_input) naming the member unless L > 0, 0 <= hurst <= 1, 1 <= L_lambda_l <= L_lambda_s (strictly less without
// the plateau), sigma > 0, aspect from 0.01 to 100, all finite, a distribution
// of heights has the skewness and kurtosis, and at least one mode lies in the band.
void validate(const Spectrum& spectrum);

// Closed forms of the continuous spectrum, a table's included, scaled so that m0 = sigma^2. Of an anisotropic surface m2 and m4 are those
// of MomentTensor. Throws as validate().
Moments theoretical_moments(const Spectrum& spectrum);

// The same of the modes a periodic L x L square has (integer wavevectors), scaled so that m0 = sigma^2: the
// expectation of the sampled moments. A sum over all modes, whose time is proportional to L_lambda_s^2. Throws as validate().
Moments discrete_moments(const Spectrum& spectrum);

// The squared length of integer wavevectors after stretching: q2 = xx kx^2 + 2 xy kx ky + yy ky^2, of determinant 1.
struct Stretch {
    double xx = 1, xy = 0, yy = 1;
    double operator()(double kx, double ky) const { return xx * kx * kx + ky * (2 * xy * kx + yy * ky); }
};
Stretch stretch(const Spectrum& spectrum);

// The shortest wave in any direction as L/lambda: L_lambda_s, or more of an anisotropic surface.
double shortest_wave(const Spectrum& spectrum);

// Relative PSD (Phi / Phi0; Phi over its largest value of a table) of the mode with integer wavevector (kx, ky); 0 outside the band. A mode
// exactly at K = kl (or ks) belongs to the surface either way, to a relative 1e-12 of its square.
double relative_psd(const Spectrum& spectrum, double kx, double ky);

// The band in integer wavevectors, the tolerance at its ends included.
struct Band {
    Stretch stretched;
    double lowest_q2 = 0;   // smallest stretched q2 of the power law
    double highest_q2 = 0;  // largest stretched q2 of all
    int highest_kx = 0;     // largest kx of all modes
    int highest_ky = 0;     // largest |ky| of all modes
    // The modes kx, first ... last; first > last if the column has none.
    struct Run {
        int first = 0, last = -1;
    };
    Run column(int kx) const;
};
Band band(const Spectrum& spectrum);

}  // namespace rsc
