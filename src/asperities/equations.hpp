// The paper's model (V. A. Yastrebov, section 4), and where each of its terms is computed.
//
//     F = C <G0 - B F>^(3/2),    <x> = max(x, 0), component by component
//
//     F    forces of the asperities [force]; N = sum F is the force on the indenter
//     G0   penetrations without interaction, g0 = z - s(x - x0, y - y0) - Z0: the height of a
//          summit above the indenter's face at the separation Z0. candidates.hpp selects those with
//          g0 > 0, of summits that shifted_summits.hpp places under a curved indenter
//     B    what a unit force at one asperity lowers the surface at another: 1/(pi E* d) at the
//          distance d, 0 at itself; interaction/kernel.hpp with layers and periods, products with
//          it in interaction/products.hpp
//     U    = G0 - B F: penetrations with interaction, the unknowns of Newton's method
//     C    = (4/3) E* sqrt(r), r the radius of an asperity. law.hpp has the law f(u) = C u^(3/2)
//          and those that replace it (elliptic spots, fourth order, hardness, relaxation), each
//          with its slope D = df/du, area A(u) and work W(u)
//
// Solved by
//     newton.hpp         Newton's method for U + B F(U) = G0 on the asperities in contact
//     dgesv.hpp          the paper's iteration, with a regularised law and dense matrices
//     start.hpp          where both begin; uniqueness.hpp: whether the solution is the only one
//     asperity_model.hpp one separation from candidates to level; contact/path.hpp: many of them
//
// Results: N, A = sum A(u) or the area of the union of elliptic spots (contact/spots.hpp), the
// energy W = sum W(u) + F'B F/2, dW/dZ0 = -N, and the stiffness dN/dZ0 (newton.hpp).
#pragma once
