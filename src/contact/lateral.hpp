// The lateral force on a sphere held above its place (physics: Hellmann-Feynman on the elastic energy of the contact).
#pragma once

#include <span>

#include "contact/indentation.hpp"

namespace rsc {

struct Vec2 {
    double x = 0, y = 0;
};

// What pushes the sphere sideways at fixed Z0 [force]: F = -dW/d(x0, y0) with W the elastic energy of the contact. dW = sum f_i dg0_i
// at a solution, so F_x = -sum f_i (x_i - x0)/sqrt(R^2 - rho_i^2), F_y alike: exact in the forces f_i at the places (x_i, y_i), without
// another solve. Positive along x, y; 0 for a flat (R infinite) and without contact. All places lie under the sphere, rho_i < R.
Vec2 lateral_force(const Indenter& indenter, std::span<const double> x, std::span<const double> y, std::span<const double> force);

// The same of the contacts of a level.
Vec2 lateral_force(const Indenter& indenter, const Asperities& asperities, const Level& level);

}  // namespace rsc
