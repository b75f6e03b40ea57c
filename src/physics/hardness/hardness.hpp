// Yielding asperities with pressures limited by the hardness (Chang, Etsion, Bogy, J. Tribol. 109,
// 1987, with their factor 1).
//
// The given law holds while the mean pressure f/A is below H. From the penetration u_c on, where it
// reaches H, the area grows by truncation at constant pressure:
//     A = A(u_c) + 2 [A(u) - A(u_c)],   f = H A
//     (sphere: u_c = (3 pi H/(4 E*))^2 r, A = pi r (2u - u_c))
// where A(u) is the area of the elastic law, extrapolated linearly beyond its range
// (Truncation::spread). Force and area are continuous; the slope increases abruptly at u_c (sphere:
// from 1.5 pi H r to 2 pi H r). Unloading from (u_m, f_m, a_m) is elastic, like a sphere of radius
// r' = 4 E' a_m^3/(3 f_m) that touches at u_r = u_m - a_m^2/r'. E' = 3 f(u_c)/(4 a(u_c) u_c), which
// is E* for a sphere, makes u_r = 0 at the onset of yielding, also for elliptic spots. Reloading
// follows the same curve up to u_m. The history is u_m of every asperity. For u_m slightly above
// u_c (sphere: below 1.42 u_c) such unloading would return more work than was done. There the force
// is proportional to (u - u_r)^m with m > 3/2 such that all work is returned, so that a closed
// cycle never produces work.
//
// More accurate model, if `sinks` (law 'fourth_order'): the flattened summit also sinks in as a
// whole, by 4 H a/(pi E') at its border (disc of constant pressure, Johnson 1985, eq. 3.29b), so
// that its area depends on u - (4 H/(pi E')) [a - a(u_c)] in place of u. Compared with boundary
// elements of the same hardness, the force of a sphere is accurate to 6 % at u_c (where the middle
// has yielded since 0.44 u_c), 3 % at 2 u_c and 1 % at 5 u_c; without sinking it is 29 % too large
// at 2.7 u_c.
//
// Size effect (Swadener, George, Pharr 2002; paper, section 5): H_i = H0 sqrt(1 + l/r_i).
#pragma once

#include "physics/physics.hpp"

namespace rsc {

extern const Physics kHardness;

// Pressures are limited to H = H0 sqrt(1 + length/r), where r is the radius of an asperity.
struct Hardness {
    double H0 = kInfinity;  // [force/length^2]; Infinity: elastic
    double length = 0;      // length of the size effect [length]
    double at(double radius) const { return H0 * std::sqrt(1 + length / radius); }
};

// A law with limited pressures. Its memory is the largest accepted penetration of each asperity.
class YieldingLaw : public Law, public LawMemory {
public:
    // Accepts a level with penetrations u[k] of asperity[k]; all others are out of contact.
    virtual void commit(int n, const int* asperity, const double* u) = 0;
    virtual double deepest(int asperity) const = 0;    // 0 if it never yielded
    virtual std::span<const int> yielded() const = 0;  // in increasing order
    virtual double work_lost() const = 0;              // of all asperities [force length]
    virtual void forget() = 0;
};

// Wraps a law to limit its pressures; H0 is finite. Throws Error(bad_input) if the law cannot be
// truncated.
std::unique_ptr<YieldingLaw> make_yielding(std::unique_ptr<Law> elastic,
                                           const Asperities& asperities, const Hardness& hardness);

// The law of the bodies with its history: the largest penetration of each asperity that yielded.
// Throws Error(bad_input) unless H0 > 0 and length is finite and not negative.
AsperityPhysics make_yielding_asperities(const ContactBodies& bodies, std::unique_ptr<Law> elastic);

}  // namespace rsc
