// A campaign: the realizations of a case, spread over a team, added up in their order, interruptible at any moment.
#pragma once

#include <cstdint>
#include <memory>

#include "case/case.hpp"
#include "run/campaign_team.hpp"
#include "run/job.hpp"
#include "run/run_options.hpp"

namespace rsc {

// Runs the realizations of `settings`, which the team knows as its member `member`, and writes the result file. `job`: the case
// made ready. Bits do not depend on the team, nor on interruptions. While it runs, and until it is finished, its state is in
// `<result file>.checkpoint`; options.resume goes on with it, or with the result file of the same campaign with fewer realizations.
// Throws Error(bad_input) before anything is run (output not writable, a checkpoint in the way or of another case), Error with
// the number of the realization that failed, Interrupted. After any of the last two the checkpoint holds all realizations that
// were finished.
RunSummary run_campaign(const Case& settings, const RunOptions& options, Team& team, std::int32_t member, std::shared_ptr<const Job> job);

// Of a campaign or a single case: is its result file there and whole, made from the same case and inputs by this version? The summary of
// what it holds then (of which only levels and failed are known).
std::optional<RunSummary> finished_result(const Case& settings);

}  // namespace rsc
