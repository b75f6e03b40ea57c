#include "contact/solver/periodic_grid.hpp"
#include "rough/parallel.hpp"

namespace rsc {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kThreads = 400000;  // pixels from which threads pay
// The preconditioner's reach, and numbers of a row of its table: those beyond the reach are 0.
constexpr int kReach = 4, kTaps = 12;
// A round of conjugate gradients: steps at most, and the reduction of the preconditioned residual that ends it sooner.
constexpr int kSteps = 8;
constexpr double kReduction = 0.05;
// Rounds from which the energy is watched in all: those that settle do so in some ten.
constexpr int kQuick = 15;
// Errors below which a round is judged in double.
constexpr double kSingle = 1e-4;
// The shortest side worth a coarser grid.
constexpr int kShortest = 32;

}  // namespace

PeriodicGrid::PeriodicGrid(int nx, int ny, double aspect, double unit, double highest, StoredHeights heights, Share share_of)
    : nx_(nx),
      ny_(ny),
      aspect_(aspect),
      unit_(unit),
      highest_(highest),
      heights_(heights),
      share_(std::move(share_of)),
      inner_(nx, ny, 1, aspect, share()) {
    set_.begin.assign(at(ny) + 1, 0);
    // K^-1 between pixels so many columns and rows apart, |k|/2/(1 + share) summed over the modes of a large period, times a window with a transform that
    // is nowhere negative: so is then the product's.
    constexpr int modes = 64;
    stencil_.assign(at((2 * kReach + 1) * kTaps), 0.0f);
    const auto window = [](int a) { return 1 - std::abs(a) / (kReach + 1.0); };
    std::vector<double> inverse(at(modes * modes));
    for (int j = 0; j < modes; ++j)
        for (int i = 0; i < modes; ++i) {
            const double k = std::numbers::pi / modes * std::hypot(i + 0.5, (j + 0.5) / aspect);
            inverse[at(j * modes + i)] = 0.5 * k / (share_ ? 1 + share()(k) : 1);
        }
    for (int b = 0; b <= kReach; ++b)
        for (int a = 0; a <= kReach; ++a) {
            double sum = 0;
            for (int j = 0; j < modes; ++j)
                for (int i = 0; i < modes; ++i) {
                    const double kx = std::numbers::pi * (i + 0.5) / modes, ky = std::numbers::pi * (j + 0.5) / modes;
                    sum += inverse[at(j * modes + i)] * std::cos(a * kx) * std::cos(b * ky);
                }
            const double value = sum / (modes * modes) * window(a) * window(b);
            for (int v : {-b, b})
                for (int u : {-a, a}) stencil_[at((v + kReach) * kTaps + u + kReach)] = static_cast<float>(value);
        }
}

PeriodicGrid::Share PeriodicGrid::share() const {
    if (!share_) return {};
    return [this](double k) { return share_(k / unit_); };
}

PeriodicPixels<double>& PeriodicGrid::fine() {
    if (!fine_) fine_ = std::make_unique<PeriodicPixels<double>>(nx_, ny_, 1, aspect_, share());
    return *fine_;
}

void PeriodicGrid::release() { fine_.reset(); }

// Sums over rows, the same whatever the threads.
template <class F>
double PeriodicGrid::over_rows(F&& f) {
    partial_.resize(at(ny_));
#pragma omp parallel for schedule(static) num_threads(omp_team(nx_ >= kThreads / ny_ ? kEveryThread : 1))
    for (int j = 0; j < ny_; ++j) partial_[at(j)] = f(j);
    double sum = 0;
    for (double v : partial_) sum += v;
    return sum;
}

bool PeriodicGrid::can_be_coarsened() const { return nx_ % 2 == 0 && ny_ % 2 == 0 && std::min(nx_, ny_) >= 2 * kShortest; }

std::unique_ptr<PeriodicGrid> PeriodicGrid::coarsened(std::vector<double>& storage) const {
    const int nx = nx_ / 2, ny = ny_ / 2;
    storage.resize(at(nx) * at(ny));
#pragma omp parallel for schedule(static) num_threads(omp_team(nx_ >= kThreads / ny_ ? kEveryThread : 1))
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            storage[at(j) * at(nx) + at(i)] =
                0.25 * (heights_(2 * j, 2 * i) + heights_(2 * j, 2 * i + 1) + heights_(2 * j + 1, 2 * i) + heights_(2 * j + 1, 2 * i + 1));
    return std::make_unique<PeriodicGrid>(nx, ny, aspect_, 2 * unit_, highest_, StoredHeights{storage.data(), nx, 0, 1}, share_);
}

