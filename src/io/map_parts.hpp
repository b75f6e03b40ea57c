// What readers of height maps and of profiles have in common.
#pragma once

#include "io/formats.hpp"
#include "io/input_netcdf.hpp"
#include "io/inputs.hpp"

namespace rsc {

// nx dx must equal the given L, if any.
void check_given_L(const std::string& path, const std::string& coordinate, int nx, double dx,
                   std::optional<double> L);

// The uniform grid of one coordinate of x y z triples, or of x z pairs.
struct TextAxis {
    double first = 0, step = 0;
    std::size_t count = 0;
    std::size_t index(double c) const { return at(std::lround((c - first) / step)); }
};
// True if the values are uniform to the rounding of their digits.
bool is_uniform(const std::vector<double>& c);
// Throws Error(bad_input) unless the values are uniform to a hundredth of their step.
TextAxis text_axis(const std::string& path, const TextTable& table, std::size_t column,
                   const char* name);

// The factors from a file's units of heights, and of x and y, to length_unit.
struct UnitFactors {
    double heights = 1, coordinates = 1;
};
// `coordinates`: the text has columns of x (and y), with a unit of their own.
UnitFactors text_factors(const std::string& path, const TextTable& table, const MapKeys& keys,
                         const std::string& length_unit, bool coordinates);

// Marks heights that mean "no data", and looks for others that may mean it.
void mark_missing(HeightMap& map, const std::vector<double>& codes, MapOrigin* origin);

// A uniform axis: value of point 0 (the smallest) and the step; `reversed` if the file counts
// downwards.
struct Axis {
    double first = 0, step = 0;
    bool reversed = false;
};
std::optional<Axis> read_axis(const NetcdfInput& file, const NetcdfInput::Variable& heights,
                              std::size_t dimension);

// The variable `channel`, or `height`, or the only one of `rank` dimensions.
NetcdfInput::Variable find_heights(const NetcdfInput& file, const std::string& channel,
                                   std::size_t rank = 2);

// Factors of heights, x and y to length_unit, from units of the file or the keys.
std::array<double, 3> unit_factors(const NetcdfInput& file, const NetcdfInput::Variable& heights,
                                   const std::string& length_unit, const MapKeys& keys,
                                   bool coordinates, std::size_t of_x);

// A file of no known format is refused; the message says how to convert it.
void refuse_unknown(const std::string& path, const std::string& start);

// Refuses steps and heights out of range, and missing points unless they are to be filled.
// `upwards`: rows are counted with y upwards; `masked` is added to "missing" in messages.
void check_heights(const std::string& path, const HeightMap& map, bool fill, bool upwards,
                   const char* masked);

}  // namespace rsc
