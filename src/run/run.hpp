// Running a case from beginning to end: surface, levels, observations, result file, and what the user sees of it.
#pragma once

#include <ostream>
#include <string>

#include "run/case.hpp"
#include "run/options.hpp"

namespace rsc {

struct RunOptions {
    std::string case_text;   // the effective namelist, for the file
    std::string command;     // for the history attribute
    Progress progress = Progress::never;
    bool quiet = false;      // no table; the summary's warnings and failures are still told on `messages`
    std::ostream* table = nullptr;     // the level table and the summary; null: none
    std::ostream* messages = nullptr;  // warnings, progress; null: none
};

// Runs the case and writes its file. Returns the number of levels that did not converge (0: all is well).
// Throws Error as everything below it does; nothing is then left under the final name.
long run_case(const Case& settings, const RunOptions& options);

}  // namespace rsc
