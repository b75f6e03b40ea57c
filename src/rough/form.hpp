// The form of a measured map, which is subtracted from it, and the Gaussian filter.
#pragma once

#include "rough/surface.hpp"

namespace rsc {

enum class Detrend { none, mean, plane, quadratic, sphere };
inline constexpr std::array kDetrendNames = {"none", "mean", "plane", "quadratic", "sphere"};

// A fitted form, in coordinates from the middle of the map.
struct Form {
    Detrend how = Detrend::none;
    double level = 0;                 // height in the middle [length]
    double slope_x = 0, slope_y = 0;  // gradient there
    // Second derivatives zxx, zxy, zyy in the middle [1/length]; of a sphere -1/radius on the diagonal when it is level there.
    double zxx = 0, zxy = 0, zyy = 0;
    double radius = 0;  // of a sphere, positive for a dome, negative for a bowl [length]; 0 for other forms
    double rms = 0;     // rms height left, about its mean [length]
};

// Subtracts the least-squares form in place; points whose height is NaN are missing: they are not fitted and stay NaN. The plane
// and the quadratic are polynomials of first and second degree; the sphere is fitted in the vertical distance, centre and radius
// free, by the Gauss-Newton method from the paraboloid. Throws Error(bad_input) if the points present do not determine the form
// (none, all on one line, ...) or no sphere as wide as the map fits them; the map is then unchanged.
Form detrend(HeightMap& map, Detrend how);

// Transmission of a wave of length lambda = 2 pi/k: exp(-pi (alpha cutoff/lambda)^2), alpha = sqrt(ln 2/pi), one half at
// lambda = cutoff.
double gaussian_transmission(double cutoff, double k);

// Gaussian low-pass filter (ISO 16610-61) with nesting index `cutoff` > 0 [length], in place: shorter waves are removed. The map is continued beyond its
// edges by reflection (by its period if it is periodic: cosine and Fourier transforms). No point may be missing. Throws
// Error(bad_input) unless the cutoff is positive and finite, Error(no_memory).
void gaussian_filter(HeightMap& map, double cutoff);

}  // namespace rsc
