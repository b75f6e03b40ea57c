// The contact law: the force of one asperity at a penetration (paper, section 4: Hertz). Solvers know nothing else of an asperity.
#pragma once

#include "contact/indentation.hpp"

namespace rsc {

// Properties of a kind of law: the columns of asperities it needs, and how its spots are treated.
struct LawTraits {
    const char* name;       // as &asperities law spells it
    bool needs_curvatures;  // kappa1, kappa2 and angle of every asperity
    bool needs_biharmonic;  // nabla^4 z at every summit
    bool between_points;    // wants the summits between the points of the grid, not the highest points (rough/summits.hpp)
    bool sinks;             // a summit that is pressed flat sinks in as a whole (hardness.hpp)
    bool elliptic_spots;    // spots are ellipses, and the contact area that of their union; otherwise circles whose areas add up
};
const LawTraits& traits(LawKind kind);

// How the area of a contact grows once it does so by truncation (hardness.hpp): the elastic area A(u), continued along a straight line
// where it ceases to describe a summit that is pressed flat; its slope; its integral over u.
struct Spread {
    double area = 0, slope = 0, integral = 0;  // [length^2], [length], [length^3]
};

// A law is increasing in the penetration u > 0, with force 0 and slope 0 for u <= 0. Asperities are named by their index in the
// Asperities the law was made from, which must outlive it.
//
// A law may remember what each asperity has been through. respond(), force() and area() answer from what is remembered and never
// change it, so that any number of trial solutions may be looked at; commit() alone tells the law that a level was accepted.
class Law {
public:
    virtual ~Law() = default;

    // True if the force is a convex function of the penetration; uniqueness is proved for such laws only.
    virtual bool convex() const { return true; }
    // True if commit() changes later results: a level then depends on those before it.
    virtual bool path_dependent() const { return false; }
    // The level with penetrations u[k] of asperity[k] (all others are out of contact) is accepted.
    virtual void commit(int n, const int* asperity, const double* u) { (void)n, (void)asperity, (void)u; }

    // Works out what the law needs of these asperities; must come before anything is asked of them.
    virtual void prepare(std::span<const int> asperities) = 0;

    // For k = 0 .. n-1: force f(u), slope D = df/du and work W = int_0^u f du of asperity[k] at penetration u[k];
    // all three are 0 where u[k] <= 0.
    virtual void respond(int n, const int* asperity, const double* u, double* force, double* slope, double* work) const = 0;

    virtual double force(int asperity, double u) const = 0;
    virtual double area(int asperity, double u) const = 0;  // contact area [length^2]; 0 for u <= 0
    virtual double axes(int asperity) const = 0;            // b/a <= 1 of the contact ellipse
    virtual bool beyond(int asperity, double u) const = 0;  // the penetration is past the law's own range: see the laws

    // What only some uses ask of a law; those that are never asked leave it out.
    // Hardness: how the area grows, and where the mean pressure f/A first is so high.
    virtual Spread spread(int asperity, double u) const { return (void)asperity, (void)u, Spread{}; }
    virtual double yield_penetration(int asperity, double pressure) const { return (void)asperity, (void)pressure, 0.0; }
    // Adhesion (sticking.hpp): d ln a/du of the contact radius a, 0 where the radius stays [1/length].
    virtual double widening(int asperity, double u) const { return (void)asperity, (void)u, 0.0; }

    // Of laws that are not convex: no secant between two penetrations up to `high` is steeper.
    virtual double steepest(int asperity, double high) const { return (void)asperity, (void)high, 0.0; }
    // Of laws that remember: whether the asperity yields at u; how far it stays pressed down without force [length]; the work all
    // asperities have taken that does not come back [force length].
    virtual bool yields(int asperity, double u) const { return (void)asperity, (void)u, false; }
    virtual double residual_depth(int asperity) const { return (void)asperity, 0.0; }
    virtual double work_lost() const { return 0; }
    // Their whole memory: the deepest penetration of a level that was accepted, 0 where the asperity never yielded. Goes back to none.
    virtual double deepest(int asperity) const { return (void)asperity, 0.0; }
    virtual void forget() {}
};

// hertz         a paraboloid of the asperity's radius: f = (4/3) E* sqrt(r) u^(3/2), area pi r u.
// elliptic      Hertz with both principal curvatures, R_e = 1/sqrt(kappa1 kappa2): u/F2 in the law above, area times F1^2 (ellipse.hpp).
// fourth_order  the elliptic law on the profile A (1 - J0(q r)), that of waves of one length from all directions: its curvature is
//               1/R_e and its flattening the surface's own, q^2 = -nabla^4 z/nabla^2 z = biharmonic/(kappa1 + kappa2), A = 2/(R_e q^2).
//               To fourth order it is r^2/(2 R_e) - b r^4, b = q^2/(32 R_e); its higher terms keep the flattening within bounds.
//               Its contact: bessel_profile.hpp, at delta = u/F2. Beyond delta = 2 A, q a = pi, where the contact would meet its
//               neighbours', a stays and the stiffness 2 E* a with it.
// Throws Error(bad_input) when the asperities lack what the law needs.
std::unique_ptr<Law> make_law(LawKind kind, const Asperities& asperities, double E_star);

}  // namespace rsc
