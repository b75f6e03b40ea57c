#include "run/campaign_team.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>

#include "error.hpp"
#include "rough/omp_team.hpp"
#include "run/signals.hpp"

namespace rsc {

void leave_if_interrupted() {
    if (const int signal = caught_signal()) throw Interrupted(signal, std::string("stopped by ") + signal_name(signal));
}

WorkerThreads::WorkerThreads(const Work& work, std::size_t threads) : work_(work) {
    threads_.reserve(threads);
    try {
        for (std::size_t k = 0; k < threads; ++k) threads_.emplace_back([this] { loop(); });
    } catch (const std::system_error&) {
        if (threads_.empty()) throw Error(Failure::no_memory, "the machine refused to start a thread");
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
    omp_set_num_threads(1);  // of this thread alone
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

ThreadTeam::ThreadTeam(Work work, int threads) : work_(std::move(work)), threads_(most_threads(threads)) {}

void ThreadTeam::run(const Next& next, const Collect& collect, int ahead) {
    leave_if_interrupted();
    WorkerThreads workers(work_, threads_);
    const std::size_t most = workers.size() * static_cast<std::size_t>(1 + ahead);
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

}  // namespace rsc
