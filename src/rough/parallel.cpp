#include "rough/parallel.hpp"

#include <omp.h>
#include <pthread.h>

namespace rsc {
namespace {

constexpr std::size_t kMost = 1024;

std::atomic<bool> used{false}, forked{false};
thread_local int alive = 1;  // size of the thread pool that libgomp keeps for this thread: that of its last region

void* wait_for(void* mutex) {
    auto* const all_there = static_cast<pthread_mutex_t*>(mutex);
    pthread_mutex_lock(all_there);
    pthread_mutex_unlock(all_there);
    return nullptr;
}

// Number of threads, at most `more`, that can be started at the same time. Not std::thread: it frees memory in the new thread, for which
// the system reserves 64 MB of address space permanently.
int can_start(int more) {
    std::array<pthread_t, kMost> started;
    pthread_mutex_t all_there = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&all_there);
    int count = 0;
    while (count < more && pthread_create(&started[static_cast<std::size_t>(count)], nullptr, wait_for, &all_there) == 0) ++count;
    pthread_mutex_unlock(&all_there);
    for (int k = 0; k < count; ++k) pthread_join(started[static_cast<std::size_t>(k)], nullptr);
    return count;
}

}  // namespace

std::size_t most_threads(int wanted) {
    const int n = wanted > 0 ? wanted : omp_get_max_threads();
    // Far more threads than processors only wait for each other: with a thousand threads on two processors, seconds of work take minutes.
    const int most = std::min(static_cast<int>(kMost), 16 + 2 * omp_get_num_procs());
    return static_cast<std::size_t>(std::clamp(n, 1, most));
}

int omp_team(std::size_t work, int wanted) {
    if (work < 2 || forked || omp_get_level() >= omp_get_max_active_levels()) return 1;
    const int team = static_cast<int>(std::min(work, most_threads(wanted)));
    if (team == 1) return 1;
    if (!used.exchange(true)) pthread_atfork(nullptr, nullptr, [] { forked = true; });
    if (team > alive) {
        const int more = can_start(team - alive);
        // If the limit was reached, one thread fewer leaves memory for the others.
        alive = std::max(1, more == team - alive ? team : alive + more - 1);
        return alive;
    }
    return alive = team;  // libgomp ends the others
}

namespace {

thread_local Watch* watch = nullptr;
thread_local Watch* of_another = nullptr;  // watch of another thread
thread_local std::chrono::steady_clock::time_point asked;

}  // namespace

Watch::Watch(std::function<void()> ask) : ask_(std::move(ask)), before_(std::exchange(watch, this)) {}
Watch::~Watch() { watch = before_; }

Watch* Watch::here() { return watch; }
Watch::Shared::Shared(Watch* shared) : before_(std::exchange(of_another, watch ? nullptr : shared)) {}
Watch::Shared::~Shared() { of_another = before_; }

void stopping_point() {
    if (of_another && of_another->stopped_) throw std::runtime_error("stopped");
    if (!watch) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - asked < std::chrono::milliseconds(50)) return;
    asked = now;
    try {
        watch->ask_();
    } catch (...) {
        watch->stopped_ = true;
        throw;
    }
}

bool LoopStop::now() noexcept {
    if (stopped_) return true;
    try {
        stopping_point();
    } catch (...) {
        if (!stopped_.exchange(true)) thrown_ = std::current_exception();
    }
    return stopped_;
}

void LoopStop::tell() const {
    if (thrown_) std::rethrow_exception(thrown_);
}

}  // namespace rsc
