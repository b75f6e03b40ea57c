// From a result file to the sums of its campaign and back: campaigns that grow or are put together.
#pragma once

#include <optional>
#include <ostream>

#include "file/result.hpp"
#include "run/job.hpp"

namespace rsc {

// The sums in the result file of the case, if it holds the first realizations of the same campaign, all of which are then done. None if it
// does not; why is told on `messages`, because that result is going to be replaced.
std::optional<Accumulators> earlier_sums(const Job& job, std::ostream* messages);

// Whether a file that the case's surfaces are read from is no older than its result.
bool input_is_newer(const Case& settings);

// What the result file of a campaign holds; levels of &compare are solved by elements here, and told on `table`. After a signal that is
// caught meanwhile the result is not whole.
Result campaign_result(const Job& job, const Accumulators& sums, std::ostream* table);

}  // namespace rsc
