#include "contact/solver/elements.hpp"
#include "rough/parallel.hpp"

namespace rsc {
namespace {

using Accuracy = PixelProducts::Accuracy;
std::size_t at(int k) { return static_cast<std::size_t>(k); }

// The working set holds what lies within so many pixels of a pixel under pressure.
constexpr int kReach = 3;
// A round of conjugate gradients: steps at most, and the reduction of the preconditioned residual that ends it sooner.
constexpr int kSteps = 5;
constexpr double kReduction = 0.1;
// Pixels outside are looked at first when the residual is so small, and again at the end.
constexpr double kClosing = 1e-2;
// Rounds from which the energy is watched: sets that settle do so in some ten rounds.
constexpr int kQuick = 30;
// Deep in the roughness, the first guess of a start covers more than this share of the pixels; a smooth sphere's covers half.
constexpr double kDeep = 0.55;
// Full products are taken from where inner ones no longer tell, in units of their error.
constexpr double kInnerReach = 10;

}  // namespace

ElementsSolver::ElementsSolver(PixelProducts& products, double highest) : products_(products), highest_(highest) {}

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
void ElementsSolver::draw(const std::vector<Pixel>& pixels, const std::vector<double>& g0, const std::vector<double>& p) {
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
    position_.clear();
    set_.clear();
    g0_.clear();
    p_.clear();
    for (std::size_t k = 0; k < n; ++k) {
        if (!in[k]) continue;
        position_.push_back(static_cast<int>(k));
        set_.push_back(pixels[k]);
        g0_.push_back(g0[k]);
        p_.push_back(p[k]);
    }
    w_.resize(set_.size());
    products_.set_pixels(set_);
}

void ElementsSolver::evaluate(Accuracy accuracy) {
    stopping_point();
    products_.apply(p_.data(), w_.data(), accuracy);
    for (std::size_t k = 0; k < w_.size(); ++k) w_[k] -= g0_[k];
}

double ElementsSolver::error() const {
    double bad = 0, weight = 0, overlap = 0;
    std::size_t touching = 0;
    for (std::size_t k = 0; k < p_.size(); ++k) {
        const double e = p_[k] >= highest_ ? std::max(w_[k], 0.0) : p_[k] > 0 ? w_[k] : std::min(w_[k], 0.0);
        bad += e * e;
        touching += p_[k] > 0;
        weight += p_[k];
        overlap += p_[k] * g0_[k];
    }
    if (touching == 0) return bad > 0 ? std::numeric_limits<double>::infinity() : 0.0;
    return std::sqrt(bad / static_cast<double>(touching)) / (overlap / weight);
}

void ElementsSolver::find_free() {
    free_.clear();
    std::vector<Pixel> pixels;
    for (std::size_t k = 0; k < p_.size(); ++k) {
        const bool held = (p_[k] <= 0 && w_[k] >= 0) || (p_[k] >= highest_ && w_[k] <= 0);
        if (held) continue;
        free_.push_back(static_cast<int>(k));
        pixels.push_back(set_[k]);
    }
    blocks_.assign(pixels, products_);
}

// Conjugate gradients on the free pixels.
void ElementsSolver::descend(int most_steps, double reduction) {
    const std::size_t n = free_.size();
    r_.resize(n);
    z_.resize(n);
    direction_.assign(set_.size(), 0.0);
    image_.resize(set_.size());
    double last = 0, first = 0;
    for (int step = 0;; ++step) {
        double rz = 0;
        for (std::size_t k = 0; k < n; ++k) r_[k] = -w_[at(free_[k])];
        blocks_.apply(r_.data(), z_.data());
        for (std::size_t k = 0; k < n; ++k) rz += r_[k] * z_[k];
        if (step == 0) first = rz;
        if (step == most_steps || !(rz > reduction * reduction * first)) return;
        const double beta = step > 0 ? rz / last : 0.0;
        last = rz;
        for (std::size_t k = 0; k < n; ++k) {
            double& d = direction_[at(free_[k])];
            d = z_[k] + beta * d;
        }
        stopping_point();
        products_.apply(direction_.data(), image_.data(), Accuracy::inner);
        double curvature = 0;
        for (int k : free_) curvature += direction_[at(k)] * image_[at(k)];
        if (!(curvature > 0)) return;
        const double alpha = rz / curvature;
        for (std::size_t k = 0; k < p_.size(); ++k) {
            p_[k] += alpha * direction_[k];
            w_[k] += alpha * image_[k];
        }
    }
}

// Pressures into their bounds. Returns how many were outside.
long ElementsSolver::bound() {
    long cut = 0;
    for (int k : free_) {
        double& value = p_[at(k)];
        const double inside = std::clamp(value, 0.0, highest_);
        cut += inside != value;
        value = inside;
    }
    return cut;
}

// Cutting pressures off may raise the energy. Then the answer is looked for between the round's start and its end, and where the energy
// does not fall that way, by a gradient step. The energy along p + t d is a parabola with the slope w'd and the curvature d'Kd.
void ElementsSolver::keep_falling(Accuracy accuracy) {
    const std::size_t n = p_.size();
    const auto back = [&](double least_fall) {
        double slope = 0, curvature = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const double d = p_[k] - before_p_[k];
            slope += d * before_w_[k];
            curvature += d * (w_[k] - before_w_[k]);
        }
        if (slope + 0.5 * curvature <= least_fall * slope) return true;
        const double t = slope < 0 && curvature > 0 ? std::min(1.0, -slope / curvature) : 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            p_[k] = before_p_[k] + t * (p_[k] - before_p_[k]);
            w_[k] = before_w_[k] + t * (w_[k] - before_w_[k]);
        }
        return t > 0;
    };
    if (back(0)) return;
    // The gradient over the pixels that may move along it, its best step, cut off, and the best part of that way.
    double square = 0, curvature = 0;
    std::fill(direction_.begin(), direction_.end(), 0.0);
    for (int k : free_) direction_[at(k)] = -w_[at(k)];
    products_.apply(direction_.data(), image_.data(), Accuracy::inner);
    for (std::size_t k = 0; k < n; ++k) square += direction_[k] * direction_[k], curvature += direction_[k] * image_[k];
    if (!(curvature > 0)) return;
    for (std::size_t k = 0; k < n; ++k) p_[k] = std::clamp(p_[k] + square / curvature * direction_[k], 0.0, highest_);
    evaluate(accuracy);
    back(0);
}

