#include "contact/solver/periodic_grid.hpp"
#include "rough/parallel.hpp"

namespace rsc {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

constexpr int kThreads = 400000;  // number of pixels above which threads are used
constexpr int kRows = 8;          // that a thread takes at a time
constexpr int kReach = 6;         // of the preconditioner in pixels
constexpr std::size_t kFew = 8;   // products are split if one of this many pixels is in the set
// Largest number of conjugate-gradient steps in a round, and the reduction of the preconditioned residual that ends a round earlier.
constexpr int kSteps = 8;
constexpr double kReduction = 0.1;
// Rounds after which the energy is monitored in every round; most sets converge in about ten.
constexpr int kQuick = 15;
// Error below which the residual of a round is computed in double precision.
constexpr double kSingle = 1e-5;
// Shortest side for which a coarser grid is used.
constexpr int kShortest = 32;

}  // namespace

PeriodicGrid::PeriodicGrid(int nx, int ny, double aspect, double unit, double highest, StoredHeights heights, Share share_of)
    : BoundedSolver(highest, {kSteps, kReduction, kQuick, true}),
      nx_(nx),
      ny_(ny),
      aspect_(aspect),
      unit_(unit),
      heights_(heights),
      share_(std::move(share_of)),
      inner_(nx, ny, 1, aspect, share()),
      plane_(nx, ny) {
    rows_.assign(at(ny) + 1, 0);
    // K^-1 by offset: |k|/2/(1 + share), multiplied by a window with a non-negative transform, so that the result is positive semidefinite as
    // well.
    inverse_ = PixelStencil(
        kReach,
        [&](double kx, double ky) {
            const double k = std::hypot(kx, ky / aspect);
            return 0.5 * k / (share_ ? 1 + share()(k) : 1);
        },
        [](int a) { return 1 - std::abs(a) / (kReach + 1.0); });
    far_ = std::make_unique<BlockCorrection>(nx, ny, aspect, inverse_, share());
    if (SplitPixels::suits(nx, ny, aspect, share())) split_ = std::make_unique<SplitPixels>(nx, ny, aspect, share());
}

int PeriodicGrid::threads() const { return nx_ >= kThreads / ny_ ? 0 : 1; }

PeriodicGrid::Share PeriodicGrid::share() const {
    if (!share_) return {};
    return [this](double k) { return share_(k / unit_); };
}

PeriodicPixels<double>& PeriodicGrid::fine() {
    if (!fine_) fine_ = std::make_unique<PeriodicPixels<double>>(nx_, ny_, 1, aspect_, share());
    return *fine_;
}

bool PeriodicGrid::can_be_coarsened() const { return nx_ % 2 == 0 && ny_ % 2 == 0 && std::min(nx_, ny_) >= 2 * kShortest; }

std::unique_ptr<PeriodicGrid> PeriodicGrid::coarsened(std::vector<double>& storage) const {
    const int nx = nx_ / 2, ny = ny_ / 2;
    storage.resize(at(nx) * at(ny));
    parallel_for(ny, kRows, threads(), [&](int j) {
        for (int i = 0; i < nx; ++i)
            storage[at(j) * at(nx) + at(i)] =
                0.25 * (heights_(2 * j, 2 * i) + heights_(2 * j, 2 * i + 1) + heights_(2 * j + 1, 2 * i) + heights_(2 * j + 1, 2 * i + 1));
    });
    return std::make_unique<PeriodicGrid>(nx, ny, aspect_, 2 * unit_, highest_, StoredHeights{storage.data(), nx, 0, 1}, share_);
}

void PeriodicGrid::start(const PeriodicGrid& coarse) {
    column_.clear(), p_.clear(), z_.clear();
    for (int j = 0; j < ny_; ++j) {
        rows_[at(j)] = p_.size();
        for (std::size_t k = coarse.rows_[at(j / 2)]; k < coarse.rows_[at(j / 2) + 1]; ++k) {
            if (!(coarse.p_[k] > 0)) continue;
            for (int i : {2 * coarse.column_[k], 2 * coarse.column_[k] + 1})
                column_.push_back(i), p_.push_back(coarse.p_[k]), z_.push_back(heights_(j, i));
        }
    }
    rows_.back() = p_.size();
}

