// The Gaussian filter of areal surface texture (ISO 16610-61).
#pragma once

#include "rough/surface.hpp"

namespace rsc {

// What the filter leaves of a wave of length lambda = 2 pi/k: exp(-pi (alpha cutoff/lambda)^2), alpha = sqrt(ln 2/pi), one half at
// lambda = cutoff.
double gaussian_transmission(double cutoff, double k);

// Low-pass filter with nesting index `cutoff` > 0 [length], in place: shorter waves are taken out. The map is continued beyond its
// edges by reflection (by its period if it is periodic: cosine and Fourier transforms). No point may be missing. Throws
// Error(bad_input) unless the cutoff is positive and finite, Error(no_memory).
void gaussian_filter(HeightMap& map, double cutoff);

}  // namespace rsc
