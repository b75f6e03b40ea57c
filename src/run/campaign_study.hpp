// The program's run: one case, or the members of a study, by whatever team there is.
#pragma once

#include <optional>
#include <vector>

#include "case/read_case.hpp"
#include "case/study.hpp"
#include "run/campaign_team.hpp"
#include "run/campaign_work.hpp"
#include "run/run_options.hpp"

namespace rsc {

// The members of the study, or the case as its only one. Throws Error(bad_input) naming the members that are wrong.
std::vector<Member> members_of(const ReadCase& read);

// The work of all members: any rank makes the same from the same case. `threads` work at a time in all, so that a member run as a
// whole has its share of them.
CampaignWork make_work(const std::vector<Member>& members, const RunOptions& options, std::size_t threads);

// All that can go wrong before the first level, for all members or the one numbered `only`: every input is read, every place of a
// result looked at. Returns the seconds that the run is expected to take with so many threads. Error(bad_input) names the member.
double check_members(const ReadCase& read, std::optional<int> only, const RunOptions& options, std::size_t threads);

// Runs all members, or the one numbered `only` (from 1), and the manifest. With options.resume those that are finished are left
// alone. Everything is looked at before anything runs: Error(bad_input) names the member. Returns the sums of levels.
// An interrupted study leaves whole files and checkpoints.
RunSummary run_members(const ReadCase& read, std::optional<int> only, const RunOptions& options, CampaignWork& work, Team& team);

}  // namespace rsc
