// Elastic layers bonded to an elastic half-space: effect of a coating on surface deflections.
#pragma once

#include "interaction/kernel.hpp"
#include "interaction/layered_body.hpp"

namespace rsc {

// T(k): deflection under a normal pressure mode of wavenumber k > 0, relative to that of a
// half-space of the top layer's material, 2/(E_1* k) times the pressure. T(0) = E_1*/E_base*; T ->
// 1 for k h >> 1. The state (displacements and tractions; plane strain, no shear at the surface) is
// propagated from the base to the surface by the matrix exponential of each layer, scaled by exp(-k
// h) to avoid overflow. The relative error is about 1e-13.
double layered_answer(const LayeredBody& body, double k);

// s(d) and its share for a body that carries layers, pressed against another one: E_star is that of
// the top layer and the second body. s(d) = 1/(pi E_1*) int (T - 1) J0(k d) dk, to about 1e-10 of
// G(d), computed in milliseconds. Throws Error(bad_input) for values out of range.
std::shared_ptr<const SmoothPart> make_layers(const LayeredBody& body, double E_star);

// As make_layers(), but null without layers, and with tables shared between equal bodies.
// Thread-safe.
std::shared_ptr<const SmoothPart> layers_of(const LayeredBody& body, double E_star);

}  // namespace rsc
