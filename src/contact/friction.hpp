// Friction of a contact whose normal answer is known: partial slip is the normal problem twice (Ciavarella, Int. J. Solids Struct. 35,
// 1998; Jaeger, Arch. Appl. Mech. 68, 1998).
//
// With the approach delta = -Z0, the load N(delta), its stiffness S = dN/ddelta and its energy W, dW/ddelta = N, a contact with
// friction mu answers to a slide xi as springs do. The spring labelled s touches when the approach is s; per ds it has the normal
// stiffness S'(s) and the tangential stiffness m S'(s), so that
//     N = int S'(s) (delta - s) ds,   Q = m int S'(s) u(s) ds,   |u(s)| <= (mu/m) (delta - s),   m = 4 G*/E*,
// u being the spring's tangential deflection: it follows the slide, except where it would leave the disc of its friction limit.
// u(s) changes by mu/m per unit of s at most, and is made of straight pieces; integrated by parts
//     Q = -m sum over the pieces of u' [N(s_end) - N(s_begin)],
// so that the load at the ends of the pieces, the memory of the contact, is all that is needed: no level is interpolated. A larger
// reversal, or less load, wipes out the pieces above the point where it meets the limit.
//
// Not included: the coupling of normal and tangential problem for unlike bodies (Poisson's ratio), and that the direction of slip varies
// within a spot. With slides in two directions, all that slips at a time is taken to pull in one direction, that of the spring at the
// inner edge of the slip: the slipping part of Q has the magnitude mu [N(delta) - N(s*)] (circular disc rule for the sum). The work
// lost is positive whatever the path; slides along one line are exact.
#pragma once

#include "contact/load_curve.hpp"
#include "std.hpp"

namespace rsc {

struct Friction {
    double coefficient = 0;  // mu >= 0
    double ratio = 1;        // m = 4 G*/E*: tangential stiffness over the normal one
    // (mu/m): full slip after first loading by delta takes the slide (mu/m) delta.
    double slide_per_approach() const { return coefficient / ratio; }
};

// Throws Error(bad_input): mu negative or not finite, m not positive and finite.
void require_friction(const Friction& friction);

struct Slide {
    double x = 0, y = 0;
};

// A contact with friction along any path of approach and slide.
class FrictionHistory {
public:
    explicit FrictionHistory(const Friction& friction);  // throws as require_friction

    // Goes on a straight path to (delta, xi). The first call only says where the path begins: the contact there, if any, is one that was
    // pressed without being slid. A slide without contact does nothing: only differences of xi count. `curve` must be that of every call
    // before. If it throws, nothing has changed.
    void go_to(LoadCurve& curve, double delta, Slide xi);

    // The sphere has moved to where its load curve is `curve`; the approach stays. Deflections are kept at the same share of the depth below the
    // first touch, times the share of the force that asperities carry at both places. Their energy falls or stays; what it falls by is lost.
    void move(LoadCurve& curve, double share);

    double approach() const { return now_.delta; }
    Slide slide() const { return now_.xi; }
    double force() const { return now_.nodes.empty() ? 0 : now_.nodes.back().load; }  // N
    // Force of the contact against the slide: it points along +xi after a first slide along +xi; the sphere is pulled back by it.
    Slide tangential_force() const;
    // Elastic energies: W of the normal problem, and that stored by the slide, (m/2) int S' u^2 ds.
    double normal_energy() const { return now_.nodes.empty() ? 0 : now_.nodes.back().energy; }
    double tangential_energy() const;
    // Friction work, in total and of the last step. Along any path, int Q dxi = change of tangential_energy() + work lost.
    double work_lost() const { return now_.lost; }
    double step_lost() const { return now_.step_lost; }
    // The spring (approach) inside which all stick: approach() where all do, first touch where none does.
    double stick_approach() const;

    // dQ/dxi, row by row, of a further slide at this approach in the direction of what slips now; m S(delta) in all directions where
    // nothing slips, and for a slide back.
    struct Tangent {
        double xx = 0, xy = 0, yx = 0, yy = 0;
    };
    Tangent stiffness(LoadCurve& curve) const;

    // The state is a value: commit() makes it the one that rollback() goes back to.
    void commit() { committed_ = now_; }
    void rollback() { now_ = committed_; }

    // u(s) is straight between nodes; the first node is the first touch, the last one delta, where u = 0.
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
    const State& committed() const { return committed_; }
    // Restores states returned by state() and committed(). Throws Error(bad_input) where they are none of this friction.
    void restore(const State& now, const State& committed);

private:
    // The path within a step, between points where a spring of the memory lets go.
    void advance(LoadCurve& curve, State& state, double delta, Slide dxi) const;
    void slip(LoadCurve& curve, State& state, double dd, Slide dxi, double old_delta, std::vector<Node> free) const;

    Friction friction_;
    State now_, committed_;
};

// --- First loading and cycles at a constant approach ----------------------------------------------------------------------------

// Pressed to delta at rest, then slid: springs above delta* slip, Q = mu [N(delta) - N(delta*)], xi = (mu/m) (delta - delta*), with the
// tangential stiffness m S(delta*).
struct SlidePoint {
    double stick_approach = 0;  // delta*
    double displacement = 0;    // xi
    double force = 0;           // Q
};
// At given slides xi >= 0; beyond full slip Q = mu N. Throws Error(bad_input): no contact at delta, a slide negative or not finite.
std::vector<SlidePoint> slide_to(LoadCurve& curve, const Friction& friction, double delta, const std::vector<double>& xi);
// At a given force 0 <= Q <= mu N(delta). Throws Error(bad_input) beyond that, and without contact.
SlidePoint slide_at_force(LoadCurve& curve, const Friction& friction, double delta, double Q);
// The slide at which all slips, (mu/m) (delta - first touch).
double full_slip(const LoadCurve& curve, const Friction& friction, double delta);

// First loading in equal steps of xi to full slip, then from the point at `amplitude` of it to the opposite one and back:
// on the way from A, Q = Q_A - 2 mu [N - N(delta**)], xi = xi_A - 2 (mu/m) (delta - delta**).
struct SlideCycle {
    std::vector<double> displacement, force;  // first loading, 0 to full slip; then the cycle, closed
    std::size_t first = 0;                    // points of the first loading
    double work = 0;                          // lost in one cycle: the loop's area
};
// `steps` of the first loading, 20 or more in multiples of 10; amplitude = 0.9.
inline constexpr double kCycleAmplitude = 0.9;
SlideCycle slide_cycle(LoadCurve& curve, const Friction& friction, double delta, int steps);
// Number of points of slide_cycle(), those of the first loading included.
std::size_t slide_cycle_points(int steps);

}  // namespace rsc
