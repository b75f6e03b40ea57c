// Spectrum, height parameters and height distribution of a height map, from which similar synthetic
// surfaces can be made.
#pragma once

#include "surface/surface.hpp"

namespace rsc {

// A fitted value and the half width of its 90 % interval.
struct Fitted {
    double value = 0, error = 0;
};

// Fitted self-affine spectrum: Phi0 (k/kl)^(-2(1+hurst)) from kl to ks, Phi0 below kl with the
// plateau. If kl_seen is false, the power law continues below kl.
struct SelfAffineFit {
    Fitted Phi0;    // [length^4]
    Fitted kl, ks;  // [1/length]
    // Hurst exponent; above 1 for slopes steeper than -4, below 0 for slopes flatter than -2.
    Fitted hurst;
    bool plateau = false;
    bool ks_seen = false;  // true if the power law ends before the grid's shortest wave
    bool kl_seen = false;  // false if the map is too small to show kl; kl is then an upper bound
    bool plateau_seen = false;  // false if the map is too small to tell whether there is a plateau
    // Lay of the surface: ratio of the correlation lengths along and across it, and its angle from
    // the x axis [rad]. Phi depends only on the stretched wavenumber
    // hypot(sqrt(aspect) k_along, k_across/sqrt(aspect)).
    double aspect = 1, direction = 0;
    double operator()(double k) const;
    double around(double k) const;  // mean over all directions at the unstretched wavenumber k
};

// Power spectral density over the wavenumber k = 2 pi/lambda, averaged over rings: the integral of
// Phi 2 pi k dk is the mean square height. Rings are 2 pi/max(Lx, Ly) wide and reach from that
// wavenumber to the smaller Nyquist wavenumber of the two directions.
struct MeasuredSpectrum {
    double ring = 0;                 // their width [1/length]
    std::vector<double> wavenumber;  // middle of the rings that have modes [1/length]
    std::vector<double> psd;         // [length^4]
    std::vector<double> modes;       // number of Fourier modes in the ring, including mirror images
    // share of independent amplitudes among them, reduced by mirror images and by the window
    double independent = 0.5;
    double coupled = 1;  // number of neighbouring rings coupled by the window
    double lost = 0;     // below this wavenumber, in rings, power has been removed with the form
    // For the first 32 rings: pairs (place, share) of the wavenumber place/kPlaces, in units of
    // rings, and its share of the expected power.
    static constexpr int kPlaces = 8;
    std::vector<std::vector<std::pair<std::size_t, double>>> seen;
    std::size_t places = 0;  // number of places
    // Spectrum by direction, on fewer rings (wider ones at large wavenumbers) and at kAngles angles
    // 0, 2.5, ... degrees from the x axis towards the y axis; the other half plane is the mirror
    // image. Near the origin values are averaged over the angle that two modes span, the resolution
    // of the window.
    static constexpr std::size_t kAngles = 72;
    std::vector<double> plane_wavenumber;  // [1/length]
    std::vector<double> plane_psd;         // [ring][angle], [length^4]
    // Synthetic surfaces with this spectrum have psd times (wavenumber/wavenumber[0])^exponent,
    // likewise plane_psd (twin_exponent()).
    double exponent = 0, plane_exponent = 0;
    // Direction of the lay from the x axis, 0 to 180 [degree]: perpendicular to the mean direction
    // of the power, averaged at twice the angle. Of a spectrum with aspect 1.
    double lay = 0;
};

// Measures the spectrum. A map that is not periodic is multiplied by a Hann window and the loss of
// power is corrected. No point may be missing. With aspect != 1 the rings are ellipses of constant
// stretched wavenumber (SelfAffineFit) and plane_psd is empty. Throws Error(no_memory).
MeasuredSpectrum measure_spectrum(const HeightMap& map, double aspect = 1, double direction = 0);

// The power of the Fourier modes of a profile, a map of one row, after the same window: mode j has
// the wavenumber j step, and all modes, those of negative wavenumbers included, sum up to the mean
// square height.
struct ModePowers {
    double step = 0;            // [1/length]
    std::vector<double> power;  // of j >= 0 [length^2]
};
ModePowers mode_powers(const HeightMap& profile);

// The squared transform of the window at 0, 1, ... half steps: the covariance within a window of
// length L is a series of waves of length 2 L. That of a Hann window is below 1e-4 beyond.
inline constexpr int kWindowReach = 5;
std::array<double, kWindowReach + 1> squared_transform(bool periodic);

// Fits in two steps. First ks, by least squares in logarithms with each ring weighted by its number
// of modes: a line of slope -2(1+hurst), -0.5 <= hurst <= 1.5, that contains at least a hundredth
// of the mean square height, with separate lines below and beyond it. The Bayesian information
// criterion determines the breaks; ks is where the spectrum falls to half of the power law. Then
// hurst, Phi0, kl and the plateau maximise Whittle's likelihood of the rings below ks, where the
// expected power of a ring includes the blur by the window. Rings that have lost power to a removed
// form are ignored. Errors are 90 % intervals of the likelihood, wider if the spectrum deviates
// from a power law; if the interval of kl includes spectra without a break, kl_seen is false.
// Throws Error(bad_input) for fewer than 8 rings with psd > 0, where can_fit() is false.
SelfAffineFit fit_self_affine(const MeasuredSpectrum& spectrum);
bool can_fit(const MeasuredSpectrum& spectrum);

// ISO 25178-2: rms height Sq about the mean, skewness Ssk and kurtosis Sku (NaN for a flat map),
// rms gradient Sdq (first differences).
struct HeightParameters {
    double sq = 0, ssk = 0, sku = 0, sdq = 0;
    // Rms slope of the points higher than the mean plane by more than sq over that of all points,
    // by first differences; 1 for Gaussian heights.
    double high_slope = 1;
};
HeightParameters height_parameters(const HeightMap& map);

// Ratio of the smallest to the largest rms slope over all directions (1 for an isotropic surface,
// near 0 for grooves) and the direction of the smallest from the x axis [rad], by first
// differences.
struct Isotropy {
    double ratio = 1, direction = 0;
};
Isotropy isotropy(const HeightMap& map);

// The exponent e for which psd(kx, ky) (k/wavenumber[0])^e, by first differences with the steps of
// the map, has the ratio of rms slope to rms height of the map, between -kMostExponent and `most`.
// The window of measure_spectrum() weighs the middle of the map, so that long waves of a map that
// is rougher elsewhere are missing, and those of a map that is rougher there count too much. `most`
// is 0 for maps with breaks: slopes that are missing there are those of pits, spikes and steps,
// which no spectrum reproduces.
inline constexpr double kMostExponent = 0.5;
double twin_exponent(const std::function<double(double, double)>& psd,
                     const std::vector<double>& wavenumber, const HeightMap& map,
                     const HeightParameters& parameters, double most);

// psd[ring][...] times (k/wavenumber[0])^exponent; as it is if the sizes do not agree.
std::vector<double> tilted(std::vector<double> psd, const std::vector<double>& wavenumber,
                           double exponent);

// Heights about their mean [length] at equally spaced normal scores from -5 to 5.
struct HeightQuantiles {
    static constexpr int kScores = 201;
    std::vector<double> score, height;
};

// No point may be missing.
HeightQuantiles height_quantiles(const HeightMap& map);

}  // namespace rsc
