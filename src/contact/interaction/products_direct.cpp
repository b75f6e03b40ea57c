
#include "contact/interaction/pair_sums.hpp"
#include "contact/interaction/products.hpp"

namespace rsc {
namespace {

class Direct final : public Products {
public:
    explicit Direct(std::shared_ptr<const Kernel> kernel) : Products(std::move(kernel)), sums_(*kernel_) {}

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
        if (precise_ || !sums_.has_single())
            sums_.apply(f, phi);
        else
            sums_.apply_single(f, phi);
    }

    void inner_passive(const double* f, double* phi) override { sums_.onto(!precise_, passive_.size(), xp_.data(), yp_.data(), f, phi); }

    void elsewhere(const double* f, int n, const double* x, const double* y, double* phi) override {
        sums_.onto(true, static_cast<std::size_t>(n), x, y, f, phi);
    }

    void full(const double* f, double* phi) override {
        ++count_;
        active_phi_.resize(active_.size());
        sums_.apply(f, active_phi_.data());
        sums_.onto(false, passive_.size(), xp_.data(), yp_.data(), f, passive_phi_.data());
        for (std::size_t k = 0; k < active_.size(); ++k) phi[active_[k]] = active_phi_[k];
        for (std::size_t k = 0; k < passive_.size(); ++k) phi[passive_[k]] = passive_phi_[k];
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

    bool precise_ = false;
    bool fresh_ = true;  // the active list belongs to earlier points
    std::vector<double> x_, y_, xa_, ya_, xp_, yp_, active_phi_, passive_phi_;
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

// With images there are no sums in single precision, and every pair is a sum itself; a smooth part is looked up in a table.
double direct_rate(const Kernel& kernel) {
    if (kernel.lattice()) return 3e7;
    return kernel.smooth() ? 4e8 : 6e9;
}

std::unique_ptr<Products> make_direct_products(std::shared_ptr<const Kernel> kernel) { return std::make_unique<Direct>(std::move(kernel)); }

}  // namespace rsc
