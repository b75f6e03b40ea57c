// Interface of contacts of a rough surface with an indenter, solved level by level: asperities
// (asperity_contact.hpp) or boundary elements
// (element_contact.hpp).
#pragma once

#include "contact/level.hpp"

namespace rsc {

// Number of steps in which a level of a relaxing body is reached after `duration`. A step is of
// second order: with 16 in the shortest relaxation time or more, or 16 in all, N of bodies with one
// and four times, pressed, held and withdrawn, is within 1.1 %, mostly 0.4 %.
inline double steps_of_time(double duration, double shortest_time) {
    return std::max(1.0, std::ceil(16 * std::min(1.0, duration / shortest_time)));
}

class Contact {
public:
    virtual ~Contact() = default;

    // Solves at the separation Z0 [length] and accepts the level; if path_dependent(), later levels
    // depend on it. Failure to converge is reported by Level::status. Throws Error(bad_input) if Z0
    // is not finite.
    Level at_separation(double Z0);

    // Finds the separation at which the indenter carries the force N [force] (N > 0 unless there is
    // adhesion), to the tolerance or the floating-point resolution of Z0, and accepts the level.
    // Intermediate trial separations have no effect on later levels.
    Level at_force(double N);

    // Throws Error(bad_input) if the surfaces are in full contact under the force N, as at_force()
    // would; where this is known in advance.
    virtual void require_gap(double N) { (void)N; }

    // Sets the time of the following levels, used only if relaxes(). The separation, or under force
    // control the force, changes linearly from the last accepted level, in up to 16 steps; a tip
    // that was moved is at its new place from the beginning of the first step. The first level is
    // applied instantaneously. Throws Error(bad_input) if the time is not finite or earlier than
    // that of the last level.
    void set_time(double time);
    double time() const { return time_; }
    virtual bool relaxes() const { return false; }
    // The shortest relaxation time; Infinity: there is none.
    virtual double shortest_time() const { return kInfinity; }

    // Of the last level; with adhesion, after move_tip(), of the state at the new place:
    // dN/dZ0 (negative; 0 without contact) [force/length].
    virtual double stiffness() = 0;
    // Force that a unit approach adds at fixed contact areas [force/length], positive: -stiffness()
    // except with adhesion, where areas change with the separation.
    virtual double clamped_stiffness() { return -stiffness(); }
    // Elastic energy W, with dW/dZ0 = -N [force length]. The error is of the order of the square of
    // the residual.
    virtual double energy() const = 0;

    // Moves the tip to (x0, y0). The last level may be used as a starting point for the next.
    // Throws Error(bad_input) if not finite.
    virtual void move_tip(double x0, double y0) = 0;

    // Z0 at which the indenter touches the surface [length]; -Infinity if nothing lies under it.
    virtual double first_touch() const = 0;

    virtual const Indenter& indenter() const = 0;

    // Asperities used at present (positions, heights, curvatures); null for boundary elements.
    virtual std::shared_ptr<const Asperities> asperities() const { return nullptr; }

    // Resets to the state of a new contact at this position of the tip: earlier levels are no
    // longer used as starting points.
    void forget() {
        last_.reset();
        last_force_ = rise_ = 0;
        forget_levels();
    }

    // True if a level depends on earlier ones. energy() is then the recoverable energy and
    // stiffness() the unloading stiffness; for relaxing bodies, the energy stored in their springs
    // and the instantaneous stiffness.
    virtual bool path_dependent() const { return false; }
    // True if forces may be negative (adhesion).
    virtual bool pulls() const { return false; }
    // State left by accepted levels, as numbers that only an identically constructed contact can
    // interpret; empty if there is none.
    virtual std::vector<double> memory() const { return {}; }
    // Restores a state returned by memory() and the last level accepted before it (null: none).
    // energy() and stiffness() then refer to this level, and later levels start from it. The tip
    // must be at its position of that time.
    virtual void recall(const std::vector<double>& memory, const Level* level) = 0;

