// The stresses below the levels of a case as a physics.
#pragma once

#include "physics/physics.hpp"

namespace rsc {

extern const Physics kStress;

// Whether stresses are asked for at some depths.
struct StressesAsked {
    bool asked = false;
};

}  // namespace rsc
