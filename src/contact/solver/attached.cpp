#include "contact/solver/attached.hpp"

#include "contact/solver/uniqueness.hpp"
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

// MINRES for symmetric indefinite systems (Paige and Saunders, SIAM J. Numer. Anal. 12, 1975): |b - M x| <= accuracy |b|. Starts from x, or
// from 0 if it is empty.
template <class Multiply>
void minres(Multiply&& multiply, const Vector& b, double accuracy, Vector& x) {
    const std::size_t n = b.size();
    Vector v = b, before(n, 0.0), next(n), w(n, 0.0), w_before(n, 0.0), w_next(n);
    const double goal = accuracy * std::sqrt(dot(b, b));
    if (!x.empty()) {
        multiply(x, next);
        for (std::size_t i = 0; i < n; ++i) v[i] -= next[i];
    }
    if (x.empty() || !(dot(v, v) < dot(b, b))) x.assign(n, 0.0), v = b;
    double beta = std::sqrt(dot(v, v)), left = beta, c = 1, c_before = 1, s = 0, s_before = 0;
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

double AttachedSolver::miss(const WorkingSet& set, const Vector& res) const {
    double error2 = 0, size2 = 0, own = 0;
    for (std::size_t k = 0; k < res.size(); ++k) {
        if (k == held_) continue;
        const auto i = static_cast<std::size_t>(products_->active()[k]);
        const Sticking::State& now = state_[k];
        const double error = now.stiffness * res[k], gap = std::abs(set.g0[i]) + std::abs(phi_[i]);
        const double weak = now.stiffness * law_.lets_go(set.asperity[i]), size = weak * weak + now.f * now.f;
        error2 += error * error, size2 += size;
        own = std::max(own, std::abs(error) / (std::sqrt(size) + kRounding * now.stiffness * gap));
    }
    return size2 == 0 ? 0.0 : std::max(std::sqrt(error2 / size2), kOwn * own);
}

void AttachedSolver::evaluate(const WorkingSet& set, const Vector& s, bool full) {
    stopping_point();
    const std::vector<int>& active = products_->active();
    const std::size_t n = active.size();
    state_.resize(n), f_.resize(n), res_.resize(n), df_.assign(n, 0.0), out_.assign(n, 0.0);
    force_ = 0;
    for (std::size_t k = 0; k < n; ++k) {
        state_[k] = law_.at(set.asperity[static_cast<std::size_t>(active[k])], s[k]);
        f_[k] = state_[k].f;
        force_ += f_[k];
    }
    if (!full && std::includes(active.begin(), active.end(), reference_.begin(), reference_.end())) {
        Vector f(n, 0.0);  // new ones had no force
        for (std::size_t k = 0, j = 0; k < n && j < reference_.size(); ++k)
            if (active[k] == reference_[j]) f[k] = f_reference_[j++];
        reference_ = active, f_reference_ = std::move(f);
    }
    if (full || n == 0 || phi_reference_.empty() || active != reference_) {
        reference_ = active, f_reference_ = f_;
        phi_reference_.assign(static_cast<std::size_t>(set.size()), 0.0);
        if (n > 0) products_->full(f_.data(), phi_reference_.data());
        noise_reference_ = 0;
    } else {
        for (std::size_t k = 0; k < n; ++k) df_[k] = f_[k] - f_reference_[k];
        products_->inner(df_.data(), out_.data());
    }
    phi_ = phi_reference_;
    for (std::size_t k = 0; k < n; ++k) phi_[static_cast<std::size_t>(active[k])] += out_[k];
    balance(set);
}

// Residual, energy and noise from forces and phi_ of the present states; on entry out_ holds the elevations by df_ from inner products.
void AttachedSolver::balance(const WorkingSet& set) {
    const std::vector<int>& active = products_->active();
    const std::size_t n = active.size();
    const double shift = products_->kernel().shift() * force_;
    for (double& phi : phi_) phi -= shift;
    const double f2 = dot(f_, f_), share = f2 > 0 ? std::sqrt(dot(df_, df_) / f2) : 0.0;
    energy_ = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const auto i = static_cast<std::size_t>(active[k]);
        const Sticking::State& now = state_[k];
        res_[k] = set.g0[i] - phi_[i] - now.u;
        energy_ += now.energy + now.f * (0.5 * phi_[i] + res_[k]);  // an error of second order in the residual
        out_[k] = products_->inner_error() * (2 * std::abs(out_[k]) + share * std::abs(phi_[i]));
    }
    residual_ = miss(set, res_), noise_ = noise_reference_ + miss(set, out_);
    weigh(0);
}

