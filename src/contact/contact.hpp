// The contact of a rough surface with an indenter, level by level, whatever it is made of: asperities (asperity_contact.hpp) or elements.
#pragma once

#include "contact/level.hpp"

namespace rsc {

class Contact {
public:
    virtual ~Contact() = default;

    // The answer at the separation Z0 [length], which is accepted: where path_dependent(), later levels depend on it. Never
    // throws for a level that did not converge: see Level::status. Throws Error(bad_input) if Z0 is not finite.
    Level at_separation(double Z0);

    // The separation at which the indenter carries the force N [force], N > 0 but with adhesion, and the answer there, to the tolerance or to the
    // spacing of floating-point numbers Z0, whichever is coarser. Separations tried on the way have no effect on later levels.
    Level at_force(double N);

    // The time of the levels that follow, for bodies that relax (relaxes(); others do not ask): loads are taken to change linearly with it
    // from the last accepted level; the first level is reached at once. Throws Error(bad_input) if it is not finite or before that level.
    void set_time(double time);
    double time() const { return time_; }
    virtual bool relaxes() const { return false; }

    // Of the last level:
    // dN/dZ0 (negative; 0 without contact) [force/length].
    virtual double stiffness() = 0;
    // Elastic energy W, with dW/dZ0 = -N [force length]. Its error is of the order of the square of the residual.
    virtual double energy() const = 0;

    // Moves the tip to (x0, y0). The last level may serve as a start for the next. Throws Error(bad_input) if not finite.
    virtual void move_tip(double x0, double y0) = 0;

    // Z0 at which the indenter touches the surface [length]; -Infinity when nothing lies under it.
    virtual double first_touch() const = 0;

    virtual const Indenter& indenter() const = 0;

    // The asperities it is made of, as they touch now: their places, heights and curvatures. Null for elements.
    virtual const Asperities* asperities() const { return nullptr; }

    // Goes on as a contact newly made with the tip here: earlier levels are no start for the next.
    void forget() {
        last_.reset();
        last_force_ = 0;
        forget_levels();
    }

    // True if a level depends on those before it. energy() is then the recoverable energy, and stiffness() that of unloading; of bodies that
    // relax, the energy their springs hold, and the stiffness of a sudden step.
    virtual bool path_dependent() const { return false; }
    // Whether forces may be negative: adhesion.
    virtual bool pulls() const { return false; }
    // All that accepted levels leave behind, as numbers that only a contact made alike understands; empty where nothing stays.
    virtual std::vector<double> memory() const { return {}; }
    // Goes back to such a memory and to the last level that was accepted before it was taken; null: there was none. energy() and stiffness()
    // speak of that level, and later levels start from it. The tip must be at its place of then.
    virtual void recall(const std::vector<double>& memory, const Level* level) = 0;

    // Residual depth of each asperity without force [length]; empty if none yielded.
    virtual std::vector<double> residual_depths() const { return {}; }
    // Elements: the points that yielded, and how far each stays lowered.
    virtual ResidualProfile residual_profile() const { return {}; }

protected:
    // State that a model keeps of earlier levels.
    virtual void forget_levels() = 0;

    // A trial: the answer at Z0, which stiffness() and energy() then speak of.
    virtual Level solve(double Z0) = 0;
    // The answer under the force N, of a model that can solve for a force directly; force control then uses nothing else.
    virtual std::optional<Level> solve_under(double N) {
        (void)N;
        return std::nullopt;
    }
    // On the way to a separation: a solution at Z0 near the last one, of its force, cheaper than solve() but not its answer where there
    // are several. settle() then gives the answer there; its counts are those of what more was done.
    virtual Level pass(double Z0) { return solve(Z0); }
    virtual Level settle(const Level& passed) {
        Level level = passed;
        level.iterations = 0, level.products = 0;
        return level;
    }
    // dN/dZ0 of the last trial as solve() counts separations, good enough for Newton's method on Z0.
    virtual double slope();
    // The last level solved is accepted: a model with a path stores it, and adds the plastic work to the level.
    virtual void accept(Level& level) { (void)level; }
    // Where relaxes(): trials that follow end a step that began at the last accepted level and takes dt.
    virtual void step(double dt) { (void)dt; }
    // The time of the last accepted level, as the first number of memory(); NaN: there is none.
    double accepted_time() const { return accepted_.value_or(std::numeric_limits<double>::quiet_NaN()); }
    void recall_time(double accepted);

    // Between flats that repeat, solve() counts separations from where no force raises the surface (Kernel::shift()): the level at
    // the separation Z0 of the mean planes is its Z0 - shift() N. first_touch() is the same.
    virtual double shift() const { return 0; }

    // The separation of full contact: at and below it solve() has no solution.
    virtual double closed() const { return -std::numeric_limits<double>::infinity(); }

    // Functions of a model that force control needs.
    virtual double tolerance() const = 0;                         // relative, of the force
    virtual double force_at_most(double depth) = 0;               // pressed in so far from the first touch; a bound, exact for one place
    virtual std::optional<double> likely_separation() const = 0;  // where to begin; none: near first touch
    virtual std::size_t levels_since_move() const = 0;            // solved since the tip was moved, at most a few

private:
    // Level at the separation Z0 of the mean planes, where shift() > 0.
    Level solve_between_planes(double Z0);

    struct Trial {
        double separation, force, slope;  // as solve() and slope() have them
    };
    std::optional<Trial> last_;  // the last level, where shift() > 0: a place to begin

    // Accepts a level, unless it did not converge, and completes it by what an area is needed for.
    void finish(Level& level);
    double last_force_ = 0;  // of the last level, 0 if it did not converge
    void begin() {
        if (relaxes()) step(accepted_ ? time_ - *accepted_ : 0.0);
    }
    double time_ = 0;
    std::optional<double> accepted_;  // the time of the last accepted level
};

}  // namespace rsc
