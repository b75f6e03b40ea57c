// Places where a map is not smooth from point to point: pits, spikes, steps. Polynomials through the points around them overshoot.
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
        double size = 0;  // of the largest: depth, height or jump [length]
    };
    std::array<Found, kKinds> found;  // by Kind
    std::vector<Place> pits;
    // Columns x rows of steps that run through most of the map, as the seams between stitched windows do; -1: none.
    int seam_column = -1, seam_row = -1;
    std::vector<std::uint8_t> clear;  // at j*nx + i, up to kMostClear: points to the nearest spike or step; empty: none anywhere
    static constexpr int kMostClear = 6;
};

// Second differences along x or along y of more than kBreak times their median are breaks. A pit is one point wide and has the largest second
// difference around, upwards; so has a spike, downwards, along both axes; all others are steps. Second differences of less than some
// steps of rounding (height_step; 0: not rounded) are none.
Breaks find_breaks(const HeightMap& map, double height_step);
inline constexpr double kBreak = 12;

// Raises pits to the polynomial through the points around them. Nothing touches their bottoms, and the summits beside them are then those
// of the surrounding surface.
void raise_pits(HeightMap& map, const Breaks& breaks);

}  // namespace rsc
