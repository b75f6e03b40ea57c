// Wear of the rough body by sliding (Archard, J. Appl. Phys. 24, 1953): at each point of boundary
// elements the depth grows by coefficient p ds. A stage of a step is implicit: with the pressures p
// at its end, which solve the elastic problem with coefficient ds added to the deflection of a
// point by its own pressure. Two stages are a step of second order.
#pragma once

#include "physics/physics.hpp"

namespace rsc {

extern const Physics kWear;

// Archard's law: a pressure p that slides a distance ds lowers the surface by coefficient p ds.
struct Wear {
    double coefficient = 0;  // [length^2/force]; 0: none
};

// Throws Error(bad_input) for a coefficient out of range.
std::unique_ptr<Lowering> make_wear(const BodyPhysics& bodies);

}  // namespace rsc
