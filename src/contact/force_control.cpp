// Force control: solves N(Z0) = N for the separation Z0.

#include "base/error.hpp"
#include "base/format.hpp"
#include "contact/contact.hpp"

namespace rsc {
namespace {

// accepted relative error of the force due to rounding of the separation
constexpr double kUnresolved = 1e-6;
constexpr double kFarAbove = 100;  // relative to the requested force
constexpr int kPasses = 2;         // number of failures after which only full solves are used

// Evaluation of a level at z: it is the solution (or failed), or lies above it; `next` is the next
// separation by Newton's method,
// -Infinity: none.
struct Verdict {
    bool found, above;
    double next;
};

// Bracketed Newton's method with the slopes of levels; a root finder without slopes takes about
// twice as many levels. It first uses intermediate levels (pass()), the last of which settle()
// completes; if this fails, only full solves. `look` computes the level at a separation,
// intermediate or full; `settle` completes an intermediate level; `judge` evaluates a level. While
// no lower bound is known, reach(next, z, high, i) limits the next separation.
template <class Look, class Settle, class Judge, class Reach>
Level search(double begin, double below, double above, int most, Look&& look, Settle&& settle,
             Judge&& judge, Reach&& reach, bool& stuck) {
    Level level;
    std::int32_t iterations = 0;
    std::int64_t products = 0;
    const auto counted = [&](Level solved) {
        iterations += solved.iterations;
        products += solved.products;
        return solved;
    };
    double z = begin, low = below, high = above;
    int passes = kPasses, i = 0;
    const auto answers_alone = [&] {  // restarts with full solves only
        passes = 0, i = -1;
        z = begin, low = below, high = above;
    };
    stuck = false;
    for (;; ++i) {
        const bool passing = passes > 0;
        level = counted(look(z, passing));
        Verdict verdict = judge(level, z);
        if (verdict.found && passing) {
            level = counted(settle(level));
            verdict = judge(level, z);
            if (!verdict.found) {  // settle() found another solution; continues from it
                if (--passes == 0) {
                    answers_alone();
                    continue;
                }
                low = below, high = above;
            }
        }
        if (verdict.found) break;
        (verdict.above ? high : low) = z;
        double next = verdict.next;
        if (std::isinf(low)) next = reach(next, z, high, i);
        if (!(next < high) || !(next > low)) next = 0.5 * (low + high);
        if (i + 1 >= most || next == z || !(next > low) || !(next < high)) {
            if (passing) {  // stuck with intermediate levels; restarts with full solves
                answers_alone();
                continue;
            }
            stuck = i + 1 < most;
            if (!stuck) level.converged = false;
            break;
        }
        z = next;
    }
    level.iterations = iterations;
    level.products = products;
    return level;
}

}  // namespace

Level Contact::at_separation(double Z0) {
    if (!std::isfinite(Z0)) throw Error(Failure::bad_input, "the separation must be finite");
    return in_steps(separation_, Z0, &Contact::to_separation);
}

Level Contact::at_force(double N) {
    if (!(N > 0 || pulls()) || !std::isfinite(N))
        throw Error(Failure::bad_input,
                    pulls() ? "the force must be finite" : "the force must be positive and finite");
    return in_steps(force_, N, &Contact::to_force);
}

Level Contact::in_steps(double from, double to, Level (Contact::*reach)(double)) {
    const double start = accepted_.value_or(time_), end = time_;
    const double steps = std::isfinite(from) ? steps_of_time(end - start, shortest_time()) : 1.0;
    if (!(steps > 1)) return (this->*reach)(to);
    const std::vector<double> before = memory();
    // A level that is not reached leaves the state of the last one.
    const auto take_back = [&] {
        recall(before, nullptr);
        time_ = end;
    };
    std::int32_t iterations = 0;
    std::int64_t products = 0;
    Level level;
    try {
        for (double k = 1; k <= steps; ++k) {
            time_ = k < steps ? start + k / steps * (end - start) : end;
            level = (this->*reach)(k < steps ? from + k / steps * (to - from) : to);
            level.iterations = iterations += level.iterations,
            level.products = products += level.products;
            if (!level.converged) break;
        }
    } catch (...) {
        take_back();
        throw;
    }
    if (!level.converged) take_back(), level.time = end;
    return level;
}

Level Contact::to_separation(double Z0) {
    begin();
    rise_ = 0;  // that of a force may be one far from Z0
    Level level = shift() > 0 ? solve_between_planes(Z0) : solve(Z0);
    finish(level);
    return level;
}

void Contact::finish(Level& level) {
    const bool converged = level.converged;
    if (converged || level.fallback == Fallback::held) {
        accept(level);
        accepted_ = time_;
        separation_ = level.separation, force_ = level.force;
    }
    // With a residual as large as the forces there is no valid state: its values are not returned.
    if (!converged && level.fallback != Fallback::held && !(level.residual < 1)) {
        Level nothing;
        nothing.separation = level.separation;
        nothing.force = nothing.area = kNotComputed;
        nothing.residual =
            std::isfinite(level.residual) ? level.residual : std::numeric_limits<double>::max();
        nothing.candidates = level.candidates, nothing.iterations = level.iterations,
        nothing.products = level.products;
        nothing.converged = level.converged, nothing.method = level.method,
        nothing.fallback = level.fallback;
        level = std::move(nothing);
    }
    if (relaxes()) level.time = time_;
    last_force_ = converged ? level.force : 0.0;
    if (const Period& period = indenter().period; period.finite()) {
        level.pressure = level.force / period.area();
        level.area_fraction = level.area / period.area();
    }
}

void Contact::set_time(double time) {
    if (!std::isfinite(time)) throw Error(Failure::bad_input, "the time must be finite");
    if (relaxes() && accepted_ && time < *accepted_)
        throw Error(Failure::bad_input,
                    format("a time of %.9g is earlier than that of the last level, %.9g", time,
                           *accepted_));
    time_ = time;
}

std::vector<double> Contact::last_accepted() const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {accepted_.value_or(none), accepted_ ? separation_ : none, accepted_ ? force_ : none};
}

