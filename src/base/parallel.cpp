#include "base/parallel.hpp"

#include <pthread.h>
#include <sched.h>
#include <unistd.h>

extern "C" int omp_in_parallel() __attribute__((weak));  // defined if the program uses OpenMP

namespace rsc {
namespace {

struct Job;

thread_local int loop_threads = 0;        // number set by LoopThreads
thread_local const Job* piece = nullptr;  // the loop of which this thread runs a piece
std::atomic<bool> forked{false};          // true in a forked child, which has no pool threads

// Number of processors that this process may use: batch systems bind jobs, and MPI its ranks, to
// some of those of the machine.
int processors() {
    static const int count = [] {
#ifdef __linux__
        cpu_set_t allowed;
        if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return CPU_COUNT(&allowed);
#endif
        return std::max(1, int(std::thread::hardware_concurrency()));
    }();
    return count;
}

int default_threads() {
    static const int count = [] {
        const char* const text = std::getenv("OMP_NUM_THREADS");
        const long requested = text ? std::strtol(text, nullptr, 10) : 0;  // the first of a list
        return requested > 0 ? int(std::min(requested, 1000000L)) : processors();
    }();
    return count;
}

// What an outermost loop and the loops inside its pieces share.
struct Tree {
    std::atomic<std::size_t> helpers;  // number that may still join any of them
    int threads;                       // loop_threads of the thread that began
};

struct Job {
    std::size_t count;
    const std::function<void(std::size_t, std::size_t)>& body;
    std::size_t requested;  // number of helpers that may still join this loop
    Tree& tree;
    std::size_t joined = 0;
    std::atomic<std::size_t> inside{0}, next{0};
    std::exception_ptr thrown{};
};

// Looks for some microseconds whether `done`: a thread that sleeps takes longer to wake, and most
// loops follow each other more closely.
template <class Done>
void look(Done&& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(10);
    while (!done() && std::chrono::steady_clock::now() < end) {
    }
}

// Pool of threads, which sleep between loops and end with the process.
struct Pool {
    std::mutex mutex;
    std::condition_variable wake, left;
    std::vector<Job*> jobs;
    std::size_t threads = 0, looking = 0;  // all, and those that look for the next job
    std::atomic<std::size_t> posted{0};    // number of jobs so far

    static Pool& get() {
        static Pool* const pool = [] {
            pthread_atfork(nullptr, nullptr, [] { forked = true; });
            return new Pool;
        }();
        return *pool;
    }

    void work(Job& job, std::size_t worker) noexcept {
        const Job* const before = std::exchange(piece, &job);
        for (std::size_t k; (k = job.next.fetch_add(1)) < job.count;) {
            try {
                job.body(k, worker);
            } catch (...) {
                job.next = job.count;
                const std::lock_guard lock(mutex);
                if (!job.thrown || worker == 0) job.thrown = std::current_exception();
            }
        }
        piece = before;
    }

    void help() {
        std::unique_lock lock(mutex);
        for (;;) {
            // Outer loops come before those inside their pieces.
            const auto found = std::ranges::find_if(jobs, [](const Job* job) {
                return job->requested > 0 && job->tree.helpers > 0 && job->next < job->count;
            });
            if (found == jobs.end()) {
                const std::size_t last = posted;
                ++looking;
                lock.unlock();
                look([&] { return posted != last; });
                lock.lock();
                --looking;
                wake.wait(lock, [&] { return posted != last; });
                continue;
            }
            Job& job = **found;
            --job.requested;
            --job.tree.helpers;
            ++job.inside;
            const std::size_t worker = ++job.joined;
            lock.unlock();
            loop_threads = job.tree.threads;
            work(job, worker);
            lock.lock();
            ++job.tree.helpers;
            if (--job.inside == 0) left.notify_all();
        }
    }

    // Starts helpers. std::thread is not used, because it throws if no thread can be started and
    // frees memory in the new thread.
    void start(std::size_t requested) {
        while (threads < requested) {
            pthread_t thread;
            const auto helper = [](void*) -> void* {
                get().help();
                return nullptr;
            };
            if (pthread_create(&thread, nullptr, helper, nullptr) != 0) return;
            pthread_detach(thread);
            ++threads;
        }
    }
};

}  // namespace

double machine_memory() {
    const double pages = double(sysconf(_SC_PHYS_PAGES)), page = double(sysconf(_SC_PAGESIZE));
    return pages > 0 && page > 0 ? pages * page : kInfinity;
}

std::size_t most_threads(int requested) {
    const int n = requested > 0 ? requested : loop_threads > 0 ? loop_threads : default_threads();
    // Far more threads than processors only wait for each other: with a thousand threads on two
    // processors, seconds of work take minutes.
    return at(std::clamp(n, 1, 16 + 2 * processors()));
}

LoopThreads::LoopThreads(int threads) : before_(std::exchange(loop_threads, threads)) {}
LoopThreads::~LoopThreads() { loop_threads = before_; }

void parallel_pieces(std::size_t count, int threads,
                     const std::function<void(std::size_t, std::size_t)>& body) {
    const std::size_t team = std::min(count, most_threads(threads));
    if (team < 2 || (piece && piece->tree.helpers == 0) || forked ||
        (omp_in_parallel && omp_in_parallel())) {
        for (std::size_t k = 0; k < count; ++k) body(k, 0);
        return;
    }
    Pool& pool = Pool::get();
    Tree own{most_threads(threads) - 1, loop_threads};
    Tree& tree = piece ? piece->tree : own;
    Job job{count, body, team - 1, tree};
    std::unique_lock lock(pool.mutex);
    if (!piece) pool.start(own.helpers);
    pool.jobs.push_back(&job);
    ++pool.posted;
    const std::size_t looking = pool.looking, free = tree.helpers;
    lock.unlock();
    for (std::size_t k = looking, end = std::min(team - 1, free); k < end; ++k)
        pool.wake.notify_one();
    pool.work(job, 0);
    lock.lock();
    std::erase(pool.jobs, &job);
    if (job.inside > 0) {
        lock.unlock();
        look([&] { return job.inside == 0; });
        lock.lock();
    }
    pool.left.wait(lock, [&] { return job.inside == 0; });
    lock.unlock();
    if (job.thrown) std::rethrow_exception(job.thrown);
}

namespace {

thread_local Watch* watch = nullptr;
thread_local std::chrono::steady_clock::time_point asked;

}  // namespace

Watch::Watch(std::function<void()> ask)
    : ask_(std::move(ask)), before_(std::exchange(watch, this)) {}
Watch::~Watch() { watch = before_; }

void stopping_point() {
    if (!watch) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - asked < std::chrono::milliseconds(50)) return;
    asked = now;
    watch->ask_();
}

}  // namespace rsc