// Pixels outside that would penetrate become members. Returns how many.
long ElementsSolver::join(const std::vector<Pixel>& pixels, const std::vector<double>& g0) {
    std::vector<Pixel> outside;
    std::vector<int> where;
    std::size_t next = 0;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        if (next < position_.size() && at(position_[next]) == k) {
            ++next;
            continue;
        }
        outside.push_back(pixels[k]);
        where.push_back(static_cast<int>(k));
    }
    if (outside.empty()) return 0;
    std::vector<double> w(outside.size());
    products_.elsewhere(p_.data(), outside, w.data());
    long joined = 0;
    // Pixels are selected by inner products; those within their error are added, and checked by full products.
    const double margin = 1 - 3 * products_.inner_error();
    for (std::size_t k = 0; k < outside.size(); ++k) {
        if (!(w[k] * margin < g0[at(where[k])])) continue;
        member_[at(where[k])] = 1;
        ++joined;
    }
    return joined;
}

ElementsOutcome ElementsSolver::solve(const std::vector<Pixel>& pixels, const std::vector<double>& g0, double tolerance,
                                      int most_iterations, std::vector<double>& p) {
    ElementsOutcome outcome;
    const long before = products_.count();
    member_.assign(pixels.size(), 0);
    if (pixels.empty()) {
        position_.clear(), set_.clear(), g0_.clear(), p_.clear(), w_.clear(), free_.clear();
        outcome.converged = true;
        return outcome;
    }
    for (double& v : p) v = std::min(v, highest_);
    if (std::none_of(p.begin(), p.end(), [](double v) { return v > 0; })) start(pixels, g0, p);
    draw(pixels, g0, p);
    evaluate(Accuracy::inner);
    bool exact = false;   // w_ comes from a full product
    bool looked = false;  // pixels outside were looked at, and those that joined are in
    while (outcome.iterations < most_iterations) {
        ++outcome.iterations;
        find_free();
        if (free_.empty()) {  // every pixel at the highest pressure, or none under any
            evaluate(Accuracy::full);
            exact = true;
        } else {
            before_p_ = p_;
            before_w_ = w_;
            descend(kSteps, kReduction);
            const long cut = bound();
            const double guess = error();
            const bool careful = outcome.iterations > kQuick;
            exact = (looked && guess < kInnerReach * products_.inner_error()) || guess < tolerance || careful;
            const Accuracy accuracy = exact ? Accuracy::full : Accuracy::inner;
            if (cut > 0 || exact) evaluate(accuracy);
            if (cut > 0 && careful) keep_falling(accuracy);
        }
        outcome.residual = error();
        const bool solved = exact && outcome.residual <= tolerance;
        if (!solved && (looked || outcome.residual > kClosing)) continue;
        const long joined = join(pixels, g0);
        looked = true;
        if (joined == 0) {
            outcome.converged = solved;
            if (solved) break;
            continue;
        }
        std::vector<double> all(pixels.size(), 0.0);
        for (std::size_t k = 0; k < p_.size(); ++k) all[at(position_[k])] = p_[k];
        draw(pixels, g0, all);
        evaluate(exact ? Accuracy::full : Accuracy::inner);
    }
    std::fill(p.begin(), p.end(), 0.0);
    for (std::size_t k = 0; k < p_.size(); ++k) p[at(position_[k])] = p_[k];
    outcome.products = products_.count() - before;
    return outcome;
}

