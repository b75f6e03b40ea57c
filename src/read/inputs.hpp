// Surfaces from files: height maps, lists of asperities and spectra in NetCDF, .gwy, .sdf or text. The format is recognised by the first bytes
// of a file, not by its name. Anything wrong is Error(bad_input) naming the file, the line or index, and what was expected. May be called
// by several threads; NetCDF files are read one at a time.
#pragma once

#include "rough/asperities.hpp"
#include "rough/measured.hpp"
#include "rough/spectrum.hpp"
#include "rough/surface.hpp"

namespace rsc {

// True if a name has wildcards of the shell (*, ?, [).
bool is_pattern(const std::string& name);

// The files that a pattern matches, in byte order; a name without wildcards gives itself. Throws Error(bad_input) when nothing matches.
std::vector<std::string> matching_files(const std::string& name);

// What a text file does not say of its map.
struct TextMap {
    std::string height_unit;      // of its heights; empty: length_unit
    std::optional<double> pixel;  // step between the points of a matrix, instead of L [length_unit]
    bool any() const { return !height_unit.empty() || pixel; }
};

// Heights from `path`.
// NetCDF: the variable `height`, dimensions (y, x), or the only two-dimensional numeric variable there is. scale_factor and
//   add_offset are applied; missing values (_FillValue, missing_value, NaN, Inf) are refused. Heights and coordinates are
//   converted from their `units` to `length_unit`; without `units` on any of them they are taken in length_unit; on some of them
//   only, in another unit than length_unit, they are refused. The spacing comes from the coordinate variables of the two dimensions, which must be uniform to 1e-6
//   of a step (or to the rounding of their own type); x0, y0 are the first coordinates; falling coordinates are turned round.
//   Without coordinate variables the steps are dx = dy = L/nx and x0 = y0 = 0. With both, nx dx must be L to 1e-6.
// Text (formats.hpp): a matrix in length_unit, a line a y, rising; needs L. Or three columns x y z, in any order of the lines: the
//   points of a full grid whose coordinates are uniform to a hundredth of a step, as text is rounded. Four columns are refused:
//   they are a list of asperities.
// L: extent in x [length_unit], a point being a cell (L = nx dx). At least 3 x 3 points. The map is not periodic.
// Gwyddion's .gwy and .sdf of ISO 25178-71 (formats.hpp): sizes and units are theirs; L, if given, must agree.
// `channel` names the image of a .gwy or the variable of a NetCDF file; empty: the first that holds heights. With Missing::fill missing
// points are NaN in the map; otherwise they are refused. In a text `nan` and `bad` are missing points, and so are points that triples
// do not list.
// `text` is for text files alone; others are refused with it.
HeightMap read_heights(const std::string& path, std::optional<double> L, const std::string& length_unit = "mm",
                       const std::string& channel = "", Missing missing = Missing::refuse, const TextMap& text = {});

// Asperities from `path`.
// NetCDF: asperity_x, asperity_y, asperity_z, asperity_radius over one dimension; asperity_kappa1, _kappa2 and _angle when all
//   three are there, asperity_biharmonic when it is there; each converted from its `units`, if it has them, to length_unit.
// Text: four columns x y z r in length_unit, separators and comments as above.
// At least one; everything finite, radii positive, kappa1 >= kappa2 > 0, no two at the same (x, y).
Asperities read_asperities(const std::string& path, const std::string& length_unit = "mm");

// The smallest rectangle that holds the asperities' summits.
struct Extent {
    double x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};
Extent extent(const Asperities& asperities);

// Properties of a measured map that made surfaces keep.
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
