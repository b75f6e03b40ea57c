#include "elements/elements.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace rsc {
namespace {

using Accuracy = PixelProducts::Accuracy;

// The working set contains all pixels within this distance of a pixel under pressure.
constexpr int kReach = 3;
// Largest number of conjugate-gradient steps in a round, and the reduction of the preconditioned
// residual that ends a round earlier.
constexpr int kSteps = 5;
constexpr double kReduction = 0.1;
// Residual below which pixels outside the working set are first checked.
constexpr double kClosing = 1e-2;
// rounds before the energy is monitored; most sets converge in about ten
constexpr int kQuick = 30;
// Share of pixels in the first guess above which the contact is deep in the roughness; for a smooth
// sphere it is one half.
constexpr double kDeep = 0.55;
// Residual, relative to the error of inner products, below which full products are used.
constexpr double kInnerReach = 10;
// relative to the tolerance: error of an exact product computed from an earlier one
constexpr double kChange = 0.05;

}  // namespace

ElementsSolver::ElementsSolver(PixelProducts& products, double highest)
    : BoundedSolver(highest, {kSteps, kReduction, kQuick, false}),
      products_(products),
      inverse_(products.inverse(0)) {}

// Hertz-like pressures: the root of the overlap `over` above s, with the s and the scale of
// smallest energy. `least` is the smallest energy so far, on entry and return. Returns the number
// of pixels under pressure; 0 and p unchanged if no such pressures have a smaller energy.
std::size_t ElementsSolver::guess(const std::vector<Pixel>& pixels, const std::vector<double>& g0,
                                  const std::vector<double>& over, double& least,
                                  std::vector<double>& p) {
    const double top = *std::max_element(over.begin(), over.end());
    if (!(top > 0)) return 0;
    const auto root = [&](std::size_t k, double s) { return std::sqrt(over[k] - s + 1e-3 * top); };
    std::vector<Pixel> some;
    std::vector<double> q, w, g;
    double lowest = 0, scale = 0, best = 0;
    const auto energy = [&](double s) {
        some.clear();
        q.clear();
        g.clear();
        for (std::size_t k = 0; k < pixels.size(); ++k) {
            if (!(over[k] >= s)) continue;
            some.push_back(pixels[k]);
            g.push_back(g0[k]);
            q.push_back(root(k, s));
        }
        w.resize(q.size());
        products_.set_pixels(some);
        products_.apply(q.data(), w.data(), Accuracy::inner);
        double a = 0, b = 0;
        for (std::size_t k = 0; k < q.size(); ++k) {
            a += q[k] * g[k];
            b += q[k] * (w[k] + diagonal_ * q[k]);
        }
        const double e = -0.5 * a * a / b;
        if (e < lowest) {
            lowest = e;
            scale = a / b;
            best = s;
        }
        return e;
    };
    double step = top / 8;
    for (int i = 7; i >= 0; --i) {
        if (energy(i * step) > 0.98 * lowest) break;  // beyond the minimum
    }
    for (int i = 0; i < 2; ++i) {
        step *= 0.5;
        const double middle = best;
        energy(middle - step);
        energy(middle + step);
    }
    if (!(lowest < least)) return 0;
    least = lowest;
    std::size_t chosen = 0;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        p[k] = over[k] >= best ? std::min(scale * root(k, best), highest_) : 0.0;
        chosen += p[k] > 0;
    }
    return chosen;
}

void ElementsSolver::start(const std::vector<Pixel>& pixels, const std::vector<double>& g0,
                           std::vector<double>& p) {
    double least = kInfinity;
    const std::size_t chosen = guess(pixels, g0, g0, least, p);
    if (!(static_cast<double>(chosen) > kDeep * static_cast<double>(pixels.size()))) return;
    // In the roughness the peaks carry the load: they stand out in the overlap that remains after
    // the deflection.
    std::vector<double> over(p.size());
    products_.set_pixels(pixels);
    products_.apply(p.data(), over.data(), Accuracy::inner);
    for (std::size_t k = 0; k < p.size(); ++k) over[k] = g0[k] - over[k] - diagonal_ * p[k];
    guess(pixels, g0, over, least, p);
}

