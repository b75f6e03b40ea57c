#include "asperities/newton.hpp"

#include "asperities/lapack.hpp"
#include "asperities/uniqueness.hpp"
#include "base/parallel.hpp"

namespace rsc {
namespace {

using Vector = std::vector<double>;

// Inner products are accurate enough for a residual kAboveError times their error; products less
// accurate than kRoughest never are.
constexpr double kAboveError = 100, kRoughest = 1e-5;

// Conjugate gradients: largest number of steps, and the relative curvature below which the
// curvature of a direction is regarded as not positive. It is above the rounding of
// single-precision products and below relevant eigenvalues (near 1 for spots that do not overlap).
constexpr std::size_t kMostGradients = 500;
constexpr double kFlat = 1e-9;

// Relative accuracy of a Newton step (Eisenstat and Walker, SIAM J. Sci. Comput. 17, 1996): the
// square root of the residual, which preserves the order 3/2, at most kLoosest; not smaller than
// kLastShare of the accuracy required in the last step, nor than kFinestForcing.
constexpr double kLoosest = 0.1, kLastShare = 0.2, kFinestForcing = 1e-5, kMostForcing = 0.3;

// Trust region with the usual parameters (Nocedal and Wright, Numerical Optimization, chapter 4). A
// step is accepted if the energy decreases by at least kSufficient of the predicted decrease. Below
// kPoor the radius shrinks to kShrink of the step; above kGood it grows if the step reached the
// border. Steps are at most kLongest |S v|, the natural scale of the unknowns.
constexpr double kSufficient = 1e-4, kPoor = 0.1, kGood = 0.5, kShrink = 0.25, kGrow = 3,
                 kLongest = 2;
constexpr int kMostAttempts = 40;  // steps shorter than 4^-40 of the first have no effect

// Rounding error of the energy relative to the sum of the magnitudes of its terms, for some 1e5
// terms.
constexpr double kEnergyRounding = 1e-11;

// Leaving a saddle: the first step is half of the penetrations and is then halved repeatedly.
constexpr double kFirstLeap = 0.5, kLastLeap = 1e-6;

}  // namespace

double relative_residual(const Vector& error, const Vector& force) {
    double most = 0, e2 = 0, f2 = 0;  // scaled by the largest value
    for (const auto k : indices(force))
        most = std::max({most, std::abs(force[k]), std::abs(error[k])});
    if (!(most > 0)) return 0;
    for (const auto k : indices(force)) {
        e2 += (error[k] / most) * (error[k] / most);
        f2 += (force[k] / most) * (force[k] / most);
    }
    const double residual = std::sqrt(e2 / f2);
    return std::isfinite(residual) ? residual : 1;
}

bool Newton::rough_will_do(double residual) const {
    return products_->inner_error() < kRoughest &&
           residual > kAboveError * products_->inner_error();
}

// Computes the state from its v; in full accuracy if requested, or if the residual is too small for
// inner products.
void Newton::evaluate(const WorkingSet& set, State& state, bool accurate) {
    stopping_point();
    const int n = set.size();
    for (auto* x : {&state.force, &state.slope, &state.work, &state.phi, &state.res})
        x->resize(at(n));
    law_.respond(n, set.asperity.data(), state.v.data(), state.force.data(), state.slope.data(),
                 state.work.data());
    state.active.clear();
    for (const int k : indices(n)) {
        if (state.force[at(k)] > 0) state.active.push_back(k);
    }
    products_->set_active(state.active);
    active_force_.clear();
    for (int k : state.active) active_force_.push_back(state.force[at(k)]);
    if (accurate)
        products_->full(active_force_.data(), state.phi.data());
    else
        products_->inner_everywhere(active_force_.data(), state.phi.data());
    state.accurate = accurate;

    state.energy = state.scale = 0;
    error_.resize(at(n));
    for (std::size_t k = 0; k < at(n); ++k) {
        const double f = state.force[k], target = set.g0[k] - state.phi[k];
        state.res[k] = state.v[k] - target;
        if (f > 0) {
            state.energy += f * (0.5 * state.phi[k] + state.v[k] - set.g0[k]) - state.work[k];
            state.scale += f * set.g0[k];
        }
        error_[k] = f - (target > 0 ? law_.force(set.asperity[k], target) : 0.0);
    }
    state.residual = relative_residual(error_, state.force);
    if (!accurate && !rough_will_do(state.residual)) evaluate(set, state, true);
}

void Newton::scale_active(const State& state) {
    root_.clear();
    for (int k : state.active) root_.push_back(std::sqrt(state.slope[at(k)]));
    for (auto* x : {&force_, &phi_, &r_, &p_, &mp_}) x->resize(root_.size());
}

void Newton::multiply(const Vector& w, Vector& out) {
    for (const auto k : indices(root_)) force_[k] = root_[k] * w[k];
    stopping_point();
    products_->inner(force_.data(), phi_.data());
    for (const auto k : indices(root_)) out[k] = w[k] + root_[k] * phi_[k];
}

void Newton::steihaug(const Vector& b, double forcing, double radius, Vector& w, Step& out) {
    const std::size_t n = b.size();
    w.assign(n, 0.0);
    r_ = b;
    p_ = r_;
    double rr = dot(r_, r_);
    const double goal = forcing * forcing * rr;
    double ww = 0, wp = 0, pp = rr;
    out = Step{std::move(out.dv)};
    const auto to_border = [&] {  // largest t >= 0 with |w + t p| = radius
        const double t = (-wp + std::sqrt(wp * wp + pp * (radius * radius - ww))) / pp;
        for (const auto k : indices(n)) w[k] += t * p_[k];
        out.border = true;
        return t;
    };
    const int most = int(std::min<std::size_t>(2 * n + 10, kMostGradients));
    for (int i = 0; i < most && rr > goal && rr > 0; ++i) {
        multiply(p_, mp_);
        const double curvature = dot(p_, mp_);
        if (!(curvature > kFlat * pp)) {
            out.negative_curvature = true;
            const double t = to_border();
            out.predicted += t * rr - 0.5 * t * t * curvature;
            break;
        }
        const double alpha = rr / curvature;
        if (ww + 2 * alpha * wp + alpha * alpha * pp >= radius * radius) {
            const double t = to_border();
            out.predicted += t * rr - 0.5 * t * t * curvature;
            break;
        }
        double rr_new = 0;
        for (const auto k : indices(n)) {
            w[k] += alpha * p_[k];
            r_[k] -= alpha * mp_[k];
            rr_new += r_[k] * r_[k];
        }
        out.predicted += 0.5 * alpha * rr;
        ww += 2 * alpha * wp + alpha * alpha * pp;
        const double beta = rr_new / rr;
        wp = beta * (wp + alpha * pp);
        pp = rr_new + beta * beta * pp;
        rr = rr_new;
        for (const auto k : indices(n)) p_[k] = r_[k] + beta * p_[k];
    }
    out.norm = std::sqrt(dot(w, w));
}

// `entering` limits the penetration that asperities without force may gain, as the radius limits
// the changes of those with force.
void Newton::step(const WorkingSet& set, const State& state, double forcing, double radius,
                  double entering, Step& out) {
    scale_active(state);
    const std::size_t n = root_.size();
    Vector b(n), w;
    for (const auto k : indices(n)) b[k] = -root_[k] * state.res[at(state.active[k])];
    steihaug(b, forcing, radius, w, out);
    out.dv.assign(at(set.size()), 0.0);
    df_.resize(n);
    for (const auto k : indices(n)) {
        out.dv[at(state.active[k])] = w[k] / root_[k];
        df_[k] = root_[k] * w[k];
    }
    const auto& passive = products_->passive();
    passive_.resize(passive.size());
    products_->inner_passive(df_.data(), passive_.data());
    for (const auto k : indices(passive)) {
        const std::size_t i = at(passive[k]);
        const double change = -state.res[i] - passive_[k];
        const double reached = state.v[i] + change;
        // penetration at which the force begins
        const double begin = law_.onset(set.asperity[i]);
        out.dv[i] = reached > begin ? begin + entering * (reached - begin) - state.v[i] : change;
    }
}

namespace {

double forcing_of(double residual, double tolerance) {
    return std::clamp(
        std::max(std::min(kLoosest, std::sqrt(residual)), kLastShare * tolerance / residual),
        kFinestForcing, kMostForcing);
}

// |S v|^2 over the active set, with v measured from where the force begins.
double square_of_scaled(const Law& law, const WorkingSet& set, const std::vector<int>& active,
                        const Vector& v, const Vector& slope) {
    double square = 0;
    for (int k : active) {
        const double u = v[at(k)] - law.onset(set.asperity[at(k)]);
        square += slope[at(k)] * u * u;
    }
    return square;
}

}  // namespace

// Newton's step within the trust region, which shrinks until the energy decreases enough; that
// state becomes the present one. False if no step does.
bool Newton::descend(const WorkingSet& set, double forcing, TrustRegion& trust) {
    trust.radius = std::min(
        trust.radius,
        kLongest * std::sqrt(square_of_scaled(law_, set, now_.active, now_.v, now_.slope)));
    // Expected residual after the step, since Newton's method has an order of at least 3/2.
    const double expected = std::max(forcing * now_.residual, std::pow(now_.residual, 1.5));
    Step next;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
        products_->set_active(now_.active);
        step(set, now_, forcing, trust.radius, trust.entering, next);
        trial_.v.resize(now_.v.size());
        for (const auto k : indices(now_.v)) trial_.v[k] = now_.v[k] + next.dv[k];
        evaluate(set, trial_, !rough_will_do(expected));
        const double decrease = now_.energy - trial_.energy;
        const double noise =
            std::max(kEnergyRounding, now_.accurate && trial_.accurate ? products_->full_error()
                                                                       : products_->inner_error()) *
            (now_.scale + trial_.scale);
        const bool accepted =
            decrease >= kSufficient * next.predicted ||
            (decrease >= -noise && trial_.residual < now_.residual && !next.negative_curvature);
        if (!accepted || decrease < kPoor * next.predicted) {
            trust.radius = kShrink * next.norm;
            if (!accepted) trust.entering *= kShrink;
        } else {
            if (next.border && decrease > kGood * next.predicted) trust.radius *= kGrow;
            if (!next.border) trust.radius = kInfinity;
            trust.entering = std::min(1.0, trust.entering / kShrink);
        }
        if (!accepted || !std::isfinite(trial_.energy)) continue;
        std::swap(now_, trial_);
        return true;
    }
    return false;
}

