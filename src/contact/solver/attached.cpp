#include "contact/solver/attached.hpp"

#include "rough/parallel.hpp"

namespace rsc {
namespace {

using Vector = std::vector<double>;

constexpr int kMostSteps = 30, kMostProducts = 400;
// The residual is that of all asperities together, or this share of the largest relative to an asperity's own force and penetration of
// detachment: beside large forces small contacts would otherwise be inaccurate.
constexpr double kOwn = 1e-3, kRounding = 1e-9;
constexpr double kFarthest = 0.5;  // largest relative change of s in a step

double dot(const Vector& a, const Vector& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

// MINRES for symmetric indefinite systems (Paige and Saunders, SIAM J. Numer. Anal. 12, 1975): |b - M x| <= accuracy |b|.
template <class Multiply>
void minres(Multiply&& multiply, const Vector& b, double accuracy, Vector& x) {
    const std::size_t n = b.size();
    x.assign(n, 0.0);
    Vector v = b, before(n, 0.0), next(n), w(n, 0.0), w_before(n, 0.0), w_next(n);
    double beta = std::sqrt(dot(b, b)), left = beta, c = 1, c_before = 1, s = 0, s_before = 0;
    const double goal = accuracy * beta;
    for (std::size_t k = 0; k < std::min<std::size_t>(2 * n + 10, kMostProducts) && std::abs(left) > goal && beta > 0; ++k) {
        for (double& value : v) value /= beta;
        multiply(v, next);
        const double alpha = dot(v, next);
        for (std::size_t i = 0; i < n; ++i) next[i] -= alpha * v[i] + beta * before[i];
        const double beta_next = std::sqrt(dot(next, next));
        const double d = c * alpha - c_before * s * beta, r1 = std::hypot(d, beta_next), r2 = s * alpha + c_before * c * beta,
                     r3 = s_before * beta;
        if (!(r1 > 0)) break;
        c_before = c, s_before = s;
        c = d / r1, s = beta_next / r1;
        for (std::size_t i = 0; i < n; ++i) {
            w_next[i] = (v[i] - r3 * w_before[i] - r2 * w[i]) / r1;
            x[i] += c * left * w_next[i];
        }
        left *= -s;
        before.swap(v), v.swap(next);
        w_before.swap(w), w.swap(w_next);
        beta = beta_next;
    }
}

}  // namespace

void AttachedSolver::evaluate(const WorkingSet& set, const Vector& s) {
    stopping_point();
    const std::vector<int>& active = products_->active();
    const std::size_t n = active.size();
    state_.resize(n), f_.resize(n), res_.resize(n);
    phi_.assign(static_cast<std::size_t>(set.size()), 0.0);
    force_ = 0;
    for (std::size_t k = 0; k < n; ++k) {
        state_[k] = law_.at(set.asperity[static_cast<std::size_t>(active[k])], s[k]);
        f_[k] = state_[k].f;
        force_ += f_[k];
    }
    if (n > 0) products_->full(f_.data(), phi_.data());
    const double shift = products_->kernel().shift() * force_;
    for (double& phi : phi_) phi -= shift;
    energy_ = 0;
    double error2 = 0, size2 = 0, own = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const auto i = static_cast<std::size_t>(active[k]);
        const Sticking::State& now = state_[k];
        res_[k] = set.g0[i] - phi_[i] - now.u;
        energy_ += now.energy + now.f * (0.5 * phi_[i] + res_[k]);  // an error of second order in the residual
        const double miss = now.stiffness * res_[k], gap = std::abs(set.g0[i]) + std::abs(phi_[i]);
        const double size = std::hypot(now.stiffness * law_.lets_go(set.asperity[i]), now.f);
        error2 += miss * miss, size2 += size * size;
        own = std::max(own, std::abs(miss) / (size + kRounding * now.stiffness * gap));
    }
    residual_ = n > 0 ? std::max(std::sqrt(error2 / size2), kOwn * own) : 0.0;
    weigh(0);
}

void AttachedSolver::weigh(double mu) {
    const std::size_t n = state_.size();
    diagonal_.resize(n), p_.resize(n), to_s_.resize(n), in_.resize(n), out_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        const Sticking::State& now = state_[k];
        const double df = now.df + mu * now.stiffness, q = now.stiffness * now.du - now.df, sign = df < 0 ? -1.0 : 1.0;
        const double slope = std::max(std::abs(df), 1e-13 * now.stiffness);
        diagonal_[k] = sign * (sign * slope + q) / (slope + q);
        p_[k] = sign * std::sqrt(now.stiffness * slope / (slope + q));
        to_s_[k] = p_[k] / (sign * slope);
    }
}

void AttachedSolver::multiply(const Vector& y, Vector& image) {
    const double shift = products_->kernel().shift();
    double sum = 0;
    for (std::size_t k = 0; k < y.size(); ++k) sum += in_[k] = p_[k] * y[k];
    products_->inner(in_.data(), out_.data());
    for (std::size_t k = 0; k < y.size(); ++k) image[k] = diagonal_[k] * y[k] + p_[k] * (out_[k] - shift * sum);
}

