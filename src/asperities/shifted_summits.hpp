// Where an indenter touches the summits of a surface: the second-order shift of each summit.
#pragma once

#include "contact/level.hpp"
#include "surface/asperities.hpp"

namespace rsc {

// Summits of the difference between a surface and the face of an indenter, to second order. Where
// the face has the gradient g and the curvatures C above a summit of curvatures H, the summit of
// the difference has the curvatures H' = H + C and lies at d = -H'^-1 g from that of the surface:
// d maximises z - d'H d/2 - s(d) for the paraboloids of both bodies. It is sought only in the
// summit's own range, |d| <= min(1/q, `farthest`), q^2 = biharmonic/(kappa1 + kappa2) (law.hpp); at
// the border of the range d maximises the same on that circle. Summits outside the face, or where
// H' is not positive definite, are unchanged. Number and order are those of the surface; the result
// depends on nothing else than the arguments.
Asperities shifted_summits(const Asperities& of_surface, const Indenter& indenter, double farthest);

// Largest slope of the face at the contacts of a level; 0 if there are none.
double steepest_contact(const Level& level, const Indenter& indenter);

}  // namespace rsc
