// Stresses below the contacts of the asperity model.
#pragma once

#include "contact/level.hpp"
#include "physics/stress/stress.hpp"

namespace rsc {

// Stress at the distance r from the axis and the depth z under a Hertz pressure of the force f over
// the circle of radius a (Huber 1904; Johnson 1985, section 3.4): xx radial, yy around the axis.
StressTensor hertz_stress(double r, double z, double f, double a, double nu);

// Largest stresses at `depth` [length] under the contacts of a level, each loaded by a Hertz
// pressure over a circle of its area, sought under the centre of each contact and on two rings
// around it, at half its radius and at its rim. Frictionless.
LargestStress stress_below(const Level& level, double nu, double depth);

}  // namespace rsc