void PeriodicGrid::start(const PeriodicGrid& coarse) {
    set_.column.clear();
    p_.clear();
    for (int j = 0; j < ny_; ++j) {
        set_.begin[at(j)] = set_.size();
        for (std::size_t k = coarse.set_.begin[at(j / 2)]; k < coarse.set_.begin[at(j / 2) + 1]; ++k) {
            if (!(coarse.p_[k] > 0)) continue;
            for (int side = 0; side < 2; ++side) {
                set_.column.push_back(2 * coarse.set_.column[k] + side);
                p_.push_back(coarse.p_[k]);
            }
        }
    }
    set_.begin.back() = set_.size();
}

void PeriodicGrid::start(Given given) {
    set_.column.clear();
    p_.clear();
    for (int j = 0; j < ny_; ++j) {
        set_.begin[at(j)] = set_.size();
        for (int i = 0; i < nx_; ++i) {
            const double overlap = given.is_pressure ? 1 : heights_(j, i) - given.value;
            if (!(overlap > 0)) continue;
            set_.column.push_back(i);
            p_.push_back(given.is_pressure ? given.value : std::sqrt(overlap));
        }
    }
    set_.begin.back() = set_.size();
    if (given.is_pressure || p_.empty()) return;
    // The scale of least energy.
    evaluate(inner_, given);
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
    return set_.size() == at(nx_) * at(ny_) && std::all_of(p_.begin(), p_.end(), [](double p) { return p > 0; });
}

// The plane becomes K p, and w_ what it is on the set; under a pressure Z0 is such that its mean over the pixels under pressure is 0.
template <class Real>
void PeriodicGrid::evaluate(PeriodicPixels<Real>& pixels, Given given) {
    ++products_;
    w_.resize(p_.size());
    stopping_point();
    pixels.apply(
        [&](int j, Real* row) {
            std::fill_n(row, nx_, Real(0));
            for (std::size_t k = set_.begin[at(j)]; k < set_.begin[at(j) + 1]; ++k) row[set_.column[k]] = static_cast<Real>(p_[k]);
        },
        [&](int j, const Real* row) {
            for (std::size_t k = set_.begin[at(j)]; k < set_.begin[at(j) + 1]; ++k)
                w_[k] = unit_ * static_cast<double>(row[set_.column[k]]) - heights_(j, set_.column[k]);
        });
    if (given.is_pressure) {
        std::size_t touching = 0;
        for (double p : p_) touching += p > 0;
        const double sum = over_rows([&](int j) {
            double part = 0;
            for (std::size_t k = set_.begin[at(j)]; k < set_.begin[at(j) + 1]; ++k) part += p_[k] > 0 ? w_[k] : 0.0;
            return part;
        });
        Z0_ = -sum / static_cast<double>(touching);
    } else {
        Z0_ = given.value;
    }
    for (double& w : w_) w += Z0_;
}

template <class Real>
double PeriodicGrid::error(const PeriodicPixels<Real>& pixels) {
    std::size_t touching = 0;
    double weight = 0, overlap = 0;
    for (std::size_t k = 0; k < p_.size(); ++k) touching += p_[k] > 0, weight += p_[k];
    const double bad = over_rows([&](int j) {
        const Real* u = pixels.row(j);
        double part = 0;
        std::size_t k = set_.begin[at(j)];
        const std::size_t end = set_.begin[at(j) + 1];
        for (int i = 0; i < nx_;) {
            const int next = k < end ? set_.column[k] : nx_;
            for (; i < next; ++i) {
                const double w = unit_ * static_cast<double>(u[i]) - heights_(j, i) + Z0_;
                part += w < 0 ? w * w : 0.0;
            }
            if (k == end) break;
            const double e = p_[k] >= highest_ ? std::max(w_[k], 0.0) : p_[k] > 0 ? w_[k] : std::min(w_[k], 0.0);
            part += e * e;
            ++k, ++i;
        }
        return part;
    });
    overlap = over_rows([&](int j) {
        double part = 0;
        for (std::size_t k = set_.begin[at(j)]; k < set_.begin[at(j) + 1]; ++k) part += p_[k] * (heights_(j, set_.column[k]) - Z0_);
        return part;
    });
    if (touching == 0) return bad > 0 ? kInfinity : 0.0;
    return std::sqrt(bad / static_cast<double>(touching)) / std::abs(overlap / weight);
}

