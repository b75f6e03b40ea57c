// Asperities that yield: no pressure above the hardness (Chang, Etsion, Bogy, J. Tribol. 109, 1987, with their factor 1).
//
// Elastic, by the law given, while the mean pressure f/A is below H; from the penetration u_c on, where it reaches H, the area grows by
// truncation at constant pressure:
//     A = A(u_c) + 2 [A(u) - A(u_c)], f = H A        (sphere: u_c = (3 pi H/(4 E*))^2 r, A = pi r (2u - u_c))
// with A(u) the elastic law's area, continued along a straight line where the law ends (Law::spread). Force and area are continuous,
// the slope jumps up at u_c (sphere: from 1.5 pi H r to 2 pi H r). Unloading from (u_m, f_m, a_m) is elastic, a sphere of radius
// r' = 4 E' a_m^3/(3 f_m) that touches at u_r = u_m - a_m^2/r'; E' = 3 f(u_c)/(4 a(u_c) u_c), E* for a sphere, makes u_r = 0 where
// yielding begins, for elliptic spots, too. Reloading goes back along it, then on. History is u_m of every asperity.
// From u_m barely above u_c (a sphere: below 1.42 u_c) that unloading would give more work back than was done. There the force falls with
// (u - u_r)^m, m > 3/2 such that it gives back all of it and no more: a closed cycle never yields work.
//
// More accurate, where `sinks` (law 'fourth_order'): the summit pressed flat sinks in as a whole, by 4 H a/(pi E') at its border (the
// disc of constant pressure, Johnson 1985, eq. 3.29b), so that its area grows with
//     u - (4 H/(pi E')) [a - a(u_c)] in place of u.
// Against elements that bear no pressure above H, a sphere carries within 6 % at u_c (where the middle has yielded since 0.44 u_c), 3 % at
// 2 u_c and 1 % at 5 u_c; without sinking 29 % too much at 2.7 u_c.
//
// Size effect (Swadener, George, Pharr 2002; paper, section 5): H_i = H0 sqrt(1 + l/r_i).
#pragma once

#include "contact/law/law.hpp"

namespace rsc {

// The law with pressures bounded. Throws Error(bad_input) unless H0 > 0 and length >= 0 is finite.
std::unique_ptr<Law> make_yielding(std::unique_ptr<Law> elastic, const Asperities& asperities, const Hardness& hardness, bool sinks);

}  // namespace rsc
