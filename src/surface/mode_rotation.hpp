// Loops over heights and batches of modes, for reshape_heights(); compiled for several instruction
// sets.
#pragma once

#include "base/std.hpp"

namespace rsc {

inline constexpr int kRotatedModes = 256;  // of a batch

// Adds the squares, cubes and fourth powers of `count` numbers, a multiple of 16, to three sums.
void add_powers(const float* z, std::ptrdiff_t count, double* total);

// Tangents and cosines of the angles by which a change p x + q y across a batch of modes rotates
// them; inverse: of their squared amplitudes.
void rotation_angles(const float* x, const float* y, const float* inverse, float p, float q,
                     float* tangent, float* cosine);

// Adds up, over a batch of modes rotated by these angles, the changes x and y across them in
// products, and the losses of u and v along them.
void add_rotated(const float* x, const float* y, const float* u, const float* v,
                 const float* inverse, float p, float q, double* total);

}  // namespace rsc
