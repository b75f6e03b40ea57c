// A height map on a finer grid.
#pragma once

#include "rough/surface.hpp"

namespace rsc {

// The map with twice as many points along each side, by its own cosine series (the map mirrored at its borders): the surface through
// the points that has no waves shorter than theirs. Every point, which is a cell, becomes four. A periodic map is taken to end at its
// borders, too. Throws Error(no_memory).
HeightMap twice_as_fine(const HeightMap& map);

}  // namespace rsc
