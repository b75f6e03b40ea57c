// A measured or otherwise known spectrum from a file.
#pragma once

#include <memory>
#include <string>

#include "rough/spectrum.hpp"

namespace rsc {

// What made surfaces keep of the map a spectrum was measured on.
struct InputSpectrum {
    std::shared_ptr<const SpectrumTable> table;         // the radial spectrum
    std::shared_ptr<const PlaneSpectrum> plane;         // by direction, if asked for
    std::shared_ptr<const HeightDistribution> heights;  // if asked for
};

// NetCDF: the variables wavenumber and psd over one dimension, as result files of measured maps have them, converted from their units
// (1/length, length^4) to length_unit; plane_wavenumber, angle, psd_plane if `by_direction`, normal_score and height_quantile if `heights`.
// Text: two columns, wavenumber and psd in powers of length_unit. Throws Error(bad_input) naming the file and what is wrong or missing.
InputSpectrum read_spectrum(const std::string& path, const std::string& length_unit, bool by_direction = false, bool heights = false);

}  // namespace rsc
