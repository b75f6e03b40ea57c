// The result file: every variable, dimension and attribute, CF-1.10, described so that `ncdump -h` reads like documentation.
#pragma once

#include "file/netcdf_file.hpp"
#include "file/result.hpp"

namespace rsc {

struct WriteOptions {
    Format format = Format::netcdf4;
    int compression = 1;  // deflate level of netcdf4, 0 to 9; shuffled first
    std::string command;  // goes into the `history` attribute behind the date
};

// Writes the result to `path`, which holds either the whole file or what it held before. Throws Error(file_system) with what to
// do, and Error(internal) for a value that is not finite where none may be absent; NaN in the others becomes _FillValue.
//
// The same result gives the same file but for the attribute `history`, whose date is that of the environment variable
// SOURCE_DATE_EPOCH (seconds since 1970) when it is set.
void write_result(const Result& result, const std::string& path, const WriteOptions& options);

// The attribute `history`: the date and the command, or the version where there is none.
std::string history_text(const std::string& command);

}  // namespace rsc
