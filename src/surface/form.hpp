// Removal of form from a measured map, and the Gaussian filter.
#pragma once

#include "surface/surface.hpp"

namespace rsc {

enum class Detrend { none, mean, plane, quadratic, sphere };
inline constexpr std::array kDetrendNames = {"none", "mean", "plane", "quadratic", "sphere"};

// A fitted form, in coordinates from the middle of the map.
struct Form {
    Detrend how = Detrend::none;
    double level = 0;                 // height in the middle [length]
    double slope_x = 0, slope_y = 0;  // gradient there
    // Second derivatives zxx, zxy, zyy in the middle [1/length]; for a sphere that is level there
    // zxx = zyy = -1/radius.
    double zxx = 0, zxy = 0, zyy = 0;
    // of a sphere [length], positive for a dome, negative for a bowl; 0 for other forms
    double radius = 0;
    double rms = 0;  // rms height of the residual, about its mean [length]
};

// Of a profile, a map of one row: a line, a parabola or an arc.
// Subtracts the least-squares form in place; missing points (NaN) are ignored and stay NaN. The
// plane and the quadratic are polynomials of first and second degree. Centre and radius of the
// sphere minimise the squared vertical distances, by the Gauss-Newton method starting from the
// paraboloid. Throws Error(bad_input) and leaves the map unchanged if the points do not determine
// the form (none, all on one line, ...) or no sphere as wide as the map fits.
Form detrend(HeightMap& map, Detrend how);

// Transmission of a wave of length lambda = 2 pi/k: exp(-pi (alpha cutoff/lambda)^2) with alpha =
// sqrt(ln 2/pi); 1/2 at lambda = cutoff.
double gaussian_transmission(double cutoff, double k);

// Gaussian low-pass filter (ISO 16610-61) with nesting index `cutoff` > 0 [length], in place. The
// map is continued beyond its edges by reflection, or periodically if it is periodic. No point may
// be missing. Throws Error(bad_input) unless the cutoff is positive and finite, Error(no_memory).
void gaussian_filter(HeightMap& map, double cutoff);

}  // namespace rsc
