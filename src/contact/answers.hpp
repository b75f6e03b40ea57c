// Results of a contact besides force and area: stiffness, energy, lateral force, conductance.
#pragma once

#include "contact/contact.hpp"
#include "contact/lateral.hpp"

namespace rsc {

// Constriction (Barber, Proc. R. Soc. A 459, 2003): the conductance of the contact is 2 S/(E* (rho_1 + rho_2)), S = -dN/dZ0, for one
// spot 4 a/(rho_1 + rho_2) (Holm); with point interaction it is Greenwood's (1966) problem of many spots. 2 S/E* is a length that needs
// no material data [length]. `stiffness` is dN/dZ0, negative.
double conductance_length(double stiffness, double E_star);

// (rho_1 + rho_2) over that length; NaN without contact and for resistivities that are both 0 [resistivity/length].
double constriction_resistance(double conductance_length, const double (&resistivity)[2]);

// Puts them into the last level of a contact. One more solution of linear equations, for the stiffness.
void add_answers(Contact& contact, Level& level, const double (&resistivity)[2]);

}  // namespace rsc