NewtonOutcome Newton::solve(const WorkingSet& set, double tolerance, int max_iterations, Vector& v,
                            bool ask_minimum) {
    NewtonOutcome outcome;
    now_.v = v;
    evaluate(set, now_, !rough_will_do(1));
    TrustRegion trust;
    for (;; ++outcome.iterations) {
        const bool last = outcome.iterations >= max_iterations;
        if (now_.residual <= tolerance) {
            Vector lowest;
            outcome.minimum = !ask_minimum || positive_definite(set, now_, lowest);
            if (outcome.minimum || last) {
                outcome.converged = outcome.minimum;
                break;
            }
            leave_saddle(set, lowest);
            continue;
        }
        if (last) {
            if (!now_.accurate) evaluate(set, now_, true);
            break;
        }
        if (!descend(set, forcing_of(now_.residual, tolerance), trust)) break;
    }
    outcome.residual = now_.residual;
    outcome.converged = outcome.converged || (!ask_minimum && now_.residual <= tolerance);
    v = now_.v;
    return outcome;
}

bool Newton::at_minimum(const WorkingSet& set) {
    Vector lowest;
    return positive_definite(set, now_, lowest);
}

void Newton::take(const WorkingSet& set, const Vector& v) {
    now_.v = v;
    evaluate(set, now_, true);
}

