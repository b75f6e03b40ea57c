#include "interaction/products.hpp"

#include "interaction/mesh.hpp"
#include "interaction/pair_matrix.hpp"
#include "interaction/pairs.hpp"

namespace rsc {
namespace {

class Direct final : public Products {
public:
    explicit Direct(std::shared_ptr<const Kernel> kernel)
        : Products(std::move(kernel)), sums_(*kernel_) {
        if (!kernel_->none() && kernel_->smooth() && !kernel_->lattice()) matrix_.emplace(*kernel_);
    }

    void set_points(int n, const double* x, const double* y) override {
        if (std::equal(x, x + n, x_.begin(), x_.end()) &&
            std::equal(y, y + n, y_.begin(), y_.end()))
            return;
        x_.assign(x, x + n);
        y_.assign(y, y + n);
        fresh_ = true;
    }

    void set_active(const std::vector<int>& active) override {
        if (!fresh_ && active == active_) return;
        const bool moved = std::exchange(fresh_, false);
        divide(active);
        stored_ = keeps_pairs(passive_.size());
        if (stored_) {
            const bool again = matrix_->stale(active_.size());
            if (again) {
                matrix_->forget();
                xo_.clear();
            }
            if (moved || again || all_.size() != x_.size())
                number(x_.size(), x_.data(), y_.data(), all_);
            select(active_, active_numbers_);
            select(passive_, passive_numbers_);
            stored_ = matrix_->set_active(active_numbers_);
        }
        if (!stored_) {
            all_.clear();
            gather(active_, xa_, ya_);
            sums_.assign(active_.size(), xa_.data(), ya_.data());
            gather(passive_, xp_, yp_);
        }
        active_phi_.resize(active_.size());
        passive_phi_.resize(passive_.size());
    }

    void inner(const double* f, double* phi) override {
        ++count_;
        among(sums_.has_single(), f, phi);
    }

    void inner_passive(const double* f, double* phi) override {
        onto_passive(sums_.has_single(), f, phi);
    }

    void elsewhere(const double* f, int n, const double* x, const double* y, double* phi) override {
        const auto count = static_cast<std::size_t>(n);
        if (stored_ && keeps_pairs(count)) {
            if (!std::equal(x, x + count, xo_.begin(), xo_.end()) ||
                !std::equal(y, y + count, yo_.begin(), yo_.end())) {
                number(count, x, y, other_numbers_);
                xo_.assign(x, x + count);
                yo_.assign(y, y + count);
            }
            return matrix_->onto(sums_.has_single(), f, other_numbers_, phi);
        }
        if (stored_) {
            gather(active_, xa_, ya_);
            sums_.assign(active_.size(), xa_.data(), ya_.data());
        }
        sums_.onto(true, count, x, y, f, phi);
    }

    void full(const double* f, double* phi) override {
        ++count_;
        among(false, f, active_phi_.data());
        onto_passive(false, f, passive_phi_.data());
        for (std::size_t k = 0; k < active_.size(); ++k) phi[active_[k]] = active_phi_[k];
        for (std::size_t k = 0; k < passive_.size(); ++k) phi[passive_[k]] = passive_phi_[k];
    }

    double full_error() const override { return 1e-14; }
    double inner_error() const override { return sums_.has_single() ? 1e-6 : full_error(); }

private:
    // True if the values at the pairs are stored.
    bool keeps_pairs(std::size_t others) const {
        return matrix_ && !matrix_->too_large(active_.size(), others);
    }

    void among(bool single, const double* f, double* phi) {
        if (stored_)
            matrix_->among(single, f, phi);
        else
            sums_.among(single, f, phi);
    }

    void onto_passive(bool single, const double* f, double* phi) {
        if (stored_)
            matrix_->onto(single, f, passive_numbers_, phi);
        else
            sums_.onto(single, passive_.size(), xp_.data(), yp_.data(), f, phi);
    }

