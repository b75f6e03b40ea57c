// Results of a contact besides force and area: stiffness, energy, lateral force and moment,
// conductance.
#pragma once

#include "contact/quantities.hpp"

namespace rsc {

// Conductance length 2 S/E* [length] of the last level, where S is the stiffness at fixed contact
// areas; NaN with layers, whose conductance does not follow from it. The conductance of the contact
// is this length over (rho_1 + rho_2) (Barber, Proc. R. Soc. A 459, 2003): 4 a/(rho_1 + rho_2) for
// one spot (Holm), and Greenwood's (1966) result for many spots with point interaction.
// `stiffness`: that of the level, negative.
double conductance_length(Path& contact, double stiffness);

// Constriction resistance (rho_1 + rho_2)/conductance_length [resistivity/length]; NaN without
// contact or if both resistivities are 0.
double constriction_resistance(double conductance_length, const std::array<double, 2>& resistivity);

// Compute these for the last level of a contact (LevelQuantity::compute). The stiffness requires
// one more linear solve.
const char* compute_stiffness(LevelSource& source);
const char* compute_lateral_force(LevelSource& source);
const char* compute_moment(LevelSource& source);
const char* compute_conductance(LevelSource& source);
const char* compute_conductance_per_area(LevelSource& source);
const char* compute_resistance(LevelSource& source);

// Lateral force on the indenter at fixed Z0 [force]: F = -dW/d(x0, y0), where W is the elastic
// energy. At a solution dW = sum f_i dg0_i, so F = -sum f_i grad s(x_i - x0, y_i - y0) with the
// forces f_i of contacts or pixels at (x_i, y_i); no further solve is required. Positive along x,
// y; 0 for a flat and without contact. With laws 'elliptic' and 'fourth_order' the curvatures of a
// summit of the difference change with the tip as those of the face above it do. This is left out:
// it is 0 for a paraboloid, and for a sphere of the order of (d/R)^2, d the distance from the tip.
Vec2 lateral_force(const Indenter& indenter, const Level& level);

// Moment of the contact forces on the indenter about its tip [force length]. A force f_i acts at
// (x_i - x0, y_i - y0, s) along the normal of the face, f_i (-grad s, 1).
Vec2 tip_moment(const Indenter& indenter, const Level& level);

}  // namespace rsc