void PeriodicGrid::start(Given given) {
    column_.clear(), p_.clear(), z_.clear();
    for (int j = 0; j < ny_; ++j) {
        rows_[at(j)] = p_.size();
        for (int i = 0; i < nx_; ++i) {
            const double overlap = given.is_pressure ? 1 : heights_(j, i) - given.value;
            if (!(overlap > 0)) continue;
            column_.push_back(i), z_.push_back(heights_(j, i));
            p_.push_back(given.is_pressure ? given.value : std::sqrt(overlap));
        }
    }
    rows_.back() = p_.size();
    if (given.is_pressure || p_.empty()) return;
    // Scales the pressures to the smallest energy.
    wanted_.reset(), Z0_ = given.value;
    evaluate(false);
    double overlap = 0, energy = 0;
    for (std::size_t k = 0; k < p_.size(); ++k) {
        const double g0 = p_[k] * p_[k];
        overlap += p_[k] * g0;
        energy += p_[k] * (w_[k] + g0);
    }
    for (double& p : p_) p = std::min(p * overlap / energy, highest_);
}

bool PeriodicGrid::bare() const {
    return std::none_of(p_.begin(), p_.end(), [](double p) { return p > 0; });
}

bool PeriodicGrid::full() const {
    return p_.size() == at(nx_) * at(ny_) && std::all_of(p_.begin(), p_.end(), [](double p) { return p > 0; });
}

std::vector<Pixel> PeriodicGrid::pixels() const {
    std::vector<Pixel> pixels;
    for (int j = 0; j < ny_; ++j)
        for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k) pixels.push_back({column_[k], j});
    return pixels;
}

template <class Real>
void PeriodicGrid::multiply_by(PeriodicPixels<Real>& pixels, const std::vector<double>& x, std::vector<double>& Kx) {
    ++products_;
    Kx.resize(x.size());
    pixels.apply(
        [&](int j, Real* row) {
            std::fill_n(row, nx_, Real(0));
            for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k) row[column_[k]] = static_cast<Real>(x[k]);
        },
        [&](int j, const Real* row) {
            for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k) Kx[k] = unit_ * static_cast<double>(row[column_[k]]);
        });
}

void PeriodicGrid::multiply(const std::vector<double>& x, std::vector<double>& Kx, bool exact) {
    exact_ = exact;
    if (exact)
        multiply_by(fine(), x, Kx);
    else
        multiply_by(inner_, x, Kx);
}

// Also collects the penetrating pixels for renew().
double PeriodicGrid::outside() {
    partial_.resize(at(ny_)), outside_.resize(at(ny_));
    parallel_for(ny_, kRows, threads(), [&](int j) {
        const float* const inner = inner_.row(j);
        const double* const exact = exact_ ? fine_->row(j) : nullptr;
        std::vector<Penetration>& found = outside_[at(j)];
        found.clear();
        double part = 0;
        int i = 0;
        for (std::size_t k = rows_[at(j)]; k <= rows_[at(j) + 1]; ++k, ++i) {
            const int upto = k < rows_[at(j) + 1] ? column_[k] : nx_;
            for (; i < upto; ++i) {
                const double w = unit_ * (exact ? exact[i] : static_cast<double>(inner[i])) - heights_(j, i) + Z0_;
                if (w < 0) part += w * w, found.push_back({i, w});
            }
        }
        partial_[at(j)] = part;
    });
    return std::accumulate(partial_.begin(), partial_.end(), 0.0);
}

// Renews the set: pixels under pressure, and penetrating pixels without pressure. Those outside the set were collected by outside().
void PeriodicGrid::renew() {
    const auto belongs = [&](std::size_t k) { return w_[k] < 0 || p_[k] > 0; };
    std::vector<std::size_t> rows(at(ny_) + 1, 0);
    parallel_for(ny_, kRows, threads(), [&](int j) {
        rows[at(j) + 1] = outside_[at(j)].size();
        for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k) rows[at(j) + 1] += belongs(k);
    });
    for (int j = 0; j < ny_; ++j) rows[at(j) + 1] += rows[at(j)];
    const std::size_t n = rows.back();
    std::vector<std::int32_t> column(n);
    std::vector<double> p(n), w(n), z(n);
    parallel_for(ny_, kRows, threads(), [&](int j) {
        std::size_t next = rows[at(j)];
        const auto add = [&](std::int32_t i, double pressure, double gap) {
            column[next] = i, p[next] = pressure, w[next] = gap;
            z[next++] = heights_(j, i);
        };
        auto other = outside_[at(j)].begin();
        const auto end = outside_[at(j)].end();
        for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k) {
            for (; other != end && other->column < column_[k]; ++other) add(other->column, 0, other->w);
            if (belongs(k)) add(column_[k], p_[k], w_[k]);
        }
        for (; other != end; ++other) add(other->column, 0, other->w);
    });
    rows_ = std::move(rows), column_ = std::move(column);
    p_ = std::move(p), w_ = std::move(w), z_ = std::move(z);
}

