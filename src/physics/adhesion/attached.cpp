#include "physics/adhesion/attached.hpp"

#include "asperities/uniqueness.hpp"
#include "base/parallel.hpp"

namespace rsc {
namespace {

using Vector = std::vector<double>;

constexpr int kMostSteps = 30, kMostProducts = 400;
// The residual is that of all asperities together, or this share of the largest relative to an
// asperity's own force and penetration of detachment: beside large forces small contacts would
// otherwise be inaccurate.
constexpr double kOwn = 1e-3, kRounding = 1e-9;
// state of a small contact that has just attached, relative to that of detachment (JKR, a sphere:
// 6.3)
constexpr double kAttached = 8;
// change of the forces by the curvature of the law that is neglected in products, relative to the
// tolerance
constexpr double kBent = 0.01;
// Share of the tolerance from which a predicted state needs no step: near detachment small
// residuals are large errors.
constexpr double kUnstepped = 0.01;
// residual of exact solutions in a last step, whatever the tolerance
constexpr double kExact = 1e-11;
constexpr double kRate = 1e-6;     // accuracy of derivatives in proofs of stability
constexpr double kFarthest = 0.5;  // largest relative change of s in a step

double dot4(const Vector& a, const Vector& b) {
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0;  // sums that do not wait for each other
    const double *x = a.data(), *y = b.data();
    std::size_t k = 0;
    for (const std::size_t n = a.size() & ~std::size_t{3}; k < n; k += 4) {
        s0 += x[k] * y[k];
        s1 += x[k + 1] * y[k + 1];
        s2 += x[k + 2] * y[k + 2];
        s3 += x[k + 3] * y[k + 3];
    }
    for (; k < a.size(); ++k) s0 += x[k] * y[k];
    return (s0 + s1) + (s2 + s3);
}

// MINRES for symmetric indefinite systems (Paige and Saunders, SIAM J. Numer. Anal. 12, 1975): adds
// M^-1 v to x until |v - M x| <= goal. multiply(y, image, lift) computes the image M y and its part
// `lift`, the sum of which is added to `lifted` as y to x.
template <class Multiply>
void minres(Multiply&& multiply, Vector v, double goal, Vector& x, Vector& lifted) {
    const std::size_t n = v.size();
    Vector before(n, 0.0), next(n), lift(n), w(n, 0.0), w_before(n, 0.0), w_lift(n, 0.0),
        w_lift_before(n, 0.0);
    double beta = std::sqrt(dot4(v, v)), left = beta, c = 1, c_before = 1, s = 0, s_before = 0;
    for (std::size_t k = 0;
         k < std::min<std::size_t>(2 * n + 10, kMostProducts) && std::abs(left) > goal && beta > 0;
         ++k) {
        for (double& value : v) value /= beta;
        multiply(v, next, lift);
        const double alpha = dot4(v, next);
        for (const auto i : indices(n)) next[i] -= alpha * v[i] + beta * before[i];
        const double beta_next = std::sqrt(dot4(next, next));
        const double d = c * alpha - c_before * s * beta, r1 = std::hypot(d, beta_next),
                     r2 = s * alpha + c_before * c * beta;
        const double r3 = s_before * beta;
        if (!(r1 > 0)) break;
        c_before = c;
        s_before = s;
        c = d / r1;
        s = beta_next / r1;
        const auto add = [&](const Vector& from, const Vector& last, Vector& to, Vector& sum) {
            const double per = 1 / r1, share = c * left;
            for (const auto i : indices(n)) to[i] = per * (from[i] - r3 * to[i] - r2 * last[i]);
            for (const auto i : indices(n)) sum[i] += share * to[i];
        };
        add(v, w, w_before, x);
        add(lift, w_lift, w_lift_before, lifted);
        left *= -s;
        before.swap(v);
        v.swap(next);
        w_before.swap(w);
        w_lift_before.swap(w_lift);
        beta = beta_next;
    }
}

}  // namespace

void AttachedSolver::judge(const WorkingSet& set) {
    double error2 = 0, doubt2 = 0, size2 = 0, own = 0, own_doubt = 0;
    for (const auto k : indices(res_)) {
        const auto i = at(products_->active()[k]);
        const Sticking::State& now = state_[k];
        const double error = now.stiffness * std::abs(res_[k]), doubt = now.stiffness * out_[k],
                     gap = std::abs(set.g0[i]) + std::abs(phi_[i]);
        const double weak = now.stiffness * law_.lets_go(set.asperity[i]),
                     size = weak * weak + now.f * now.f;
        error2 += error * error;
        doubt2 += doubt * doubt;
        size2 += size;
        const double per = 1 / (std::sqrt(size) + kRounding * now.stiffness * gap);
        own = std::max(own, error * per);
        own_doubt = std::max(own_doubt, doubt * per);
    }
    const auto relative = [&](double sum2, double alone) {
        return size2 == 0 ? 0.0 : std::max(std::sqrt(sum2 / size2), kOwn * alone);
    };
    residual_ = relative(error2, own);
    noise_ = noise_reference_ + relative(doubt2, own_doubt);
}

void AttachedSolver::evaluate(const WorkingSet& set, const Vector& s, bool full,
                              double negligible) {
    stopping_point();
    const std::vector<int>& active = products_->active();
    const std::size_t n = active.size();
    // After a step the product is known but for its curvature.
    const bool stepped = std::exchange(stepped_, false) && f_.size() == n && lifted_.size() == n &&
                         elevated_.size() == n;
    state_.resize(n);
    f_.resize(n);
    res_.resize(n);
    df_.assign(n, 0.0);
    out_.assign(n, 0.0);
    derivative_.clear();
    force_ = 0;
    double bent2 = 0, f2 = 0;
    for (const auto k : indices(n)) {
        state_[k] = law_.at(set.asperity[at(active[k])], s[k]);
        if (stepped) {
            bent2 += std::pow(state_[k].f - f_[k] - pulled_[k], 2);
            f2 += state_[k].f * state_[k].f;
        }
        f_[k] = state_[k].f;
        force_ += f_[k];
    }
    const double bent = stepped && f2 > 0 ? std::sqrt(bent2 / f2) : 1.0;
    if (!full &&
        std::includes(active.begin(), active.end(), reference_.begin(), reference_.end())) {
        Vector f(n, 0.0);  // new ones had no force
        for (std::size_t k = 0, j = 0; k < n && j < reference_.size(); ++k)
            if (active[k] == reference_[j]) f[k] = f_reference_[j++];
        reference_ = active;
        f_reference_ = std::move(f);
    }
    if (full || n == 0 || phi_reference_.empty() || active != reference_) {
        reference_ = active;
        f_reference_ = f_;
        phi_reference_.assign(at(set.size()), 0.0);
        if (n > 0) products_->full(f_.data(), phi_reference_.data());
        noise_reference_ = noise_bent_ = 0;
    } else {
        bool changed = false;
        for (const auto k : indices(n)) {
            df_[k] = f_[k] - f_reference_[k];
            changed = changed || df_[k] != 0;
        }
        if (changed && bent <= negligible) {
            noise_bent_ += bent;
            for (const auto k : indices(n)) out_[k] = elevated_[k] + lifted_[k];
        } else {
            noise_bent_ = 0;
            if (changed) products_->inner(df_.data(), out_.data());
        }
    }
    elevated_ = out_;
    phi_ = phi_reference_;
    for (const auto k : indices(n)) phi_[at(active[k])] += out_[k];
    balance(set);
}

// Residual, energy and noise from forces and phi_ of the present states; on entry out_ holds the
// elevations by df_ from inner products.
void AttachedSolver::balance(const WorkingSet& set) {
    const std::vector<int>& active = products_->active();
    const std::size_t n = active.size();
    const double shift = products_->kernel().shift() * force_;
    for (double& phi : phi_) phi -= shift;
    const double f2 = dot4(f_, f_), share = f2 > 0 ? std::sqrt(dot4(df_, df_) / f2) : 0.0;
    energy_ = 0;
    for (const auto k : indices(n)) {
        const auto i = at(active[k]);
        const Sticking::State& now = state_[k];
        res_[k] = set.g0[i] - phi_[i] - now.u;
        energy_ += now.energy +
                   now.f * (0.5 * phi_[i] + res_[k]);  // an error of second order in the residual
        out_[k] = products_->inner_error() * (2 * std::abs(out_[k]) + share * std::abs(phi_[i])) +
                  noise_bent_ * std::abs(phi_[i]);
    }
    judge(set);
    weighed_ = false;
    mu_ = 0;
    in_.resize(n);
}

void AttachedSolver::weigh(double mu) {
    const std::size_t n = state_.size();
    mu_ = mu;
    weighed_ = true;
    diagonal_.resize(n);
    p_.resize(n);
    to_s_.resize(n);
    in_.resize(n);
    out_.resize(n);
    for (const auto k : indices(n)) {
        const Sticking::State& now = state_[k];
        const double df = now.df + mu * now.stiffness, q = now.stiffness * now.du - now.df,
                     sign = df < 0 ? -1.0 : 1.0;
        const double slope = std::max(std::abs(df), 1e-13 * now.stiffness);
        diagonal_[k] = sign * (sign * slope + q) / (slope + q);
        p_[k] = sign * std::sqrt(now.stiffness * slope / (slope + q));
        to_s_[k] = p_[k] / (sign * slope);
    }
}

void AttachedSolver::multiply(const Vector& y, Vector& image, Vector& lift) {
    for (const auto k : indices(y)) in_[k] = p_[k] * y[k];
    products_->inner(in_.data(), lift.data());
    complete(y, image, lift);
}

// image = M y, where lift = B p y without shift().
void AttachedSolver::complete(const Vector& y, Vector& image, const Vector& lift) const {
    const double shift = products_->kernel().shift() * dot4(p_, y);
    for (const auto k : indices(y)) image[k] = diagonal_[k] * y[k] + p_[k] * (lift[k] - shift);
}

void AttachedSolver::solve_linear(const Vector& right, double accuracy, Vector& ds) {
    if (!weighed_) weigh(0);
    const std::size_t n = right.size();
    Vector v(n);
    for (const auto k : indices(n)) v[k] = p_[k] * right[k];
    const double goal = accuracy * std::sqrt(dot4(v, v));
    ds.assign(n, 0.0);
    lifted_.assign(n, 0.0);
    minres([this](const Vector& y, Vector& image, Vector& lift) { multiply(y, image, lift); },
           std::move(v), goal, ds, lifted_);
    pulled_.resize(n);
    for (const auto k : indices(n)) {
        pulled_[k] = p_[k] * ds[k];
        ds[k] *= to_s_[k];
    }
}

// True if I + B D is stable: D^-1 + B is positive definite. A proof for stiffer asperities holds
// for softer and fewer ones.
bool AttachedSolver::apart(const WorkingSet& set) {
    const Kernel& kernel = products_->kernel();
    const std::vector<int>& active = products_->active();
    const std::size_t n = state_.size();
    stiffest_.resize(phi_.size(), 0.0);
    bool covered = true;
    for (std::size_t k = 0; k < n && covered; ++k)
        covered = state_[k].stiffness <= stiffest_[at(active[k])];
    if (covered) return true;
    std::ranges::fill(stiffest_, 0.0);
    // First with room for growth, and with those that may attach.
    std::vector<double> a(stiffest_.size());
    for (const double wider : {room_, 1.0}) {
        if (wider < 1.001 && wider > 1) continue;
        std::ranges::fill(a, 0.0);
        if (wider > 1)
            for (const int k : products_->passive()) {
                const int i = set.asperity[at(k)];
                a[at(k)] = law_.at(i, kAttached * law_.least(i)).stiffness / (2 * kernel.modulus());
            }
        for (const auto k : indices(n))
            a[at(active[k])] = wider * state_[k].stiffness / (2 * kernel.modulus());
        if (!kernel.none() && !positive_definite_by_shells(set.x, set.y, a)) {
            room_ = 1 + 0.5 * (room_ - 1);
            continue;
        }
        for (const auto k : indices(a)) stiffest_[k] = 2 * kernel.modulus() * a[k];
        return true;
    }
    return false;
}

bool AttachedSolver::proved(const WorkingSet& set) {
    constexpr int most = 6;
    // share of diag(u') v that must be left; products may have small errors
    constexpr double certain = 1e-3;
    const std::vector<int>& active = products_->active();
    const auto place = [&](std::size_t k) { return at(active[k]); };
    if (products_->kernel().lattice() || products_->kernel().smooth() || !apart(set))
        return false;  // the proof needs B >= 0
    proof_.resize(phi_.size(), 0.0);
    for (int round = 0; round < most; ++round) {
        bool any = false, holds = true;
        for (const auto k : indices(state_)) {
            const double du = state_[k].du + mu_, df = state_[k].df + mu_ * state_[k].stiffness;
            in_[k] = 0;
            if (df >= 0) continue;
            if (!(du > 0)) return false;
            in_[k] = proof_[place(k)] > 0 ? proof_[place(k)] : 1 / du;
            any = true;
        }
        if (!any) return true;
        products_->inner(in_.data(), out_.data());
        for (const auto k : indices(state_)) {
            if (in_[k] == 0) continue;
            const double du = state_[k].du + mu_, df = state_[k].df + mu_ * state_[k].stiffness;
            if (!(std::abs(df * out_[k]) +
                      2 * products_->inner_error() * std::abs(df) * std::abs(out_[k]) <
                  (1 - certain) * du * in_[k]))
                holds = false;
            proof_[place(k)] = (1 - df * out_[k]) / du;
        }
        if (holds) return true;
    }
    return false;
}

bool AttachedSolver::stable(const WorkingSet& set) {
    const std::size_t n = state_.size();
    for (const auto k : indices(n))
        if (1 + state_[k].stiffness * products_->kernel().self() <=
            0) {  // sinks in by itself on a soft layer: no minimum of the energy
            weakest_ = k;
            return false;
        }
    if (proved(set)) return true;
    Vector right(n, -1.0), x;
    solve_linear(right, kRate, derivative_);
    const double shift = products_->kernel().shift();
    double sum = 0;
    for (const auto k : indices(n)) sum += in_[k] = state_[k].stiffness;
    products_->inner(in_.data(), right.data());
    double crowded = 0;  // largest row sum of B D: (I + B D)^-1 1 is positive if it is below 1
    for (double& value : right) {
        value += -shift * sum;
        crowded = std::max(crowded, value);
        value += 1;
    }
    const auto positive = [&](const Vector& ds, double sign) {
        weakest_ = 0;
        double lowest = 1;
        for (const auto k : indices(n)) {
            if (std::isnan(ds[k])) return false;
            if (state_[k].df < 0 && sign * ds[k] < lowest) {
                lowest = sign * ds[k];
                weakest_ = k;
            }
        }
        return lowest > 0;
    };
    if (crowded < 1 && positive(derivative_, -1)) return true;
    solve_linear(right, kRate, x);
    return positive(x, 1);
}

void AttachedSolver::step(const WorkingSet& set, double accuracy, Vector& s) {
    stepped_ = true;
    Vector ds;
    solve_linear(res_, accuracy, ds);
    for (const auto k : indices(s)) {
        const double least = law_.least(set.asperity[at(products_->active()[k])]);
        const double next =
            std::clamp(s[k] + ds[k], (1 - kFarthest) * s[k], (1 + kFarthest) * s[k]);
        s[k] = std::max(next, 0.5 * (s[k] + least));
    }
}

void AttachedSolver::rest_on(const WorkingSet& set, double noise, const Vector& s) {
    evaluate(set, s, false);
    if (noise_ > noise) return evaluate(set, s, true);
    add_passive();
    const double shift = products_->kernel().shift() * force_;
    reference_ = products_->active();
    f_reference_ = f_;
    phi_reference_ = phi_;
    noise_reference_ = noise_;
    for (double& phi : phi_reference_) phi += shift;
}

// Adds the change of the forces to phi_ at the others.
void AttachedSolver::add_passive() {
    const std::vector<int>& passive = products_->passive();
    if (df_.empty()) return;
    Vector more(passive.size());
    products_->inner_passive(df_.data(), more.data());
    for (const auto k : indices(more)) phi_[at(passive[k])] += more[k];
}

bool AttachedSolver::solve(const WorkingSet& set, double tolerance, bool exact, Vector& s,
                           int least) {
    const bool predicted = exact && !phi_reference_.empty();
    double best = 1e300;
    int worse = 0;
    for (int k = 0;; ++k) {
        evaluate(set, s, false, kBent * tolerance);
        const double noise = least > 0 ? noise_ - noise_reference_ : noise_;
        const bool near = residual_ <= tolerance + 2 * noise, stuck = residual_ >= 0.9 * best;
        if ((near && noise > (exact ? 0.0 : 0.1 * tolerance)) ||
            (stuck && noise > 0.01 * residual_))
            evaluate(set, s, true);
        if (residual_ <= (predicted && k == 0 ? kUnstepped : 1.0) * tolerance && k >= least) {
            if (!stable(set)) return false;
            add_passive();
            return true;
        }
        if (residual_ < 0.9 * best) {
            best = residual_;
            worse = 0;
        } else
            ++worse;
        if (k == kMostSteps || worse > 6 || !std::isfinite(residual_)) break;
        step(set,
             std::clamp(std::max(0.1 * residual_,
                                 (exact ? std::min(kExact, 0.1 * tolerance) : 0.1 * tolerance) /
                                     residual_),
                        1e-6, 3e-2),
             s);
    }
    weakest_ = 0;
    double nearest = 1e300;
    for (const auto k : indices(s)) {
        const double margin = s[k] / law_.least(set.asperity[at(products_->active()[k])]);
        if (margin < nearest) {
            nearest = margin;
            weakest_ = k;
        }
    }
    return false;
}

std::optional<AttachedSolver::Relaxed> AttachedSolver::relax(const WorkingSet& set,
                                                             double tolerance, Vector& s) {
    constexpr int most = 300;
    constexpr double near = 1e-3, longest = 0.3, stalled = 1e-9,
                     shrunk = 0.05;  // steps relative to s; s relative to its least value
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
            solve_linear(res_, 1e-3, ds);
            change = 0;
            for (const auto i : indices(s)) change = std::max(change, std::abs(ds[i]) / s[i]);
            if (change > longest) mu *= 2;
        }
        if (!(change <= longest) || change < stalled) break;
        for (const auto i : indices(s)) {
            s[i] += ds[i];
            if (s[i] < shrunk * law_.least(set.asperity[at(products_->active()[i])]))
                return Relaxed{i};
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

std::vector<double> AttachedSolver::elevations(const Vector& f) {
    Vector phi(phi_.size()), lift;
    products_->full(f.data(), phi.data());
    for (const int k : products_->active()) lift.push_back(phi[at(k)]);
    return lift;
}

// r'A^-1 r = 2 r'y - y'A y but for the square of the error of y, with a full product for A y.
double AttachedSolver::clamped_stiffness(const std::vector<Sticking::State>& states) {
    constexpr double accuracy = 1e-5;
    const double shift = products_->kernel().shift();
    Vector root, y, f;  // roots r of the stiffnesses D in A y = y + D^1/2 B D^1/2 y = D^1/2
    for (const Sticking::State& now : states) root.push_back(std::sqrt(now.clamped));
    in_.resize(root.size());
    y.resize(root.size());
    lifted_.resize(root.size());
    const auto multiply_clamped = [&](const Vector& v, Vector& image, Vector& lift) {
        double sum = 0;
        for (const auto k : indices(v)) sum += in_[k] = root[k] * v[k];
        products_->inner(in_.data(), lift.data());
        for (const auto k : indices(v)) image[k] = v[k] + root[k] * (lift[k] - shift * sum);
    };
    minres(multiply_clamped, root, accuracy * std::sqrt(dot4(root, root)), y, lifted_);
    for (const auto k : indices(y)) f.push_back(root[k] * y[k]);
    const double sum = sum_of(f);
    return 2 * sum - dot4(y, y) - dot4(f, elevations(f)) + shift * sum * sum;
}

// N' = -b'A^-1 b with b = -p, and b'A^-1 b = 2 b'y - y'A y but for the square of the error of y,
// with a full product for A y.
double AttachedSolver::slope(const std::vector<Sticking::State>& states) {
    constexpr double accuracy = 1e-4;
    std::vector<Sticking::State> last = std::exchange(state_, states);
    Vector y, image(states.size());
    weigh(0);
    solve_linear(Vector(states.size(), -1.0), accuracy, y);
    for (const auto k : indices(y)) {
        y[k] /= to_s_[k];
        in_[k] = p_[k] * y[k];
    }
    complete(y, image, elevations(in_));
    state_ = std::move(last);
    weighed_ = stepped_ = false;
    return 2 * dot4(p_, y) + dot4(y, image);
}

AttachedSolver::Change AttachedSolver::change(const Vector& rate, double accuracy) {
    Change c;
    const std::vector<int>&active = products_->active(), &passive = products_->passive();
    const double shift = products_->kernel().shift();
    Vector right, df(state_.size());
    for (int k : active) right.push_back(rate[at(k)]);
    const bool known = accuracy >= kRate && derivative_.size() == right.size() &&
                       std::ranges::all_of(right, [](double r) { return r == -1; });
    if (known)
        c.s = derivative_;
    else if (!right.empty())
        solve_linear(right, accuracy, c.s);
    for (const auto k : indices(df)) {
        c.force += df[k] = state_[k].df * c.s[k];
        c.power -= df[k] * right[k];
    }
    c.u.assign(passive.size(), 0.0);
    if (!df.empty()) products_->inner_passive(df.data(), c.u.data());
    for (const auto k : indices(passive)) c.u[k] = rate[at(passive[k])] - c.u[k] + shift * c.force;
    return c;
}

}  // namespace rsc
