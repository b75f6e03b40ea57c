// Power spectral density of a self-affine surface and its spectral moments (paper, section 2).
#pragma once

#include "surface/height_distribution.hpp"

namespace rsc {

// A power spectral density tabulated on rings of wavenumbers, and at equally spaced angles or for
// all directions. It is interpolated linearly in logarithms between rings and linearly between
// angles, and is zero outside the table and beside entries that are zero.
class SpectrumTable {
public:
    // wavenumber [1/length]; psd [length^4], in any consistent unit, [ring][angle] at the angles 0,
    // 180/angles, ... degrees from the x axis towards the y axis, with the other half plane as the
    // mirror image. Throws Error(bad_input) with the number of the entry unless there are two rings
    // or more, all values are finite, wavenumbers are positive and increase, psd is not negative,
    // and two entries of adjacent rings are positive.
    SpectrumTable(std::vector<double> wavenumber, std::vector<double> psd, std::size_t angles = 1);
    double operator()(double kx, double ky = 0) const;
    double lowest() const { return k_.front(); }
    double highest() const { return k_.back(); }
    double largest() const { return largest_; }        // largest psd
    bool by_direction() const { return angles_ > 1; }  // otherwise the same in all directions
    // Integral of kx^p ky^q Phi over the plane, p + q even.
    double integral(int p, int q) const;
    double sigma() const;  // rms height

private:
    double along(std::size_t ring,
                 double turn) const;  // psd of a ring at an angle in steps of the table
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
    // Anisotropy (Peklenik): ratio of the correlation lengths along and across `direction`; 1:
    // isotropic. The spectrum is Phi(sqrt(aspect k1^2 + k2^2/aspect)) with k1 along the direction
    // and k2 across it.
    double aspect = 1.0;
    // direction of the long correlation length, from the x axis towards the y axis [degree]
    double direction = 0.0;
    // Non-Gaussian heights, by skewness and kurtosis, or by their distribution if it is set
    // (surface/reshape.cpp).
    HeightShape shape = {};
    std::shared_ptr<const HeightDistribution> heights = nullptr;
    bool gaussian() const { return !heights && shape.skewness == 0 && shape.kurtosis == 3; }
    // If set, the spectrum, scaled to sigma. hurst and plateau are then not used, and the cutoffs
    // are the ends of the table; aspect and direction apply to a table that is not by direction.
    std::shared_ptr<const SpectrumTable> table = nullptr;
    bool by_direction() const { return table && table->by_direction(); }
    bool directional() const { return aspect != 1 || by_direction(); }
};

// Parameters of a surface with a tabulated spectrum on a square of side L.
Spectrum tabulated_spectrum(std::shared_ptr<const SpectrumTable> table, double L, double sigma);

// Moments by direction: m_pq is the integral of kx^p ky^q Phi over the plane, m20 = <(dz/dx)^2>,
// m11 = <dz/dx dz/dy>, m40 = <(d2z/dx2)^2>,
// ... [length^(2-p-q)].
struct MomentTensor {
    double m20 = 0, m11 = 0, m02 = 0;
    double m40 = 0, m31 = 0, m22 = 0, m13 = 0, m04 = 0;
    // m2 of an isotropic surface of the same rms slope: half of <|grad z|^2>.
    double m2() const { return (m20 + m02) / 2; }
    // m4 of an isotropic surface of the same mean square curvature <(nabla^2 z)^2>, which does not
    // depend on the axes.
    double m4() const { return 3.0 / 8.0 * (m40 + 2 * m22 + m04); }
    // rms of the slope along the direction in which it is smallest, times sqrt(2): the rms slope of
    // an isotropic surface that is as gentle as this one along its lay.
    double gentlest_slope() const;
    MomentTensor transposed() const { return {m02, m11, m20, m04, m13, m22, m31, m40}; }
};

// One-dimensional profile moments m0, m2, m4 of an isotropic surface; m_p has the unit
// length^(2-p).
struct Moments {
    double m0 = 0, m2 = 0, m4 = 0;
    MomentTensor tensor = {};                             // moments by direction
    HeightShape heights = {};                             // of a non-Gaussian surface
    double nayak() const { return m0 * m4 / (m2 * m2); }  // Nayak's alpha
    double rms_slope() const;                             // rms gradient sqrt(2 m2)
    // D = sqrt(3) m4 / (18 pi m2) [1/length^2] with the moments of the isotropic surface that was
    // stretched; exact for those, an estimate for other directional spectra.
    double summit_density() const;
    double mean_spacing() const;  // <d> = 1/sqrt(D) [length]
    double mean_radius() const;   // the paper's r_g = 1/<kappa_g> = 0.737/sqrt(m4) [length]
};

// Moments by direction of an isotropic surface with moments m2, m4 after stretching and rotation.
MomentTensor directional_moments(double m2, double m4, double aspect, double direction);

// Throws Error(bad_input) unless the parameters, each within the bounds of its key, are possible
// together: a height distribution with the skewness and kurtosis exists, at least one mode lies in
// the band, and wavevectors are not too large.
void validate(const Spectrum& spectrum);

// Moments of the continuous spectrum (tables included) in closed form, scaled so that m0 = sigma^2.
// For an anisotropic surface m2 and m4 are those of MomentTensor. Throws as validate().
Moments theoretical_moments(const Spectrum& spectrum);

// Expectation of the sampled moments on a periodic L x L square (integer wavevectors), scaled so
// that m0 = sigma^2. It is a sum over all modes, which takes a time proportional to L_lambda_s^2.
// Throws as validate().
Moments discrete_moments(const Spectrum& spectrum);

// Squared length of stretched integer wavevectors: q2 = xx kx^2 + 2 xy kx ky + yy ky^2, with
// determinant 1.
struct Stretch {
    double xx = 1, xy = 0, yy = 1;
    double operator()(double kx, double ky) const {
        return xx * kx * kx + ky * (2 * xy * kx + yy * ky);
    }
};
Stretch stretch(const Spectrum& spectrum);

// L/lambda of the shortest wave in any direction: L_lambda_s, or more if the surface is
// anisotropic.
double shortest_wave(const Spectrum& spectrum);

// Relative PSD (Phi/Phi0; for a table Phi over its largest value) of the mode with integer
// wavevector (kx, ky); 0 outside the band. Modes at K = kl or ks, to a relative tolerance of 1e-12
// in K^2, belong to the band.
double relative_psd(const Spectrum& spectrum, double kx, double ky);

// The band in integer wavevectors, including the tolerance at its ends.
struct Band {
    Stretch stretched;
    double lowest_q2 = 0;   // smallest stretched q2 of the power law
    double highest_q2 = 0;  // largest stretched q2 of all
    int highest_kx = 0;     // largest kx of all modes
    int highest_ky = 0;     // largest |ky| of all modes
    // Range of ky of the modes in a column kx; first > last if there are none.
    struct Run {
        int first = 0, last = -1;
    };
    Run column(int kx) const;
};
Band band(const Spectrum& spectrum);

}  // namespace rsc
