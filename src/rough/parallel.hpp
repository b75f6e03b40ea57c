// Number of OpenMP threads of a parallel region: no more than the system starts.
//
// Number of OpenMP threads, and stopping of long loops.
#pragma once

#include "std.hpp"

namespace rsc {

// Number of OpenMP threads of a parallel region: no more than the system starts.
//
// libgomp ends the program if a thread cannot be started, and crashes with tens of thousands of threads. Every parallel region of rsc
// therefore has num_threads(omp_team(...)), which first tests how many threads can be started. Results do not depend on the number of
// threads.

// `work`: number of work items, kEveryThread if there are many; 0 or 1: one thread. `wanted`: requested threads; 0: omp_get_max_threads().
// Returns 1 inside a parallel region, and in a process forked from one that had used threads: libgomp's threads do not exist there, and it
// would wait for them forever.
inline constexpr std::size_t kEveryThread = static_cast<std::size_t>(-1);  // more work than threads
int omp_team(std::size_t work, int wanted = 0);

// Number of threads that a campaign or study may start: `wanted`, or all that OpenMP offers if 0.
std::size_t most_threads(int wanted);

// Long loops check regularly whether they must stop.

// During its lifetime, stopping_point() on this thread calls `ask` at most every 50 ms; `ask` throws to stop the work.
class Watch {
public:
    explicit Watch(std::function<void()> ask);
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    ~Watch();

    static Watch* here();  // the watch of this thread, or null
    // During its lifetime, stopping_point() on this thread throws once the watch has stopped its own thread.
    class Shared {
    public:
        explicit Shared(Watch* watch);
        Shared(const Shared&) = delete;
        Shared& operator=(const Shared&) = delete;
        ~Shared();

    private:
        Watch* before_;
    };

private:
    std::function<void()> ask_;
    Watch* before_;
    std::atomic<bool> stopped_{false};
    friend void stopping_point();
};

// Point at which an exception may end the work: outside parallel regions, with all data in a consistent state.
void stopping_point();

// Stopping point in a parallel OpenMP loop, which no exception may leave:
//
//     LoopStop stop;
//     #pragma omp parallel for
//     for (...) { if (stop.now()) continue; ... }
//     stop.tell();
class LoopStop {
public:
    bool now() noexcept;  // true if the remaining iterations are to be skipped
    void tell() const;    // rethrows the exception of the stopping point, if any

private:
    std::atomic<bool> stopped_{false};
    std::exception_ptr thrown_;
};

}  // namespace rsc