void AttachedSolver::weigh(double mu) {
    const std::size_t n = state_.size();
    mu_ = mu;
    diagonal_.resize(n), p_.resize(n), to_s_.resize(n), in_.resize(n), out_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        const Sticking::State& now = state_[k];
        const double df = now.df + mu * now.stiffness, q = now.stiffness * now.du - now.df, sign = df < 0 ? -1.0 : 1.0;
        const double slope = std::max(std::abs(df), 1e-13 * now.stiffness);
        diagonal_[k] = sign * (sign * slope + q) / (slope + q);
        p_[k] = sign * std::sqrt(now.stiffness * slope / (slope + q));
        to_s_[k] = p_[k] / (sign * slope);
    }
    if (held_ < n) diagonal_[held_] = 1, p_[held_] = to_s_[held_] = 0;
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
    for (std::size_t k = 0; k < ds.size(); ++k) ds[k] /= to_s_[k];
    minres([this](const Vector& y, Vector& image) { multiply(y, image); }, b, accuracy, ds);
    for (std::size_t k = 0; k < b.size(); ++k) ds[k] *= to_s_[k];
}

// True if I + B D is stable: D^-1 + B is positive definite. A proof for stiffer asperities holds for softer and fewer ones.
bool AttachedSolver::apart(const WorkingSet& set) {
    const Kernel& kernel = products_->kernel();
    const std::vector<int>& active = products_->active();
    const std::size_t n = state_.size();
    stiffest_.resize(phi_.size(), 0.0);
    bool covered = true;
    for (std::size_t k = 0; k < n && covered; ++k) covered = state_[k].stiffness <= stiffest_[static_cast<std::size_t>(active[k])];
    if (covered) return true;
    std::fill(stiffest_.begin(), stiffest_.end(), 0.0);
    std::vector<double> x(n), y(n), a(n);
    for (const double wider : {1.2, 1.0}) {
        for (std::size_t k = 0; k < n; ++k) {
            const auto i = static_cast<std::size_t>(active[k]);
            x[k] = set.x[i], y[k] = set.y[i], a[k] = wider * state_[k].stiffness / (2 * kernel.modulus());
        }
        if (!kernel.none() && !positive_definite_by_shells(x, y, a)) continue;
        for (std::size_t k = 0; k < n; ++k) stiffest_[static_cast<std::size_t>(active[k])] = wider * state_[k].stiffness;
        return true;
    }
    return false;
}

bool AttachedSolver::proved(const WorkingSet& set) {
    constexpr int most = 6;
    constexpr double certain = 1e-3;  // share of diag(u') v that must be left; products may have small errors
    const std::vector<int>& active = products_->active();
    const auto place = [&](std::size_t k) { return static_cast<std::size_t>(active[k]); };
    if (products_->kernel().lattice() || products_->kernel().smooth() || !apart(set)) return false;  // the proof needs B >= 0
    proof_.resize(phi_.size(), 0.0);
    for (int round = 0; round < most; ++round) {
        bool any = false, holds = true;
        for (std::size_t k = 0; k < state_.size(); ++k) {
            const double du = state_[k].du + mu_, df = state_[k].df + mu_ * state_[k].stiffness;
            in_[k] = 0;
            if (df >= 0 || k == held_) continue;
            if (!(du > 0)) return false;
            in_[k] = proof_[place(k)] > 0 ? proof_[place(k)] : 1 / du, any = true;
        }
        if (!any) return true;
        products_->inner(in_.data(), out_.data());
        for (std::size_t k = 0; k < state_.size(); ++k) {
            if (in_[k] == 0) continue;
            const double du = state_[k].du + mu_, df = state_[k].df + mu_ * state_[k].stiffness;
            if (!(std::abs(df * out_[k]) + 2 * products_->inner_error() * std::abs(df) * std::abs(out_[k]) < (1 - certain) * du * in_[k]))
                holds = false;
            proof_[place(k)] = (1 - df * out_[k]) / du;
        }
        if (holds) return true;
    }
    return false;
}

bool AttachedSolver::stable(const WorkingSet& set) {
    const std::size_t n = state_.size();
    for (std::size_t k = 0; k < n; ++k)
        if (1 + state_[k].stiffness * products_->kernel().self() <= 0) {  // sinks in by itself on a soft layer: no minimum of the energy
            weakest_ = k;
            return false;
        }
    if (proved(set)) return true;
    Vector right(n, -1.0), derivative, x;
    solve_linear(right, 1e-6, derivative);
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
            if (state_[k].df < 0 && k != held_ && sign * ds[k] < lowest) lowest = sign * ds[k], weakest_ = k;
        }
        return lowest > 0;
    };
    if (crowded < 1 && positive(derivative, -1)) return true;
    solve_linear(right, 1e-6, x);
    return positive(x, 1);
}

void AttachedSolver::step(const WorkingSet& set, double accuracy, Vector& s) {
    Vector ds;
    solve_linear(res_, accuracy, ds);
    for (std::size_t k = 0; k < s.size(); ++k) {
        const double least = law_.least(set.asperity[static_cast<std::size_t>(products_->active()[k])]);
        const double next = std::clamp(s[k] + ds[k], (1 - kFarthest) * s[k], (1 + kFarthest) * s[k]);
        s[k] = std::max(next, 0.5 * (s[k] + least));
    }
}

void AttachedSolver::rest_on(const WorkingSet& set, double noise, const Vector& s, bool solved) {
    if (!solved) held_ = ~std::size_t{0}, evaluate(set, s, false);
    if (noise_ > noise) return evaluate(set, s, true);
    add_passive();
    const double shift = products_->kernel().shift() * force_;
    reference_ = products_->active(), f_reference_ = f_, phi_reference_ = phi_, noise_reference_ = noise_;
    for (double& phi : phi_reference_) phi += shift;
}

