// The grid of a height map that a file announces: refused before memory is asked for.
#pragma once

#include <cstddef>
#include <string>

#include "rough/surface.hpp"

namespace rsc {

// "1.23456789"
std::string text_of(double value);

// A file may announce any size; more than the machine holds is refused. `what` has `count` doubles. Throws Error(bad_input).
void check_memory(const std::string& path, const std::string& what, double count);

// At least 3 x 3 points, at most 2^31 - 1 a side, in the machine's memory. Throws Error(bad_input).
void check_grid(const std::string& path, std::size_t nx, std::size_t ny);

// Rows without padding.
HeightMap allocate_map(std::size_t nx, std::size_t ny);

// Turn a map round.
void reverse_columns(HeightMap& map);
void reverse_rows(HeightMap& map);

}  // namespace rsc
