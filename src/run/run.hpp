// Running a case: options, outcome, a single realization, or a whole case.
#pragma once

#include "case/case.hpp"
#include "case/options.hpp"
#include "run/job.hpp"

namespace rsc {

struct RunOptions {
    std::string command;              // for the history attribute
    std::vector<std::string> inputs;  // files that the case was read from: no result is written over them
    Progress progress = Progress::never;
    bool quiet = false;                            // no table; warnings and failures still go to `messages`
    bool compare_automatically = false;            // obey compare%levels = 'auto': the program does, in single runs
    bool resume = false;                           // a campaign: continue an interrupted run
    std::ostream* table = nullptr;                 // the level table and the summary; null: none
    std::ostream* messages = nullptr;              // warnings, progress; null: none
    const std::atomic<bool>* abandoned = nullptr;  // once true the run ends, with Interrupted
    // Reports levels or realizations done, and their total number, several times a second in the calling thread. If it returns true the run
    // ends with Interrupted.
    std::function<bool(double done, double total)> report;
};

// The outcome of a run.
struct RunSummary {
    long levels = 0, failed = 0;  // of all realizations, those compared with elements included; failed: did not converge
    double separation = 0;        // of the last level; its means over the realizations:
    double force = 0, area = 0;
};

// check_output for the result of a case, which must not replace its input files. Returns true if an earlier result is replaced.
bool check_result_path(const Case& settings, const RunOptions& options);

// The effective namelist in a result file: that of the case without run%threads, which has no effect on results.
std::string case_text(const Case& settings);

// The stream for a progress line, or null if none is wanted; `terminal` is set if stderr is one.
std::ostream* progress_stream(const RunOptions& options, bool& terminal);

// Reports levels that did not converge on `messages`.
void tell_failed(const RunOptions& options, const RunSummary& summary);

// Runs a case of one realization: its surface, its levels, the observations, the result file and the screen. Errors as run_case.
RunSummary run_realization(const Case& settings, const RunOptions& options);

// The namelist of a campaign on twins of a measured map: surfaces with the spectrum stored in the result file `result`, otherwise as the
// case of the job.
std::string twins_text(const Job& job, const std::string& result);

// Runs a case, one realization or a campaign, and writes its file. Returns the number of levels that did not converge. Throws Error, and
// Interrupted after a signal if the program catches them; there is then no new result file, but a campaign leaves its checkpoint.
long run_case(const Case& settings, const RunOptions& options);

}  // namespace rsc