// The set anew: pixels under pressure, and those that penetrate without any.
template <class Real>
void PeriodicGrid::collect(const PeriodicPixels<Real>& pixels) {
    PixelRows next;
    next.begin.assign(at(ny_) + 1, 0);
    const auto visit = [&](int j, auto&& take) {
        const Real* u = pixels.row(j);
        std::size_t k = set_.begin[at(j)];
        const std::size_t end = set_.begin[at(j) + 1];
        for (int i = 0; i < nx_;) {
            const int upto = k < end ? set_.column[k] : nx_;
            for (; i < upto; ++i) {
                const double w = unit_ * static_cast<double>(u[i]) - heights_(j, i) + Z0_;
                if (w < 0) take(i, 0.0, w);
            }
            if (k == end) break;
            if (p_[k] > 0 || w_[k] < 0) take(i, p_[k], w_[k]);
            ++k, ++i;
        }
    };
    const auto parallel = nx_ >= kThreads / ny_;
#pragma omp parallel for schedule(static) num_threads(omp_team(parallel ? kEveryThread : 1))
    for (int j = 0; j < ny_; ++j) visit(j, [&](int, double, double) { ++next.begin[at(j) + 1]; });
    for (int j = 0; j < ny_; ++j) next.begin[at(j) + 1] += next.begin[at(j)];
    const std::size_t n = next.begin.back();
    next.column.resize(n);
    std::vector<double> p(n), w(n);
#pragma omp parallel for schedule(static) num_threads(omp_team(parallel ? kEveryThread : 1))
    for (int j = 0; j < ny_; ++j) {
        std::size_t k = next.begin[at(j)];
        visit(j, [&](int i, double pressure, double gap) {
            next.column[k] = i;
            p[k] = pressure;
            w[k] = gap;
            ++k;
        });
    }
    set_ = std::move(next);
    p_ = std::move(p);
    w_ = std::move(w);
    free_.resize(n);
    for (std::size_t k = 0; k < n; ++k) free_[k] = !((p_[k] <= 0 && w_[k] >= 0) || (p_[k] >= highest_ && w_[k] <= 0));
}

// y = the part of K^-1 that reaches no farther than kReach pixels, of r, over the free pixels.
void PeriodicGrid::precondition(const std::vector<double>& r, std::vector<double>& y) {
    const auto parallel = nx_ >= kThreads / ny_;
#pragma omp parallel for schedule(static) num_threads(omp_team(parallel ? kEveryThread : 1))
    for (int j = 0; j < ny_; ++j) {
        float* const row = inner_.row(j);
        std::fill_n(row, nx_, 0.0f);
        for (std::size_t k = set_.begin[at(j)]; k < set_.begin[at(j) + 1]; ++k)
            row[set_.column[k]] = free_[k] ? static_cast<float>(r[k]) : 0.0f;
    }
    const auto around = [](int v, int n) { return ((v % n) + n) % n; };
#pragma omp parallel for schedule(static) num_threads(omp_team(parallel ? kEveryThread : 1))
    for (int j = 0; j < ny_; ++j) {
        const float* rows[2 * kReach + 1];
        for (int b = -kReach; b <= kReach; ++b) rows[b + kReach] = inner_.row(around(j + b, ny_));
        for (std::size_t k = set_.begin[at(j)]; k < set_.begin[at(j) + 1]; ++k) {
            if (!free_[k]) {
                y[k] = 0;
                continue;
            }
            const int i = set_.column[k];
            float sum[kTaps] = {};
            if (i >= kReach && i + kTaps - kReach <= nx_) {
                for (int b = 0; b <= 2 * kReach; ++b) {
                    const float *from = rows[b] + i - kReach, *weight = stencil_.data() + b * kTaps;
                    for (int a = 0; a < kTaps; ++a) sum[a] += weight[a] * from[a];
                }
            } else {
                for (int b = 0; b <= 2 * kReach; ++b)
                    for (int a = 0; a <= 2 * kReach; ++a) sum[a] += stencil_[at(b * kTaps + a)] * rows[b][around(i + a - kReach, nx_)];
            }
            float total = 0;
            for (float v : sum) total += v;
            y[k] = static_cast<double>(total);
        }
    }
}

