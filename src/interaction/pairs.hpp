// Direct sums over pairs, phi_i = sum_j f_j G_ij: products with the interaction matrix B (paper,
// section 4), which is not stored.
//
// The loops over 1/d (pairs_kernel.inl) are compiled for several instruction sets, and the best
// supported one is chosen at run time. With one instruction set the results are reproducible bit
// for bit. Coinciding points do not interact by 1/d; distances below 2^-60 of the largest extent
// are treated as 0.
#pragma once

#include "interaction/kernel.hpp"

namespace rsc {

// Points in the coordinates of the pair loops: double, or integers of 31 bits, whose differences
// are exact, for sums in single precision.
template <class Coordinate>
struct PairPoints {
    double x0 = 0, y0 = 0, scale = 1;  // origin, and coordinate units per length
    std::vector<Coordinate> x, y;      // padded by the last point
};

// Sums from a set of sources onto the sources themselves or onto other targets. The kernel must
// outlive this object. A const object can be used by several threads at once.
//
// Sums in full accuracy are exact to a few units in the last place of sum_j |f_j G_ij|. With
// `single` an error of 1e-6 of this sum is sufficient: 1/d is summed in single precision, where a
// pair has an additional relative error of (extent / d) 2^-31, and sums among the sources must be
// within the range of float.
class PairSums {
public:
    explicit PairSums(const Kernel& kernel) : kernel_(&kernel) {}

    // Sets n sources and reuses the memory. Throws Error(bad_input) unless coordinates are finite.
    void assign(std::size_t n, const double* x, const double* y);
    // phi[i] = sum_j f[j] G_ij at the sources, including the self term; f and phi must not overlap.
    // Every 1/d is used in both directions.
    void among(bool single, const double* f, double* phi) const;
    // Sum at n other targets. Throws Error(bad_input) unless coordinates are finite.
    void onto(bool single, std::size_t n, const double* x, const double* y, const double* f,
              double* phi) const;

    // True if there is a faster sum in single precision (no periodic images).
    bool has_single() const { return !kernel_->lattice(); }

private:
    void scale_and_add(std::size_t n, const double* x, const double* y, const double* f,
                       double* phi) const;

    const Kernel* kernel_;
    std::vector<double> x_, y_;
    PairPoints<double> exact_;
    PairPoints<std::int32_t> rough_;
};

}  // namespace rsc
