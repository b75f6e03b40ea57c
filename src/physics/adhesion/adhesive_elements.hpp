// Adhesive boundary elements, free or periodic: the Maugis-Dugdale traction s0 = w/z0 acts across
// all gaps below z0, where w is the work of adhesion (Maugis, J. Colloid Interface Sci. 150, 1992).
//
// The traction acts where the gap, linear between the points, is below z0; a point carries the
// share of s0 that follows from the energy of this area. For a given attraction p, q >= 0 solves
// the problem without adhesion for heights raised by K p: one convex solve. The attraction is
// renewed, starting from that of the last accepted level, until it is that of the gaps. The state
// thus follows the previous one at a given separation; if there is none nearby, the contact jumps.
//
// The error of the pull-off force of smooth spheres is 1 % where the length E* z0^2/w, in which the
// traction acts at an edge of contact, is one to two pixels, and falls faster than the pixel.
#pragma once

#include "contact/model.hpp"
#include "physics/adhesion/sticking.hpp"
#include "surface/surface.hpp"

namespace rsc {

// Length over which the traction acts beside the edge of a contact: that of Dugdale's zone,
// (pi/8) K^2/s0^2 with K^2 = 2 E* w and s0 = w/z0 [length]. Elements resolve it, not z0, which is a
// height: heights and pressures may be multiplied by one number without a change of the problem.
inline double cohesive_length(double E_star, const Adhesion& adhesion) {
    return 0.25 * std::numbers::pi * E_star * adhesion.range * adhesion.range / adhesion.work;
}

// Share of w times the area that attracts, below which a step counts as reversible.
inline double loss_share(double range) { return range > 0 ? 1e-3 : 3e-3; }

// Throws Error(bad_input) if the cohesive length is less than half of the grid step.
void require_resolved(double E_star, const Adhesion& adhesion, double step);

// The heights, as require_elements() returns them, must outlive the contact. The options used are
// the tolerance, the number of iterations and the adhesion with a positive range. Throws
// Error(bad_input) for options that are not available with adhesion, and for a range below half a
// pixel. Of the functions of Model:
//   energy()      elastic energy minus s0 (z0 - w) integrated over the attracting points;
//   energy_lost of a level: that of the way from the last one, which is divided where the loss is
//                 least known, with a range into ten parts that attract at most, so that no level
//                 takes many times the work of a first one. A part that loses less than
//                 loss_share() counts as reversible, unless both its ends prove a loss
//   stiffness()   dN/dZ0 for fixed attracting points
//   move_tip()    follows the state along the straight (on a surface that repeats, the shortest)
//                 way of the tip at the last separation, in pieces of at most a quarter of a pixel;
//                 the work of a piece is that of the mean pressures of its ends. stiffness() and
//                 energy() are then those of the new position. Throws Error(bad_input) if points
//                 near the edge of a body (a punch) attract, Error(not_converged) if the path is
//                 lost; the tip and the state are then as before
std::unique_ptr<Model> make_adhesive_elements(const HeightMap& heights, const Indenter& indenter,
                                              const SolverOptions& options);

}  // namespace rsc
