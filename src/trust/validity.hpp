// Validity of the asperity model at a level: counts and conditions for the status out_of_validity.
#pragma once

#include "contact/indentation.hpp"
#include "contact/level.hpp"

namespace rsc {

// Smallest valid separation in rms heights; below it the tip of the sphere is lower than all but a
// thousandth of the surface.
inline constexpr double kLowestSeparation = -3;

// True if the contact area exceeds the nominal area.
bool exceeds_nominal_area(const LevelValues& level);

// Sets large_contacts, edge_contacts and nominal_area of a level with contacts and sums. Raises its
// status to out_of_validity if one of these holds: force_error_expected above 10 % (if unknown:
// contacts with a > <d>/4 or beyond the law); contacts closer to the border of a free surface than
// <d> or their radius; A above the nominal area; Z0 below -3 sigma. Conditions with unknown
// parameters are not tested.
void judge_range(Level& level, const Indenter& indenter, const SolverOptions& options);

// Sets the same values for boundary elements, which are valid for any size and depth of contacts.
// edge_contacts includes contacts with a pixel on the border, and nominal_area is the smallest disc
// about the tip that contains all pixels. Only edge_contacts raise the status.
void judge_edges(Level& level, const Indenter& indenter, const SolverOptions& options);

}  // namespace rsc
