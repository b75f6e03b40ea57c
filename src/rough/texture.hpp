// Texture of a height map: autocorrelation lengths along and across its lay, and the height distribution.
#pragma once

#include "rough/surface.hpp"

namespace rsc {

// Parameters of ISO 25178-2 (2012).
struct Texture {
    // Sal [length]: shortest lag over all directions at which the autocorrelation falls to 0.2. Str: ratio of the shortest to the longest
    // such lag, 1 for an isotropic surface, near 0 for grooves. str_bounded: the autocorrelation stays above 0.2 within half the map along
    // some direction, and `str` is an upper bound. NaN for a flat map.
    double sal = 0, str = 0;
    bool str_bounded = false;
    // Heights of the core, the reduced peaks and the reduced valleys from the Abbott-Firestone curve (ISO 13565-2) [length].
    double sk = 0, spk = 0, svk = 0;
    // Height distribution: heights about their mean [length] at kScores equally spaced normal scores from -5 to 5.
    static constexpr int kScores = 201;
    std::vector<double> score, height;
    // Autocorrelation at the lags -reach ... reach, times the steps, row by row.
    int reach_x = 0, reach_y = 0;
    double step_x = 0, step_y = 0;  // [length]
    std::vector<double> autocorrelation;
};

// No point may be missing. Throws Error(no_memory).
Texture measure_texture(const HeightMap& map);

}  // namespace rsc
