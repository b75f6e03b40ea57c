// Maps whose heights were rounded by the instrument or its file: plateaus have no summits, and second differences on them are the rounding's.
#pragma once

#include "rough/surface.hpp"

namespace rsc {

// The step of which all differences of neighbouring heights are multiples, where so many neighbours are equal that it matters; otherwise
// 0. Missing points (NaN) are left out. To be asked before a form is taken off.
double height_step(const HeightMap& map);

// Replaces the heights by a smooth surface within half a step of them, on which a plateau is the top of one summit: smoothing over the
// plateaus' width by a kernel that leaves paraboloids as they are, and going back to within half a step, in turn.
void smooth_within_step(HeightMap& map, double step);

}  // namespace rsc
