// Runs one case, or the members of a study, and writes the manifest.
#pragma once

#include "case/read_case.hpp"
#include "case/study.hpp"
#include "run/run.hpp"
#include "run/team.hpp"

namespace rsc {

// Writes the manifest of a study, "output/rsc_manifest.nc" for "output/rsc.nc": the result file of
// each member, and the values of the keys that differ between members. It does not depend on which
// members are finished, so that all tasks of a job array may write it. Throws Error(file_system).
void write_manifest(const ReadCase& read, const std::vector<Member>& members,
                    const std::string& command);

// "1  output/rsc_001.nc  surface%sigma=0.001 surface%L_lambda_s=256", one line for each member.
std::string list_members(const std::vector<Member>& members);

// The members of the study, or the case as its only one. Throws Error(bad_input) with the names of
// invalid members.
std::vector<Member> members_of(const ReadCase& read);

// The work of all members, identical on every rank. A member that is run as a whole gets its share
// of the `threads`.
CampaignWork make_work(const std::vector<Member>& members, const RunOptions& options,
                       std::size_t threads);

// The size of a case, or of the largest member of a study.
struct CheckedSize {
    double megabytes = 0;  // memory of elements and coated asperities at their peak; 0: unknown
    std::string unknowns;
};

// Checks all members, or the one numbered `only`, without solving a level: reads every input and
// checks the path of every result. Returns the size with `threads` threads. Error(bad_input) names
// the member.
CheckedSize check_members(const ReadCase& read, std::optional<int> only, const RunOptions& options,
                          std::size_t threads);

// Runs all members, or the one numbered `only` (from 1), and writes the manifest. With
// options.resume finished members are kept. All members are checked before anything runs:
// Error(bad_input) names the member. Returns the sums of levels. An interrupted study leaves
// complete files and checkpoints.
RunSummary run_members(const ReadCase& read, std::optional<int> only, const RunOptions& options,
                       CampaignWork& work, Team& team);

}  // namespace rsc
