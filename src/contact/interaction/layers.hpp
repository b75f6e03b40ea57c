// Elastic layers bonded to an elastic half-space: effect of a coating on surface deflections.
#pragma once

#include "contact/indentation.hpp"
#include "contact/interaction/kernel.hpp"

namespace rsc {

// T(k): deflection under a normal pressure mode of wavenumber k > 0, relative to that of a half-space of the top layer's material, 2/(E_1*
// k) times the pressure. T(0) = E_1*/E_base*; T -> 1 for k h >> 1. The state (displacements and tractions; plane strain, no shear at the
// surface) is propagated from the base to the surface by the matrix exponential of each layer, scaled by exp(-k h) to avoid overflow. The
// relative error is about 1e-13.
double layered_answer(const LayeredBody& body, double k);

// s(d) and share(k) for a layered body in contact with a second body; E_star is that of the top layer and the second body. With R^2 = d^2 +
// z^2 and T - 1 = sum of a_n exp(-k z) L_n(2 k z) (Laguerre),
//     s(d) = 1/(pi E_1* R) sum of a_n P_n((d^2 - z^2)/R^2)        (Legendre),
// because the Hankel transform of exp(-k z) L_n(2 k z) is P_n/R. Throws Error(bad_input) for values out of range, or if the layers are too
// different for the series to converge.
std::shared_ptr<const SmoothPart> make_layers(const LayeredBody& body, double E_star);

// As make_layers(), but null without layers, and with tables shared between equal bodies. Thread-safe.
std::shared_ptr<const SmoothPart> layers_of(const LayeredBody& body, double E_star);

}  // namespace rsc
