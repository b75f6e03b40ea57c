// Surfaces from files: height maps, lists of asperities and spectra in NetCDF, .gwy, .sdf or text.
// The format is recognised by the first bytes of a file, not by its name. Errors are
// Error(bad_input) with the file, the line or index, and the expected content. Thread-safe; NetCDF
// files are read one at a time.
#pragma once

#include "surface/asperities.hpp"
#include "surface/measured.hpp"
#include "surface/spectrum.hpp"
#include "surface/surface.hpp"

namespace rsc {

// True if a name has wildcards of the shell (*, ?, [).
bool is_pattern(const std::string& name);

// The files that match a pattern, in byte order; a name without wildcards is returned. Throws
// Error(bad_input) if nothing matches.
std::vector<std::string> matching_files(const std::string& name);

// Properties of a map that a file may not contain; keys of &surface.
struct MapKeys {
    std::string height_unit{};  // of its heights, if the file has no units
    std::optional<double>
        pixel{};  // step between the points of a matrix, instead of L [length_unit]
    // Heights that mean a missing point: as text and NetCDF files have them, of instruments' files
    // [length_unit].
    std::vector<double> missing_value = {};
    std::string coordinate_unit = "";  // of its x and y, if the file has no units

    // Throws Error(bad_input) for a key that the file leaves no use for: `heights` and `sides` are
    // true if it has no unit of these.
    void require_use(const std::string& path, bool heights, bool sides) const;
};

// What a map was read from, for messages and results.
struct MapOrigin {
    std::string channel;  // image of a .gwy or variable of a NetCDF file; empty: the file has none
    // A height as in MapKeys::missing_value that is probably a code for missing points
    // (likely_code()).
    std::optional<double> code;
    long coded = 0;  // points that have it
};

// A height that probably means "no data": the lowest or highest one if it fills more than a
// thousandth of the points and is farther from the others than these are from each other, or if it
// is met much more often than the height next to it; or 0 in blocks of 3 x 3 points and more where
// no other height fills such blocks. `points` receives their number. Rows without padding.
std::optional<double> likely_code(const HeightMap& map, long& points);

// True if the units and the pixel of MapKeys may apply to the readable file `path`: text, or a file
// without units of its heights or coordinates. `channel` as for read_heights().
bool lacks_units(const std::string& path, const std::string& channel);

// Heights from `path`.
//
// NetCDF: the variable `height`, dimensions (y, x), or the only two-dimensional numeric variable.
// scale_factor and add_offset are applied; missing values (_FillValue, missing_value, outside
// valid_min, valid_max or valid_range, NaN) are refused. These limits are stored values, before
// scale_factor and add_offset; real numbers for packed integers are heights. Heights and
// coordinates are converted from their `units` to `length_unit`. If none of them has `units`,
// `keys` or length_unit apply; if only some have, and another unit than length_unit, the file is
// refused. The spacing comes from the coordinate variables of the two dimensions, which must be
// uniform to 1e-6 of a step (or to the rounding of their own type, if this is a hundredth of a step
// at most); x0, y0 are the first coordinates; decreasing coordinates are reversed. Without
// coordinate variables the steps are dx = dy = pixel or L/nx, x0 = y0 = 0, and the first row has
// the lowest y. If both are given, nx dx must equal L to 1e-6.
//
// Text (formats.hpp), which gzip may have packed: a matrix, one line for each y in increasing
// order, but from the top of the picture, in decreasing order, under the heading of Gwyddion's
// exports; heights are in the unit that a comment states as theirs, otherwise in length_unit; a
// comment that names another unit of length asks for `keys.height_unit`. Needs L, or a comment with
// the width. Or three columns x y z, in any order of the lines: the points of a full grid whose
// coordinates are uniform to a hundredth of a step, as text is rounded; x and y are in the unit of
// a comment ("x [um]") or of `keys.coordinate_unit`, which must be given if the heights have a unit
// and x and y have none. Four columns are refused, because they are a list of asperities.
//
// Gwyddion's .gwy and .sdf of ISO 25178-71 (formats.hpp): sizes and units come from the file; L, if
// given, must agree.
//
// L: extent in x [length_unit] of the points as cells (L = nx dx). At least 3 x 3 points. The map
// is not periodic. `channel` names the image of a .gwy or the variable of a NetCDF file; empty: the
// first with heights. With Missing::fill missing points are NaN in the map; otherwise they are
// refused. In a text `nan` and `bad` are missing points, as are points that are not among the
// triples.
HeightMap read_heights(const std::string& path, std::optional<double> L,
                       const std::string& length_unit = "mm", const std::string& channel = "",
                       Missing missing = Missing::refuse, const MapKeys& keys = {},
                       MapOrigin* origin = nullptr);

// A profile, heights along x, as a map of one row of the side dy = thickness [length_unit]: a
// surface that is constant along y.
//
// NetCDF: the variable `height`, dimension (x), or the only one of one dimension that is no
// coordinate; .sdf with NumProfiles = 1; .smd of ISO 5436-2; text: two columns x z or one of
// heights (read_profile_table()), or more, x in the first and z in that of the number `channel`,
// with the units of their headings or of `keys`. Without x, `keys` give the pixel, or L does. At
// least 16 points; otherwise as read_heights().
HeightMap read_profile(const std::string& path, std::optional<double> L,
                       const std::string& length_unit, const std::string& channel, Missing missing,
                       const MapKeys& keys, double thickness, MapOrigin* origin = nullptr);

// Asperities from `path`.
// NetCDF: asperity_x, asperity_y, asperity_z, asperity_radius over one dimension; asperity_kappa1,
// _kappa2 and _angle if all three exist, asperity_biharmonic if it exists; each converted from its
// `units`, if it has them, to length_unit.
// Text: four columns x y z r in length_unit, separators and comments as above.
// At least one asperity; all values finite, radii positive, kappa1 >= kappa2 > 0, no two asperities
// at the same (x, y).
Asperities read_asperities(const std::string& path, const std::string& length_unit = "mm");

// Properties of a measured map that synthetic surfaces reproduce.
struct InputSpectrum {
    std::shared_ptr<const SpectrumTable> table;         // by direction, if requested
    double sigma = 0;                                   // rms height of the radial spectrum
    std::shared_ptr<const HeightDistribution> heights;  // if requested
};

// NetCDF: the variables wavenumber and psd over one dimension, as result files of measured maps
// have them, converted from their units (1/length, length^4) to length_unit; plane_wavenumber,
// angle, psd_plane if `by_direction`, normal_score and height_quantile if `heights`.
// Text: two columns, wavenumber and psd in powers of length_unit. Throws Error(bad_input) with the
// file and the wrong or missing variable.
InputSpectrum read_spectrum(const std::string& path, const std::string& length_unit,
                            bool by_direction = false, bool heights = false);

}  // namespace rsc