double ElementsSolver::energy() const {
    double sum = 0;
    for (std::size_t k = 0; k < p_.size(); ++k) sum += p_[k] * (p_[k] < highest_ ? g0_[k] - w_[k] : g0_[k] + w_[k]);
    return 0.5 * sum;
}

void ElementsSolver::press_out(std::vector<Pixel>& pixels, std::vector<double>& depth) {
    pixels.clear();
    depth.clear();
    for (std::size_t k = 0; k < p_.size(); ++k) {
        if (!(p_[k] >= highest_ && w_[k] < 0)) continue;
        pixels.push_back(set_[k]);
        depth.push_back(-w_[k]);
        g0_[k] += w_[k];
        w_[k] = 0;
    }
}

double ElementsSolver::stiffness(double tolerance, Way way) {
    free_.clear();
    std::vector<Pixel> pixels;
    for (std::size_t k = 0; k < p_.size(); ++k) {
        if (!(p_[k] > 0 && (way == Way::back || p_[k] < highest_))) continue;
        free_.push_back(static_cast<int>(k));
        pixels.push_back(set_[k]);
    }
    if (free_.empty()) return 0;
    blocks_.assign(pixels, products_);
    // The same steps on the same matrix, with 1 for g0; the answer of the level is put back afterwards.
    const std::vector<double> p = p_, w = w_;
    std::fill(p_.begin(), p_.end(), 0.0);
    std::fill(w_.begin(), w_.end(), -1.0);
    constexpr int rounds = 60;
    for (int round = 0; round < rounds; ++round) {
        descend(4 * kSteps, std::max(0.1 * products_.inner_error(), 1e-3));
        products_.apply(p_.data(), w_.data(), Accuracy::full);
        double square = 0;
        for (double& v : w_) v -= 1;
        for (int k : free_) square += w_[at(k)] * w_[at(k)];
        if (std::sqrt(square / static_cast<double>(free_.size())) <= tolerance) break;
    }
    double sum = 0;
    for (int k : free_) sum += p_[at(k)];
    p_ = p;
    w_ = w;
    return sum;
}

}  // namespace rsc