void AttachedSolver::release(std::size_t k) {
    if (products_->active() != reference_) return;
    Vector part(phi_reference_.size());
    products_->set_active({reference_[k]});
    products_->inner_everywhere(&f_reference_[k], part.data());
    for (std::size_t i = 0; i < part.size(); ++i) phi_reference_[i] -= part[i];
    reference_.erase(reference_.begin() + static_cast<std::ptrdiff_t>(k));
    f_reference_.erase(f_reference_.begin() + static_cast<std::ptrdiff_t>(k));
}

double AttachedSolver::elevation(const WorkingSet& set, int position) {
    const auto i = static_cast<std::size_t>(position);
    double more = 0;
    if (!df_.empty()) products_->elsewhere(df_.data(), 1, &set.x[i], &set.y[i], &more);
    return phi_[i] + more;
}

// Adds the change of the forces to phi_ at the others.
void AttachedSolver::add_passive() {
    const std::vector<int>& passive = products_->passive();
    if (df_.empty() || passive.empty()) return;
    Vector more(passive.size());
    products_->inner_passive(df_.data(), more.data());
    for (std::size_t k = 0; k < more.size(); ++k) phi_[static_cast<std::size_t>(passive[k])] += more[k];
}

bool AttachedSolver::solve(const WorkingSet& set, double tolerance, bool exact, Vector& s, int least, int held, bool whole) {
    held_ = static_cast<std::size_t>(held);
    double best = 1e300;
    int worse = 0;
    for (int k = 0;; ++k) {
        evaluate(set, s, false);
        const double noise = least > 0 ? noise_ - noise_reference_ : noise_;
        const bool near = residual_ <= tolerance + 2 * noise, stuck = residual_ >= 0.9 * best;
        if ((near && noise > (exact ? 0.0 : 0.1 * tolerance)) || (stuck && noise > 0)) evaluate(set, s, true);
        if (residual_ <= tolerance && k >= least) {
            if (!whole) return true;
            if (!stable(set)) return false;
            add_passive();
            return true;
        }
        if (residual_ < 0.9 * best)
            best = residual_, worse = 0;
        else
            ++worse;
        if (k == kMostSteps || worse > 6 || !std::isfinite(residual_)) break;
        step(set, std::clamp(std::max(0.1 * residual_, exact ? 0.0 : 0.01 * tolerance / residual_), 1e-6, 1e-2), s);
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
        evaluate(set, s, true);
        double change = 2 * longest;
        for (int k = 0; k < 60 && change > longest; ++k) {
            weigh(mu);
            if (!stable(set)) {
                mu *= 2;
                continue;
            }
            ds.clear();
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
            if (solve(set, tolerance, true, end)) {
                s = std::move(end);
                return Relaxed{};
            }
        }
        mu *= change < 0.5 * longest ? 0.5 : 1;
    }
    return std::nullopt;
}

double AttachedSolver::clamped_stiffness(const std::vector<Sticking::State>& states) {
    constexpr double accuracy = 1e-9;
    const double shift = products_->kernel().shift();
    Vector root, y;  // roots of the stiffnesses D in y + D^1/2 B D^1/2 y = D^1/2
    for (const Sticking::State& now : states) root.push_back(std::sqrt(now.clamped));
    in_.resize(root.size()), out_.resize(root.size());
    const auto multiply_clamped = [&](const Vector& v, Vector& image) {
        double sum = 0;
        for (std::size_t k = 0; k < v.size(); ++k) sum += in_[k] = root[k] * v[k];
        products_->inner(in_.data(), out_.data());
        for (std::size_t k = 0; k < v.size(); ++k) image[k] = v[k] + root[k] * (out_[k] - shift * sum);
    };
    minres(multiply_clamped, root, accuracy, y);
    return dot(root, y);
}

AttachedSolver::Change AttachedSolver::change(const Vector& rate, double accuracy) {
    Change c;
    const std::vector<int>&active = products_->active(), &passive = products_->passive();
    const auto at = [](int k) { return static_cast<std::size_t>(k); };
    const double shift = products_->kernel().shift();
    Vector right, df(state_.size());
    before_.resize(phi_.size(), 0.0);
    for (int k : active) right.push_back(rate[at(k)]), c.s.push_back(before_[at(k)]);
    if (!right.empty()) solve_linear(right, accuracy, c.s);
    for (std::size_t k = 0; k < df.size(); ++k) {
        before_[at(active[k])] = c.s[k];
        c.force += df[k] = state_[k].df * c.s[k];
        c.power -= df[k] * right[k];
    }
    c.u.assign(passive.size(), 0.0);
    if (!df.empty()) products_->inner_passive(df.data(), c.u.data());
    for (std::size_t k = 0; k < passive.size(); ++k) c.u[k] = rate[at(passive[k])] - c.u[k] + shift * c.force;
    return c;
}

}  // namespace rsc
