// Spectrum and height distribution of a height map: the numbers from which similar synthetic surfaces are made.
#pragma once

#include "rough/surface.hpp"

namespace rsc {

// A fitted value and its standard error.
struct Fitted {
    double value = 0, error = 0;
};

// The self-affine spectrum that fits: Phi0 (k/kl)^(-2(1+hurst)) from kl to ks, Phi0 below kl with the plateau (physics, section 2).
struct SelfAffineFit {
    Fitted Phi0;    // [length^4]
    Fitted kl, ks;  // [1/length]
    Fitted hurst;   // Hurst exponent; above 1 for slopes steeper than -4, below 0 for slopes flatter than -2
    bool plateau = false;
    bool ks_seen = false;  // the power law ends before the grid's shortest wave
    // The surface's lay: the wavenumber is hypot(sqrt(aspect) k along, k across/sqrt(aspect)), so that Phi is a function of it alone.
    double aspect = 1, direction = 0;  // ratio of the correlation lengths along and across the lay; the lay from the x axis [rad]
    double operator()(double k) const;
    double around(double k) const;  // mean over all directions at wavenumber k of the surface itself
};

// Power spectral density over the wavenumber k = 2 pi/lambda, averaged over rings: the integral of Phi 2 pi k dk is the mean square
// height. Rings are one step 2 pi/max(Lx, Ly) wide, from that step to the shorter Nyquist wavenumber of both directions.
struct MeasuredSpectrum {
    std::vector<double> wavenumber;  // middle of the rings [1/length]
    std::vector<double> psd;         // [length^4]
    std::vector<double> modes;       // Fourier modes in the ring, mirror images included
    double independent = 0.5;        // share of independent amplitudes among them: half are mirror images, a window couples neighbours
    double coupled = 1;              // rings that tell the same, because the window couples them
    // The same by direction: at fewer rings, wider ones where there are many, and at kAngles angles, 0, 2.5, ... degrees from the x axis towards
    // the y axis (the other half plane is the mirror image). Near the origin a value is a mean over as many angles as the window blurs into
    // one: two modes along the circle.
    static constexpr std::size_t kAngles = 72;
    std::vector<double> plane_wavenumber;  // [1/length]
    std::vector<double> plane_psd;         // [ring][angle], [length^4]
    // The direction of the lay: at right angles to the direction with the most power, from the x axis, 0 to 180 [degree].
    double lay() const;
};

// A map that is not periodic is multiplied by a Hann window, whose loss of power is restored. No point may be missing.
// Throws Error(no_memory).
// With a lay the rings are ellipses of the stretched wavenumber of SelfAffineFit; plane_psd is then empty.
MeasuredSpectrum measure_spectrum(const HeightMap& map, double aspect = 1, double direction = 0);

// Least squares in the logarithms, a ring weighing as many modes as it has: a line of slope -2(1+hurst), -0.5 <= hurst <= 1.5, between kl
// and ks that holds a hundredth of the mean square height or more; below kl a constant at its height (plateau) or a line of its own (none); beyond ks another (noise, the window's leakage). Whether
// there is a kl or ks above the map's own, and which, is decided by the least residual with Bayes' penalty for each parameter; rings next to a
// break, which the window blurs, do not count. ks is then moved to where the spectrum falls to half of the line. Errors: of Phi0 and hurst by
// the residuals' scatter; of kl and ks by how far they may move before the residual grows by one variance, half a ring at least.
// At least 8 rings with psd > 0 are needed: Error(bad_input), unless can_fit.
SelfAffineFit fit_self_affine(const MeasuredSpectrum& spectrum);
bool can_fit(const MeasuredSpectrum& spectrum);

// ISO 25178-2: rms height Sq about the mean, skewness Ssk, kurtosis Sku (NaN of a flat map), rms gradient Sdq (first differences of neighbours).
struct HeightParameters {
    double sq = 0, ssk = 0, sku = 0, sdq = 0;
};
HeightParameters height_parameters(const HeightMap& map);

// The ratio of the rms slopes along the directions in which they are smallest and largest, 1 for an isotropic surface, towards 0 for
// grooves, and the direction of the smallest, from the x axis [rad]. From first differences.
struct Isotropy {
    double ratio = 1, direction = 0;
};
Isotropy isotropy(const HeightMap& map);

}  // namespace rsc
