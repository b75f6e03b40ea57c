// Where a result may be written: never over a file that is not rsc's own.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rsc {

// What a NetCDF file that rsc wrote, a result or the manifest of a study, says of itself.
struct ResultHead {
    std::string source;     // "rsc 0.2.0, deterministic ..."
    std::string case_text;  // the effective namelist
    bool this_version() const;
};
// None for any other file, or where there is none.
std::optional<ResultHead> head_of_result(const std::string& path);
// The case alone.
std::optional<std::string> case_in_result(const std::string& path);

// Can a result be written there? Changes nothing on the disk. `inputs`: files the run reads; names that are no plain file are
// ignored (so that "/dev/stdin" may be among them). Returns whether a result of rsc is there and will be replaced. Throws
// Error(bad_input) saying what is in the way: no name, a folder or a device of that name, a folder that is missing above an absolute
// path, is no folder, or may not be written to, one of the inputs under whatever name, or a file that is no result of rsc.
bool check_output(const std::string& path, const std::vector<std::string>& inputs = {});

}  // namespace rsc
