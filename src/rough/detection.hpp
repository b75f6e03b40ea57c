// Finding asperities: the summits of a height map, or of its difference from a body above it (paper, section 3).
#pragma once

#include "rough/asperities.hpp"
#include "rough/breaks.hpp"
#include "rough/surface.hpp"

namespace rsc {

// The face of the body above a surface, which is subtracted before summits are looked for: only the difference decides
// what touches.
class BodyAbove {
public:
    // Height, derivatives and nabla^4 at a place.
    struct Form {
        double height = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, biharmonic = 0;
    };
    virtual ~BodyAbove() = default;
    // Heights at the places (x0 + k dx, y), k = 0 ... n-1; Infinity where there is none. The face does not repeat, whatever the surface does,
    // unless periodic().
    virtual void row(int n, double x0, double dx, double y, double* height) const = 0;
    virtual Form at(double x, double y) const = 0;
    virtual bool periodic() const = 0;
};

// How a summit is located.
enum class Detail {
    grid,     // the grid point and second differences (the paper): enough for Hertz asperities
    subgrid,  // the summit between the points, its derivatives by long stencils, the biharmonic with them
};

// Counts of a search for summits.
struct SummitCount {
    long summits = 0;         // asperities kept
    long saddles = 0;         // grid maxima that are no summits: saddles by their curvatures, or none in reach; not kept
    long repeated = 0;        // Detail::subgrid: grid maxima that lead to a summit which another one leads to; not kept
    double mean_kappa_g = 0;  // mean of the geometric mean curvature [1/length]
    double mean_kappa_a = 0;  // mean of the algebraic mean curvature [1/length]
};

// Summits: grid points strictly above their 8 neighbours. Curvatures from second differences. Periodic maps wrap around,
// others give interior points only. Order: row by row (y, then x). x, y are those of the grid point; radius = 1/kappa_g or
// 1/kappa_a. Neither the result nor the means depend on `threads`, to the last bit.
//
// Detail::subgrid: the summits of the surface that Newton's method reaches from those points and from those whose second differences
// indicate one within a step, in the order of these points; periodic x, y lie in the map. points_per_wave >= 4 says that the map
// holds no wave shorter than so many grid steps (Error(bad_input) for less): errors are then some 1e-8 of the derivatives' rms
// values, and a summit is the same on every grid that finds it; one beside a higher one may be missed (one in 170 with 4 points in
// lambda_s, one in some thousands with 8). 0: not known, for measured maps; Lagrange polynomials through
// kMeasuredReach points on either side, whose rms errors on self-affine surfaces with 4, 6, 8, 16 points in the shortest wave are
// 1e-3, 2e-5, 8e-7, 5e-10 of the curvatures' and 6e-3, 2e-4, 2e-5, 5e-8 of the biharmonic's rms values at summits; noise in the heights comes
// on top. Near the border of a map that is not periodic, and near breaks (whose pits were raised), they go through fewer points.
//
// With a body above (Detail::subgrid only) the summits are those of the difference, map less its face: x, y is their place, z the height of
// the surface there, curvatures and biharmonic are the difference's. On a surface with a lay the biharmonic is that of
// the round profile that flattens like the elongated summit (Asperities::biharmonic). Under one that does not repeat, on a periodic map, those within
// the map.
Asperities find_asperities(const HeightMap& map, Curvature curvature, SummitCount* count = nullptr, int threads = 1,
                           Detail detail = Detail::grid, double points_per_wave = 0, const BodyAbove* above = nullptr,
                           const Breaks* breaks = nullptr);
inline constexpr int kMeasuredReach = 6;

// The asperities of a synthetic surface, found while it is being made: the same as find_asperities(synthesize(...)), bit
// for bit, in less time, and in half the memory of the surface, which is never stored. Errors as synthesize().
// Detail::subgrid on fewer than 4 points in lambda_s works on the next multiple of n that has them: the surface is the same on
// both. `differences` (optional) receives the moments that finite differences on the n x n grid give, exact sums over the modes:
// those of grid_moments(synthesize(...)).
Asperities make_asperities(const Spectrum& spectrum, int n, Normalise normalise, std::int64_t seed, std::int64_t realization,
                           Curvature curvature, SummitCount* count = nullptr, Moments* sampled = nullptr, int threads = 1,
                           Detail detail = Detail::grid, Moments* differences = nullptr, const BodyAbove* above = nullptr);

}  // namespace rsc