std::span<const double> Contact::recall_accepted(std::span<const double> memory) {
    if (memory.size() < 3)
        throw Error(Failure::bad_input, "the state does not belong to a body that relaxes");
    accepted_.reset();
    if (std::isfinite(memory[0])) accepted_ = memory[0];
    time_ = accepted_.value_or(0.0), separation_ = memory[1], force_ = memory[2];
    return memory.subspan(3);
}

double Contact::slope() {
    const double S = stiffness();
    return S / (1 - shift() * S);
}

// Solves z + shift() N(z) = Z0, where z is the separation of solve(). The left side increases with
// z and is convex as long as N is a function of Z0.
Level Contact::solve_between_planes(double Z0) {
    const double c = shift();
    if (Z0 >= first_touch()) return solve(Z0);
    double begin = Z0;
    if (last_) {
        const auto& [at, force, rise] = *last_;
        begin = at + (Z0 - at - c * force) / (1 + c * rise);
        if (!(begin < Z0) || !(1 + c * rise > 0)) begin = Z0;
    }
    double miss = 0;
    const auto judge = [&](const Level& level, double z) {
        const double rise = slope(), steep = 1 + c * rise;
        miss = z + c * level.force - Z0;
        last_ = {z, level.force, rise};
        // An error of Z0 corresponds to an error of the force of -rise/steep times as much.
        const double rounding =
            4 * std::numeric_limits<double>::epsilon() * (std::abs(Z0) + std::abs(z));
        const bool found =
            !level.converged || std::abs(miss) <= rounding ||
            (steep > 0 && std::abs(miss * rise) <= 0.1 * tolerance() * level.force * steep);
        return Verdict{found, miss > 0, steep > 0 ? z - miss / steep : -kInfinity};
    };
    const auto reach = [&](double next, double z, double above, int) {
        return std::isfinite(next) && next < above ? next : z - 2 * (std::abs(miss) + (Z0 - z));
    };
    constexpr int most = 60;
    bool stuck;
    Level level = search(
        begin, -kInfinity, Z0, most,
        [&](double z, bool passing) { return passing ? pass(z) : solve(z); },
        [&](const Level& passed) { return settle(passed); }, judge, reach, stuck);
    if (stuck) level.converged = false;
    // Without a solution the search goes on to forces without bounds: a level far from Z0 is no
    // state of it.
    if (!level.converged)
        level.residual = std::max(level.residual, std::abs(miss) / (first_touch() - Z0));
    level.separation = Z0;
    return level;
}

