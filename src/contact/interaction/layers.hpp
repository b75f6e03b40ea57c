// Elastic layers bonded to an elastic half-space: what a coating changes in the answer of its surface.
#pragma once

#include "contact/indentation.hpp"
#include "contact/interaction/kernel.hpp"

namespace rsc {

// T(k): how far a mode of normal pressure of wavenumber k > 0 lowers the surface, over what it does to a half-space of the top layer's
// material, which is 2/(E_1* k) of it. T(0) = E_1*/E_base*; T -> 1 for k h >> 1. Without a formula of its own for any number of layers: the
// state (displacements and tractions) is carried from the base to the surface by the exponential of its equations in each layer (plane
// strain, no shear at the surface), scaled by exp(-k h) so that nothing overflows. To some 1e-13, of T itself where it is small.
double layered_answer(const LayeredBody& body, double k);

// s(d) and its share for a body that carries layers, pressed against another one: E_star is that of the surface, of the top layer and the
// second body. s(d) = 1/(pi E_1*) int (T - 1) J0(k d) dk, to some 1e-10 of G(d); milliseconds for any layers.
// Throws Error(bad_input) for values out of range.
std::shared_ptr<const SmoothPart> make_layers(const LayeredBody& body, double E_star);

// The same, null without layers. Bodies in use share their tables; several threads may ask at once.
std::shared_ptr<const SmoothPart> layers_of(const LayeredBody& body, double E_star);

}  // namespace rsc
