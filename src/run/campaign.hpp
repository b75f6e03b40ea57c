// Campaigns: the realizations of a case, distributed to a team and added up in their order; they may be interrupted at any moment.
#pragma once

#include "case/case.hpp"
#include "file/result.hpp"
#include "run/job.hpp"
#include "run/run.hpp"
#include "run/team.hpp"

namespace rsc {

// Runs the realizations of `settings`, which is number `member` of the team's members and prepared as `job`, and writes the result
// file. Its bits depend neither on the team nor on interruptions. Until the campaign is finished its state is in
// `<result file>.checkpoint`; options.resume continues from it, or from the result file of the same campaign with fewer realizations.
// Throws Error(bad_input) before anything runs (output not writable, an earlier checkpoint, one of another case), Error with the number
// of the realization that failed, and Interrupted; after the last two the checkpoint contains all finished realizations.
RunSummary run_campaign(const Case& settings, const RunOptions& options, Team& team, std::int32_t member, std::shared_ptr<const Job> job);

// The summary of a campaign or a single case (levels and failed only) if its result file is complete, and was written for the same case
// and inputs by this version.
std::optional<RunSummary> finished_result(const Case& settings);

// rsc --merge. `files`: results of one case, in any order, whose realizations are consecutive. The variables of the result file `output`
// equal, bit for bit, those of one campaign over all of them. Throws Error(bad_input), before anything is written, naming a file that is
// no result of a campaign, of another version or of another case (with the keys that differ), or realizations that are in two files or in
// none.
RunSummary merge_campaigns(const std::vector<std::string>& files, const std::string& output, const RunOptions& options);

}  // namespace rsc
