// Sums over pairs of a kernel's G, one by one.
#pragma once

#include "contact/interaction/kernel.hpp"
#include "contact/interaction/pairs.hpp"

namespace rsc {

// Sources that are targets, too, and other targets. The kernel must outlive it.
class PairSums {
public:
    explicit PairSums(const Kernel& kernel) : kernel_(&kernel) {}

    void assign(std::size_t n, const double* x, const double* y);
    std::size_t size() const { return x_.size(); }
    // phi[i] = sum_j f[j] G_ij, what a source does to itself included, in full accuracy.
    void apply(const double* f, double* phi) const;
    // The same to 1e-6, where has_single().
    void apply_single(const double* f, double* phi) const;
    // The same at other targets; `single`: 1e-6 will do.
    void onto(bool single, std::size_t n, const double* x, const double* y, const double* f, double* phi) const;

    // Without images there is a faster sum in single precision, over the sources.
    bool has_single() const { return !kernel_->lattice(); }

private:
    void scale_and_add(std::size_t n, const double* x, const double* y, const double* f, double* phi) const;

    const Kernel* kernel_;
    PairSet set_;
    std::vector<double> x_, y_;
};

}  // namespace rsc