// Conjugate gradients on the free pixels: K x = ... with the residual r_; with `keep_sum` the sum of x stays, and r_ counts but for a
// constant. Returns how far the residual came down.
double PeriodicGrid::descend(std::vector<double>& x, bool keep_sum, int most_steps, double reduction) {
    const std::size_t n = set_.size();
    y_.resize(n);
    d_.assign(n, 0.0);
    image_.resize(n);
    const auto sum_of = [&](const std::vector<double>& a, const std::vector<double>& b) {
        return over_rows([&](int j) {
            double part = 0;
            for (std::size_t k = set_.begin[at(j)]; k < set_.begin[at(j) + 1]; ++k) part += a[k] * b[k];
            return part;
        });
    };
    const auto total = [&](const std::vector<double>& a) {
        return over_rows([&](int j) {
            double part = 0;
            for (std::size_t k = set_.begin[at(j)]; k < set_.begin[at(j) + 1]; ++k) part += a[k];
            return part;
        });
    };
    const auto product = [&] {  // image_ = K d_ over the free pixels
        ++products_;
        inner_.apply(
            [&](int j, float* row) {
                std::fill_n(row, nx_, 0.0f);
                for (std::size_t k = set_.begin[at(j)]; k < set_.begin[at(j) + 1]; ++k) row[set_.column[k]] = static_cast<float>(d_[k]);
            },
            [&](int j, const float* row) {
                for (std::size_t k = set_.begin[at(j)]; k < set_.begin[at(j) + 1]; ++k)
                    image_[k] = free_[k] ? unit_ * static_cast<double>(row[set_.column[k]]) : 0.0;
            });
    };
    // A single step is one along the gradient itself: cut off at the bounds it still leads down.
    const bool plain = most_steps == 1;
    std::vector<double> ones(n, 1.0);
    one_.resize(n);
    if (plain)
        for (std::size_t k = 0; k < n; ++k) one_[k] = free_[k] ? 1 : 0;
    else
        precondition(ones, one_);
    const double whole = total(one_);
    // With a free mean pressure, a correction by punch-like pressures is cheap, the more so the fuller the contact: it is a step of its own.
    double punch = 0;
    if (!keep_sum && !plain) {
        d_ = one_;
        product();
        const double energy = sum_of(d_, image_);
        punch = energy > 0 ? 1 / energy : 0;
        std::fill(d_.begin(), d_.end(), 0.0);
    }
    double first = 0, last = 0;
    for (int step = 0;; ++step) {
        if (plain)
            y_ = r_;
        else
            precondition(r_, y_);
        const double c = keep_sum ? -total(y_) / whole : punch * sum_of(one_, r_);
        for (std::size_t k = 0; k < n; ++k) y_[k] += c * one_[k];
        const double ry = sum_of(r_, y_);
        if (step == 0) first = ry;
        if (!(ry > 0)) return 0;
        if (step == most_steps || !(ry > reduction * reduction * first)) return std::sqrt(ry / first);
        const double beta = step > 0 ? ry / last : 0.0;
        last = ry;
        for (std::size_t k = 0; k < n; ++k) d_[k] = y_[k] + beta * d_[k];
        product();
        const double curvature = sum_of(d_, image_);
        if (!(curvature > 0)) return std::sqrt(ry / first);
        const double alpha = ry / curvature;
        for (std::size_t k = 0; k < n; ++k) {
            x[k] += alpha * d_[k];
            r_[k] -= alpha * image_[k];
        }
    }
}

// Clips pressures to their bounds and restores their given mean, by adding pressure where a lower flat would.
void PeriodicGrid::bound(Given given) {
    const std::size_t n = p_.size();
    for (double& p : p_) p = std::clamp(p, 0.0, highest_);
    if (!given.is_pressure) return;
    const double wanted = given.value * static_cast<double>(nx_) * static_cast<double>(ny_);
    constexpr int most = 50;
    for (int i = 0; i < most; ++i) {
        double sum = 0, room = 0;
        for (std::size_t k = 0; k < n; ++k) {
            sum += p_[k];
            room += p_[k] > 0 ? one_[k] : 0.0;
        }
        const double missing = wanted - sum;
        if (std::abs(missing) <= 1e-14 * wanted || !(room > 0)) break;
        for (std::size_t k = 0; k < n; ++k) {
            if (p_[k] > 0) p_[k] = std::max(p_[k] + missing / room * one_[k], 0.0);
        }
    }
}