    void number(std::size_t n, const double* x, const double* y, std::vector<std::uint32_t>& to) {
        to.resize(n);
        for (std::size_t k = 0; k < n; ++k) to[k] = matrix_->find(x[k], y[k]);
    }
    void select(const std::vector<int>& which, std::vector<std::uint32_t>& to) const {
        to.resize(which.size());
        for (std::size_t k = 0; k < which.size(); ++k)
            to[k] = all_[static_cast<std::size_t>(which[k])];
    }

    bool fresh_ = true;    // true until set_active() is called for the current points
    bool stored_ = false;  // the matrix is used for the current points
    std::vector<double> xa_, ya_, xp_, yp_, xo_, yo_, active_phi_, passive_phi_;
    std::vector<std::uint32_t> all_, active_numbers_, passive_numbers_,
        other_numbers_;  // numbers of points in the matrix
    PairSums sums_;
    std::optional<PairMatrix> matrix_;
};

}  // namespace

void Products::inner_everywhere(const double* f, double* phi) {
    part_.resize(std::max(active_.size(), passive_.size()));
    inner(f, part_.data());
    for (std::size_t k = 0; k < active_.size(); ++k) phi[active_[k]] = part_[k];
    inner_passive(f, part_.data());
    for (std::size_t k = 0; k < passive_.size(); ++k) phi[passive_[k]] = part_[k];
}

void Products::gather(const std::vector<int>& which, std::vector<double>& x,
                      std::vector<double>& y) const {
    x.clear();
    y.clear();
    for (const int k : which) {
        x.push_back(x_[static_cast<std::size_t>(k)]);
        y.push_back(y_[static_cast<std::size_t>(k)]);
    }
}

void Products::divide(const std::vector<int>& active) {
    active_ = active;
    passive_.clear();
    std::size_t next = 0;
    for (int k = 0; k < static_cast<int>(x_.size()); ++k) {
        if (next < active_.size() && active_[next] == k)
            ++next;
        else
            passive_.push_back(k);
    }
}

// Periodic kernels have no single-precision sums and cost more per pair; a smooth part is evaluated
// from a table. Values of these kernels are stored for as many contacts as memory allows.
double direct_rate(const Kernel& kernel, std::size_t candidates) {
    if (kernel.lattice()) return 3e7;
    constexpr std::size_t stored = 4500;
    return !kernel.smooth() || candidates < stored ? 6e9 : 4e8;
}

std::unique_ptr<Products> make_direct_products(std::shared_ptr<const Kernel> kernel) {
    return std::make_unique<Direct>(std::move(kernel));
}

namespace {

// True if sums over pairs are cheaper than a mesh that resolves the smooth part of the kernel, as
// for a thin layer.
bool too_fine_a_mesh(const Kernel& kernel, std::size_t n, const double* x, const double* y,
                     double error) {
    if (!kernel.smooth() || kernel.lattice() || n == 0) return false;
    const auto [west, east] = std::minmax_element(x, x + n);
    const auto [south, north] = std::minmax_element(y, y + n);
    const double width = *east - *west, height = *north - *south, side = std::max(width, height);
    if (!(std::min(width, height) > 0)) return false;
    const double pairs = static_cast<double>(n) * static_cast<double>(n);
    return pairs / direct_rate(kernel, n) <
           MeshPotential::estimated_cost(n, error, width / height, kernel.smooth()->scale() / side);
}

// Products over the whole working set, with zero forces at passive points.
class Mesh final : public Products {
public:
    Mesh(std::shared_ptr<const Kernel> kernel, double full_error, double inner_error)
        : Products(std::move(kernel)),
          full_error_(full_error),
          inner_error_(inner_error),
          pairs_(*kernel_) {}

    void set_points(int n, const double* x, const double* y) override {
        const auto size = static_cast<std::size_t>(n);
        x_.assign(x, x + n);
        y_.assign(y, y + n);
        f_.resize(size);
        phi_.resize(size);
        inner_.reset();  // created on first use
        exact_.reset();
        among_.reset();
        by_pairs_ = too_fine_a_mesh(*kernel_, size, x, y, inner_error_);
        if (by_pairs_) return by_pairs().set_points(n, x, y);
        if (direct()) pairs_.assign(size, x, y);
    }

    void set_active(const std::vector<int>& active) override {
        divide(active);
        if (by_pairs_) by_pairs().set_active(active);
    }

