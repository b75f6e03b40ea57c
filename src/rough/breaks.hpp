// Breaks: places where a map is not smooth on the scale of its grid (pits, spikes, steps). Interpolating polynomials overshoot there.
#pragma once

#include "rough/surface.hpp"

namespace rsc {

struct Breaks {
    enum Kind { pit, spike, step, kKinds };
    struct Place {
        int i = 0, j = 0;
        bool along_x = true;  // a pit (or groove) in the profile along x, otherwise along y
    };
    struct Found {
        long points = 0;
        Place largest;
        double size = 0;  // depth, height or jump of the largest [length]
    };
    std::array<Found, kKinds> found;  // by Kind
    std::vector<Place> pits, spikes;
    // Column and row of a step that runs through most of the map, such as a seam between stitched windows; -1: none.
    int seam_column = -1, seam_row = -1;
    std::vector<std::uint8_t> clear;  // distance to the nearest spike or step in points, at most kMostClear, at j*nx + i; empty: none
    static constexpr int kMostClear = 6;
};

// A point is a break if its second difference along x or y exceeds kBreak times the median. A pit has a positive second difference larger
// than those of both neighbours, a spike a negative one along both axes; all other breaks are steps. Second differences below a few
// multiples of the rounding step `height_step` (0: heights are not rounded) are ignored.
Breaks find_breaks(const HeightMap& map, double height_step);
inline constexpr double kBreak = 12;

// Raises pits to the polynomial through their neighbours. Their bottoms never touch, and they would distort the summits beside them.
void raise_pits(HeightMap& map, const Breaks& breaks);

}  // namespace rsc