void AttachedSolver::solve_linear(const Vector& right, double accuracy, Vector& ds) {
    Vector b(right.size());
    for (std::size_t k = 0; k < b.size(); ++k) b[k] = p_[k] * right[k];
    minres([this](const Vector& y, Vector& image) { multiply(y, image); }, b, accuracy, ds);
    for (std::size_t k = 0; k < b.size(); ++k) ds[k] *= to_s_[k];
}

bool AttachedSolver::stable() {
    const std::size_t n = state_.size();
    Vector right(n, -1.0), x;
    solve_linear(right, 1e-6, change_);
    const double shift = products_->kernel().shift();
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += in_[k] = state_[k].stiffness;
    products_->inner(in_.data(), right.data());
    double crowded = 0;  // largest row sum of B D: (I + B D)^-1 1 is positive if it is below 1
    for (double& value : right) value += -shift * sum, crowded = std::max(crowded, value), value += 1;
    const auto positive = [&](const Vector& ds, double sign) {
        weakest_ = 0;
        double lowest = 1;
        for (std::size_t k = 0; k < n; ++k) {
            if (std::isnan(ds[k])) return false;
            if (state_[k].df < 0 && sign * ds[k] < lowest) lowest = sign * ds[k], weakest_ = k;
        }
        return lowest > 0;
    };
    if (crowded < 1 && positive(change_, -1)) return true;
    solve_linear(right, 1e-6, x);
    return positive(x, 1);
}

bool AttachedSolver::solve(const WorkingSet& set, double tolerance, Vector& s) {
    double best = 1e300;
    int worse = 0;
    Vector ds;
    for (int step = 0;; ++step) {
        evaluate(set, s);
        if (residual_ <= tolerance) return stable();
        if (residual_ < 0.9 * best)
            best = residual_, worse = 0;
        else
            ++worse;
        if (step == kMostSteps || worse > 6 || !std::isfinite(residual_)) break;
        solve_linear(res_, std::clamp(0.1 * residual_, 1e-6, 1e-2), ds);
        for (std::size_t k = 0; k < s.size(); ++k) {
            const double least = law_.least(set.asperity[static_cast<std::size_t>(products_->active()[k])]);
            const double next = std::clamp(s[k] + ds[k], (1 - kFarthest) * s[k], (1 + kFarthest) * s[k]);
            s[k] = std::max(next, 0.5 * (s[k] + least));
        }
    }
    weakest_ = 0;
    double nearest = 1e300;
    for (std::size_t k = 0; k < s.size(); ++k) {
        const double margin = s[k] / law_.least(set.asperity[static_cast<std::size_t>(products_->active()[k])]);
        if (margin < nearest) nearest = margin, weakest_ = k;
    }
    return false;
}

std::optional<AttachedSolver::Relaxed> AttachedSolver::relax(const WorkingSet& set, double tolerance, Vector& s) {
    constexpr int most = 300;
    constexpr double near = 1e-3, longest = 0.3, stalled = 1e-9, shrunk = 0.05;  // steps relative to s; s relative to its least value
    Vector ds;
    double mu = 1;
    for (int step = 0; step < most; ++step) {
        evaluate(set, s);
        double change = 2 * longest;
        for (int k = 0; k < 60 && change > longest; ++k) {
            weigh(mu);
            if (!stable()) {
                mu *= 2;
                continue;
            }
            solve_linear(res_, 1e-3, ds);
            change = 0;
            for (std::size_t i = 0; i < s.size(); ++i) change = std::max(change, std::abs(ds[i]) / s[i]);
            if (change > longest) mu *= 2;
        }
        if (!(change <= longest) || change < stalled) break;
        for (std::size_t i = 0; i < s.size(); ++i) {
            s[i] += ds[i];
            if (s[i] < shrunk * law_.least(set.asperity[static_cast<std::size_t>(products_->active()[i])])) return Relaxed{i};
        }
        if (change < near * std::min(1.0, 1 / mu)) {
            Vector end = s;
            if (solve(set, tolerance, end)) {
                s = std::move(end);
                return Relaxed{};
            }
        }
        mu *= change < 0.5 * longest ? 0.5 : 1;
    }
    return std::nullopt;
}

AttachedSolver::Change AttachedSolver::change() {
    Change c;
    c.s = change_;
    const double shift = products_->kernel().shift();
    Vector df(state_.size());
    for (std::size_t k = 0; k < df.size(); ++k) c.force += df[k] = state_[k].df * c.s[k];
    c.u.assign(products_->passive().size(), 0.0);
    if (!df.empty()) products_->inner_passive(df.data(), c.u.data());
    for (double& u : c.u) u = -1 - u + shift * c.force;
    return c;
}

}  // namespace rsc