bool Newton::positive_definite(const WorkingSet& set, const State& state, Vector& w) {
    std::vector<double> x, y, reach;
    for (int k : state.active) {
        x.push_back(set.x[at(k)]);
        y.push_back(set.y[at(k)]);
        reach.push_back(state.slope[at(k)]);
    }
    if (products_->kernel().none()) return true;
    const double E_star = products_->kernel().modulus();
    for (double& s : reach) s /= 2 * E_star;
    if (positive_definite_by_shells(x, y, reach, products_->kernel().period())) return true;
    products_->set_active(state.active);
    scale_active(state);
    Vector image(root_.size());
    const double lowest = lapack::lanczos_lowest(
        root_.size(), [&](const Vector& in, Vector& out) { multiply(in, out); }, w);
    return lowest > 0;
}

// Moves from a saddle along the direction of negative curvature, to both sides, until the energy is
// lower.
void Newton::leave_saddle(const WorkingSet& set, const Vector& w) {
    double largest = 0;
    for (const auto k : indices(w)) {
        const std::size_t i = at(now_.active[k]);
        largest = std::max(largest,
                           std::abs(w[k] / root_[k]) / (now_.v[i] - law_.onset(set.asperity[i])));
    }
    double gradient = 0;
    for (const auto k : indices(w)) gradient += w[k] * root_[k] * now_.res[at(now_.active[k])];
    const double downhill = gradient > 0 ? -1.0 : 1.0;
    for (double length = kFirstLeap; length > kLastLeap; length *= 0.5) {
        for (double side : {downhill, -downhill}) {
            trial_.v = now_.v;
            for (const auto k : indices(w)) {
                trial_.v[at(now_.active[k])] += side * length / largest * w[k] / root_[k];
            }
            evaluate(set, trial_, true);
            if (trial_.energy < now_.energy) {
                std::swap(now_, trial_);
                return;
            }
        }
    }
}

