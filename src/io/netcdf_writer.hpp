// The result file: every variable, dimension and attribute, CF-1.10, with long names and comments,
// so that `ncdump -h` documents the file.
#pragma once

#include "io/netcdf_file.hpp"
#include "io/result.hpp"

namespace rsc {

struct WriteOptions {
    Format format = Format::netcdf4;
    int compression = 1;  // deflate level of netcdf4, 0 to 9; shuffled first
    std::string command;  // follows the date in the `history` attribute
};

// Writes the result to `path`, completely or not at all. Throws Error(file_system) with a remedy,
// and Error(internal) for a value that is not finite in a variable without missing values; NaN in
// the others becomes _FillValue.
//
// Equal results give equal files except for the attribute `history`, whose date is that of the
// environment variable SOURCE_DATE_EPOCH (seconds since 1970) if it is set.
void write_result(const Result& result, const std::string& path, const WriteOptions& options);

// The attribute `history`: the date and the command, or the version if there is no command.
std::string history_text(const std::string& command);

}  // namespace rsc
