// The lateral force on a sphere held above its place (physics: Hellmann-Feynman on the elastic energy of the contact).
#pragma once

#include "contact/level.hpp"

namespace rsc {

struct Vec2 {
    double x = 0, y = 0;
};

// The force that pushes the sphere sideways at fixed Z0 [force]: F = -dW/d(x0, y0) with W the elastic energy of the contact. dW = sum f_i dg0_i
// at a solution, so F_x = -sum f_i (x_i - x0)/sqrt(R^2 - rho_i^2), F_y alike: exact in the forces f_i at the places (x_i, y_i), those of
// pixels where a level has them, without another solve. Positive along x, y; 0 for a flat (R infinite) and without contact. All places lie under the sphere, rho_i < R.
Vec2 lateral_force(const Indenter& indenter, const Level& level);

}  // namespace rsc
