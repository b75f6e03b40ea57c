// Common to contacts of elements: checks of their input, and the contact spots that the pixels under pressure form.
#pragma once

#include "contact/indentation.hpp"
#include "contact/interaction/pixel_products.hpp"
#include "contact/level.hpp"
#include "rough/surface.hpp"

namespace rsc {

// Gives the heights back; throws Error(bad_input) for moduli, radii, heights or options out of range.
const HeightMap& require_elements(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options);

// Puts contacts, force, areas and pixels into a level. Contacts are sets of pixels connected by sides, with indenter.period finite also
// across the seam, and centroids then lie within the map. Areas are those of the pixels less (pi - 1 + ln 2)/24 of a pixel for each
// side of their border (Yastrebov, Anciaux and Molinari, J. Mech. Phys. Solids 107, 2017). For a pixel with the pressure H0 nothing is
// subtracted: it counts when its middle is in contact, which errs as often to one side as to the other. The sides of other pixels count
// 1 + s^2 times, s the share of the contact's pixels at the hardness, because the pressure may fall from H0 to 0 within one of them (ours,
// measured on smooth spheres 2 to 20 pixels wide: within 4 % of fine grids, 1 % where most yields). A contact yields when one of its pixels
// does. Its penetration is how far it alone presses in the place of its highest pressure (Johnson 1985, eq. 3.25).
// `touching`: pixels in contact, row by row, with their pressures > -tension [force/length^2].
void add_pixels(Level& level, const HeightMap& map, const Indenter& indenter, double H0, const std::vector<Pixel>& touching,
                std::vector<double> pressure, double tension = 0);

}  // namespace rsc
