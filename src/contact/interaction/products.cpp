#include "contact/interaction/products.hpp"

#include "contact/interaction/mesh.hpp"
#include "contact/interaction/pair_sums.hpp"

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
    bool fresh_ = true;  // true until set_active() is called for the current points
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

// Periodic kernels have no single-precision sums and cost more per pair; a smooth part is evaluated from a table.
double direct_rate(const Kernel& kernel) {
    if (kernel.lattice()) return 3e7;
    return kernel.smooth() ? 4e8 : 6e9;
}

std::unique_ptr<Products> make_direct_products(std::shared_ptr<const Kernel> kernel) { return std::make_unique<Direct>(std::move(kernel)); }

namespace {

// Products over the whole working set, with zero forces at passive points.
class Mesh final : public Products {
public:
    Mesh(std::shared_ptr<const Kernel> kernel, double full_error, double inner_error)
        : Products(std::move(kernel)), full_error_(full_error), inner_error_(inner_error), pairs_(*kernel_) {}

    void set_points(int n, const double* x, const double* y) override {
        const auto size = static_cast<std::size_t>(n);
        x_.assign(x, x + n);
        y_.assign(y, y + n);
        f_.resize(size);
        phi_.resize(size);
        inner_.reset();  // created on first use
        exact_.reset();
        among_.reset();
        if (direct()) pairs_.assign(size, x, y);
    }

    void set_active(const std::vector<int>& active) override {
        active_ = active;
        complement(static_cast<int>(x_.size()));
    }

    void set_precise(bool precise) override { precise_ = precise; }

    void inner(const double* f, double* phi) override {
        constexpr double few = 0.8;  // share of active points below which a separate mesh is faster
        if (!precise_ && static_cast<double>(active_.size()) < few * static_cast<double>(x_.size())) {
            ++count_;
            among().apply(f, phi);
            return;
        }
        everywhere(f, precise_);
        for (std::size_t k = 0; k < active_.size(); ++k) phi[k] = phi_[static_cast<std::size_t>(active_[k])];
    }

    void inner_passive(const double* f, double* phi) override {
        everywhere(f, precise_);
        for (std::size_t k = 0; k < passive_.size(); ++k) phi[k] = phi_[static_cast<std::size_t>(passive_[k])];
    }

    void elsewhere(const double* f, int n, const double* x, const double* y, double* phi) override {
        const std::size_t sources = active_.size(), targets = static_cast<std::size_t>(n);
        std::vector<double> xa, ya;
        for (int k : active_) {
            xa.push_back(x_[static_cast<std::size_t>(k)]);
            ya.push_back(y_[static_cast<std::size_t>(k)]);
        }
        constexpr double making = 3;  // cost of setting up a mesh and of one product, in products
        const double pairs = static_cast<double>(sources) * static_cast<double>(targets);
        if (pairs / direct_rate(*kernel_) < making * MeshPotential::estimated_cost(sources + targets, kElsewhere)) {
            PairSums sums(*kernel_);
            sums.assign(sources, xa.data(), ya.data());
            sums.onto(true, targets, x, y, f, phi);
        } else {
            xa.insert(xa.end(), x, x + n);
            ya.insert(ya.end(), y, y + n);
            std::vector<double> force(f, f + sources), all(xa.size());
            force.resize(xa.size());
            MeshPotential(xa.size(), xa.data(), ya.data(), kElsewhere, kernel_, &far_).apply(force.data(), all.data());
            std::copy(all.begin() + static_cast<std::ptrdiff_t>(sources), all.end(), phi);
        }
    }

    void full(const double* f, double* phi) override {
        everywhere(f, true);
        std::copy(phi_.begin(), phi_.end(), phi);
    }

    double inner_error() const override { return inner_error_; }
    double full_error() const override { return direct() ? 1e-14 : full_error_; }

private:
    // Smallest error of mesh products; for smaller errors full products are direct sums.
    static constexpr double kFinest = 1e-10;
    bool direct() const { return full_error_ < kFinest; }
    // Error of products at other points.
    static constexpr double kElsewhere = 1e-5;

    const MeshPotential& made(std::optional<MeshPotential>& mesh, double error) {
        if (!mesh) mesh.emplace(x_.size(), x_.data(), y_.data(), error, kernel_, &far_);
        return *mesh;
    }

    void everywhere(const double* f, bool exact) {
        ++count_;
        std::fill(f_.begin(), f_.end(), 0.0);
        for (std::size_t k = 0; k < active_.size(); ++k) f_[static_cast<std::size_t>(active_[k])] = f[k];
        if (!exact)
            made(inner_, inner_error_).apply(f_.data(), phi_.data());
        else if (direct())
            pairs_.apply(f_.data(), phi_.data());
        else
            made(exact_, full_error_).apply(f_.data(), phi_.data());
    }

    // Mesh of the active points only.
    const MeshPotential& among() {
        if (!among_ || among_active_ != active_) {
            std::vector<double> xa, ya;
            for (int k : active_) {
                xa.push_back(x_[static_cast<std::size_t>(k)]);
                ya.push_back(y_[static_cast<std::size_t>(k)]);
            }
            among_.emplace(xa.size(), xa.data(), ya.data(), inner_error_, kernel_, &far_);
            among_active_ = active_;
        }
        return *among_;
    }

    double full_error_, inner_error_;
    bool precise_ = false;
    std::vector<double> x_, y_, f_, phi_;
    FarFields far_;
    std::optional<MeshPotential> inner_, exact_, among_;
    std::vector<int> among_active_;  // active points for which among_ was created
    PairSums pairs_;
};

}  // namespace

std::unique_ptr<Products> make_mesh_products(std::shared_ptr<const Kernel> kernel, double full_error, double inner_error) {
    if (kernel->none()) return make_direct_products(std::move(kernel));  // no interaction, so no mesh
    return std::make_unique<Mesh>(std::move(kernel), full_error, inner_error);
}

}  // namespace rsc