// Products inside a round need not be accurate, because the next round starts from an accurate one.
void PeriodicGrid::multiply_roughly(const std::vector<double>& x, std::vector<double>& Kx) {
    if (!split_ || x.size() > at(nx_) * at(ny_) / kFew) return multiply(x, Kx, false);
    split_->multiply(plane_, {rows_, column_}, x, Kx, threads());
    for (double& v : Kx) v *= unit_;
}

// y = K^-1, truncated to kReach pixels and with a correction for the farther ones, times r over the free pixels.
void PeriodicGrid::precondition(const std::vector<double>& r, std::vector<double>& y) {
    from_.resize(r.size()), to_.resize(r.size());
    for (std::size_t k = 0; k < r.size(); ++k) from_[k] = free_[k] ? static_cast<float>(r[k]) : 0.0f;
    plane_.convolve(inverse_, {rows_, column_}, from_.data(), to_.data(), threads());
    correct(y);
}

void PeriodicGrid::precondition_ones(std::vector<double>& y) {
    from_.assign(free_.begin(), free_.end());
    to_ = ones_;
    correct(y);
}

// Corrects to_, the truncated K^-1 times from_, and copies it to y.
void PeriodicGrid::correct(std::vector<double>& y) {
    if (far_is_set_) far_->subtract({rows_, column_}, from_.data(), to_.data(), threads());
    y.resize(to_.size());
    double product = 0;
    for (std::size_t k = 0; k < y.size(); ++k) {
        y[k] = free_[k] ? static_cast<double>(to_[k]) : 0.0;
        product += static_cast<double>(from_[k]) * y[k];
    }
    if (!far_is_set_ || product > 0) return;
    far_is_set_ = false;  // the correction is not proved to be positive definite
    plane_.convolve(inverse_, {rows_, column_}, from_.data(), to_.data(), threads());
    correct(y);
}

void PeriodicGrid::freed() {
    far_is_set_ = far_->exists();
    from_.assign(free_.begin(), free_.end()), ones_.resize(free_.size());
    plane_.convolve(inverse_, {rows_, column_}, from_.data(), ones_.data(), threads());
    if (!far_is_set_) return;
    std::vector<float> m = ones_;
    for (std::size_t k = 0; k < m.size(); ++k) m[k] = free_[k] ? std::max(m[k], 0.0f) : 0.0f;
    far_->set({rows_, column_}, std::move(m), threads());
}

bool PeriodicGrid::judge_exactly(bool exact, double residual, int) { return exact || residual < kSingle; }

ElementsOutcome PeriodicGrid::solve(Given given, double tolerance, int most_iterations, bool finest) {
    const long before = products_;
    wanted_.reset();
    if (given.is_pressure)
        wanted_ = given.value * static_cast<double>(nx_) * static_cast<double>(ny_);
    else
        Z0_ = given.value;
    ElementsOutcome outcome = iterate(tolerance, most_iterations, finest);
    outcome.products = products_ - before;
    return outcome;
}

double PeriodicGrid::stiffness(bool back) {
    // The answer's error is of second order in these.
    constexpr double tolerance = 5e-4, reduction = 2e-2;
    constexpr int rounds = 20, steps = 60;
    return BoundedSolver::stiffness(back, tolerance, rounds, steps, reduction);
}

void PeriodicGrid::deflect(std::vector<double>& plane) {
    fine().apply([&](int j, double* row) { std::copy_n(plane.data() + at(j) * at(nx_), nx_, row); },
                 [&](int j, const double* row) {
                     for (int i = 0; i < nx_; ++i) plane[at(j) * at(nx_) + at(i)] = unit_ * row[i];
                 });
}

double PeriodicGrid::least_inverse() {
    std::vector<double> least(at(ny_));
    fine().apply(
        [&](int j, double* row) {
            for (int i = 0; i < nx_; ++i) row[i] = heights_(j, i);
        },
        [&](int j, const double* row) { least[at(j)] = *std::min_element(row, row + nx_); }, PeriodicPixels<double>::Answer::pressure);
    return *std::min_element(least.begin(), least.end()) / unit_;
}

}  // namespace rsc
