// Boundary-element contact of a rough surface with an indenter: every pixel carries a uniform
// pressure p >= 0 (Johnson 1985, section 3.4; Polonsky and Keer, Wear 231, 1999). The asperity
// model is an approximation of this.
//
// With a hardness H, p <= H. Where p = H the gap w may be negative; the heights are permanently
// lowered by -w when the level is accepted. The plastic work is H times the volume of this
// residual, and the recoverable energy is W = p'Kp dx dy/2.
//
// For relaxing bodies (solids%relaxation_share) a level is an elastic problem with an additional
// gap due to earlier loads (load_memory.hpp).
//
// For bodies that wear (pixel_model.hpp, Lowering) pixels deflect by their own pressure, too, by as
// much as it lowers them in this step.
//
// The solution is unique (K is positive definite): earlier levels are starting points and affect it
// only within the tolerance. Contacts and their areas: pixel_spots.hpp.
//
// With periodic boundaries (two rough flats; Johnson 1985, chapter 13) separations are measured
// from z = 0 of the heights (the mean plane of synthetic surfaces and detrended maps) to the flat;
// the mean deflection is 0. As for asperities, a pressure mode of wavenumber k deflects the surface
// by 2/(E* k) times itself, the mean pressure by nothing. There is no level at full contact:
// Error(bad_input).
#pragma once

#include "contact/model.hpp"
#include "elements/element_physics.hpp"
#include "surface/surface.hpp"

namespace rsc {

// The heights must outlive the model and are not changed; with periodic boundaries the map is the
// period. The options used are the tolerance, the number of iterations and relaxation. Throws
// Error(bad_input) for moduli, radii, heights or options out of range.
std::unique_ptr<Model> make_elements(const HeightMap& heights, const Indenter& indenter,
                                     const SolverOptions& options, ElementPhysics physics = {});

}  // namespace rsc
