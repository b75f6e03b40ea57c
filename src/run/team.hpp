// Parallel work on campaigns and studies.
#pragma once

#include "case/case.hpp"
#include "problem/job.hpp"
#include "run/run.hpp"

namespace rsc {

// Workers of campaigns and studies: the threads of this process, or the ranks of an MPI job
// (mpi_team.hpp). Tasks are distributed one by one to idle workers; results do not depend on the
// distribution.

// A task: one realization of a member, or the whole member (realization 0).
struct Task {
    std::int32_t member = 0;  // from 0
    std::int64_t realization = 0;
};

// Executes a task and returns its result as bytes. Once `abandoned` is true the result is no longer
// needed.
using Work = std::function<std::string(const Task&, const std::atomic<bool>& abandoned)>;

class Team {
public:
    // The next task, or none at present. Called again after every result.
    using Next = std::function<std::optional<Task>()>;
    // Takes a result. Called by the thread that called run(), in the order in which results arrive.
    using Collect = std::function<void(const Task&, std::string&&)>;

    virtual ~Team() = default;
    virtual std::size_t workers() const = 0;
    // Runs until `next` has no more tasks and every result has arrived. `ahead`: tasks queued for a
    // worker in addition to its present one.
    // Rethrows exceptions of tasks and of `collect`, and throws Interrupted once a signal has been
    // caught; unfinished tasks are then abandoned.
    virtual void run(const Next& next, const Collect& collect, int ahead) = 0;

    std::function<void()>
        meanwhile;  // called several times a second by the thread that called run(); may throw
};

// Threads that execute tasks from a queue. Loops within a task run on its thread only.
class WorkerThreads {
public:
    struct Done {
        Task task;
        std::string answer;
        std::exception_ptr error;
    };
    WorkerThreads(const Work& work, std::size_t threads);
    WorkerThreads(const WorkerThreads&) = delete;
    WorkerThreads& operator=(const WorkerThreads&) = delete;
    ~WorkerThreads();  // abandons running tasks and waits for the threads

    void push(const Task& task);
    // Waits for a result, at most for this time.
    std::optional<Done> pop(std::chrono::microseconds wait);
    // Number of tasks pushed and not popped.
    std::size_t unfinished() const { return unfinished_; }
    std::size_t size() const { return threads_.size(); }

private:
    void loop();

    const Work& work_;
    std::mutex mutex_;
    std::condition_variable wake_worker_, wake_owner_;
    std::deque<Task> tasks_;
    std::deque<Done> done_;
    std::atomic<bool> abandoned_{false};
    std::size_t unfinished_ = 0;  // of the owner
    std::vector<std::thread> threads_;
};

class ThreadTeam : public Team {
public:
    // threads = 0: as many as are available to this process.
    ThreadTeam(Work work, int threads);
    std::size_t workers() const override { return threads_; }
    void run(const Next& next, const Collect& collect, int ahead) override;

private:
    Work work_;
    std::size_t threads_;
};

// Throws Interrupted if a signal has been caught; `state` ends its message.
void leave_if_interrupted(const std::string& state = "");

// The work of a worker: realizations of the members of a study (or of the one case there is), or
// whole members.

// Any thread may request any task. A member is prepared on the first request and kept until another
// member is requested.
class CampaignWork {
public:
    // `whole`: options for running whole members, with `threads` threads.
    CampaignWork(std::vector<Case> members, RunOptions whole);
    // The record of the realization as bytes (checkpoint.hpp), or for a whole member those of
    // its RunSummary. Throws Error with the number of the realization, and Interrupted when
    // abandoned.
    std::string operator()(const Task& task, const std::atomic<bool>& abandoned);
    std::shared_ptr<const Job> job(std::int32_t member);

private:
    std::vector<Case> members_;
    RunOptions whole_;
    std::mutex mutex_;
    std::int32_t prepared_ = -1;
    std::shared_ptr<const Job> job_;
};

}  // namespace rsc
