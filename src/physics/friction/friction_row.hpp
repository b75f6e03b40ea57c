// Friction as a physics of a case.
#pragma once

#include "physics/physics.hpp"

namespace rsc {

extern const Physics kFriction;

}  // namespace rsc
