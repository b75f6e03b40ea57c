// The result file: every variable, dimension and attribute, CF-1.10, with long names and comments,
// so that `ncdump -h` documents the file.
#pragma once

#include "io/netcdf_file.hpp"
#include "io/result.hpp"

namespace rsc {

// Writes the result to `path` in the format of its case, completely or not at all. `command`
// follows the date in the attribute `history`. Throws Error(file_system) with a remedy, and
// Error(internal) for a value that is not finite in a variable without missing values; NaN in the
// others becomes _FillValue.
//
// Equal results give equal files except for the attribute `history`, whose date is that of the
// environment variable SOURCE_DATE_EPOCH (seconds since 1970) if it is set.
void write_result(const Result& result, const std::string& path, const std::string& command);

// The attribute `history`: the date and the command, or the version if there is no command.
std::string history_text(const std::string& command);

}  // namespace rsc
