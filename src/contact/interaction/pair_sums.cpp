#include "contact/interaction/pair_sums.hpp"

namespace rsc {

void PairSums::assign(std::size_t n, const double* x, const double* y) {
    if (!lattice_) set_.assign(n, x, y);
    x_.assign(x, x + n);
    y_.assign(y, y + n);
}

void PairSums::apply(const double* f, double* phi) const {
    if (lattice_)
        onto(false, x_.size(), x_.data(), y_.data(), f, phi);
    else
        set_.apply(f, phi);
}

void PairSums::onto(bool single, std::size_t n, const double* x, const double* y, const double* f, double* phi) const {
    if (!lattice_) {
        const auto sums = single ? pair_potential_single : pair_potential;
        sums(n, x, y, x_.size(), x_.data(), y_.data(), f, phi);
        return;
    }
    lattice_->potential(n, x, y, x_.size(), x_.data(), y_.data(), f, phi);
    double total = 0;
    for (std::size_t k = 0; k < x_.size(); ++k) total += f[k];
    for (std::size_t k = 0; k < n; ++k) phi[k] -= lattice_->least() * total;
}

}  // namespace rsc
