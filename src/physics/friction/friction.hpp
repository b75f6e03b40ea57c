// Friction of a contact with a known load curve. Partial slip is the superposition of two normal
// contacts (Ciavarella, Int. J. Solids Struct. 35, 1998; Jaeger, Arch. Appl. Mech. 68, 1998).
//
// With the approach delta = -Z0, the load N(delta), its stiffness S = dN/ddelta and its energy W,
// dW/ddelta = N, a contact with friction mu responds to a slide xi like a set of springs. Spring s
// touches at the approach s; per ds it has the normal stiffness S'(s) and the tangential stiffness
// m S'(s), so that
//     N = int S'(s) (delta - s) ds,   Q = m int S'(s) u(s) ds,
//     |u(s)| <= (mu/m) (delta - s),   m = 4 G*/E*,
// u is the tangential deflection of the spring: it follows the slide within the disc of its
// friction limit. u(s) is piecewise linear and changes by at most mu/m per unit of s; integration
// by parts gives
//     Q = -m sum over the pieces of u' [N(s_end) - N(s_begin)],
// so that only loads at the ends of the pieces (the memory of the contact) are needed and no level
// is interpolated. A larger reversal or a smaller load removes the pieces above the point where it
// reaches the limit.
//
// Not included: coupling of the normal and tangential problems for different materials (Poisson's
// ratio), and the variation of the direction of slip within a spot. For slides in two directions,
// all slipping springs are assumed to pull in the direction of the spring at the inner edge of the
// slip, and the slipping part of Q has the magnitude mu [N(delta) - N(s*)]. The dissipated work is
// positive for all paths; slides along one line are exact.
#pragma once

#include "base/std.hpp"

namespace rsc {

// Load curve of a contact as a function of the approach, the only property of a contact that
// friction uses.
class LoadCurve {
public:
    struct Load {
        double force = 0;   // N(delta) [force]
        double energy = 0;  // W(delta), dW/ddelta = N [force length]
    };
    virtual ~LoadCurve() = default;
    // Approach at first touch, at and below which all results are 0; Infinity if nothing can touch.
    virtual double first_touch() const = 0;
    virtual Load load(double delta) = 0;
    virtual double stiffness(double delta) = 0;  // S = dN/ddelta >= 0
    virtual double approach(double force) = 0;   // delta at which N(delta) = force > 0
};

struct Friction {
    double coefficient = 0;  // mu >= 0
    double ratio = 1;        // m = 4 G*/E*: tangential stiffness over the normal one
    // mu/m: after loading by delta, full slip begins at the slide (mu/m) delta.
    double slide_per_approach() const { return coefficient / ratio; }
};

// Throws Error(bad_input) unless mu is finite and not negative and m is finite and positive.
void require_friction(const Friction& friction);

struct Slide {
    double x = 0, y = 0;
};

// A contact with friction along any path of approach and slide.
class FrictionHistory {
public:
    explicit FrictionHistory(const Friction& friction);  // throws as require_friction

    // Follows a straight path to (delta, xi). The first call defines the beginning of the path,
    // with a contact (if any) that has been pressed without sliding. A slide without contact has no
    // effect: only differences of xi matter. `curve` must be the same in all calls.
    // If it throws, the state is unchanged.
    void go_to(LoadCurve& curve, double delta, Slide xi);

    // To be called after the sphere has moved to a place with the load curve `curve`, at the same
    // approach. Deflections are kept at the same relative depth below first touch and multiplied by
    // `share`, the share of the force carried by asperities common to both places.
    // The tangential energy does not increase; its decrease counts as dissipated work.
    void move(LoadCurve& curve, double share);

