// Sums over pairs of G less its factor near(), one by one: 1/d, or Gamma and the shift where everything repeats.
#pragma once

#include <vector>

#include "contact/interaction/lattice.hpp"
#include "contact/interaction/pairs.hpp"

namespace rsc {

// Sources that are targets, too, and other targets. The lattice, null where nothing repeats, must outlive it.
class PairSums {
public:
    explicit PairSums(const Lattice* lattice = nullptr) : lattice_(lattice) {}

    void assign(std::size_t n, const double* x, const double* y);
    // phi[i] = sum_j f[j] G_ij/near(), what a source does to itself included, in full accuracy.
    void apply(const double* f, double* phi) const;
    // The same at other targets; `single`: 1e-6 will do.
    void onto(bool single, std::size_t n, const double* x, const double* y, const double* f, double* phi) const;

    // Without images there is a faster sum in single precision, over the sources.
    bool has_single() const { return !lattice_; }
    void apply_single(const float* f, float* phi) const { set_.apply_single(f, phi); }

private:
    const Lattice* lattice_;
    PairSet set_;
    std::vector<double> x_, y_;
};

}  // namespace rsc
