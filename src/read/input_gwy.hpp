// Gwyddion's own files (.gwy): a tree of named values (Gwyddion file format, http://gwyddion.net/documentation/user-guide-en/gwyfile-format.html).
#pragma once

#include <string>

#include "rough/surface.hpp"

namespace rsc {

// Whether a file begins as Gwyddion's do.
bool is_gwy(const std::string& start);

// The channel named `channel`, or the first one whose values are lengths; missing points (NaN, or those under the channel's mask) are
// NaN. Lengths are converted to length_unit. The first row of the file, the top of the picture, has the largest y; x0 = y0 = 0.
// Throws Error(bad_input) naming the byte of what is wrong.
HeightMap read_gwy(const std::string& path, const std::string& channel, const std::string& length_unit);

}  // namespace rsc
