// What is common to every way of running a case: what the caller wants to see, and the outcome of a run.
#pragma once

#include <atomic>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/options.hpp"

namespace rsc {

struct RunOptions {
    std::string command;              // for the history attribute
    std::vector<std::string> inputs;  // files that the case was read from: no result is written over them
    Progress progress = Progress::never;
    bool quiet = false;                            // no table; the summary's warnings and failures are still told on `messages`
    bool compare_automatically = false;            // what compare%levels = 'auto' stands for is done: by the program, in single runs
    bool resume = false;                           // a campaign: go on with what an interrupted run left
    std::ostream* table = nullptr;                 // the level table and the summary; null: none
    std::ostream* messages = nullptr;              // warnings, progress; null: none
    const std::atomic<bool>* abandoned = nullptr;  // once true the run ends, with Interrupted
    // Called by the thread that called, several times a second where it can be: levels or realizations done, of how many. True: the run ends, with
    // Interrupted.
    std::function<bool(double done, double total)> report;
};

// The outcome of a run.
struct RunSummary {
    long levels = 0, failed = 0;  // of all realizations, those compared with elements included; failed: did not converge
    double separation = 0;        // of the last level; its means over the realizations:
    double force = 0, area = 0;
};

// check_output for the result of a case: neither the files it was read from nor the surface's. Returns whether a result is replaced.
bool check_result_path(const Case& settings, const RunOptions& options);

// The effective namelist as it stands in a result file: that of the case but for run%threads, which touches nothing in the file.
std::string case_text(const Case& settings);

// Whether a progress line is wanted, and the stream for it or null.
std::ostream* progress_stream(const RunOptions& options, bool& terminal);

// Tells `messages` about levels that did not converge.
void tell_failed(const RunOptions& options, const RunSummary& summary);

}  // namespace rsc
