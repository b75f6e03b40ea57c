#include <algorithm>
#include <cmath>

#include "contact/interaction/pair_sums.hpp"
#include "contact/interaction/products.hpp"

namespace rsc {
namespace {

class Direct final : public Products {
public:
    explicit Direct(std::shared_ptr<const Kernel> kernel)
        : Products(std::move(kernel)), scale_(kernel_->near()), sums_(kernel_->lattice()) {}

    void set_points(int n, const double* x, const double* y) override {
        x_.assign(x, x + n);
        y_.assign(y, y + n);
        fresh_ = true;
    }

    void set_active(const std::vector<int>& active) override {
        if (!fresh_ && active == active_) return;
        fresh_ = false;
        active_ = active;
        gather(active_, xa_, ya_);
        sums_.assign(active_.size(), xa_.data(), ya_.data());
        complement(static_cast<int>(x_.size()));
        gather(passive_, xp_, yp_);
        passive_phi_.resize(passive_.size());
    }

    void set_precise(bool precise) override { precise_ = precise; }

    void inner(const double* f, double* phi) override {
        ++count_;
        if (scale_ == 0) {
            std::fill(phi, phi + active_.size(), 0.0);
            return;
        }
        if (precise_ || !sums_.has_single()) {
            active_full(f, phi);
            return;
        }
        const std::size_t n = active_.size();
        // Forces are scaled to order one: in single precision they might underflow in the user's units.
        double largest = 0;
        for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, std::abs(f[k]));
        const double unit = largest > 0 ? largest : 1.0;
        f_single_.resize(n);
        phi_single_.resize(n);
        for (std::size_t k = 0; k < n; ++k) f_single_[k] = static_cast<float>(f[k] / unit);
        sums_.apply_single(f_single_.data(), phi_single_.data());
        for (std::size_t k = 0; k < n; ++k) phi[k] = scale_ * unit * static_cast<double>(phi_single_[k]);
    }

    void inner_passive(const double* f, double* phi) override {
        if (scale_ == 0) {
            std::fill(phi, phi + passive_.size(), 0.0);
            return;
        }
        sums_.onto(!precise_, passive_.size(), xp_.data(), yp_.data(), f, phi);
        for (std::size_t k = 0; k < passive_.size(); ++k) phi[k] *= scale_;
    }

    void elsewhere(const double* f, int n, const double* x, const double* y, double* phi) override {
        if (scale_ == 0) {
            std::fill(phi, phi + n, 0.0);
            return;
        }
        sums_.onto(true, static_cast<std::size_t>(n), x, y, f, phi);
        for (int k = 0; k < n; ++k) phi[k] *= scale_;
    }

    void full(const double* f, double* phi) override {
        ++count_;
        if (scale_ == 0) {
            std::fill(phi, phi + x_.size(), 0.0);
            return;
        }
        active_phi_.resize(active_.size());
        active_full(f, active_phi_.data());
        sums_.onto(false, passive_.size(), xp_.data(), yp_.data(), f, passive_phi_.data());
        for (std::size_t k = 0; k < active_.size(); ++k) phi[active_[k]] = active_phi_[k];
        for (std::size_t k = 0; k < passive_.size(); ++k) phi[passive_[k]] = scale_ * passive_phi_[k];
    }

    double full_error() const override { return 1e-14; }
    double inner_error() const override { return sums_.has_single() ? 1e-6 : full_error(); }

private:
    void gather(const std::vector<int>& which, std::vector<double>& x, std::vector<double>& y) const {
        x.resize(which.size());
        y.resize(which.size());
        for (std::size_t k = 0; k < which.size(); ++k) {
            x[k] = x_[static_cast<std::size_t>(which[k])];
            y[k] = y_[static_cast<std::size_t>(which[k])];
        }
    }

    void active_full(const double* f, double* phi) const {
        sums_.apply(f, phi);
        for (std::size_t k = 0; k < active_.size(); ++k) phi[k] *= scale_;
    }

    double scale_;  // of sums of f/d; 0: no interaction
    bool precise_ = false;
    bool fresh_ = true;  // the active list belongs to earlier points
    std::vector<double> x_, y_, xa_, ya_, xp_, yp_, active_phi_, passive_phi_;
    std::vector<float> f_single_, phi_single_;
    PairSums sums_;
};

}  // namespace

void Products::inner_everywhere(const double* f, double* phi) {
    part_.resize(std::max(active_.size(), passive_.size()));
    inner(f, part_.data());
    for (std::size_t k = 0; k < active_.size(); ++k) phi[active_[k]] = part_[k];
    inner_passive(f, part_.data());
    for (std::size_t k = 0; k < passive_.size(); ++k) phi[passive_[k]] = part_[k];
}

void Products::complement(int n) {
    passive_.clear();
    std::size_t next = 0;
    for (int k = 0; k < n; ++k) {
        if (next < active_.size() && active_[next] == k)
            ++next;
        else
            passive_.push_back(k);
    }
}

// With images there are no sums in single precision, and every pair is a sum itself.
double direct_rate(const Kernel& kernel) { return kernel.lattice() ? 3e7 : 6e9; }

std::unique_ptr<Products> make_direct_products(std::shared_ptr<const Kernel> kernel) { return std::make_unique<Direct>(std::move(kernel)); }

}  // namespace rsc