void Newton::potential_at(std::size_t n, const double* x, const double* y, double* phi) {
    products_->set_active(now_.active);
    active_force_.clear();
    for (int k : now_.active) active_force_.push_back(now_.force[at(k)]);
    products_->elsewhere(active_force_.data(), int(n), x, y, phi);
}

// Solves with inner products and corrects with accurate ones: with r = b - A w, b'A^-1 b = b'w +
// w'r + r'A^-1 r, where the last term is neglected.
double Newton::stiffness(double tolerance) {
    products_->set_active(now_.active);
    scale_active(now_);
    const std::size_t n = root_.size();
    Vector b(n), r, more, all(now_.phi.size());
    Vector& w = sinking_;
    w.assign(n, 0.0);
    for (const auto k : indices(n)) b[k] = -root_[k];
    r = b;
    const double goal = std::sqrt(tolerance * dot(b, b));
    const double forcing = std::min(std::max(products_->inner_error(), std::sqrt(tolerance)), 1e-2);
    constexpr int most = 6;
    double left = 0;
    for (int pass = 0; pass < most; ++pass) {
        const double before = std::sqrt(dot(r, r));
        Step ignored;
        steihaug(Vector(r), forcing, kInfinity, more, ignored);
        for (const auto k : indices(n)) w[k] += more[k];
        if (products_->inner_error() <= tolerance) return -dot(b, w);
        for (const auto k : indices(n)) force_[k] = root_[k] * w[k];
        products_->full(force_.data(), all.data());
        for (const auto k : indices(n)) r[k] = b[k] - w[k] - root_[k] * all[at(now_.active[k])];
        left = std::sqrt(dot(r, r));
        if (left <= goal || !(left < 0.5 * before)) break;
    }
    return -dot(b, w) - dot(r, w);
}

std::vector<double> Newton::sinking() const {
    Vector change(sinking_);
    for (const auto k : indices(change)) change[k] /= root_[k];
    return change;
}

}  // namespace rsc
