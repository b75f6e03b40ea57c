#include "run/team.hpp"

#include "base/archive.hpp"
#include "base/parallel.hpp"
#include "run/checkpoint.hpp"
#include "run/realize.hpp"
#include "run/signals.hpp"

namespace rsc {

void leave_if_interrupted(const std::string& state) {
    if (const int signal = caught_signal())
        throw Interrupted(signal, "stopped by ", signal_name(signal), state);
}

WorkerThreads::WorkerThreads(const Work& work, std::size_t threads) : work_(work) {
    threads_.reserve(threads);
    try {
        for (std::size_t k = 0; k < threads; ++k) threads_.emplace_back([this] { loop(); });
    } catch (const std::system_error&) {
        if (threads_.empty()) throw Error(Failure::no_memory, "the system cannot start a thread");
    }
}

WorkerThreads::~WorkerThreads() {
    {
        const std::lock_guard lock(mutex_);
        abandoned_ = true;
        tasks_.clear();
    }
    wake_worker_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void WorkerThreads::loop() {
    const LoopThreads loops(1);
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_worker_.wait(lock, [this] { return abandoned_ || !tasks_.empty(); });
        if (abandoned_) return;
        Done done{tasks_.front(), {}, {}};
        tasks_.pop_front();
        lock.unlock();
        try {
            done.answer = work_(done.task, abandoned_);
        } catch (...) {
            done.error = std::current_exception();
        }
        lock.lock();
        done_.push_back(std::move(done));
        wake_owner_.notify_one();
    }
}

void WorkerThreads::push(const Task& task) {
    {
        const std::lock_guard lock(mutex_);
        tasks_.push_back(task);
    }
    ++unfinished_;
    wake_worker_.notify_one();
}

std::optional<WorkerThreads::Done> WorkerThreads::pop(std::chrono::microseconds wait) {
    std::unique_lock lock(mutex_);
    if (!wake_owner_.wait_for(lock, wait, [this] { return !done_.empty(); })) return {};
    std::optional<Done> done(std::move(done_.front()));
    done_.pop_front();
    --unfinished_;
    return done;
}

ThreadTeam::ThreadTeam(Work work, int threads)
    : work_(std::move(work)), threads_(most_threads(threads)) {}

void ThreadTeam::run(const Next& next, const Collect& collect, int ahead) {
    leave_if_interrupted();
    WorkerThreads workers(work_, threads_);
    const std::size_t most = workers.size() * at(1 + ahead);
    for (;;) {
        while (workers.unfinished() < most) {
            const std::optional<Task> task = next();
            if (!task) break;
            workers.push(*task);
        }
        if (workers.unfinished() == 0) return;
        std::optional<WorkerThreads::Done> done = workers.pop(std::chrono::milliseconds(50));
        leave_if_interrupted();
        if (meanwhile) meanwhile();
        if (!done) continue;
        if (done->error) std::rethrow_exception(done->error);
        collect(done->task, std::move(done->answer));
    }
}

CampaignWork::CampaignWork(std::vector<Case> members, RunOptions whole)
    : members_(std::move(members)), whole_(std::move(whole)) {
    whole_.table = whole_.messages = nullptr;
    whole_.progress = Progress::never;
    whole_.compare_automatically = false;
}

std::shared_ptr<const Job> CampaignWork::job(std::int32_t member) {
    const std::lock_guard lock(mutex_);
    if (prepared_ != member) {
        job_ = std::make_shared<const Job>(prepare(members_.at(at(member))));
        prepared_ = member;
    }
    return job_;
}

std::string CampaignWork::operator()(const Task& task, const std::atomic<bool>& abandoned) {
    if (task.realization == 0) {
        RunOptions options = whole_;
        options.abandoned = &abandoned;
        return bytes_of(run_realization(members_.at(at(task.member)), options));
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
        return to_bytes(
            observe(ready->observe, task.realization, r.statistics, r.levels, std::move(r.curves)));
    } catch (const Error& error) {
        throw Error(error.kind(), which + error.what());
    } catch (const std::bad_alloc&) {
        throw Error(Failure::no_memory, which, "out of memory; reduce run%threads or surface%n");
    }
}

}  // namespace rsc
