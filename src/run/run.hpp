// Runs a case: options, outcome, a single realization or a whole case.
#pragma once

#include "case/case.hpp"
#include "case/options.hpp"
#include "problem/job.hpp"

namespace rsc {

struct RunOptions {
    std::string command;              // for the history attribute
    std::vector<std::string> inputs;  // input files of the case, which no result may overwrite
    Progress progress = Progress::never;
    // Apply compare%levels = 'auto', as the program does in single runs.
    bool compare_automatically = false;
    bool resume = false;                           // a campaign: continue an interrupted run
    std::ostream* table = nullptr;                 // the level table and the summary; null: none
    std::ostream* messages = nullptr;              // warnings, progress; null: none
    const std::atomic<bool>* abandoned = nullptr;  // once true the run ends with Interrupted
    // Called several times a second in the calling thread with the levels or realizations done and
    // their total number. If it returns true the run ends with Interrupted.
    std::function<bool(double done, double total)> report;
};

// The outcome of a run.
struct RunSummary {
    // Of all realizations, including those compared with elements; failed: not converged.
    long levels = 0, failed = 0;
    long held = 0;            // of these those whose force no state has (Fallback::held)
    long doubtful = 0;        // levels with doubts
    std::int32_t doubts = 0;  // all of these (trust/doubts.hpp)
    // Means over the realizations at the first and the last level.
    LevelValues first = {}, last = {};
    double least_force_error = kNotComputed;  // expected, relative; of a single realization
};

// The files that a case reads: heights, spectrum or asperities of the surface, and the map of the
// indenter. Throws Error(bad_input) if a pattern matches none.
std::vector<std::string> input_files(const Case& settings);

// Applies check_output to the result of a case, which must not replace its input files. Returns
// true if an earlier result is replaced.
bool check_result_path(const Case& settings, const RunOptions& options);

// The effective namelist in a result file: that of the case without run%threads, which has no
// effect on results.
std::string case_text(const Case& settings);

// The outcome of a run with this result.
RunSummary summary_of(const Result& result);

// Reports levels that did not converge on `messages`.
void tell_failed(const RunOptions& options, const RunSummary& summary);

// Runs a case of one realization: surface, levels, observations, result file and screen output.
// Errors as run_case.
RunSummary run_realization(const Case& settings, const RunOptions& options);

// The namelist of a campaign on twins of a measured map: surfaces with the spectrum in the result
// file `result`, other keys as in the case of the job.
std::string twins_text(const Job& job, const std::string& result);

// Runs a case, one realization or a campaign, and writes its file. Returns the number of levels
// that did not converge. Throws Error, and Interrupted after a signal if the program catches
// signals; then there is no new result file, but a campaign leaves its checkpoint.
long run_case(const Case& settings, const RunOptions& options);

// Campaigns: the realizations of a case, distributed to a team and added up in their order; they
// may be interrupted at any moment.

class Team;

// Runs the realizations of `settings`, which is number `member` of the team's members and prepared
// as `job`, and writes the result file. Its bits depend neither on the team nor on interruptions.
// Until the campaign is finished its state is in `<result file>.checkpoint`; options.resume
// continues from it, or from the result file of the same campaign with fewer realizations.
// Throws Error(bad_input) before anything runs (output not writable, an earlier checkpoint, one of
// another case), Error with the number of the realization that failed, and Interrupted; after the
// last two the checkpoint contains all finished realizations.
RunSummary run_campaign(const Case& settings, const RunOptions& options, Team& team,
                        std::int32_t member, std::shared_ptr<const Job> job);

// The summary of a campaign or a single case (levels and failed only) if its result file is
// complete, and was written for the same case and inputs by this version.
std::optional<RunSummary> finished_result(const Case& settings);

// rsc --merge. `files`: results of one case, in any order, whose realizations are consecutive. The
// variables of the result file `output` equal, within rounding, those of one campaign over all of
// them. Throws Error(bad_input), before anything is written, naming a file that is no result of a
// campaign, of another version or of another case (with the keys that differ), or realizations that
// are in two files or in none.
RunSummary merge_campaigns(const std::vector<std::string>& files, const std::string& output,
                           const RunOptions& options);

}  // namespace rsc
