#include "run/campaign_work.hpp"

#include <cstring>
#include <new>

#include "error.hpp"
#include "rough/stopping.hpp"
#include "run/campaign_archive.hpp"
#include "run/signals.hpp"
#include "run/single.hpp"

namespace rsc {

CampaignWork::CampaignWork(std::vector<Case> members, RunOptions whole) : members_(std::move(members)), whole_(std::move(whole)) {
    whole_.table = whole_.messages = nullptr;
    whole_.progress = Progress::never;
    whole_.compare_automatically = false;
}

std::shared_ptr<const Job> CampaignWork::job(std::int32_t member) {
    const std::lock_guard lock(mutex_);
    if (prepared_ != member) {
        job_ = std::make_shared<const Job>(prepare(members_.at(static_cast<std::size_t>(member))));
        prepared_ = member;
    }
    return job_;
}

std::string CampaignWork::operator()(const Task& task, const std::atomic<bool>& abandoned) {
    if (task.realization == 0) {
        RunOptions options = whole_;
        options.abandoned = &abandoned;
        return to_bytes(run_realization(members_.at(static_cast<std::size_t>(task.member)), options));
    }
    const std::shared_ptr<const Job> ready = job(task.member);
    const std::string which = "realization " + std::to_string(task.realization) + ": ";
    try {
        const auto go_on = [&] {
            if (abandoned || caught_signal() != 0) throw Interrupted(caught_signal(), "abandoned");
        };
        const Watch watch(go_on);
        const Realization r = realize(*ready, task.realization, 1);
        go_on();
        return to_bytes(observe(*ready, task.realization, r));
    } catch (const Error& error) {
        throw Error(error.kind(), which + error.what());
    } catch (const std::bad_alloc&) {
        throw Error(Failure::no_memory, which + "the machine refused memory; fewer run%threads or a smaller surface%n need less");
    }
}

std::string to_bytes(const RunSummary& summary) { return {reinterpret_cast<const char*>(&summary), sizeof summary}; }

RunSummary summary_from_bytes(std::string_view bytes) {
    RunSummary summary;
    if (bytes.size() != sizeof summary) throw Error(Failure::internal, "the summary of a member has not the length it should have");
    std::memcpy(&summary, bytes.data(), sizeof summary);
    return summary;
}

}  // namespace rsc
