// A measured or otherwise known spectrum from a file.
#pragma once

#include <memory>
#include <string>

#include "rough/spectrum.hpp"

namespace rsc {

// NetCDF: the variables wavenumber and psd over one dimension, as result files of measured maps have them, converted from their units
// (1/length, length^4) to length_unit. Text: two columns, wavenumber and psd in powers of length_unit. Throws Error(bad_input) naming the
// file and what is wrong.
std::shared_ptr<const SpectrumTable> read_spectrum(const std::string& path, const std::string& length_unit);

}  // namespace rsc
