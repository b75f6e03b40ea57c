// Result files of parts of a campaign put together into that of the whole: rsc --merge.
#pragma once

#include <string>
#include <vector>

#include "run/run_options.hpp"

namespace rsc {

// `files`: results of one case but for run%first_realization and run%realizations, in any order, whose realizations follow each other. The
// result file `output` is, bit for bit in its variables, that of one campaign over all of them. Throws Error(bad_input), before anything
// is written, naming the file that is no result of a campaign, of another version or of another case (with the keys that differ), and
// realizations that are in two files or in none.
RunSummary merge_campaigns(const std::vector<std::string>& files, const std::string& output, const RunOptions& options);

}  // namespace rsc
