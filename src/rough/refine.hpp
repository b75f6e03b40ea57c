// From a maximum of the grid to the summit between its points.
#pragma once

#include "rough/detection.hpp"
#include "rough/stencil.hpp"

namespace rsc {

// Heights around a grid point, which is the middle of the patch.
struct Patch {
    static constexpr int kTravel = 3;  // grid steps a summit may lie from the grid's maximum
    static constexpr int kMargin = Stencil::kMostReach + kTravel;
    static constexpr int kSide = 2 * kMargin + 2;
    static constexpr int kStride = 2 * kMargin + Stencil::kTaps;  // a stencil's padding reads beyond the last point
    alignas(64) double z[kSide][kStride] = {};
    // Grid points, counted from the middle, at which the stencil's middle point may lie.
    int first_x = -kTravel, last_x = kTravel, first_y = -kTravel, last_y = kTravel;
};

// A summit and its neighbourhood; everything in grid steps, (x, y) from the middle of the patch.
struct RefinedSummit {
    double x = 0, y = 0, z = 0;
    double zxx = 0, zxy = 0, zyy = 0;
    double zxxxx = 0, zxxxy = 0, zxxyy = 0, zxyyy = 0, zyyyy = 0;
};

// A body above as a patch sees it: its middle is at (x, y), its steps are dx and dy.
struct PatchAbove {
    const BodyAbove* above = nullptr;
    double x = 0, y = 0, dx = 1, dy = 1;
};

// Climbs from the middle of the patch to the summit by Newton's method on grad z = 0, steps not longer than a grid step, uphill
// where the surface is no peak. Nothing if there is no summit within `travel` grid steps: the maximum is one of the grid alone.
// With a body above it is the summit of the patch less its face; the fourth derivatives are then those of the patch alone.
std::optional<RefinedSummit> refine(const Stencil& stencil, const Patch& patch, int travel = Patch::kTravel, const PatchAbove& less = {});

}  // namespace rsc
