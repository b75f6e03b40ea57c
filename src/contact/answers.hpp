// Results of a contact besides force and area: stiffness, energy, lateral force, conductance.
#pragma once

#include "contact/contact.hpp"
#include "contact/lateral.hpp"

namespace rsc {

// Conductance length 2 S/E* [length], where `stiffness` is dN/dZ0 = -S (negative). The conductance of the contact is this length over
// (rho_1 + rho_2) (Barber, Proc. R. Soc. A 459, 2003): 4 a/(rho_1 + rho_2) for one spot (Holm), and Greenwood's (1966) result for many
// spots with point interaction.
double conductance_length(double stiffness, double E_star);

// Constriction resistance (rho_1 + rho_2)/conductance_length [resistivity/length]; NaN without contact or if both resistivities are 0.
double constriction_resistance(double conductance_length, const double (&resistivity)[2]);

// Adds these results to the last level of a contact. The stiffness requires one more linear solve.
void add_answers(Contact& contact, Level& level, const double (&resistivity)[2]);

}  // namespace rsc
