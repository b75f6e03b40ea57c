// The way back from the result file of a campaign to its sums over realizations, so that others can be added to them.
#pragma once

#include <optional>
#include <string>

#include "observe/record.hpp"

namespace rsc {

// The sums as they were, bit for bit, when the file was written; `options` and `steps` are those of its case. Throws Error(bad_input),
// naming the file, for one that lacks them (it holds one realization, or is of an earlier version), whose bins, map or levels are
// others, or that is damaged.
Accumulators read_sums(const std::string& path, const ObserveOptions& options, std::size_t steps);

// Levels of all realizations in a result, and how many of them did not converge. None for a file that does not tell.
struct LevelCount {
    long levels = 0, failed = 0;
};
std::optional<LevelCount> count_levels(const std::string& path);

}  // namespace rsc
