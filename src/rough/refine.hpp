// Refinement of a grid maximum to the summit between grid points.
#pragma once

#include "rough/detection.hpp"
#include "rough/stencil.hpp"

namespace rsc {

// Heights around a grid point, the middle of the patch.
struct Patch {
    static constexpr int kTravel = 3;  // largest distance of a summit from the grid maximum [grid steps]
    static constexpr int kMargin = Stencil::kMostReach + kTravel;
    static constexpr int kSide = 2 * kMargin + 2;
    static constexpr int kStride = 2 * kMargin + Stencil::kTaps;  // a stencil's padding reads beyond the last point
    alignas(64) double z[kSide][kStride] = {};
    // Range of grid points, counted from the middle, at which the stencil may be centred.
    int first_x = -kTravel, last_x = kTravel, first_y = -kTravel, last_y = kTravel;
};

// A summit and its derivatives, in units of grid steps; (x, y) is counted from the middle of the patch.
struct RefinedSummit {
    double x = 0, y = 0, z = 0;
    double zxx = 0, zxy = 0, zyy = 0;
    double zxxxx = 0, zxxxy = 0, zxxyy = 0, zxyyy = 0, zyyyy = 0;
};

// A body above a patch with its middle at (x, y) and grid steps dx and dy.
struct PatchAbove {
    const BodyAbove* above = nullptr;
    double x = 0, y = 0, dx = 1, dy = 1;
};

// Climbs from the middle of the patch to the summit by Newton's method on grad z = 0, with steps of at most one grid step, uphill where the
// surface is not concave. Returns nothing if there is no summit within `travel` grid steps. With a body above, it climbs on the patch minus
// the body's face; the fourth derivatives are those of the patch alone.
std::optional<RefinedSummit> refine(const Stencil& stencil, const Patch& patch, int travel = Patch::kTravel, const PatchAbove& less = {});

}  // namespace rsc
