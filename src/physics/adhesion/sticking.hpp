// Adhesive asperity (Johnson, Kendall and Roberts, Proc. R. Soc. A 324, 1971) for any law of
// law.hpp.
//
// The state of an attached asperity is s, the penetration at which the law without adhesion has the
// same contact area. With the force f0(s), slope D = df0/ds (the stiffness of a flat punch with
// this area), area A(s) and work W0(s) of that law, a contact with an edge in equilibrium with the
// work of adhesion w has
//     u = s - 2 h,   f = f0 - 2 h D,   h = sqrt(w A/D),   energy W = W0 - 2 h f0 + w A.
// For a sphere s = a^2/r and this is u = a^2/r - sqrt(2 pi w a/E*), f = 4 E* a^3/(3 r) - sqrt(8 pi
// w E* a^3). With l = d ln a/ds,
//     du/ds = 1 - l h,   df/ds = D (1 - 3 l h):
// at a given separation the asperity detaches where l h = 1 (sphere: f = -(5/6) pi w r); its force
// is smallest where l h = 1/3 (-(3/2) pi w r). A free asperity attaches at u = 0. The edge of an
// elliptic contact is in equilibrium on average. Law 'fourth_order': where l h reaches 1/3 again
// before the trough around the summit, the contact would spread to the trough spontaneously.
// Beyond, radius and stiffness are constant, as beyond the trough without adhesion; such contacts
// count as beyond the law.
//
// With a range z0 of the attraction (Maugis 1992; Dugdale traction s0 = w/z0 across gaps below z0)
// an asperity has the contact radius a and attracts up to the radius c; the state is s = c^2/r. The
// law must be that of a paraboloid, f0 ~ s^(3/2), with modulus E and radius r (ellipses are
// replaced by circles of the same area). With e^2 = c^2 - a^2 and cos(beta) = a/c,
//     u = a^2/r - 2 s0 e/E,   f = 2 E (u a - a^3/(3 r)) - 4 s0 (pi c^2/4 - int_0^a sqrt(c^2 - t^2)
//     dt),
//     z0 = (c^2 beta + a e - 2 a^2 beta)/(pi r) + (4 s0/(pi E)) (e beta - c + a)     the gap at c
// and before contact, a = 0, u = c^2/(2 r) - 4 s0 c/(pi E) - z0, f = -pi s0 c^2 (Kim, McMeeking and
// Johnson 1998): u, f and their slopes are continuous. A free asperity attaches at u = -z0. The
// stiffness at a fixed c is 2 E a; D is at least a tenth of 2 E c, because attached.hpp
// requires a positive value. A larger D than necessary makes it take stable states of close
// neighbours for unstable ones.
#pragma once

#include "asperities/law.hpp"

namespace rsc {

// Adhesion of the bodies.
struct Adhesion {
    double work = 0;   // work of adhesion w [force/length]; 0: no adhesion
    double range = 0;  // range z0 of the attraction [length]; 0: JKR
};

class Sticking {
public:
    // w: work of adhesion [force/length], positive; range: z0 [length], 0: JKR. The law must
    // outlive this object. Throws Error(bad_input) unless the law can widen, and with a range is
    // that of a paraboloid.
    Sticking(Law& law, double w, double range = 0);

    double touches() const { return -z0_; }  // penetration at which a free asperity attaches

    // Must be called before other functions for these asperities.
    void prepare(std::span<const int> asperities);

    // Attached asperity in the state s >= least().
    struct State {
        double u = 0, f = 0;    // penetration [length], force
        double du = 0, df = 0;  // derivatives with respect to s; du > 0 except at s = least()
        double stiffness =
            0;               // D: df/du at a fixed contact area, or the least that the solver needs
        double clamped = 0;  // df/du at a fixed contact area
        // elastic energy minus w A; in equilibrium its derivative with respect to u is f
        double energy = 0;
        double area = 0;
        double pressed = 0;   // force of the law at this area; f - pressed is the tension
        double outer = 0;     // area including the cohesive ring
        bool beyond = false;  // the radius is constant
    };
    State at(int asperity, double s) const;

    double least(int asperity) const {
        return limits_[place(asperity)].least;
    }  // state of detachment at a given separation
    double lets_go(int asperity) const {
        return limits_[place(asperity)].lets_go;
    }                                               // penetration at detachment, negative
    double state_at(int asperity, double u) const;  // state s at the penetration u > lets_go()
    // Energy lost by an asperity on its own when it attaches, or detaches.
    double loss(int asperity, bool attaches) const {
        const Limits& of = limits_[place(asperity)];
        return attaches ? of.lost_attaching : of.lost_detaching;
    }

private:
    struct Limits {
        double least = 0, lets_go = 0;
        double lost_attaching = 0, lost_detaching = 0;
        double last = 0;      // the radius is constant from here on; Infinity: never
        double E = 0, r = 0;  // of the paraboloid, if the range is positive
    };
    Limits limits_of_range(int asperity) const;
    Limits limits_of_jkr(int asperity) const;
    State attracting(const Limits& of, double s) const;
    std::size_t place(int asperity) const { return std::size_t(place_[std::size_t(asperity)]); }
    State bare(int asperity, double s) const;        // without the limit `last`
    double spreading(int asperity, double s) const;  // l h

    Law& law_;
    const Widening& widening_;
    double w_, z0_;
    std::vector<int> place_;  // index of an asperity in limits_; -1: not prepared
    std::vector<Limits> limits_;
};

}  // namespace rsc
