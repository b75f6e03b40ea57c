// Where a result may be written: never over a file that is not rsc's own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "file/whole_file.hpp"

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

// Results and manifests, the files that head_of_result() knows.
extern const FileKind kResultFile;

// Can a result be written there? Changes nothing on the disk. `inputs`: files the run reads; names that are no plain file are
// ignored (so that "/dev/stdin" may be among them). Returns whether a result of rsc is there and will be replaced. Throws
// Error(bad_input) saying what is in the way: no name, an address of the net, a folder that is missing above an absolute path, is no folder, or
// may not be written to, one of the inputs under whatever name, or what reason_to_leave() says.
bool check_output(const std::string& path, const std::vector<std::string>& inputs = {});

}  // namespace rsc