    double approach() const { return now_.delta; }
    Slide slide() const { return now_.xi; }
    double force() const { return now_.nodes.empty() ? 0 : now_.nodes.back().load; }  // N
    // Tangential force Q: along +xi after a first slide along +xi; it pulls the sphere back.
    Slide tangential_force() const;
    // Elastic energies: W of the normal contact, and (m/2) int S' u^2 ds stored by the slide.
    double normal_energy() const { return now_.nodes.empty() ? 0 : now_.nodes.back().energy; }
    double tangential_energy() const;
    // Dissipated friction work, in total and of the last step. Along any path, int Q dxi = change
    // of tangential_energy() + work_lost().
    double work_lost() const { return now_.lost; }
    double step_lost() const { return now_.step_lost; }
    // Approach s below which all springs stick: approach() if all do, first touch if none does.
    double stick_approach() const;

    // Tangential stiffness dQ/dxi for a further slide at constant approach that continues the
    // present slip. Without slip, and for a reversed slide, it is m S(delta) in all directions.
    struct Tangent {
        double xx = 0, xy = 0, yx = 0, yy = 0;
    };
    Tangent stiffness(LoadCurve& curve) const;

    // u(s) is linear between nodes; the first node is at first touch, the last at delta, where u =
    // 0.
    struct Node {
        double approach = 0, load = 0, energy = 0;  // s, N(s), W(s)
        Slide deflection;                           // u(s)
    };
    struct State {
        bool begun = false;
        double delta = 0;
        Slide xi;
        std::vector<Node> nodes;  // empty without contact
        double lost = 0, step_lost = 0;
    };
    const Friction& friction() const { return friction_; }
    const State& state() const { return now_; }
    // Restores a state returned by state(). Throws Error(bad_input) if it does not belong to this
    // friction.
    void restore(const State& state);

private:
    // Advance along a part of a step within which no node of the memory is released.
    void advance(LoadCurve& curve, State& state, double delta, Slide dxi) const;
    void slip(LoadCurve& curve, State& state, double dd, Slide dxi, double old_delta,
              std::vector<Node> free) const;

    Friction friction_;
    State now_;
};

// --- First loading and cycles at a constant approach
// ----------------------------------------------------------------------------

// First loading: pressed to delta without sliding, then slid. Springs above delta* slip: Q = mu
// [N(delta) - N(delta*)], xi = (mu/m) (delta
// - delta*), tangential stiffness m S(delta*).
struct SlidePoint {
    double stick_approach = 0;  // delta*
    double displacement = 0;    // xi
    double force = 0;           // Q
};
// Solves for given slides xi >= 0; beyond full slip Q = mu N. Throws Error(bad_input) without
// contact at delta, or for a slide that is negative or not finite.
std::vector<SlidePoint> slide_to(LoadCurve& curve, const Friction& friction, double delta,
                                 const std::vector<double>& xi);
// Solves for a given force 0 <= Q <= mu N(delta). Throws Error(bad_input) for other forces and
// without contact.
SlidePoint slide_at_force(LoadCurve& curve, const Friction& friction, double delta, double Q);
// Slide at which full slip begins, (mu/m) (delta - first touch).
double full_slip(const LoadCurve& curve, const Friction& friction, double delta);

// First loading in equal steps of xi to full slip, then cycles between +-amplitude. After a
// reversal at A, Q = Q_A - 2 mu [N - N(delta**)] and xi = xi_A - 2 (mu/m) (delta - delta**), up to
// full slip.
struct SlideCycles {
    int steps = 20;  // of the first loading, and from one end of a cycle to the other
    int cycles = 1;
    std::size_t first() const { return at(steps) + 1; }  // points of the first loading
    // Points of the first loading and of the cycles, from one end at +amplitude to the last.
    std::size_t points() const { return first() + 2 * at(steps) * at(cycles) + 1; }
};
struct SlideCycle {
    std::vector<double> displacement, force;
    double work = 0;  // dissipated in a cycle, the area of the loop
};
SlideCycle slide_cycle(LoadCurve& curve, const Friction& friction, double delta, double amplitude,
                       const SlideCycles& in);

}  // namespace rsc
