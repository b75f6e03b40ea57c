// Common parts of boundary-element contacts: input checks, and contact spots formed by the pixels
// under pressure.
#pragma once

#include "contact/indentation.hpp"
#include "contact/level.hpp"
#include "elements/pixel_products.hpp"
#include "surface/surface.hpp"

namespace rsc {

// Returns the heights. Throws Error(bad_input) for moduli, radii, heights or options out of range.
const HeightMap& require_elements(const HeightMap& heights, const Indenter& indenter,
                                  const SolverOptions& options);

// Adds contacts, force, areas and pixels to a level. Contacts are sets of pixels connected by sides
// (with a finite indenter.period also across the borders of the map; centroids then lie within the
// map). Their areas are those of the pixels minus (pi - 1 + ln 2)/24 of a pixel for each side on
// the border (Yastrebov, Anciaux and Molinari, J. Mech. Phys. Solids 107, 2017). Nothing is
// subtracted for pixels at the pressure H0, whose errors cancel on average. For the sides of other
// pixels the correction is multiplied by 1 + s^2, where s is the share of the contact's pixels at
// the hardness, because the pressure may fall from H0 to 0 within one of them (empirical; within 4
// % of fine grids for smooth spheres 2 to 20 pixels wide, 1 % where most pixels yield). A contact
// yields if one of its pixels does. Its penetration is its own deflection at its highest pressure
// (Johnson 1985, eq. 3.25). `touching`: pixels in contact, row by row, with pressures > -tension
// [force/length^2].
void add_pixels(Level& level, const HeightMap& map, const Indenter& indenter, double H0,
                const std::vector<Pixel>& touching, std::vector<double> pressure,
                double tension = 0);

}  // namespace rsc
