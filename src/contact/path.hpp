// Path: a model led from level to level, at given separations or forces, in time, and back to
// earlier states.
#pragma once

#include "contact/model.hpp"

namespace rsc {

class Path final {
public:
    // The forces have the relative tolerance `tolerance`.
    Path(std::unique_ptr<Model> model, double tolerance)
        : model_(std::move(model)), tolerance_(tolerance) {}

    // Solves at the separation Z0 [length] and accepts the level; if path_dependent(), later levels
    // depend on it. Failure to converge is reported by Level::converged. Throws Error(bad_input) if
    // Z0 is not finite.
    Level at_separation(double Z0);

    // Finds the separation at which the indenter carries the force N [force] (N > 0 unless it
    // pulls()), to the tolerance or the floating-point resolution of Z0, and accepts the level.
    // Trial separations have no effect on later levels.
    Level at_force(double N);

    // The last level with its energy, from at_separation(), at_force() or restore(); the caller may
    // complete it. Empty: there is none.
    std::optional<Level>& level() { return level_; }
    const std::optional<Level>& level() const { return level_; }
    // The tip of that level.
    Vec2 place_of_level() const { return level_place_; }
    // The indenter where it was at that level; it may have moved since.
    Indenter indenter_at_level() const;

    // Sets the time of the following levels, or their distance of sliding if that is the clock. The
    // separation, or under force control the force, changes linearly from the last accepted level,
    // in the steps of the body's Stepper; a tip that was moved is at its new place from the
    // beginning of the first step. The first level is applied instantaneously. Throws
    // Error(bad_input) if the time is not finite or earlier than that of the last level.
    void set_time(double time);
    double time() const { return time_; }
    PathClock clock() const { return stepper() ? stepper()->clock() : PathClock::none; }

    // True if a level depends on earlier ones. energy() is then the recoverable energy and
    // stiffness() the unloading stiffness; for relaxing bodies, the energy stored in their springs
    // and the instantaneous stiffness.
    bool path_dependent() const { return history() != nullptr; }
    bool relaxes() const { return clock() == PathClock::time; }
    // True if forces may be negative (adhesion).
    bool pulls() const { return history() && history()->attraction() >= 0; }

    // Of the last level; with adhesion, after move_tip(), of the state at the new place:
    // dN/dZ0 (negative; 0 without contact) [force/length].
    double stiffness();
    // Force that a unit approach adds at fixed contact areas [force/length], positive.
    double clamped_stiffness();
    // Elastic energy W, with dW/dZ0 = -N [force length].
    double energy();

    // Moves the tip to (x0, y0). Throws Error(bad_input) if not finite.
    void move_tip(double x0, double y0);
    // Z0 at which the indenter touches the surface [length]; -Infinity if nothing lies under it.
    double first_touch() const { return model_->contact_range().first_touch; }
    const Indenter& indenter() const { return model_->indenter(); }
    // Asperities used at present; null for boundary elements.
    std::shared_ptr<const Asperities> asperities() const { return model_->asperities(); }

    // What the levels up to the last one, `level`, leave in the bodies.
    Remains remains(const Level& level) const {
        return history() ? history()->remains(level) : Remains();
    }

    // Resets to the state of a new contact at this position of the tip.
    void forget();

    // All that later levels and answers depend on, to the last bit, and the last level: for trials
    // that are taken back, copies, and files.
    struct State {
        double x0 = 0, y0 = 0;  // the tip
        bool moved = false;     // Indenter::around: it was moved on a surface that repeats
        double clock = 0;       // set_time(); NaN (files of rsc 0.4): that of the last level
        // Of the last accepted level; NaN: there is none.
        double time = kNotComputed, separation = kNotComputed, force = kNotComputed;
        std::vector<double> history;  // History::write()
        std::optional<Level> level;
        double level_x0 = 0, level_y0 = 0;  // tip of the level
        // The last solution and the starting points, by an archive of this version of rsc. Empty:
        // the level is solved again, and the following ones are the same within the tolerance.
        std::string solution;
    };
    State state() const;
    // Throws Error(bad_input) if the state does not belong to these bodies. A tip that was moved
    // cannot become one that was not.
    void restore(const State& state);

private:
    History* history() const { return model_->history(); }
    const Stepper* stepper() const { return history() ? history()->stepper() : nullptr; }
    void put_tip(double x0, double y0);
    State history_state() const;
    void restore_history(const State& state);
    void restore_solution(const State& state);
    template <class Archive, class Self>
    static void archive(Archive& a, Self& path) {
        a(path.solved_, path.solved_force_, path.last_force_, path.rise_, path.levels_since_move_,
          path.last_);
    }
    void solve_level_again();

    // Reaches a level with this separation, or force, `from` that of the last accepted level.
    using Reach = Level (Path::*)(double);
    Level in_steps(double from, double to, Reach reach);
    Level to_separation(double Z0);  // as at_separation and at_force, in one step
    Level to_force(double N);
    Level level_under(double N);
    Level newton_force(double N);
    Level follow_to_force(double N);
    Level approach_force(double N);
    // Solves at the separation Z0 of the mean planes if shift() > 0.
    Level solve_between_planes(double Z0);
    double first_guess(double N, double above, double depth) const;
    void require_resolved(Level& level, double N);
    [[noreturn]] void refuse_closing(double N, const Level& closing) const;
    // Accepts a level if it converged, and adds the quantities that depend on the nominal area.
    void finish(Level& level);
    // That of the last accepted level, as the model counts it.
    double last_separation() const { return separation_ - model_->shift() * force_; }

    std::unique_ptr<Model> model_;
    double tolerance_;
    std::optional<Level> level_;
    Vec2 level_place_;
    bool solved_ = true;  // the model's last solution is that of the level
    double solved_force_ = 0;

    double time_ = 0;                 // of the clock, as in set_time()
    std::optional<double> accepted_;  // time of the last accepted level, and its values:
    double separation_ = kNotComputed, force_ = kNotComputed;

    // Starting points of force control: the force of the last level, 0 if it did not converge;
    // d ln N/dz where it was last needed, 0: unknown; the number of levels since the tip was moved;
    // and the last level if shift() > 0.
    double last_force_ = 0, rise_ = 0;
    int levels_since_move_ = 0;
    struct Trial {
        double z, force, slope;
    };
    std::optional<Trial> last_;
};

}  // namespace rsc
