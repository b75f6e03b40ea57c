// Running a case of one realization from beginning to end.
#pragma once

#include "run/run_options.hpp"

namespace rsc {

// Its surface, its levels, what is observed, the result file, and what the user sees of it. Errors as run_case (run.hpp).
RunSummary run_realization(const Case& settings, const RunOptions& options);

}  // namespace rsc
