#include "contact/solver/elements.hpp"

namespace rsc {
namespace {

using Accuracy = PixelProducts::Accuracy;
std::size_t at(int k) { return static_cast<std::size_t>(k); }

// The working set holds what lies within so many pixels of a pixel under pressure.
constexpr int kReach = 3;
// A round of conjugate gradients: steps at most, and the reduction of the preconditioned residual that ends it sooner.
constexpr int kSteps = 5;
constexpr double kReduction = 0.1;
// Pixels outside are looked at first when the residual is so small.
constexpr double kClosing = 1e-2;
constexpr int kQuick = 30;  // rounds: sets that settle do so in some ten
// Deep in the roughness, the first guess of a start covers more than this share of the pixels; a smooth sphere's covers half.
constexpr double kDeep = 0.55;
// Full products are taken from where inner ones no longer tell, in units of their error.
constexpr double kInnerReach = 10;
constexpr double kChange = 0.05;  // of the tolerance: error of an exact product that was got from an earlier one

}  // namespace

ElementsSolver::ElementsSolver(PixelProducts& products, double highest)
    : BoundedSolver(highest, {kSteps, kReduction, kQuick, false}), products_(products) {}

// Pressures like those of Hertz, the root of the overlap `over` above s, with the s and the scale of least energy, which `least` is on
// entry and return. Returns how many pixels carry them; 0, and p as it was, where none have less energy.
std::size_t ElementsSolver::guess(const std::vector<Pixel>& pixels, const std::vector<double>& g0, const std::vector<double>& over,
                                  double& least, std::vector<double>& p) {
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
        for (std::size_t k = 0; k < q.size(); ++k) a += q[k] * g[k], b += q[k] * w[k];
        const double e = -0.5 * a * a / b;
        if (e < lowest) lowest = e, scale = a / b, best = s;
        return e;
    };
    double step = top / 8;
    for (int i = 7; i >= 0; --i) {
        if (energy(i * step) > 0.98 * lowest) break;  // past the minimum
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

void ElementsSolver::start(const std::vector<Pixel>& pixels, const std::vector<double>& g0, std::vector<double>& p) {
    double least = std::numeric_limits<double>::infinity();
    const std::size_t chosen = guess(pixels, g0, g0, least, p);
    if (!(static_cast<double>(chosen) > kDeep * static_cast<double>(pixels.size()))) return;
    // The peaks of the roughness carry: they stand out in what is left of the overlap once the surface is deflected.
    std::vector<double> over(p.size());
    products_.set_pixels(pixels);
    products_.apply(p.data(), over.data(), Accuracy::inner);
    for (std::size_t k = 0; k < p.size(); ++k) over[k] = g0[k] - over[k];
    guess(pixels, g0, over, least, p);
}

// The working set: members, and pixels within kReach of one that is a member or under pressure.
void ElementsSolver::draw(const std::vector<double>& p) {
    const std::vector<Pixel>& pixels = *pixels_;
    const std::size_t n = pixels.size();
    std::vector<std::size_t> row_begin;  // of the rows that have pixels
    for (std::size_t k = 0; k < n; ++k) {
        if (k == 0 || pixels[k].y != pixels[k - 1].y) row_begin.push_back(k);
    }
    const std::size_t rows = row_begin.size();
    row_begin.push_back(n);
    std::vector<char> in(n, 0);
    for (std::size_t r = 0; r < rows; ++r) {
        const int y = pixels[row_begin[r]].y;
        for (std::size_t s = r < at(kReach) ? 0 : r - at(kReach); s < rows && pixels[row_begin[s]].y <= y + kReach; ++s) {
            if (pixels[row_begin[s]].y < y - kReach) continue;
            std::size_t k = row_begin[r];
            for (std::size_t l = row_begin[s]; l < row_begin[s + 1]; ++l) {
                if (!(p[l] > 0) && !member_[l]) continue;
                while (k < row_begin[r + 1] && pixels[k].x < pixels[l].x - kReach) ++k;
                while (k < row_begin[r + 1] && pixels[k].x <= pixels[l].x + kReach) in[k++] = 1;
            }
        }
    }
    position_.clear(), set_.clear(), z_.clear(), p_.clear(), w_.clear(), full_p_.clear();
    for (std::size_t k = 0; k < n; ++k) {
        if (!in[k]) continue;
        position_.push_back(static_cast<int>(k));
        set_.push_back(pixels[k]);
        z_.push_back((*g0_)[k]);
        p_.push_back(p[k]);
    }
    rows_ = {0, set_.size()};
    if (!set_.empty()) products_.set_pixels(set_);
}

// An exact product is a full one, or the last full one plus a cheaper product with what has changed since: the error of that is relative to the
// change.
void ElementsSolver::multiply(const std::vector<double>& x, std::vector<double>& Kx, bool exact) {
    const std::size_t n = x.size();
    Kx.resize(n);
    if (!exact) return products_.apply(x.data(), Kx.data(), Accuracy::inner);
    if (full_p_.size() == n) {
        double change = 0, all = 0;
        r_.resize(n);
        for (std::size_t k = 0; k < n; ++k) r_[k] = x[k] - full_p_[k], change += r_[k] * r_[k], all += x[k] * x[k];
        for (const Accuracy accuracy : {Accuracy::inner, Accuracy::between}) {
            if (!(products_.error(accuracy) * std::sqrt(change) <= kChange * tolerance_ * std::sqrt(all))) continue;
            products_.apply(r_.data(), Kx.data(), accuracy);
            for (std::size_t k = 0; k < n; ++k) Kx[k] += full_w_[k];
            return;
        }
    }
    products_.apply(x.data(), Kx.data(), Accuracy::full);
    full_p_ = x, full_w_ = Kx;
}

void ElementsSolver::freed() {
    std::vector<Pixel> pixels;
    for (std::size_t k = 0; k < set_.size(); ++k)
        if (free_[k]) pixels.push_back(set_[k]);
    blocks_.assign(pixels, products_);
}

void ElementsSolver::precondition(const std::vector<double>& r, std::vector<double>& y) {
    r_.clear();
    for (std::size_t k = 0; k < r.size(); ++k)
        if (free_[k]) r_.push_back(r[k]);
    y_.resize(r_.size());
    if (!r_.empty()) blocks_.apply(r_.data(), y_.data());
    y.assign(r.size(), 0.0);
    for (std::size_t k = 0, l = 0; k < r.size(); ++k)
        if (free_[k]) y[k] = y_[l++];
}

bool ElementsSolver::judge_exactly(bool, double residual, int rounds) {
    const double guess = wanted_ ? kReduction * residual : error();  // Z0 is not known before the next product
    return (looked_ && guess < kInnerReach * products_.inner_error()) || guess < tolerance_ || rounds > kQuick;
}

// Pixels outside that would penetrate become members. Returns how many.
long ElementsSolver::join() {
    const std::vector<Pixel>& pixels = *pixels_;
    std::vector<Pixel> others;
    std::vector<int> where;
    std::size_t next = 0;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        if (next < position_.size() && at(position_[next]) == k) {
            ++next;
            continue;
        }
        others.push_back(pixels[k]);
        where.push_back(static_cast<int>(k));
    }
    if (others.empty()) return 0;
    std::vector<double> w(others.size());
    products_.elsewhere(p_.data(), others, w.data());
    long joined = 0;
    // Pixels are selected by inner products; those within their error are added, and checked by full products.
    const double margin = 1 - 3 * products_.inner_error();
    for (std::size_t k = 0; k < others.size(); ++k) {
        if (!(w[k] * margin < (*g0_)[at(where[k])] - Z0_)) continue;
        member_[at(where[k])] = 1;
        ++joined;
    }
    return joined;
}

// Pixels outside are looked at when the residual is small, and again at the end.
bool ElementsSolver::complete(bool solved, double residual) {
    if (!solved && (looked_ || residual > kClosing)) return false;
    const long joined = join();
    looked_ = true;
    if (joined == 0) return solved;
    std::vector<double> all(pixels_->size(), 0.0);
    for (std::size_t k = 0; k < p_.size(); ++k) all[at(position_[k])] = p_[k];
    draw(all);
    return false;
}

ElementsOutcome ElementsSolver::solve(const std::vector<Pixel>& pixels, const std::vector<double>& g0, double tolerance,
                                      int most_iterations, std::vector<double>& p, std::optional<double> sum) {
    const long before = products_.count();
    pixels_ = &pixels, g0_ = &g0;
    tolerance_ = tolerance;
    wanted_ = sum;
    Z0_ = 0;
    member_.assign(pixels.size(), 0);
    looked_ = false;
    for (double& v : p) v = std::min(v, highest_);
    if (!p.empty() && std::none_of(p.begin(), p.end(), [](double v) { return v > 0; })) start(pixels, g0, p);
    draw(p);
    ElementsOutcome outcome;
    outcome.converged = pixels.empty();
    if (!pixels.empty()) outcome = iterate(tolerance, most_iterations, true);
    std::fill(p.begin(), p.end(), 0.0);
    for (std::size_t k = 0; k < p_.size(); ++k) p[at(position_[k])] = p_[k];
    outcome.products = products_.count() - before;
    return outcome;
}

void ElementsSolver::press_out(std::vector<Pixel>& pixels, std::vector<double>& depth) {
    pixels.clear();
    depth.clear();
    for (const auto& [k, d] : BoundedSolver::press_out()) pixels.push_back(set_[at(k)]), depth.push_back(d);
}

double ElementsSolver::stiffness(double tolerance, bool back) {
    constexpr int rounds = 60;
    tolerance_ = tolerance;
    return BoundedSolver::stiffness(back, tolerance, rounds, 4 * kSteps, std::max(0.1 * products_.inner_error(), 1e-3));
}

}  // namespace rsc
