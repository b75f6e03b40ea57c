// Stresses below the contacts of the asperity model: their Hertz pressures, put on a grid.
#pragma once

#include "contact/indentation.hpp"
#include "physics/stress/plane_stress.hpp"

namespace rsc {

// The pressures of the spots of a level on a grid, each that of Hertz over a circle of its area,
// integrated over the pixels.
struct SpotPressures {
    PointGrid grid;
    LevelPixels pixels;
};

// For stresses at `depth` [length]. Pixels are a twelfth of the mean radius of the spots, weighted
// by their forces, or a sixteenth of the depth, or as small as 4 million of them permit. With a
// finite period the grid is the rectangle `cell`, otherwise it reaches beyond the spots as far as
// their largest stresses may be.
SpotPressures pressures_of_spots(const Level& level, const Period& period, const Rectangle& cell,
                                 double depth);

}  // namespace rsc
