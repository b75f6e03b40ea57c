// The checksum of result files: a last line of text behind what NetCDF and HDF5 know of, "\nrsc: CRC-32 of all before this line: 0a1b2c3d\n".
// It is looked at before these libraries get the file: HDF5 crashes on some damaged ones, and classic files have no checksums of their own.
#pragma once

#include <cstdint>
#include <string>

namespace rsc {

// That line for the `size` bytes of a file.
std::string checksum_line(const char* bytes, std::size_t size);

// Throws Error(bad_input) for a file with such a line whose bytes are not those it was made for. Files without one pass: those of earlier versions
// and of other programs.
void require_sound(const std::string& path);

}  // namespace rsc