    void inner(const double* f, double* phi) override {
        if (by_pairs_) return ++count_, by_pairs().inner(f, phi);
        constexpr double few = 0.8;  // share of active points below which a separate mesh is faster
        if (static_cast<double>(active_.size()) < few * static_cast<double>(x_.size())) {
            ++count_;
            among().apply(f, phi);
            return;
        }
        everywhere(f, false);
        for (std::size_t k = 0; k < active_.size(); ++k)
            phi[k] = phi_[static_cast<std::size_t>(active_[k])];
    }

    void inner_passive(const double* f, double* phi) override {
        if (by_pairs_) return by_pairs().inner_passive(f, phi);
        everywhere(f, false);
        for (std::size_t k = 0; k < passive_.size(); ++k)
            phi[k] = phi_[static_cast<std::size_t>(passive_[k])];
    }

    void elsewhere(const double* f, int n, const double* x, const double* y, double* phi) override {
        if (by_pairs_) return by_pairs().elsewhere(f, n, x, y, phi);
        const std::size_t sources = active_.size(), targets = static_cast<std::size_t>(n);
        std::vector<double> xa, ya;
        gather(active_, xa, ya);
        constexpr double making = 3;  // cost of setting up a mesh and of one product, in products
        const double pairs = static_cast<double>(sources) * static_cast<double>(targets);
        if (pairs / direct_rate(*kernel_, sources) <
            making * MeshPotential::estimated_cost(sources + targets, kElsewhere)) {
            PairSums sums(*kernel_);
            sums.assign(sources, xa.data(), ya.data());
            sums.onto(true, targets, x, y, f, phi);
        } else {
            xa.insert(xa.end(), x, x + n);
            ya.insert(ya.end(), y, y + n);
            std::vector<double> force(f, f + sources), all(xa.size());
            force.resize(xa.size());
            MeshPotential(xa.size(), xa.data(), ya.data(), kElsewhere, kernel_)
                .apply(force.data(), all.data());
            std::copy(all.begin() + static_cast<std::ptrdiff_t>(sources), all.end(), phi);
        }
    }

    void full(const double* f, double* phi) override {
        if (by_pairs_) return ++count_, by_pairs().full(f, phi);
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

    Products& by_pairs() {
        if (!pair_products_) pair_products_ = make_direct_products(kernel_);
        return *pair_products_;
    }

    MeshPotential& made(std::optional<MeshPotential>& mesh, double error) {
        if (!mesh) mesh.emplace(x_.size(), x_.data(), y_.data(), error, kernel_);
        return *mesh;
    }

    void everywhere(const double* f, bool exact) {
        ++count_;
        std::fill(f_.begin(), f_.end(), 0.0);
        for (std::size_t k = 0; k < active_.size(); ++k)
            f_[static_cast<std::size_t>(active_[k])] = f[k];
        if (!exact)
            made(inner_, inner_error_).apply(f_.data(), phi_.data());
        else if (direct())
            pairs_.among(false, f_.data(), phi_.data());
        else
            made(exact_, full_error_).apply(f_.data(), phi_.data());
    }

    // Mesh of the active points only.
    MeshPotential& among() {
        if (!among_ || among_active_ != active_) {
            std::vector<double> xa, ya;
            gather(active_, xa, ya);
            among_.emplace(xa.size(), xa.data(), ya.data(), inner_error_, kernel_);
            among_active_ = active_;
        }
        return *among_;
    }

    double full_error_, inner_error_;
    bool by_pairs_ = false;
    std::unique_ptr<Products> pair_products_;
    std::vector<double> f_, phi_;
    std::optional<MeshPotential> inner_, exact_, among_;
    std::vector<int> among_active_;  // active points for which among_ was created
    PairSums pairs_;
};

}  // namespace

std::unique_ptr<Products> make_mesh_products(std::shared_ptr<const Kernel> kernel,
                                             double full_error, double inner_error) {
    if (kernel->none())
        return make_direct_products(std::move(kernel));  // no interaction, so no mesh
    return std::make_unique<Mesh>(std::move(kernel), full_error, inner_error);
}

}  // namespace rsc
