// Validity of the asperity model at a level: the counts, and the conditions for status out_of_validity.
#pragma once

#include "contact/indentation.hpp"
#include "contact/level.hpp"

namespace rsc {

// Separations below this many rms heights are out of range: the sphere's tip lies under all but a thousandth of the surface.
inline constexpr double kLowestSeparation = -3;

// More contact than there is surface under the sphere.
bool exceeds_nominal_area(const LevelValues& level);

// Fills large_contacts, edge_contacts and nominal_area of a level whose contacts and sums are there, and raises its status to out_of_validity
// where one of these holds: N may be off by more than 10 % (force_error_expected; where that is not known: contacts with a > <d>/4, or
// beyond the law), contacts within <d>, or their own radius, of the border of a free surface
// (what would carry beyond it is missing), A above the nominal area, Z0 below -3 sigma. Each is judged only where what it needs is
// known.
void judge_range(Level& level, const Indenter& indenter, const SolverOptions& options);

// The same numbers for elements, whose contacts may be of any size and at any depth: edge_contacts are those whose middle is within <d>, or
// their own radius, of the border of a free surface, and those with a pixel on it, nominal_area is that of the smallest disc about the tip that holds all pixels. Only edge_contacts raise the
// status.
void judge_edges(Level& level, const Indenter& indenter, const SolverOptions& options);

}  // namespace rsc