// True if the last round lowered the energy; otherwise pressures return to the best ones found on the way.
bool PeriodicGrid::fell() {
    double slope = 0, curvature = 0;
    for (std::size_t k = 0; k < p_.size(); ++k) {
        const double d = p_[k] - before_p_[k];
        slope += d * before_w_[k];
        curvature += d * (w_[k] - before_w_[k]);
    }
    if (slope + 0.5 * curvature <= 0) return true;
    const double t = slope < 0 && curvature > 0 ? std::min(1.0, -slope / curvature) : 0.5;
    for (std::size_t k = 0; k < p_.size(); ++k) p_[k] = before_p_[k] + t * (p_[k] - before_p_[k]);
    return false;
}

ElementsOutcome PeriodicGrid::solve(Given given, double tolerance, int most_iterations, bool finest) {
    ElementsOutcome outcome;
    const long before = products_;
    if (given.is_pressure) {  // a start may have another mean
        one_ = p_;
        bound(given);
    }
    bool exact = false;
    const auto look = [&] {
        if (exact)
            evaluate(fine(), given);
        else
            evaluate(inner_, given);
    };
    int steps = kSteps;
    double last = kInfinity;
    for (;;) {
        const auto measure = [&] {
            look();
            outcome.residual = exact ? error(*fine_) : error(inner_);
        };
        measure();
        // Where the error grows, and in later rounds always, the energy is asked, and a round that raised it taken back to its best place; shorter ones follow.
        if ((outcome.residual > last || outcome.iterations > kQuick) && !before_p_.empty() && !fell()) {
            measure();
            steps = std::max(steps / 2, 1);
        } else {
            steps = std::min(steps + 1, kSteps);
        }
        last = outcome.residual;
        if (outcome.residual <= tolerance && finest && !exact) {
            exact = true;
            before_p_.clear();
            continue;
        }
        outcome.converged = outcome.residual <= tolerance;
        if (outcome.converged || outcome.iterations >= most_iterations) break;
        ++outcome.iterations;
        if (exact)
            collect(*fine_);
        else
            collect(inner_);
        const std::size_t n = set_.size();
        r_.resize(n);
        for (std::size_t k = 0; k < n; ++k) r_[k] = free_[k] ? 0 - w_[k] : 0.0;
        before_p_ = p_;
        before_w_ = w_;
        descend(p_, given.is_pressure, steps, kReduction);
        bound(given);
        exact = finest && (exact || outcome.residual < kSingle);
    }
    before_p_.clear();
    before_w_.clear();
    outcome.products = products_ - before;
    return outcome;
}

double PeriodicGrid::stiffness(bool back) {
    // The same steps on the same matrix, with 1 for g0. 1'q + r'q = 2 1'q - q'Kq misses what it tends to by the square of the residual only.
    constexpr double reduction = 1e-5;
    constexpr int most = 400;
    const std::size_t n = set_.size();
    std::vector<double> q(n, 0.0);
    free_.resize(n);
    r_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        free_[k] = p_[k] > 0 && (back || p_[k] < highest_);
        r_[k] = free_[k] ? 1 : 0;
    }
    descend(q, false, most, reduction);
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += q[k] * (free_[k] ? 1 + r_[k] : 0);
    return sum;
}

double PeriodicGrid::energy() const {
    double sum = 0;
    for (int j = 0; j < ny_; ++j)
        for (std::size_t k = set_.begin[at(j)]; k < set_.begin[at(j) + 1]; ++k) {
            sum += p_[k] * (heights_(j, set_.column[k]) - Z0_ - w_[k]);
        }
    return 0.5 * sum;
}

void PeriodicGrid::press_out() {
    for (std::size_t k = 0; k < p_.size(); ++k)
        if (p_[k] >= highest_) w_[k] = std::max(w_[k], 0.0);
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
