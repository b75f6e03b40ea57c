#include "interaction/products.hpp"

#include "base/dispatch.hpp"
#include "interaction/mesh.hpp"
#include "interaction/pairs.hpp"

namespace rsc {
namespace {

// sum = row . f and phi += own row over n numbers, a multiple of kLanes. The partial sums are the
// same on every machine.
constexpr std::size_t kLanes = 8;
RSC_ALWAYS_INLINE void both_body(std::size_t n, const double* row, const double* f, double own,
                                 double* phi, double& sum) {
    double lanes[kLanes] = {};
    for (std::size_t j = 0; j < n; j += kLanes)
        for (std::size_t l = 0; l < kLanes; ++l) {
            lanes[l] += row[j + l] * f[j + l];
            phi[j + l] += own * row[j + l];
        }
    sum = 0;
    for (const double lane : lanes) sum += lane;
}
RSC_DISPATCH(both_ways, both_body,
             (std::size_t n, const double* row, const double* f, double own, double* phi,
              double& sum),
             (n, row, f, own, phi, sum))

// G between the points of a set, for kernels that are expensive to evaluate (layers): a solution
// takes some forty products with the same points.
class StoredPairs {
public:
    explicit StoredPairs(const Kernel& kernel) : kernel_(kernel) {}

    bool suits(std::size_t n) const {
        return kernel_.smooth() && !kernel_.none() && !kernel_.lattice() &&
               n * n <= 2 * kMostStoredValues;
    }
    bool empty() const { return begin_.empty(); }
    void clear() { begin_.clear(); }

    void store(const std::vector<double>& x, const std::vector<double>& y) {
        const std::size_t n = x.size();
        begin_.assign(1, 0);
        for (std::size_t i = 0; i < n; ++i) begin_.push_back(begin_.back() + whole(i));
        values_.assign(begin_.back(), 0.0);
        for (std::vector<double>* of_points : {&square_, &force_, &phi_})
            of_points->assign(whole(n), 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            double* const row = values_.data() + begin_[i];
            for (std::size_t j = 0; j < i; ++j)
                square_[j] = (x[j] - x[i]) * (x[j] - x[i]) + (y[j] - y[i]) * (y[j] - y[i]);
            for (std::size_t j = 0; j < i; j += SquareTable::kBlock)
                kernel_.smooth()->table().values(std::min(SquareTable::kBlock, i - j),
                                                 square_.data() + j, row + j);
            // 1/d does not apply to coinciding points.
            for (std::size_t j = 0; j < i; ++j)
                row[j] = square_[j] > 0
                             ? row[j] + (kernel_.shift() + kernel_.near() / std::sqrt(square_[j]))
                             : kernel_.self();
        }
    }

    // G f at the points `from`, of their forces f, and at the points `also`; by number of the
    // point.
    const std::vector<double>& product(const std::vector<int>& from, const double* f,
                                       const std::vector<int>& also) {
        for (std::vector<double>* of_points : {&force_, &phi_})
            std::fill(of_points->begin(), of_points->end(), 0.0);
        for (std::size_t k = 0; k < from.size(); ++k) force_[at(from[k])] = f[k];
        for (const std::vector<int>* points : {&from, &also})
            for (const int point : *points) {
                const std::size_t i = at(point);
                double sum = 0;
                both_ways(whole(i), values_.data() + begin_[i], force_.data(), force_[i],
                          phi_.data(), sum);
                phi_[i] += sum + kernel_.self() * force_[i];
            }
        return phi_;
    }

private:
    static std::size_t whole(std::size_t n) { return (n + kLanes - 1) / kLanes * kLanes; }

    const Kernel& kernel_;
    // Rows of the points before each, with 0 up to a multiple of kLanes.
    std::vector<double> values_;
    std::vector<std::size_t> begin_;
    std::vector<double> square_, force_, phi_;  // of all points
};

class Direct final : public Products {
public:
    explicit Direct(std::shared_ptr<const Kernel> kernel)
        : Products(std::move(kernel)), sums_(*kernel_), stored_(*kernel_) {}

    void set_points(int n, const double* x, const double* y) override {
        if (std::equal(x, x + n, x_.begin(), x_.end()) &&
            std::equal(y, y + n, y_.begin(), y_.end()))
            return;
        x_.assign(x, x + n);
        y_.assign(y, y + n);
        fresh_ = true;
        stored_.clear();
    }

    void set_active(const std::vector<int>& active) override {
        if (!std::exchange(fresh_, false) && active == active_) return;
        divide(active);
        gather(active_, xa_, ya_);
        gather(passive_, xp_, yp_);
        sums_.assign(active_.size(), xa_.data(), ya_.data());
        if (stored_.empty() && stored_.suits(x_.size())) stored_.store(x_, y_);
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
        sums_.onto(true, static_cast<std::size_t>(n), x, y, f, phi);
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
    void among(bool single, const double* f, double* phi) {
        if (stored_.empty()) return sums_.among(single, f, phi);
        const std::vector<double>& all = stored_.product(active_, f, {});
        for (std::size_t k = 0; k < active_.size(); ++k) phi[k] = all[at(active_[k])];
    }

    void onto_passive(bool single, const double* f, double* phi) {
        if (stored_.empty())
            return sums_.onto(single, passive_.size(), xp_.data(), yp_.data(), f, phi);
        const std::vector<double>& all = stored_.product(active_, f, passive_);
        for (std::size_t k = 0; k < passive_.size(); ++k) phi[k] = all[at(passive_[k])];
    }

    bool fresh_ = true;  // true until set_active() is called for the current points
    std::vector<double> xa_, ya_, xp_, yp_, active_phi_, passive_phi_;
    PairSums sums_;
    StoredPairs stored_;
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
    constexpr std::size_t stored = 8000;  // about half of the candidates are near contact
    return !kernel.smooth() || candidates < stored ? 6e9 : 4e8;
}

std::unique_ptr<Products> make_direct_products(std::shared_ptr<const Kernel> kernel) {
    return std::make_unique<Direct>(std::move(kernel));
}

namespace {

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
        if (direct()) pairs_.assign(size, x, y);
    }

    void set_active(const std::vector<int>& active) override { divide(active); }

    void inner(const double* f, double* phi) override {
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
        everywhere(f, false);
        for (std::size_t k = 0; k < passive_.size(); ++k)
            phi[k] = phi_[static_cast<std::size_t>(passive_[k])];
    }

    void elsewhere(const double* f, int n, const double* x, const double* y, double* phi) override {
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
