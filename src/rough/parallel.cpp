#include "rough/parallel.hpp"

#include <omp.h>
#include <pthread.h>

namespace rsc {
namespace {

constexpr std::size_t kMost = 1024;

std::atomic<bool> used{false}, forked{false};
thread_local int alive = 1;  // threads that libgomp holds ready for regions of this thread: those of the last one

// Number of threads, at most `more`, that the system starts at the same time.
int can_start(int more) {
    std::vector<std::thread> started;
    std::mutex all_there;
    try {
        started.reserve(static_cast<std::size_t>(more));
        const std::lock_guard wait(all_there);
        for (int k = 0; k < more; ++k) started.emplace_back([&] { const std::lock_guard lock(all_there); });
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
    for (std::thread& thread : started) thread.join();
    return static_cast<int>(started.size());
}

}  // namespace

std::size_t most_threads(int wanted) {
    const int n = wanted > 0 ? wanted : omp_get_max_threads();
    return std::clamp<std::size_t>(static_cast<std::size_t>(std::max(n, 1)), 1, kMost);
}

int omp_team(std::size_t work, int wanted) {
    if (work < 2 || forked || omp_get_level() >= omp_get_max_active_levels()) return 1;
    const int team = static_cast<int>(std::min(work, most_threads(wanted)));
    if (team == 1) return 1;
    if (!used.exchange(true)) pthread_atfork(nullptr, nullptr, [] { forked = true; });
    if (team > alive) {
        const int more = can_start(team - alive);
        // If not all could be started, one less leaves memory for the others to work with.
        alive = std::max(1, more == team - alive ? team : alive + more - 1);
        return alive;
    }
    return alive = team;  // libgomp lets the others go
}

namespace {

thread_local Watch* watch = nullptr;
thread_local Watch* of_another = nullptr;  // thread
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

}  // namespace rsc
