// Profiles, heights along a line: parameters, spectrum, and the spectrum of surfaces that have such
// profiles. A profile is a height map of one row.
#pragma once

#include "surface/form.hpp"
#include "surface/measured_spectrum.hpp"

namespace rsc {

// ISO 21920-2 (ISO 4287), of heights about their mean line.
struct ProfileParameters {
    double length = 0;           // evaluation length [length]
    double sampling_length = 0;  // of rz: the long cutoff; without one the whole length
    int samplings = 1;           // whole sampling lengths in it
    double ra = 0, rq = 0;       // mean and rms deviation [length]
    double rz = 0;               // mean over the sampling lengths of highest less lowest [length]
    double rsk = 0, rku = 0;     // skewness and kurtosis; NaN for equal heights
    double rdq = 0;              // rms slope, by the formula of 7 points of ISO 4287
};
ProfileParameters profile_parameters(const HeightMap& profile, double cutoff_long);

// Long-wave cutoff lambda_c of ISO 16610-21: subtracts the Gaussian mean line. Half a cutoff at
// each end, where the filter reaches beyond the profile, is cut off. Throws Error(bad_input) if
// fewer than 16 points remain.
void remove_long_waves(HeightMap& profile, double cutoff);

// Cuts `points` points off either end, also of a mask of them.
void cut_ends(HeightMap& profile, int points, std::vector<std::uint8_t>& mask);

// Power spectral density C1 of a profile in bands of wavenumbers: its integral over all q, negative
// ones included, is the mean square height.
struct ProfileSpectrum {
    std::vector<double> wavenumber;  // of the bands, mean of the logarithms [1/length]
    std::vector<double> middle;      // between the first and the last mode of each [1/length]
    std::vector<double> psd;         // [length^3]
    std::vector<double> modes;       // number of Fourier modes
    double step = 0;                 // between modes [1/length]
    double lowest = 0, highest = 0;  // wavenumbers that neither form nor filter removed
};

// After a Hann window, with the loss of power corrected, as measure_spectrum(); divided by the
// transmission of the filters of these cutoffs (0: none). Waves that the form took, one or
// more of length of the profile, and those beyond a cutoff are left out.
ProfileSpectrum profile_spectrum(const HeightMap& profile, double cutoff_long, double cutoff_short,
                                 Detrend form);

// The density C1 at wavenumber q of the profiles of an isotropic surface with this self-affine
// spectrum and hurst = H > -1/2, in closed form: 2 int_0 Phi(sqrt(q^2 + t^2)) dt.
double profile_of_self_affine(const SelfAffineFit& surface, double q);

// Phi [length^4] of the isotropic surface whose profiles have the density C1:
//   Phi(k) = -(1/pi) int_k^infinity C1'(q)/sqrt(q^2 - k^2) dq,
// with C1 a power law between the wavenumbers and 0 beyond the last (Nayak, Wear 26, 1973, 165).
// Where C1 rises too fast for any surface, 0.
std::vector<double> isotropic_spectrum(const std::vector<double>& wavenumber,
                                       const std::vector<double>& c1);

// The self-affine surface whose profiles most likely have this spectrum (Whittle), with half widths
// of 90 % intervals.
struct ProfileFit {
    SelfAffineFit surface;
    double noise = 0;     // density of white noise under it, 0: none seen [length^3]
    Fitted sigma, slope;  // rms height, and rms slope of the profile, of the fitted band
};
// The largest H of a fit.
inline constexpr double kMostHurst = 1.6;
// Throws Error(bad_input) for fewer than 8 bands.
ProfileFit fit_profile(const ProfileSpectrum& spectrum);
bool can_fit(const ProfileSpectrum& spectrum);

// What Measured has of a profile beside what it has of a map.
struct MeasuredProfile {
    std::vector<double> trace, form;  // as read, and the form, at all points [length]
    double trace_x0 = 0;              // of their first point
    std::vector<double> heights;      // treated, from x0 of the map on
    ProfileParameters parameters;
    double cutoff_long = 0;
    ProfileSpectrum spectrum;
    std::optional<ProfileFit> fit;
    // Factor of the wavenumber by the assumed lay: the profile of a surface with Phi(k') of
    // stretched wavenumbers has C1(q) = (1/factor) C1'(q/factor), C1' of the isotropic one.
    double stretch = 1;
};

}  // namespace rsc
