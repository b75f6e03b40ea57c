// The flow through the gap of two flats as a physics of a case.
#pragma once

#include "physics/physics.hpp"

namespace rsc {

extern const Physics kFlow;

// Whether the permeability of each level is asked for.
struct FlowAsked {
    bool asked = false;
};

}  // namespace rsc
