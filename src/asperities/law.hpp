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
    // the contact area is that of the union of elliptic spots; otherwise the sum of circular areas
    bool elliptic_spots;
};
const LawTraits& traits(LawKind kind);

// Force, slope df/du and work at a penetration.
struct Response {
    double force = 0, slope = 0, work = 0;
};

// Contact area at a penetration [length^2], 0 for u <= 0; b/a <= 1 of its ellipse; whether the
// penetration is beyond the range of validity of the law.
struct Footprint {
    double area = 0, axes = 1;
    bool beyond = false;
};

// What hardness asks of a law: how the area grows by truncation (physics/hardness/hardness.hpp).
class Truncation {
public:
    // The elastic area A(u), extrapolated linearly where it no longer describes a flattened summit,
    // its slope and its integral over u.
    struct Spread {
        double area = 0, slope = 0, integral = 0;  // [length^2], [length], [length^3]
    };
    virtual Spread spread(int asperity, double u) const = 0;
    // The smallest penetration at which the mean pressure f/A reaches this one.
    virtual double yield_penetration(int asperity, double pressure) const = 0;
    virtual bool sinks() const = 0;  // a flattened summit sinks in as a whole

protected:
    ~Truncation() = default;
};

// What adhesion asks of a law (physics/adhesion/sticking.hpp): d ln a/du of the contact radius a
// [1/length]; 0 where the radius is constant.
class Widening {
public:
    virtual double widening(int asperity, double u) const = 0;

protected:
    ~Widening() = default;
};

// What a law says of itself for the physics that needs it. What it does not say is not available,
// and that physics is refused with this law.
struct LawCapabilities {
    const Truncation* truncation = nullptr;
    const Widening* widening = nullptr;
    bool paraboloid = false;  // f ~ u^(3/2): adhesion with a range
    // The slope increases with the penetration, from 0: relaxation; uniqueness is proved for such
    // laws, and for those whose LawMemory bounds the slopes.
    bool convex = false;
};

// Laws that depend on the history of each asperity, which accepted levels change.
class LawMemory {
public:
    // Largest penetration at which the force is 0, after unloading [length].
    virtual double residual_depth(int asperity) const = 0;
    virtual bool yields(int asperity, double u) const = 0;
    // Upper bound of the secant slopes between penetrations up to `high`, for laws that are not
    // convex.
    virtual double steepest(int asperity, double high) const = 0;

protected:
    ~LawMemory() = default;
};

// Forces increase with the penetration u > 0; force and slope are 0 for u <= 0. Asperities are
// identified by their index in the Asperities from which the law was made, which must outlive it.
class Law {
public:
    virtual ~Law() = default;

    // Precomputes the data of these asperities; must be called before any other function for them,
    // and again for elastic laws when an asperity has changed.
    virtual void prepare(std::span<const int> asperities) = 0;

    // For k = 0 .. n-1: force f(u), slope D = df/du and work W = int_0^u f du of asperity[k] at the
    // penetration u[k]; all are 0 if u[k] <= 0.
    virtual void respond(int n, const int* asperity, const double* u, double* force, double* slope,
                         double* work) const = 0;
    virtual Footprint footprint(int asperity, double u) const = 0;

    // Default: none. The pointers belong to the law.
    virtual LawCapabilities capabilities() const { return {}; }
    // Null: levels do not depend on earlier ones.
    virtual const LawMemory* memory() const { return nullptr; }

    // Of one asperity:
    Response response(int asperity, double u) const {
        Response r;
        respond(1, &asperity, &u, &r.force, &r.slope, &r.work);
        return r;
    }
    double force(int asperity, double u) const { return response(asperity, u).force; }
    double area(int asperity, double u) const { return footprint(asperity, u).area; }
    // Largest penetration without a force.
    double onset(int asperity) const { return memory() ? memory()->residual_depth(asperity) : 0.0; }
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
// With `shifts` the asperities are its summits, each of which is shifted before it is prepared.
// Throws Error(bad_input) if data required by the law are missing.
std::unique_ptr<Law> make_law(LawKind kind, const Asperities& asperities, double E_star,
                              ShiftedSummits* shifts = nullptr);

// What laws of this kind can do, without asperities: the pointers only tell whether they can.
LawCapabilities capabilities_of(LawKind kind);

}  // namespace rsc
