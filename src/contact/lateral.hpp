// Lateral force and moment on an indenter at a fixed position, by the derivative of the elastic energy.
#pragma once

#include "contact/level.hpp"

namespace rsc {

// Lateral force on the indenter at fixed Z0 [force]: F = -dW/d(x0, y0), where W is the elastic energy. At a solution dW = sum f_i dg0_i, so
// F = -sum f_i grad s(x_i - x0, y_i - y0) with the forces f_i of contacts or pixels at (x_i, y_i); no further solve is required. Positive
// along x, y; 0 for a flat and without contact. With the laws 'elliptic' and 'fourth_order' the place and curvature of a summit also change
// with the tip; this is left out, up to 0.3 % of N under steep indenters.
Vec2 lateral_force(const Indenter& indenter, const Level& level);

// Moment of the contact forces on the indenter about its tip [force length]. A force f_i acts at (x_i - x0, y_i - y0, s) along the normal
// of the face, f_i (-grad s, 1).
Vec2 tip_moment(const Indenter& indenter, const Level& level);

}  // namespace rsc
