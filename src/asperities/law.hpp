// Contact law: the force of one asperity at a penetration (paper, section 4: Hertz), the only
// property of an asperity that solvers use.
#pragma once

#include "contact/indentation.hpp"

namespace rsc {

class ShiftedSummits;

// Properties of a kind of law: required columns of asperities and treatment of spots.
struct LawTraits {
    const char* name;       // name in &asperities law
    bool needs_curvatures;  // kappa1, kappa2 and angle of every asperity
    bool needs_biharmonic;  // nabla^4 z at every summit
    // uses summits between grid points, not grid maxima (surface/detection.hpp)
    bool between_points;
    bool sinks;  // a flattened summit sinks in as a whole (hardness.hpp)
    // the contact area is that of the union of elliptic spots; otherwise the sum of circular areas
    bool elliptic_spots;
};
const LawTraits& traits(LawKind kind);

// Area for growth by truncation (hardness.hpp): the elastic area A(u), extrapolated linearly where
// it no longer describes a flattened summit, its slope and its integral over u.
struct Spread {
    double area = 0, slope = 0, integral = 0;  // [length^2], [length], [length^3]
};

// Force, slope df/du and work at a penetration.
struct Response {
    double force = 0, slope = 0, work = 0;
};

// Forces increase with the penetration u > 0; force and slope are 0 for u <= 0. Asperities are
// identified by their index in the Asperities from which the law was made, which must outlive it.
//
// A law may depend on the history of each asperity. Only commit(), which accepts a level, changes
// the history; respond() and area() can be called for any number of trial solutions.
class Law {
public:
    virtual ~Law() = default;

    // True if the force is a convex function of the penetration; uniqueness is proved for such laws
    // only.
    virtual bool convex() const { return true; }
    // True if commit() changes later results: levels then depend on earlier ones.
    virtual bool path_dependent() const { return false; }
    // Accepts a level with penetrations u[k] of asperity[k]; all other asperities are out of
    // contact.
    virtual void commit(int n, const int* asperity, const double* u) {
        (void)n;
        (void)asperity;
        (void)u;
    }

    // Precomputes the data of these asperities; must be called before any other function for them,
    // and again for elastic laws when an asperity has changed.
    virtual void prepare(std::span<const int> asperities) = 0;

    // For k = 0 .. n-1: force f(u), slope D = df/du and work W = int_0^u f du of asperity[k] at the
    // penetration u[k]; all are 0 if u[k] <=
    // 0.
    virtual void respond(int n, const int* asperity, const double* u, double* force, double* slope,
                         double* work) const = 0;

    Response response(int asperity, double u) const {  // of one asperity
        Response r;
        respond(1, &asperity, &u, &r.force, &r.slope, &r.work);
        return r;
    }
    virtual double force(int asperity, double u) const { return response(asperity, u).force; }
    virtual double area(int asperity, double u) const = 0;  // contact area [length^2]; 0 for u <= 0
    virtual double axes(int asperity) const = 0;            // b/a <= 1 of the contact ellipse
    virtual bool beyond(int asperity,
                        double u) const = 0;  // true beyond the range of validity of the law

    // Functions that only some models need. Hardness: growth of the area, and smallest penetration
    // at which the mean pressure f/A reaches a value.
    virtual Spread spread(int asperity, double u) const {
        return (void)asperity, (void)u, Spread{};
    }
    virtual double yield_penetration(int asperity, double pressure) const {
        return (void)asperity, (void)pressure, 0.0;
    }
    // Adhesion (sticking.hpp): d ln a/du of the contact radius a [1/length]; 0 where the radius is
    // constant.
    virtual double widening(int asperity, double u) const { return (void)asperity, (void)u, 0.0; }

    // Non-convex laws: upper bound of the secant slopes between penetrations up to `high`.
    virtual double steepest(int asperity, double high) const {
        return (void)asperity, (void)high, 0.0;
    }
    // Path-dependent laws: the penetration of a first loading that gives the spot of u, or from
    // which it was unloaded.
    virtual double first_loading(int asperity, double u) const { return (void)asperity, u; }
    // True if the asperity yields at u; residual depth after unloading [length]; dissipated work of
    // all asperities
    // [force length].
    virtual bool yields(int asperity, double u) const { return (void)asperity, (void)u, false; }
    virtual double residual_depth(int asperity) const { return (void)asperity, 0.0; }
    virtual double work_lost() const { return 0; }
    // The history of an asperity: its largest accepted penetration, 0 if it never yielded. forget()
    // removes the history.
    virtual double deepest(int asperity) const { return (void)asperity, 0.0; }
    // The asperities with a history, in increasing order.
    virtual std::span<const int> yielded() const { return {}; }

    virtual void forget() {}
};

// hertz: paraboloid of the asperity's radius r, f = (4/3) E* sqrt(r) u^(3/2), area pi r u.
// elliptic: Hertz with both principal curvatures (ellipse.hpp), the same with R_e = 1/sqrt(kappa1
// kappa2) for r and u/F2 for u, area times F1^2.
// fourth_order: the elliptic law for the profile A (1 - J0(q r)) (bessel_profile.hpp, delta =
// u/F2), which is r^2/(2 R_e) - b r^4 to fourth order, b = q^2/(32 R_e), and remains bounded:
// curvature 1/R_e, q^2 = -nabla^4 z/nabla^2 z = biharmonic/(kappa1 + kappa2), A = 2/(R_e q^2).
// Beyond delta = 2 A (q a = pi), where the contact would reach its neighbours, a and the stiffness
// 2 E* a are constant.
//
//
// With `shifts` the asperities are its summits, each of which is shifted before it is prepared.
// Throws Error(bad_input) if data required by the law are missing.
std::unique_ptr<Law> make_law(LawKind kind, const Asperities& asperities, double E_star,
                              ShiftedSummits* shifts = nullptr);

}  // namespace rsc
