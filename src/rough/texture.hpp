// The texture of a height map: autocorrelation lengths along and across its lay, and the height distribution.
#pragma once

#include "rough/surface.hpp"

namespace rsc {

// Parameters of ISO 25178-2 (2012).
struct Texture {
    // Lags at which the autocorrelation first falls to 0.2, over all directions: the shortest (Sal) [length] and the shortest over the
    // longest (Str): 1 for an isotropic surface, towards 0 for grooves. str_bounded: along some direction it does not fall to 0.2 within half
    // the map; Str is then at most this. NaN for a flat map.
    double sal = 0, str = 0;
    bool str_bounded = false;
    // Heights of the core, the reduced peaks and the reduced valleys by the curve of Abbott and Firestone (ISO 13565-2) [length].
    double sk = 0, spk = 0, svk = 0;
    // Heights about their mean at normal scores, kScores of them from -5 to 5 in equal steps [length]: the distribution of the heights.
    static constexpr int kScores = 201;
    std::vector<double> score, height;
    // Autocorrelation in the middle of its plane: lags -reach ... reach times the steps, row by row.
    int reach_x = 0, reach_y = 0;
    double step_x = 0, step_y = 0;  // [length]
    std::vector<double> autocorrelation;
};

// No point may be missing. Throws Error(no_memory).
Texture measure_texture(const HeightMap& map);

}  // namespace rsc
