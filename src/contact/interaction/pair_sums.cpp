#include "contact/interaction/pair_sums.hpp"

namespace rsc {

void PairSums::assign(std::size_t n, const double* x, const double* y) {
    if (!kernel_->lattice()) set_.assign(n, x, y);
    x_.assign(x, x + n);
    y_.assign(y, y + n);
}

// Converts sums of f/d to sums of f G.
void PairSums::scale_and_add(std::size_t n, const double* x, const double* y, const double* f, double* phi) const {
    const double near = kernel_->near();
    for (std::size_t k = 0; k < n; ++k) phi[k] *= near;
    const SmoothPart* const smooth = kernel_->smooth();
    if (!smooth) return;
    smooth->table().add(n, x, y, x_.size(), x_.data(), y_.data(), f, phi);
    if (const double shift = kernel_->shift(); shift > 0) {
        double total = 0;
        for (std::size_t k = 0; k < x_.size(); ++k) total += f[k];
        for (std::size_t k = 0; k < n; ++k) phi[k] += shift * total;
    }
}

void PairSums::apply(const double* f, double* phi) const {
    if (kernel_->none()) {
        for (std::size_t k = 0; k < x_.size(); ++k) phi[k] = kernel_->self() * f[k];
    } else if (kernel_->lattice()) {
        onto(false, x_.size(), x_.data(), y_.data(), f, phi);
    } else {
        set_.apply(f, phi);
        scale_and_add(x_.size(), x_.data(), y_.data(), f, phi);
    }
}

void PairSums::apply_single(const double* f, double* phi) const {
    if (kernel_->none()) return apply(f, phi);
    const std::size_t n = x_.size();
    static thread_local std::vector<float> force, sum;
    // Forces are scaled to order one, because they might underflow in single precision in the user's units.
    double largest = 0;
    for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, std::abs(f[k]));
    const double unit = largest > 0 ? largest : 1.0;
    force.resize(n);
    sum.resize(n);
    for (std::size_t k = 0; k < n; ++k) force[k] = static_cast<float>(f[k] / unit);
    set_.apply_single(force.data(), sum.data());
    for (std::size_t k = 0; k < n; ++k) phi[k] = unit * static_cast<double>(sum[k]);
    scale_and_add(n, x_.data(), y_.data(), f, phi);
}

void PairSums::onto(bool single, std::size_t n, const double* x, const double* y, const double* f, double* phi) const {
    if (kernel_->none()) {
        std::fill_n(phi, n, 0.0);
    } else if (const Lattice* lattice = kernel_->lattice()) {
        lattice->potential(n, x, y, x_.size(), x_.data(), y_.data(), f, phi);
        double total = 0;
        for (std::size_t k = 0; k < x_.size(); ++k) total += f[k];
        for (std::size_t k = 0; k < n; ++k) phi[k] = kernel_->near() * (phi[k] - lattice->least() * total);
    } else {
        const auto sums = single ? pair_potential_single : pair_potential;
        sums(n, x, y, x_.size(), x_.data(), y_.data(), f, phi);
        scale_and_add(n, x, y, f, phi);
    }
}

}  // namespace rsc
