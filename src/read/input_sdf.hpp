// Surface data files (.sdf) of ISO 25178-71, text and binary, and of their forerunner BCR.
#pragma once

#include <string>

#include "rough/surface.hpp"

namespace rsc {

// Whether a file begins as these do: aISO-1.0, bISO-1.0, aBCR-1.0, ...
bool is_sdf(const std::string& start);

// The heights, converted from metres to length_unit; missing points (BAD in a text, the least value of an integer type, the largest of an
// unsigned one, NaN or the least double) are NaN. The first profile, the top of the picture, has the largest y; x0 = y0 = 0. Throws
// Error(bad_input) naming the line or byte of what is wrong.
HeightMap read_sdf(const std::string& path, const std::string& length_unit);

}  // namespace rsc