    // Relaxing bodies: the loads under which the instantaneous body has the present deflections,
    // where earlier loads last; empty for others.
    // Their pixels, or their contacts, are those that ever carried load. `level` is the last level.
    virtual std::optional<Level> lasting_loads(const Level& level) const {
        return (void)level, std::nullopt;
    }

    // Residual depth of each asperity after unloading [length]; empty if none yielded.
    virtual std::vector<double> residual_depths() const { return {}; }
    // Boundary elements: the points that yielded and their residual depths.
    virtual ResidualProfile residual_profile() const { return {}; }

protected:
    // Discards the state of the model from earlier levels.
    virtual void forget_levels() = 0;

    // Solves a trial level at Z0, to which stiffness() and energy() then refer.
    virtual Level solve(double Z0) = 0;
    // Solves for the force N directly, if the model can; force control then uses only this
    // function.
    virtual std::optional<Level> solve_under(double N) {
        (void)N;
        return std::nullopt;
    }
    // Intermediate trial during force control: a solution at Z0 near the last one, cheaper than
    // solve() but possibly a different one if there are several. settle() then returns the result
    // of solve() there, with the counts of the additional work.
    virtual Level pass(double Z0) { return solve(Z0); }
    virtual Level settle(const Level& passed) {
        Level level = passed;
        level.iterations = 0, level.products = 0;
        return level;
    }
    // dN/dZ0 of the last trial, with separations as in solve(), accurate enough for Newton's method
    // on Z0.
    virtual double slope();
    // Accepts the last level solved: path-dependent models store it and add the dissipated work to
    // the level.
    virtual void accept(Level& level) { (void)level; }
    // If relaxes(): following trials end a time step dt that begins at the last accepted level.
    virtual void step(double dt) { (void)dt; }
    // Time, separation and force of the last accepted level, the first numbers of memory(), NaN if
    // there is none; and back. Returns the other numbers; throws Error(bad_input) if there are
    // fewer.
    std::vector<double> last_accepted() const;
    std::span<const double> recall_accepted(std::span<const double> memory);

    // For periodic flats, solve() uses a reference plane that no force raises (Kernel::shift()):
    // the separation Z0 of the mean planes corresponds to Z0 - shift() N in solve(). first_touch()
    // is the same in both.
    virtual double shift() const { return 0; }

    // Separation of full contact, at and below which solve() has no solution.
    virtual double closed() const { return -kInfinity; }

    // Functions required by force control.
    virtual double tolerance() const = 0;  // relative tolerance of the force
    virtual double force_at_most(
        double depth) = 0;  // upper bound at a depth below first touch; exact for one asperity
    virtual std::optional<double> likely_separation() const {
        return {};
    }  // initial guess; absent: near first touch
    virtual std::size_t levels_since_move() const {
        return 0;
    }  // number of levels since the tip was moved, at most a few

private:
    Level to_separation(double Z0);  // as at_separation and at_force, in one step of time
    Level to_force(double N);
    // Reaches a level in steps of time, on which its separation, or its force, changes linearly
    // `from` that of the last accepted level.
    Level in_steps(double from, double to, Level (Contact::*reach)(double));
    double separation_ = std::numeric_limits<double>::quiet_NaN(),
           force_ = separation_;  // of the last accepted level

    // Solves at the separation Z0 of the mean planes if shift() > 0.
    Level solve_between_planes(double Z0);

    struct Trial {
        double separation, force, slope;  // as used by solve() and slope()
    };
    std::optional<Trial> last_;  // last level if shift() > 0, a starting point
    double rise_ = 0;  // d ln N/dZ0 where it was last needed under force control; 0: unknown

    // Accepts a level if it converged, and adds the quantities that depend on the nominal area.
    void finish(Level& level);
    double last_force_ = 0;  // of the last level, 0 if it did not converge
    void begin() {
        if (relaxes()) step(accepted_ ? time_ - *accepted_ : 0.0);
    }
    double time_ = 0;
    std::optional<double> accepted_;  // time of the last accepted level
};

}  // namespace rsc
