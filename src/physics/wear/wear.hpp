// Wear of the rough body by sliding (Archard, J. Appl. Phys. 24, 1953): at each point of boundary
// elements the depth grows by coefficient p ds. A step ds is implicit: with the pressures p at its
// end, which solve the elastic problem with coefficient ds added to the deflection of a point by
// its own pressure. It is stable for any ds, and the worn volume is coefficient times the sum of
// N ds. Steps are extrapolated to second order by Path.
#pragma once

#include "physics/physics.hpp"

namespace rsc {

extern const Physics kWear;

// Throws Error(bad_input) for a coefficient out of range.
std::unique_ptr<Lowering> make_wear(const BodyPhysics& bodies);

}  // namespace rsc
