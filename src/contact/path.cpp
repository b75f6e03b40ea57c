#include "contact/path.hpp"

#include "base/error.hpp"
#include "contact/force_search.hpp"

namespace rsc {
namespace {

// accepted relative error of the force due to rounding of the separation
constexpr double kForceByRounding = 1e-6;
constexpr double kFarAbove = 100;   // relative to the requested force
constexpr double kReleased = 1e-3;  // resolution of pulling off, relative to the range
// Steps of the approach to a force: the most by which one is longer than the last.
constexpr double kGrowth = 4;

// Of all solutions on the way to a level.
struct Effort {
    std::int32_t iterations = 0;
    std::int64_t products = 0;
    // Adds that of a solution, which then has the sum.
    void add(Level& level) {
        level.iterations = iterations += level.iterations;
        level.products = products += level.products;
    }
};

// Near N = 0 the force of bodies that attract is the difference of pressure and attraction, and no
// more exact than these.
bool has_force(const Level& level, double N, double tolerance) {
    double traction = 0, pulled = 0;
    for (const double p : level.pixels.attraction) traction = std::max(traction, -p);
    if (traction > 0) pulled = traction * (level.area + level.cohesive_area);
    for (const double force : level.tractions.pulled) pulled += std::abs(force);
    return std::abs(level.force - N) <= tolerance * std::max(std::abs(N), pulled);
}

// The separations that bodies that attract try for a force N, away from the first level or towards
// the surface: by interpolation of the last three levels, at most kGrowth times as far as before,
// until the force is beyond N or nothing attracts any more, then between.
struct Approach {
    double N;
    bool down;
    double range, lowest;  // no separation is below
    double step = 0.25 * range, guess = kNotComputed;
    int guesses = 0;
    std::vector<std::array<double, 2>> last = {};  // separations and forces, at most three

