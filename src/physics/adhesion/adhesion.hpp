// Adhesion as a physics of a case: asperities (adhesive_contact.hpp) or elements
// (adhesive_elements.hpp) that attract.
#pragma once

#include "physics/physics.hpp"

namespace rsc {

extern const Physics kAdhesion;

// As Physics::grid_error and doubts_range.
GridError adhesion_grid_error(const Level& level, const HeightMap& map, const Indenter& indenter,
                              const BodyPhysics& bodies, const GridError& few);
bool adhesion_range_in_doubt(const Level& level, const HeightMap& map, const BodyPhysics& bodies);

}  // namespace rsc
