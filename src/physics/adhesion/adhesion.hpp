// Adhesion as a physics of a case: asperities (adhesive_contact.hpp) or elements
// (adhesive_elements.hpp) that attract.
#pragma once

#include "physics/physics.hpp"

namespace rsc {

extern const Physics kAdhesion;

}  // namespace rsc