    static bool is_free(const Level& l) { return l.contacts == 0 && !(l.cohesive_area > 0); }
    bool nearer(const Level& level) const {
        return (down || !is_free(level)) && (level.force < N) == down;
    }
    double next(const Bracket& bracket, bool released) {
        const double z = down ? bracket.high : bracket.low;
        if (std::isfinite(down ? bracket.low : bracket.high))
            return !released && ++guesses % 4 != 0 ? guess : kNotComputed;
        const double length = down ? z - guess : guess - z;
        step = length > 0 ? std::min(length, kGrowth * step) : 1.4 * step;
        return down ? std::max(z - step, lowest) : z + step;
    }
    // Extrapolates the separation with the force N as a polynomial of the force.
    void note(const Level& level) {
        last.push_back({level.separation, level.force});
        if (last.size() == 1) return;
        if (last.size() > 3) last.erase(last.begin());
        guess = 0;
        for (const auto i : indices(last)) {
            double share = 1;
            for (const auto j : indices(last))
                if (j != i) share *= (N - last[j][1]) / (last[i][1] - last[j][1]);
            guess += share * last[i][0];
        }
    }
};

// The search for `level`, which judge() evaluates: with trials, until the last of them has another
// result when it is solved completely.
template <class Judge>
SearchEnd search(Model& model, Level& level, double begin, Bracket bracket, int most,
                 Judge&& judge) {
    Effort effort;
    SearchEnd end = SearchEnd::stuck;
    for (bool trial : {true, false}) {
        const auto evaluate = [&](double z, Bracket& now, int i) {
            const auto solve = [&] {
                level = model.solve(z, trial);
                effort.add(level);
                return judge(z, now, i);
            };
            const double next = solve();
            if (!now.closed() || !level.provisional) return next;
            now = bracket;
            trial = false;
            return solve();
        };
        end = search_force(begin, bracket, most, evaluate);
        if (end == SearchEnd::closed) break;
    }
    return end;
}

}  // namespace

Level Path::at_separation(double Z0) {
    if (!std::isfinite(Z0)) bad_input("the separation must be finite");
    return in_steps(separation_, Z0, &Path::to_separation);
}

Level Path::at_force(double N) {
    if (!(N > 0 || pulls()) || !std::isfinite(N))
        bad_input(pulls() ? "the force must be finite" : "the force must be positive and finite");
    return in_steps(force_, N, &Path::to_force);
}

Level Path::in_steps(double from, double to, Reach reach) {
    const double end = time_, start = accepted_.value_or(end);
    Effort effort;
    const auto solve = [&](double part, double length, double lasting) {
        time_ = part < 1 ? start + part * (end - start) : end;
        if (stepper()) history()->step(length, lasting);
        Level level = (this->*reach)(part < 1 ? from + part * (to - from) : to);
        effort.add(level);
        return level;
    };
    const bool steps = stepper() && std::isfinite(from) && end > start;
    std::optional<State> before;
    if (steps || (pulls() && reach == &Path::to_force)) before = history_state();
    level_.reset();
    solved_ = true;
    Level level;
    // A level that is not reached leaves the history before it.
    const auto take_back = [&] {
        if (before) restore_history(*before);
        time_ = end;
    };
    try {
        level = steps ? stepper()->follow({end - start, reach == &Path::to_force, force_, solve,
                                           [&] { restore_history(*before); },
                                           [&] { return first_touch(); }})
                      : solve(1, 0, 0);
    } catch (...) {
        take_back();
        throw;
    }
    ++levels_since_move_;
    if (!level.converged && level.fallback != Fallback::held) take_back();
    if (relaxes()) level.time = end;
    if (clock() == PathClock::distance) level.distance = end;
    level_ = level;
    level_place_ = {indenter().x0, indenter().y0};
    return level;
}

Level Path::to_separation(double Z0) {
    rise_ = 0;  // that of a force may be one far from Z0
    Level level = model_->shift() > 0 ? solve_between_planes(Z0) : model_->solve(Z0);
    finish(level);
    return level;
}

void Path::finish(Level& level) {
    const bool converged = level.converged;
    const bool state = converged || level.fallback == Fallback::held;
    solved_force_ = level.force;
    last_force_ = converged ? level.force : 0.0;
    if (state) {
        if (history()) history()->accept(level);
        accepted_ = time_;
        separation_ = level.separation;
        force_ = level.force;
    }
    // With a residual above a tenth of the forces not even a first digit is known: there is no
    // state, and no values are returned.
    constexpr double kNoDigit = 0.1;
    if (!state && !(level.residual < kNoDigit)) {
        Level nothing;
        nothing.separation = level.separation;
        nothing.force = nothing.area = kNotComputed;
        nothing.residual =
            std::isfinite(level.residual) ? level.residual : std::numeric_limits<double>::max();
        nothing.candidates = level.candidates;
        nothing.iterations = level.iterations;
        nothing.products = level.products;
        nothing.converged = level.converged;
        nothing.method = level.method;
        nothing.fallback = level.fallback;
        level = std::move(nothing);
    } else {
        level.energy = energy();
    }
    if (const Period& period = indenter().period; period.finite()) {
        level.pressure = level.force / period.area();
        level.area_fraction = level.area / period.area();
    } else if (period.line()) {
        level.force_per_length = level.force / period.length();
    }
}

void Path::set_time(double time) {
    if (!std::isfinite(time)) bad_input("the time must be finite");
    if (clock() != PathClock::none && accepted_ && time < *accepted_)
        bad_input(format("a %s of %.9g is before that of the last level, %.9g",
                         relaxes() ? "time" : "sliding distance", time, *accepted_));
    time_ = time;
}

double Path::stiffness() {
    solve_level_again();
    const double S = model_->stiffness(Slope::exact);
    return S / (1 + model_->shift() * S);
}

double Path::clamped_stiffness() {
    if (!pulls()) return 0 - stiffness();
    solve_level_again();
    return 0 - model_->stiffness(Slope::clamped);
}

// The shift c adds c N^2/2, which is not part of the energy of the bodies.
double Path::energy() {
    solve_level_again();
    const double c = relaxes() ? 0.0 : model_->shift();
    return model_->energy() - 0.5 * c * solved_force_ * solved_force_;
}

Indenter Path::indenter_at_level() const {
    Indenter tip = indenter();
    tip.x0 = level_place_.x;
    tip.y0 = level_place_.y;
    return tip;
}

void Path::move_tip(double x0, double y0) {
    if (!std::isfinite(x0) || !std::isfinite(y0)) bad_input("the tip's position must be finite");
    model_->move_tip(x0, y0);
    levels_since_move_ = 0;
}

void Path::put_tip(double x0, double y0) {
    if (indenter().x0 != x0 || indenter().y0 != y0) move_tip(x0, y0);
}

void Path::forget() {
    last_.reset();
    last_force_ = rise_ = 0;
    levels_since_move_ = 0;
    accepted_.reset();
    separation_ = force_ = kNotComputed;
    model_->forget();
}

Path::State Path::history_state() const {
    State now;
    if (accepted_) now.time = *accepted_;
    now.separation = separation_;
    now.force = force_;
    if (history()) now.history = history()->write();
    return now;
}

Path::State Path::state() const {
    State now = history_state();
    now.x0 = indenter().x0;
    now.y0 = indenter().y0;
    now.moved = indenter().around.finite();
    now.clock = time_;
    now.level = level_;
    now.level_x0 = level_place_.x;
    now.level_y0 = level_place_.y;
    ArchiveWriter writer;
    archive(writer, *this);
    model_->keep(writer);
    now.solution = std::move(writer.bytes);
    return now;
}

void Path::restore_history(const State& state) {
    accepted_.reset();
    if (std::isfinite(state.time)) accepted_ = state.time;
    time_ = accepted_.value_or(0.0);
    separation_ = state.separation;
    force_ = state.force;
    if (history()) history()->read(state.history);
}

void Path::restore(const State& state) {
    forget();  // what is replaced below would follow the tip
    const bool at_level = state.solution.empty() && history() && state.level && !pulls();
    level_.reset();
    put_tip(at_level ? state.level_x0 : state.x0, at_level ? state.level_y0 : state.y0);
    restore_history(state);
    level_ = state.level;
    level_place_ = {state.level_x0, state.level_y0};
    restore_solution(state);
    if (std::isfinite(state.clock)) time_ = state.clock;
}

void Path::restore_solution(const State& state) {
    if (!state.solution.empty()) {
        ArchiveReader reader(state.solution, Failure::bad_input, "the state is damaged");
        archive(reader, *this);
        model_->recall(reader);
        return reader.end();
    }
    const bool at_level = history() && state.level && !pulls();
    solved_ = !level_;
    // Without a history this is left until it is needed.
    if (history()) solve_level_again();
    if (at_level && (state.x0 != state.level_x0 || state.y0 != state.level_y0)) {
        if (std::isnan(level_->stiffness)) level_->stiffness = stiffness();  // lost by the move
        put_tip(state.x0, state.y0);
    }
}

// Solves again at a level that was restored, where the tip was then.
void Path::solve_level_again() {
    if (solved_) return;
    solved_ = true;
    const Vec2 now{indenter().x0, indenter().y0};
    if (!pulls()) put_tip(level_place_.x, level_place_.y);
    model_->solve_again(level_->separation - model_->shift() * level_->force, *level_);
    solved_force_ = level_->force;
    if (!pulls()) put_tip(now.x, now.y);
}

// Solves z + shift() N(z) = Z0, where z is the separation of the model. The left side increases
// with z and is convex as long as N is a function of Z0.
Level Path::solve_between_planes(double Z0) {
    const double c = model_->shift(), touch = first_touch();
    if (Z0 >= touch) return model_->solve(Z0);
    double begin = Z0;
    if (last_) {
        begin = last_->z + (Z0 - last_->z - c * last_->force) / (1 + c * last_->slope);
        if (!(begin < Z0) || !(1 + c * last_->slope > 0)) begin = Z0;
    }
    Level level;
    double miss = 0;
    const auto judge = [&](double z, Bracket& bracket, int) {
        const double slope = model_->stiffness(Slope::rough), steep = 1 + c * slope;
        miss = z + c * level.force - Z0;
        last_ = {z, level.force, slope};
        // An error of Z0 corresponds to an error of the force of -slope/steep times as much.
        const double rounding =
            4 * std::numeric_limits<double>::epsilon() * (std::abs(Z0) + std::abs(z));
        if (!level.converged || std::abs(miss) <= rounding ||
            (steep > 0 && std::abs(miss * slope) <= 0.1 * tolerance_ * level.force * steep))
            return bracket.close(z);
        (miss > 0 ? bracket.high : bracket.low) = z;
        const double next = steep > 0 ? z - miss / steep : kInfinity;
        if (std::isfinite(bracket.low) || next < z) return next;
        return z - 2 * (miss + (Z0 - z));
    };
    constexpr int most = 60;
    if (search(*model_, level, begin, {-kInfinity, touch}, most, judge) != SearchEnd::closed)
        level.converged = false;
    // Without a solution the search goes on to forces without bracket: a level far from Z0 is no
    // state of it.
    if (!level.converged) level.residual = std::max(level.residual, std::abs(miss) / (touch - Z0));
    level.separation = Z0;
    return level;
}

void Path::refuse_closing(double N, const Level& closing) const {
    const double area = indenter().period.area();
    bad_input(
        format("a nominal pressure of %.9g is above that of full contact "
               "on this surface, %.4g",
               N / area, closing.force / area));
}

// The separation at which the search for the force N begins: that of the last level unless it
// failed, had no contact, or is so much deeper that a start from first touch takes fewer steps. At
// `depth` below first touch the force is at most of the order of N.
double Path::first_guess(double N, double above, double depth) const {
    const double touching = above - 0.25 * depth;
    double z = touching;
    if (last_force_ > 0 && last_force_ < kFarAbove * N) {
        z = last_separation();
        if (last_ && last_->force > 0)
            z = last_->z + std::log(N / last_->force) * last_->force / last_->slope;
        else if (rise_ < 0 && levels_since_move_ > 0)
            z += std::log(N / last_force_) / rise_;
        if (!(z < above)) z = touching;
    }
    const double below = model_->contact_range().full_contact;
    return z > below ? z : 0.5 * (above + below);
}

// The separation of a level is exact to its last bit, and its force is not N: either the force
// jumps there, or it is too small for the resolution of the separation.
void Path::require_resolved(Level& level, double N) {
    const double z = level.separation;
    const double ulp = std::nextafter(std::abs(z), kInfinity) - std::abs(z);
    const double slope = model_->stiffness(Slope::rough);
    const double resolved = 2 * ulp * std::abs(slope) + model_->force_at_most(2 * ulp);
    if (std::abs(level.force - N) > resolved) {  // no separation has the force N
        level.converged = false;
        level.fallback = Fallback::jump;
    } else if (std::abs(level.force / N - 1) >
               kForceByRounding) {  // N is proportional to depth^(3/2)
        bad_input(
            format("a force of %.9g is too small for the resolution of the separation: "
                   "near %.9g the smallest possible force is %.9g",
                   N, z, model_->force_at_most(1.5 * ulp / kForceByRounding)));
    }
}

Level Path::to_force(double N) {
    if (!std::isfinite(first_touch()))
        bad_input(
            "no point of the surface lies under body 2, so that it cannot carry a force: it is "
            "narrower than a step of the grid, or lies beyond the border");
    Level level = pulls() ? follow_to_force(N) : level_under(N);
    finish(level);
    return level;
}

Level Path::level_under(double N) {
    std::optional<Level> level = model_->solve_under(N);
    if (!level) return pulls() ? approach_force(N) : newton_force(N);
    level->separation += model_->shift() * level->force;
    return std::move(*level);
}

// Solves ln N(z) = ln N with the slope from the stiffness; a root finder without slopes takes about
// twice as many levels.
Level Path::newton_force(double N) {
    const double above = first_touch();  // upper bound of the separation
    const bool near = last_force_ > 0.5 * N && last_force_ < 2 * N && last_separation() < above;
    const double depth = near ? above - last_separation() : least_depth(*model_, N);
    Level level;
    const auto judge = [&](double z, Bracket& bracket, int i) {
        const double miss = level.force / N - 1, furthest = z - std::ldexp(depth, i);
        if (std::abs(miss) <= tolerance_ || !level.converged) return bracket.close(z);
        (miss < 0 ? bracket.high : bracket.low) = z;
        const bool open = std::isinf(bracket.low);
        if (!(level.force > 0)) return open ? furthest : -kInfinity;
        rise_ = model_->stiffness(Slope::rough) / level.force;
        const double next = z - std::log1p(miss) / rise_;
        if (!open) return next;
        return next < z ? std::max(next, furthest) : furthest;
    };
    constexpr int most = 200;
    const Bracket bracket{model_->contact_range().full_contact, above};
    const SearchEnd end =
        search(*model_, level, first_guess(N, above, depth), bracket, most, judge);
    if (end == SearchEnd::most) level.converged = false;
    if (end == SearchEnd::stuck) require_resolved(level, N);
    if (const double c = model_->shift(); c > 0) {
        last_ = {level.separation, level.force, model_->stiffness(Slope::rough)};
        level.separation += c * level.force;
    }
    return level;
}

// Bodies that attract follow their path to the first level with the force N: towards the surface if
// N is larger than the present force, otherwise away. If no level has it, the result is that of the
// smallest force, with Fallback::held.
Level Path::follow_to_force(double N) {
    // Where the smallest force is reached, less than this share from it.
    constexpr double near_least = 1e-7;
    const State before = history_state();
    Level level = level_under(N);
    if (level.fallback != Fallback::held || level.force <= (1 - near_least) * level.least_force)
        return level;
    restore_history(before);
    level = level_under((1 - near_least) * level.least_force);
    level.fallback = Fallback::held;
    level.converged = false;
    return level;
}

// Accepts the levels on the way but the last one, if the model has followed its path to them.
Level Path::approach_force(double N) {
    const double range = history()->attraction();
    Effort effort;
    std::int32_t jumps = 0;
    double least_on_path = 0;
    const auto solve = [&](double z, bool trial) {
        Level there = model_->solve(z, trial);
        effort.add(there);
        there.jumps += jumps;
        return there;
    };
    const auto ends = [&](const Level& there) {
        return !there.converged || has_force(there, N, tolerance_);
    };
    // Begins at the last level, or where nothing attracts yet.
    const bool first = !std::isfinite(separation_);
    Level level;
    level.separation = first ? first_touch() + range : separation_;
    level.force = first ? 0.0 : force_;
    level.contacts = level.force != 0;
    if (std::abs(level.force - N) <= tolerance_ * std::abs(N) || levels_since_move_ == 0 ||
        (!first && level.force == 0)) {
        level = solve(level.separation, false);
        if (ends(level)) return level;
        if (!first) history()->accept(level);
        jumps = level.jumps;
    }
    Approach way{N, level.force < N, range, model_->contact_range().full_contact + 1e-6 * range};
    way.note(level);
    if (const double slope = model_->stiffness(Slope::rough); slope < 0)
        way.guess = level.separation + (N - level.force) / slope;
    State least;
    const auto compare = [&] {
        if (std::isfinite(least.force) && level.force >= least.force) return;
        least.force = level.force;
        least.separation = level.separation;
        least.history = history()->write();
    };
    compare();
    bool released = false;
    const auto evaluate = [&](double z, Bracket& bracket, int) {
        level = solve(z, true);
        const bool nearer = way.nearer(level);
        if (level.provisional && ends(level)) level = solve(z, false);
        if (ends(level)) return bracket.close(z);
        if (nearer && z == way.lowest) refuse_closing(N, level);
        way.note(level);
        least_on_path = level.least_force;
        (nearer == way.down ? bracket.high : bracket.low) = z;
        if (!nearer) {
            released = !way.down && Approach::is_free(level);
        } else {
            if (!level.provisional) {
                history()->accept(level);
                jumps = level.jumps;
            }
            compare();
        }
        if (released && bracket.high - bracket.low < kReleased * range) return bracket.close(z);
        return way.next(bracket, released);
    };
    if (way.down || !Approach::is_free(level)) {
        const double z = level.separation;
        const Bracket bracket{way.down ? -kInfinity : z, way.down ? z : kInfinity};
        constexpr int most = std::numeric_limits<int>::max();
        (void)search_force(way.next(bracket, false), bracket, most, evaluate);
        if (ends(level)) return level;
    }
    history()->read(least.history);
    level = solve(least.separation, false);
    level.least_force = std::min(least_on_path, level.force);
    level.fallback = Fallback::held;
    level.converged = false;
    return level;
}

}  // namespace rsc
