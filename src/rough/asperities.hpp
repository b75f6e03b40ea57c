// Asperities: the summits of a height map with their curvatures (paper, section 3).
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "rough/surface.hpp"

namespace rsc {

enum class Curvature { geometric, algebraic };

// Structure of arrays, one entry an asperity. x, y, z [length] and radius [length] are always there; the rest is empty when
// the asperities were given without curvatures.
struct Asperities {
    std::vector<double> x, y, z, radius;
    std::vector<double> kappa1, kappa2;  // principal curvatures, kappa1 >= kappa2 > 0 [1/length]
    std::vector<double> angle;  // direction of the kappa2 axis (the long axis of the contact ellipse) from x, in (-pi/2, pi/2]
    std::vector<double> biharmonic;  // nabla^4 z at the summit [1/length^3]; empty unless a law needs it
    std::size_t size() const { return x.size(); }
};

// Asperities that come from outside: throws Error(bad_input) unless there is at least one, all arrays that are not empty have
// one length (kappa1, kappa2 and angle together), all values are finite, radii positive, kappa1 >= kappa2 > 0 and no two lie at
// the same (x, y). `name(i)` says in the message which one is meant.
void validate(const Asperities& asperities, const std::function<std::string(std::size_t)>& name);

// What was counted on the way.
struct SummitCount {
    long summits = 0;         // asperities kept
    long saddles = 0;         // grid maxima whose curvatures make them saddles: counted, not kept
    double mean_kappa_g = 0;  // mean of the geometric mean curvature [1/length]
    double mean_kappa_a = 0;  // mean of the algebraic mean curvature [1/length]
};

// Summits: grid points strictly above their 8 neighbours. Curvatures from second differences. Periodic maps wrap around,
// others give interior points only. Order: row by row (y, then x). x, y are those of the grid point; radius = 1/kappa_g or
// 1/kappa_a. Neither the result nor the means depend on `threads`, to the last bit.
Asperities find_asperities(const HeightMap& map, Curvature curvature, SummitCount* count = nullptr, int threads = 1);

// The asperities of a synthetic surface, found while it is being made: the very same as find_asperities(synthesize(...)), bit
// for bit, in less time, and in half the memory of the surface, which is never stored. Errors as synthesize().
Asperities make_asperities(const Spectrum& spectrum, int n, Normalise normalise, std::int64_t seed, std::int64_t realization,
                           Curvature curvature, SummitCount* count = nullptr, Moments* sampled = nullptr, int threads = 1);

}  // namespace rsc
