// Detection of asperities: the summits of a height map (paper, section 3).
#pragma once

#include "surface/asperities.hpp"
#include "surface/defects.hpp"
#include "surface/surface.hpp"

namespace rsc {

class RowSource;

// Method by which a summit is located.
enum class Detail {
    grid,     // grid point and second differences, as in the paper; enough for Hertz asperities
    subgrid,  // summit between the grid points; derivatives and biharmonic by long stencils
};

// Counts and means of a search for summits.
struct SummitCount {
    long summits = 0;  // asperities found
    long saddles = 0;  // grid maxima left out: saddles by their curvatures, or no summit in reach
    // Detail::subgrid: grid maxima left out because another one leads to the same summit
    long repeated = 0;
    double mean_kappa_g = 0;  // mean of the geometric mean curvature [1/length]
    double mean_kappa_a = 0;  // mean of the algebraic mean curvature [1/length]
};

// Detail::grid: summits are grid points strictly above their 8 neighbours, with curvatures from
// second differences. Maps that are not periodic have no summits at their edges. Summits are
// ordered by row (y, then x); radius = 1/kappa_g or 1/kappa_a. The result is independent of
// `threads`, bit for bit.
//
// Detail::subgrid: Newton's method climbs to the summits from those grid points, and from points
// whose second differences indicate a summit within one step. Summits are ordered by these points;
// x, y of periodic maps lie in the map. points_per_wave >= 4 states that the map holds no wave
// shorter than this many grid steps (Error(bad_input) for less). Errors are then about 1e-8 of the
// rms values of the derivatives, and a summit has the same values on every grid on which it is
// found; a summit beside a higher one may be missed (one in 170 with 4 points in lambda_s, one in
// some thousands with 8). 0 means unknown, for measured maps: Lagrange polynomials through
// kMeasuredReach points on either side. On self-affine surfaces with 4, 6, 8, 16 points in the
// shortest wave their rms errors at summits are 1e-3, 2e-5, 8e-7, 5e-10 of the rms curvature and
// 6e-3, 2e-4, 2e-5, 5e-8 of the rms biharmonic, plus the effect of noise in the heights. Fewer
// points are used near the border of a map that is not periodic and near breaks (pits have been
// raised before).
//
// With a lay, the biharmonic is the one described at Asperities::biharmonic.
Asperities find_asperities(const HeightMap& map, Curvature curvature, SummitCount* count = nullptr,
                           int threads = 1, Detail detail = Detail::grid,
                           double points_per_wave = 0, const Breaks* breaks = nullptr);
inline constexpr int kMeasuredReach = 6;

// Points along a side of the grid on which summits between the points are found: n, or its smallest
// multiple with 4 points in lambda_s.
int summit_points(const Spectrum& spectrum, int n);

// Asperities of a synthetic surface, detected during synthesis without storing the surface: faster
// than find_asperities(synthesize(...)), in half the memory, with bitwise the same result (with a
// lay nearer to the y axis: that of the transposed surface). Throws as synthesize(). With
// fewer than 4 points in lambda_s, Detail::subgrid uses the smallest multiple of n that has 4; the
// surface is the same.
// `differences` (optional) receives the moments by finite differences on the n x n grid, as
// grid_moments(synthesize(...)), computed as exact sums over the modes.
Asperities make_asperities(const Spectrum& spectrum, int n, Normalise normalise, std::int64_t seed,
                           std::int64_t realization, Curvature curvature,
                           SummitCount* count = nullptr, Moments* sampled = nullptr,
                           int threads = 1, Detail detail = Detail::grid,
                           Moments* differences = nullptr);

}  // namespace rsc
