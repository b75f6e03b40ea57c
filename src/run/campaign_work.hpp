// The work of a worker: realizations of the members of a study (or of the one case there is), or whole members.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.hpp"
#include "run/campaign_team.hpp"
#include "run/job.hpp"
#include "run/run_options.hpp"

namespace rsc {

// Any thread may ask for any task. A member is prepared when it is first wanted and kept until another is.
class CampaignWork {
public:
    // `whole`: how members are run as a whole, by so many threads.
    CampaignWork(std::vector<Case> members, RunOptions whole);
    // The record of the realization as bytes (campaign_archive.hpp), or for a whole member its RunSummary. Throws Error naming
    // the realization, Interrupted when abandoned.
    std::string operator()(const Task& task, const std::atomic<bool>& abandoned);
    std::shared_ptr<const Job> job(std::int32_t member);

private:
    std::vector<Case> members_;
    RunOptions whole_;
    std::mutex mutex_;
    std::int32_t prepared_ = -1;
    std::shared_ptr<const Job> job_;
};

std::string to_bytes(const RunSummary& summary);
RunSummary summary_from_bytes(std::string_view bytes);

}  // namespace rsc
