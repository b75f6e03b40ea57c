// Adhesive boundary elements, free or periodic: the Maugis-Dugdale traction s0 = w/z0 acts across all gaps below z0, where w is the work of
// adhesion (Maugis, J. Colloid Interface Sci. 150, 1992).
//
// A pixel is in contact (gap w = 0, p >= -s0), cohesive (0 < w < z0, p = -s0) or free (p = 0). For a given set C of attracting pixels, q =
// p + s0 >= 0 solves the problem without adhesion for heights raised by s0 K 1_C: one convex solve. C is renewed, starting from that of the
// last accepted level, until it contains exactly the pixels with gaps below z0. The state thus follows the previous one at a given
// separation; if there is none nearby, the contact jumps: pixels enter or leave C in an avalanche.
//
// The error is of first order in h/z0, where h is the side of a pixel: a range below two pixels causes a warning, below half a pixel an
// error.
#pragma once

#include "contact/contact.hpp"
#include "rough/surface.hpp"

namespace rsc {

// The heights, as require_elements() returns them, must outlive the contact. The options used are the tolerance, the number of iterations and
// the adhesion with a positive range. Throws Error(bad_input) for options that are not available with adhesion, and for a range below half a
// pixel. Of the functions of Contact:
//   energy()      elastic energy minus s0 (z0 - w) integrated over the attracting points; energy_lost of a level is the work done since the
//                 first level (trapezoidal rule over the levels) minus the change of the energy
//   stiffness()   dN/dZ0 for fixed attracting points
//   at_force(N)   searches a separation with the force, towards the surface if it is larger than the present force, otherwise away. If there
//                 is none, the level is that of the smallest force found, with Fallback::held
//   move_tip()    throws Error(bad_input) if any point attracts. On a surface that repeats the tip returns by whole periods, and contacts
//                 end at the border
//   memory()      separation, force, work done, smallest force, dissipated energy, then the attracting points
std::unique_ptr<Contact> make_adhesive_elements(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options);

}  // namespace rsc
