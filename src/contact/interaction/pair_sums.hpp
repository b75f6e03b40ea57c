// Direct sums of a kernel's G over pairs.
#pragma once

#include "contact/interaction/kernel.hpp"
#include "contact/interaction/pairs.hpp"

namespace rsc {

// Sums from a set of sources onto the sources themselves or onto other targets. The kernel must outlive this object.
class PairSums {
public:
    explicit PairSums(const Kernel& kernel) : kernel_(&kernel) {}

    void assign(std::size_t n, const double* x, const double* y);
    std::size_t size() const { return x_.size(); }
    // phi[i] = sum_j f[j] G_ij, including the self term, in full accuracy.
    void apply(const double* f, double* phi) const;
    // As apply(), to 1e-6; only if has_single().
    void apply_single(const double* f, double* phi) const;
    // Sum at other targets; `single`: an error of 1e-6 is sufficient.
    void onto(bool single, std::size_t n, const double* x, const double* y, const double* f, double* phi) const;

    // True if there is a faster single-precision sum over the sources (no periodic images).
    bool has_single() const { return !kernel_->lattice(); }

private:
    void scale_and_add(std::size_t n, const double* x, const double* y, const double* f, double* phi) const;

    const Kernel* kernel_;
    PairSet set_;
    std::vector<double> x_, y_;
};

}  // namespace rsc
