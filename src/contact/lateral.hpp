// Lateral force and moment on an indenter held above its place (Hellmann-Feynman on the elastic energy of the contact).
#pragma once

#include "contact/level.hpp"

namespace rsc {

// The force that pushes the indenter sideways at fixed Z0 [force]: F = -dW/d(x0, y0) with W the elastic energy of the contact. At a
// solution dW = sum f_i dg0_i, so F = -sum f_i grad s(x_i - x0, y_i - y0): exact in the forces f_i at the places (x_i, y_i), those of
// pixels where a level has them, without another solve. Positive along x, y; 0 for a flat and without contact.
Vec2 lateral_force(const Indenter& indenter, const Level& level);

// The moment of the contact's forces on the indenter about its tip [force length]. A force f_i acts at (x_i - x0, y_i - y0, s) along
// the normal of the face, f_i (-grad s, 1).
Vec2 tip_moment(const Indenter& indenter, const Level& level);

}  // namespace rsc
