// The length a NetCDF file of the classic formats must have.
#pragma once

#include <string>

namespace rsc {

// Reads the header of a classic, 64-bit offset or CDF-5 file and throws Error(bad_input) if the file ends before the header or
// the data it announces: the NetCDF library gives zeros or worse there without a word. Does nothing with other files.
void check_classic_length(const std::string& path);

}  // namespace rsc