// Solves ln N(Z0) = ln N with the slope from the stiffness.
Level Contact::to_force(double N) {
    begin();
    double above = first_touch();  // upper bound of the separation
    if (!std::isfinite(above))
        throw Error(Failure::bad_input,
                    "no asperity lies under the indenter, so that it cannot carry a force");
    if (std::optional<Level> level = solve_under(N)) {
        finish(*level);
        return std::move(*level);
    }
    double below = closed();  // lower bound of the separation
    // Initial depth: the force cannot be reached before half of it.
    double depth = std::numeric_limits<double>::epsilon() *
                   std::max(std::abs(above), std::numeric_limits<double>::min());
    const std::optional<double> likely =
        last_force_ > 0.5 * N && last_force_ < 2 * N ? likely_separation() : std::nullopt;
    if (likely && *likely < above)
        depth = above - *likely;
    else
        while (force_at_most(depth) < N) depth *= 2;
    double Z0 = above - 0.25 * depth;
    // Starts from the last level unless it failed, had no contact, or is so much deeper that a
    // start from first touch takes fewer steps.
    if (last_force_ > 0 && last_force_ < kFarAbove * N) {
        Z0 = likely_separation().value_or(Z0);
        if (last_ && last_->force > 0)
            Z0 = last_->separation + std::log(N / last_->force) * last_->force / last_->slope;
        else if (
            rise_ < 0 &&
            levels_since_move() >
                0)  // otherwise it is extrapolated to the new place, with the change of the force
            Z0 += std::log(N / last_force_) / rise_;
        if (!(Z0 < above)) Z0 = above - 0.25 * depth;
    }
    if (!(Z0 > below)) Z0 = 0.5 * (above + below);
    const auto judge = [&](const Level& level, double z) {
        const double miss = level.force / N - 1;
        const bool found = std::abs(miss) <= tolerance() || !level.converged;
        if (found) return Verdict{true, false, z};
        if (!(level.force > 0)) return Verdict{false, true, -kInfinity};
        rise_ = slope() / level.force;
        return Verdict{false, miss < 0, z - std::log1p(miss) / rise_};
    };
    const auto reach = [&](double next, double z, double highest, int i) {
        const double furthest =
            highest - 2 * (levels_since_move() > 1 ? highest - z : 0.0) - std::ldexp(depth, i);
        return std::isfinite(next) && next < highest ? std::max(next, furthest) : furthest;
    };
    constexpr int most = 200;
    bool stuck;
    Level level = search(
        Z0, below, above, most,
        [&](double z, bool passing) { return passing ? pass(z) : solve(z); },
        [&](const Level& passed) { return settle(passed); }, judge, reach, stuck);
    if (stuck) {
        // Z0 is exact to its last bit. A larger error of the force is due to a jump of N(Z0): no
        // separation has the force N.
        Z0 = level.separation;
        const double ulp = std::nextafter(std::abs(Z0), kInfinity) - std::abs(Z0);
        const double resolved = 2 * ulp * std::abs(slope()) + force_at_most(2 * ulp);
        if (std::abs(level.force - N) > resolved)
            level.converged = false, level.fallback = Fallback::jump;
        else if (std::abs(level.force / N - 1) > kUnresolved)  // N is proportional to depth^(3/2)
            throw Error(Failure::bad_input,
                        format("a force of %.9g is too small for the resolution of the separation: "
                               "near %.9g the smallest possible "
                               "force is %.9g",
                               N, Z0, force_at_most(1.5 * ulp / kUnresolved)));
    }
    if (shift() > 0) {
        last_ = {level.separation, level.force, slope()};
        level.separation += shift() * level.force;
    }
    finish(level);
    return level;
}

}  // namespace rsc
