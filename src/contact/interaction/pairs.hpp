// Direct sums over pairs, phi_i = sum_{j, d_ij > 0} f_j / d_ij: the product with the interaction matrix B (paper, section 4)
// without storing it. The factor 1/(pi E*) is the caller's. d_ij is the distance in the plane; points that coincide do not act on
// each other.
//
// The loops exist once (pairs_kernel.inl) and are compiled for several instruction sets; the best one the machine has is chosen
// at run time. Within one instruction set the results are reproducible bit by bit. Distances below 2^-60 of the largest extent
// count as 0.
#pragma once

#include "std.hpp"

namespace rsc {

// phi[i] = sum_j fs[j] / |target i - source j|, i < n_targets, to a few units of the last place of sum_j |fs[j]| / d_ij.
// Coordinates must be finite: Error(bad_input) otherwise. phi may not overlap the other arrays.
void pair_potential(std::size_t n_targets, const double* xt, const double* yt, std::size_t n_sources, const double* xs, const double* ys,
                    const double* fs, double* phi);

// The same with a loop in single precision: relative error about 1e-6 of sum_j |fs[j]| / d_ij. Coordinates become 31-bit integers
// spanning the points, whose differences are exact; a pair closer than 2^-11 of the extent loses digits, (extent / d) 2^-31 of
// its own term.
void pair_potential_single(std::size_t n_targets, const double* xt, const double* yt, std::size_t n_sources, const double* xs,
                           const double* ys, const double* fs, double* phi);

// Points that are sources and targets at once, for products taken again and again: every 1/d is computed once and used both ways.
// A const object may be used by several threads at once.
class PairSet {
public:
    // Takes n points (finite coordinates, Error(bad_input) otherwise). Reuses its memory.
    void assign(std::size_t n, const double* x, const double* y);
    std::size_t size() const { return n_; }
    // phi[i] = sum_{j, d_ij > 0} f[j] / d_ij with f and phi of size() entries that do not overlap; accuracies as above.
    void apply(const double* f, double* phi) const;
    // Single precision takes any unit of length and force as long as f and phi themselves are within the range of float.
    void apply_single(const float* f, float* phi) const;

private:
    std::size_t n_ = 0;
    double scale_ = 1, fixed_scale_ = 1;           // coordinate units per length
    std::vector<double> x_, y_;                    // scaled, padded
    std::vector<std::int32_t> x_fixed_, y_fixed_;  // fixed point, padded
};

// The instruction set in use: "avx512", "avx2", "sse2" or "generic".
const char* pair_instruction_set();

}  // namespace rsc
