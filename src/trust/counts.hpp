// Counts of a level that say how near it is to the limits of its model.
#pragma once

#include "contact/level.hpp"

namespace rsc {

// Sets large_contacts, wide_contacts, edge_contacts, nominal_area and indenter_slope of a level.
void count_contacts(Level& level, const Indenter& indenter, const SolverOptions& options);

// True if the contact area exceeds the nominal area.
bool exceeds_nominal_area(const LevelValues& level);

}  // namespace rsc
