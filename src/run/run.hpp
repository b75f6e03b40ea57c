// Running a case: one realization or a campaign.
#pragma once

#include "run/run_options.hpp"

namespace rsc {

// Runs the case and writes its file. Returns the number of levels that did not converge (0: all is well).
// Throws Error as everything below it does, and Interrupted after a signal if the program catches them; nothing is then left
// under the final name. A campaign leaves its checkpoint beside the file in both cases.
long run_case(const Case& settings, const RunOptions& options);

}  // namespace rsc
