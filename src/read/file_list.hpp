// Several files behind one name.
#pragma once

#include <string>
#include <vector>

namespace rsc {

// Whether a name has a shell's wildcards (*, ?, [).
bool is_pattern(const std::string& name);

// The files that a pattern matches, in the order of their bytes; of a name without wildcards itself alone. Throws Error(bad_input) when
// nothing matches.
std::vector<std::string> matching_files(const std::string& name);

}  // namespace rsc
