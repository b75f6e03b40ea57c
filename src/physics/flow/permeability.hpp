// Permeability of the gap between two flats: Reynolds' thin film div(g^3 grad P) = 0 in the open
// gap, with pressures that are periodic apart from a mean gradient.
//
// Finite volumes on the points: between two open neighbours the conductance is the harmonic mean of
// g^3/12 times side over distance, as in ReynoldsFlow (github vyastreb/reynoldsflow). Only sets of
// points that wind around the cell carry fluid, and of these not the dead ends. The equations are
// solved by CHOLMOD (Chen, Davis, Hager and Rajamanickam, ACM Trans. Math. Softw. 35, 2008).
#pragma once

#include "physics/flow/openings.hpp"

namespace rsc {

// Flux per width q = -(K/eta) grad P of the means over the cell [length^3]; symmetric.
struct Permeability {
    double xx = 0, yy = 0, xy = 0;
};

// Flux per width q = S U that the smooth face drags along when it slides with the velocity U over
// the rough one at rest [length]; xy: along x, for a velocity along y.
struct ShearFlow {
    double xx = 0, xy = 0, yx = 0, yy = 0;
};

struct GapFlow {
    Permeability K;
    ShearFlow S;
};

// False if rsc was built without CHOLMOD.
bool has_permeability();

// Largest memory for n points [bytes], and the most points for that memory: from the peaks of gaps
// that are open everywhere, which take the most.
double permeability_bytes(double points);
double permeability_points(double bytes);

// Solves for the permeability, and computes from its pressures the shear flow, by reciprocity:
// S_as = <(g/2) (e_a + grad P_a)_s>, P_a the pressure of the mean gradient along a, g the mean gap
// of two open neighbours. `flow`: if not null, the magnitude of the flux at each point times
// eta for a mean gradient 1 along x [length^3], row by row. Links so narrow that rounding hides
// them next to the widest are left out. Throws Error(no_memory), and Error(internal) without
// CHOLMOD or if the equations are not solved to 1e-11 of K.
GapFlow permeability(const GapMap& map, std::vector<double>* flow = nullptr);

}  // namespace rsc