// Selects the working set: members, and pixels within kReach of a member or of a pixel under
// pressure.
void ElementsSolver::draw(const std::vector<double>& p) {
    const std::vector<Pixel>& pixels = *pixels_;
    const std::size_t n = pixels.size();
    const int threads = threads_for(n);
    std::vector<int> row_begin,
        seeds;  // begin of each row that has pixels; members and pixels under pressure
    find_all(
        n, kPixels, threads,
        [&](std::size_t k) { return k == 0 || pixels[k].y != pixels[k - 1].y; }, row_begin);
    find_all(
        n, kPixels, threads, [&](std::size_t k) { return p[k] > 0 || member_[k]; }, seeds);
    const std::size_t rows = row_begin.size();
    row_begin.push_back(static_cast<int>(n));
    int left = std::numeric_limits<int>::max(),
        right = std::numeric_limits<int>::min();  // of all pixels, with their reach
    for (std::size_t r = 0; r < rows; ++r) {
        left = std::min(left, pixels[at(row_begin[r])].x - kReach);
        right = std::max(right, pixels[at(row_begin[r + 1] - 1)].x + kReach);
    }
    in_.resize(n);
    constexpr std::size_t together = 16;
    parallel_for((rows + together - 1) / together, 1, threads, [&](std::size_t piece) {
        std::vector<char> line(at(right - left + 1));
        for (std::size_t r = piece * together; r < std::min(rows, (piece + 1) * together); ++r) {
            const int y = pixels[at(row_begin[r])].y;
            std::size_t first = r, last = r;
            while (first > 0 && pixels[at(row_begin[first - 1])].y >= y - kReach) --first;
            while (last + 1 < rows && pixels[at(row_begin[last + 1])].y <= y + kReach) ++last;
            auto seed = std::lower_bound(seeds.begin(), seeds.end(), row_begin[first]);
            std::fill(line.begin(), line.end(), 0);
            for (; seed != seeds.end() && *seed < row_begin[last + 1]; ++seed)
                std::fill_n(line.data() + (pixels[at(*seed)].x - kReach - left), 2 * kReach + 1, 1);
            for (int k = row_begin[r]; k < row_begin[r + 1]; ++k)
                in_[at(k)] = line[at(pixels[at(k)].x - left)];
        }
    });
    w_.clear(), full_p_.clear();
    find_all(
        n, kPixels, threads, [&](std::size_t k) { return in_[k]; }, position_);
    const std::size_t size = position_.size();
    set_.resize(size), z_.resize(size), p_.resize(size);
    each([&](std::size_t k) {
        const std::size_t l = at(position_[k]);
        set_[k] = pixels[l];
        z_[k] = (*g0_)[l];
        p_[k] = p[l];
    });
    constexpr std::size_t part = 512;
    rows_ = {0};
    for (std::size_t k = part; k < size; k += part) rows_.push_back(k);
    rows_.push_back(size);
    if (!set_.empty()) products_.set_pixels(set_);
    enclose();
}

// Pressures of all pixels.
void ElementsSolver::spread(std::vector<double>& p) {
    parallel_for(p.size(), kPixels, threads_for(p.size()), [&](std::size_t k) { p[k] = 0; });
    each([&](std::size_t k) { p[at(position_[k])] = p_[k]; });
}

// An exact product is a full one, or the last full one plus a cheaper product with the change
// since, whose error is relative to the change.
void ElementsSolver::multiply(const Array<double>& x, Array<double>& Kx, bool exact) {
    const std::size_t n = x.size();
    Kx.resize(n);
    if (!exact) return products_.apply(x.data(), Kx.data(), Accuracy::inner);
    if (full_p_.size() == n) {
        // Sums of squares, by pieces.
        std::vector<double> change(n / kPixels + 1), all(change.size());
        step_.resize(n);
        each([&](std::size_t k) {
            step_[k] = x[k] - full_p_[k];
            if (step_[k] != 0 || x[k] != 0)
                change[k / kPixels] += step_[k] * step_[k], all[k / kPixels] += x[k] * x[k];
        });
        const double moved = std::accumulate(change.begin(), change.end(), 0.0),
                     whole = std::accumulate(all.begin(), all.end(), 0.0);
        for (const Accuracy accuracy : {Accuracy::inner, Accuracy::between}) {
            if (!(products_.error(accuracy) * std::sqrt(moved) <=
                  kChange * tolerance_ * std::sqrt(whole)))
                continue;
            products_.apply(step_.data(), Kx.data(), accuracy);
            each([&](std::size_t k) { Kx[k] += full_w_[k]; });
            return;
        }
    }
    products_.apply(x.data(), Kx.data(), Accuracy::full);
    full_p_ = x;
    full_w_ = Kx;
}

void ElementsSolver::multiply_roughly(const Array<double>& x, Array<double>& Kx) {
    Kx.resize(x.size());
    products_.apply(x.data(), Kx.data(), Accuracy::inner, free_.data());
}

// Places the working set on a plane for the preconditioner. At opposite sides of the plane pixels
// are farther apart than the stencil reaches.
void ElementsSolver::enclose() {
    plane_rows_.assign(1, 0);
    column_.resize(set_.size());
    if (set_.empty()) return;
    struct Width {
        int left = std::numeric_limits<int>::max(), right = std::numeric_limits<int>::min();
        Width operator+(const Width& o) const {
            return {std::min(left, o.left), std::max(right, o.right)};
        }
    };
    const auto [left, right] = sum_with<Width>([&](Width& part, std::size_t k) {
        part = part + Width{set_[k].x, set_[k].x};
    });
    const int reach = inverse_.reach(), low = set_.front().y,
              rows = set_.back().y - low + 1 + reach;
    plane_ = SparsePlane(right - left + 1 + reach, rows);
    plane_rows_.resize(at(rows) + 1);
    for (int row = 0; row <= rows; ++row)
        plane_rows_[at(row)] = static_cast<std::size_t>(
            std::ranges::lower_bound(set_, low + row, {}, &Pixel::y) - set_.begin());
    const int first = left;
    each([&](std::size_t k) { column_[k] = set_[k].x - first; });
}

