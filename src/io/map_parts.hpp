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

// Throws Error(bad_input) for fewer than 16 points, or too many.
HeightMap allocate_profile(const std::string& path, std::size_t points);

// As read_heights() for rank 2, and as read_profile() for rank 1.
HeightMap read_netcdf_heights(const std::string& path, std::optional<double> L,
                              const std::string& length_unit, const std::string& channel,
                              bool missing, const MapKeys& keys, MapOrigin* origin,
                              std::size_t rank);

// A file of no known format is refused; the message says how to convert it.
void refuse_unknown(const std::string& path, const std::string& start);

// Refuses steps and heights out of range, and missing points unless they are to be filled.
// `upwards`: rows are counted with y upwards; `masked` is added to "missing" in messages.
void check_heights(const std::string& path, const HeightMap& map, bool fill, bool upwards,
                   const char* masked);

}  // namespace rsc
