#include "rough/omp_team.hpp"

#include <omp.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace rsc {
namespace {

constexpr std::size_t kMost = 1024;

std::atomic<bool> used{false}, forked{false};
thread_local int alive = 1;  // threads that libgomp holds ready for regions of this thread: those of the last one

// How many of `more` threads can be there at the same time.
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
        // Where not all came, one less leaves room for what the others need besides.
        alive = std::max(1, more == team - alive ? team : alive + more - 1);
        return alive;
    }
    return alive = team;  // libgomp lets the others go
}

}  // namespace rsc