void ElementsSolver::freed() {
    if (std::exchange(inverse_of_, diagonal_) != diagonal_) inverse_ = products_.inverse(diagonal_);
}

void ElementsSolver::precondition(const Array<double>& r, Array<double>& y) {
    struct Largest {
        double value = 0;
        Largest operator+(const Largest& o) const { return {std::max(value, o.value)}; }
    };
    const double unit =  // for single precision
        sum_with<Largest>([&](Largest& part, std::size_t k) {
            part.value = std::max(part.value, std::abs(r[k]));
        }).value;
    if (!(unit > 0)) return;
    from_.resize(r.size());
    to_.resize(r.size());
    each([&](std::size_t k) { from_[k] = free_[k] ? static_cast<float>(r[k] / unit) : 0.0f; });
    plane_.convolve(inverse_, {plane_rows_, column_}, from_.data(), to_.data(),
                    threads_for(r.size()));
    each([&](std::size_t k) { y[k] = free_[k] ? unit * static_cast<double>(to_[k]) : 0.0; });
}

bool ElementsSolver::judge_exactly(bool, double residual, int rounds) {
    // Z0 is not known before the next product
    const double guess = given_sum_ ? kReduction * residual : error();
    return (looked_ && guess < kInnerReach * products_.inner_error()) || guess < tolerance_ ||
           rounds > kQuick;
}

// Makes pixels outside the working set members if they would penetrate under the pressures p.
// Returns whether there are any.
bool ElementsSolver::join(const std::vector<double>& p) {
    if (position_.size() == p.size()) return false;
    elsewhere_.resize(p.size());
    outside_.resize(p.size());
    parallel_for(p.size(), kPixels, threads_for(p.size()),
                 [&](std::size_t k) { outside_[k] = !in_[k]; });
    products_.elsewhere(p.data(), *pixels_, elsewhere_.data(), outside_.data());
    // Pixels are selected by inner products with a margin for their error.
    const double margin = 3 * products_.inner_error();
    std::vector<int> joined;
    find_all(
        p.size(), kPixels, threads_for(p.size()),
        [&](std::size_t k) {
            const double w = elsewhere_[k];
            return !in_[k] && w * (w > 0 ? 1 - margin : 1 + margin) < (*g0_)[k] - Z0_;
        },
        joined);
    for (const int k : joined) member_[at(k)] = 1;
    return !joined.empty();
}

// Checks the pixels outside when the residual is small, and again at the end.
bool ElementsSolver::complete(bool solved, double residual) {
    if (!solved && (looked_ || residual > kClosing)) return false;
    spread(*answer_);
    looked_ = true;
    if (!join(*answer_)) return solved;
    draw(*answer_);
    return false;
}

ElementsOutcome ElementsSolver::solve(const std::vector<Pixel>& pixels,
                                      const std::vector<double>& g0, double tolerance,
                                      int most_iterations, std::vector<double>& p,
                                      std::optional<double> sum) {
    const long before = products_.count();
    pixels_ = &pixels;
    g0_ = &g0;
    answer_ = &p;
    tolerance_ = tolerance;
    given_sum_ = sum;
    Z0_ = 0;
    member_.assign(pixels.size(), 0);
    looked_ = false;
    for (double& v : p) v = std::min(v, highest_);
    if (!p.empty() && std::none_of(p.begin(), p.end(), [](double v) { return v > 0; }))
        start(pixels, g0, p);
    draw(p);
    ElementsOutcome outcome;
    outcome.converged = set_.empty();  // nothing touches
    if (!set_.empty()) outcome = iterate(tolerance, most_iterations, true);
    spread(p);
    outcome.products = products_.count() - before;
    return outcome;
}

std::vector<std::pair<Pixel, double>> ElementsSolver::press_out() {
    std::vector<std::pair<Pixel, double>> lowered;
    for (const auto& [k, depth] : BoundedSolver::press_out())
        lowered.emplace_back(set_[at(k)], depth);
    return lowered;
}

void ElementsSolver::keep(ArchiveWriter& to) const {
    const BoundedSolver<double>& solved = *this;
    archive(to, solved);
    to(set_);
}

void ElementsSolver::recall(ArchiveReader& from, int columns, int rows) {
    BoundedSolver<double>& solved = *this;
    archive(from, solved);
    from(set_);
    if (!fits(set_.size()) || !within(set_, columns, rows))
        bad_input("the state does not belong to a contact of this surface");
    if (!set_.empty()) products_.set_pixels(set_);
    enclose();
}

bool within(const std::vector<Pixel>& pixels, int columns, int rows) {
    return std::ranges::all_of(pixels, [&](const Pixel& pixel) {
        return pixel.x >= 0 && pixel.x < columns && pixel.y >= 0 && pixel.y < rows;
    });
}

double ElementsSolver::stiffness(double tolerance, bool back) {
    constexpr int rounds = 60;
    tolerance_ = 0;  // products in full, so that nothing depends on the last one
    return BoundedSolver::stiffness(back, tolerance, rounds, 4 * kSteps,
                                    std::max(0.1 * products_.inner_error(), 1e-3));
}

}  // namespace rsc
