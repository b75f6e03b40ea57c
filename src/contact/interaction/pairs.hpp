// Direct sums over pairs, phi_i = sum_{j, d_ij > 0} f_j / d_ij: products with the interaction matrix B (paper, section 4), which is not
// stored, without its factor 1/(pi E*). d_ij is the distance in the plane; coinciding points do not interact.
//
// The loops (pairs_kernel.inl) are compiled for several instruction sets, and the best supported one is chosen at run time. With one
// instruction set the results are reproducible bit for bit. Distances below 2^-60 of the largest extent are treated as 0.
#pragma once

#include "std.hpp"

namespace rsc {

// phi[i] = sum_j fs[j] / |target i - source j|, i < n_targets, to a few units in the last place of sum_j |fs[j]| / d_ij. Throws
// Error(bad_input) unless coordinates are finite. phi must not overlap the other arrays.
void pair_potential(std::size_t n_targets, const double* xt, const double* yt, std::size_t n_sources, const double* xs, const double* ys,
                    const double* fs, double* phi);

// As pair_potential(), in single precision: the error is about 1e-6 of sum_j |fs[j]| / d_ij. Coordinates are converted to 31-bit integers,
// whose differences are exact; the term of a pair has an additional relative error of (extent / d) 2^-31.
void pair_potential_single(std::size_t n_targets, const double* xt, const double* yt, std::size_t n_sources, const double* xs,
                           const double* ys, const double* fs, double* phi);

// Points that are both sources and targets, for repeated products: every 1/d is computed once and used in both directions. A const object
// can be used by several threads at once.
class PairSet {
public:
    // Sets n points and reuses the memory. Throws Error(bad_input) unless coordinates are finite.
    void assign(std::size_t n, const double* x, const double* y);
    std::size_t size() const { return n_; }
    // phi[i] = sum_{j, d_ij > 0} f[j] / d_ij for size() entries, f and phi not overlapping; accuracies as above.
    void apply(const double* f, double* phi) const;
    // Any units of length and force are possible as long as f and phi are within the range of float.
    void apply_single(const float* f, float* phi) const;

private:
    std::size_t n_ = 0;
    double scale_ = 1, fixed_scale_ = 1;           // coordinate units per length
    std::vector<double> x_, y_;                    // scaled, padded
    std::vector<std::int32_t> x_fixed_, y_fixed_;  // fixed point, padded
};

// Instruction set in use: "avx512", "avx2", "sse2" or "generic".
const char* pair_instruction_set();

}  // namespace rsc
