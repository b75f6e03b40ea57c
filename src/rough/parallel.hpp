// Number of OpenMP threads of a parallel region: no more than the system starts.
//
// libgomp ends the program where the machine refuses to start a thread, and crashes where tens of thousands are asked for. Every parallel
// region of rsc therefore says num_threads(omp_team(...)), which tries first by threads of its own.
// What a region answers depends on no number of threads.
#pragma once

#include "std.hpp"

namespace rsc {

// Number of OpenMP threads of a parallel region: no more than the system starts.
//
// libgomp ends the program if a thread cannot be started, and crashes with tens of thousands of threads. Every parallel
// region of rsc therefore says num_threads(omp_team(...)), which tries first, by threads of the C++ library, whose refusal is an
// exception. Results of a region do not depend on the number of threads.

// `work`: number of pieces of work, kEveryThread if there are many; 0 or 1: one thread. `wanted`: requested threads; 0: omp_get_max_threads().
// Returns 1 inside a parallel region, and in a process that was forked from one that had used threads: libgomp's do not live there, and waiting
// for them would not end.
inline constexpr std::size_t kEveryThread = static_cast<std::size_t>(-1);  // more work than threads
int omp_team(std::size_t work, int wanted = 0);

// Threads that a campaign or a study may start: `wanted`, or with 0 what the machine offers this process.
std::size_t most_threads(int wanted);

// Long loops check now and then whether they are to be stopped.

// While it lives, stopping_point() on this thread calls `ask`, at most every 50 ms. To stop the work `ask` throws.
class Watch {
public:
    explicit Watch(std::function<void()> ask);
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    ~Watch();

    static Watch* here();  // that of this thread, or null
    // While it lives, stopping_point() on this thread throws once the thread of the watch has been stopped.
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

// A place where work may be left by an exception: outside of parallel regions, and where nothing is half done.
void stopping_point();

// A stopping point in a loop that OpenMP shares out among threads, which no exception may leave:
//
//     LoopStop stop;
//     #pragma omp parallel for
//     for (...) { if (stop.now()) continue; ... }
//     stop.tell();
class LoopStop {
public:
    bool now() noexcept;  // whether what is left of the loop shall be left out; the thread that has the watch asks
    void tell() const;    // throws what the stopping point threw, if it did

private:
    std::atomic<bool> stopped_{false};
    std::exception_ptr thrown_;
};

}  // namespace rsc
