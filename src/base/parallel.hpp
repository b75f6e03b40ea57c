// Parallel loops, and points at which long work can be stopped.
//
// The threads belong to a pool of the process. They are started on first use and sleep between
// loops, ten microseconds after the last, so that they do not slow down other programs. OpenMP
// threads spin at barriers, end the program if a thread cannot be started, and hang after a fork.
#pragma once

#include "base/std.hpp"

namespace rsc {

// Memory of the machine [bytes]; Infinity: not known.
double machine_memory();

// Number of threads for loops and campaigns: `requested`, or if 0 that of LoopThreads, of
// OMP_NUM_THREADS, or the number of processors. At most 16 + 2 times the number of processors.
std::size_t most_threads(int requested);

// During its lifetime, loops of this thread with threads = 0 use this number of threads.
class LoopThreads {
public:
    explicit LoopThreads(int threads);
    LoopThreads(const LoopThreads&) = delete;
    LoopThreads& operator=(const LoopThreads&) = delete;
    ~LoopThreads();

private:
    int before_;
};

// Runs body(piece, worker) for the pieces 0 ... count - 1 on this thread and on helpers of the
// pool, at most most_threads(threads) in total, fewer if the system cannot start them. `worker` is
// below the number of threads and unique among concurrent pieces, so that it can index buffers. The
// assignment of pieces to threads is random: results must depend only on the pieces. If a piece
// throws, pieces not yet begun are skipped, and one exception is rethrown here, preferably that of
// this thread. A loop inside a piece of another loop is shared with threads that the outer loop has
// no pieces for. All pieces run on this thread inside an OpenMP region of the caller and after a
// fork.
void parallel_pieces(std::size_t count, int threads,
                     const std::function<void(std::size_t piece, std::size_t worker)>& body);

// Runs body(k) or body(k, worker) for k = 0 ... n - 1, with `grain` values per piece.
template <class Index, class Body>
void parallel_for(Index n, int grain, int threads, Body&& body) {
    const auto each = static_cast<Index>(grain);
    parallel_pieces(at((n + each - 1) / each), threads, [&](std::size_t piece, std::size_t worker) {
        for (Index k = static_cast<Index>(piece) * each, end = std::min<Index>(n, k + each);
             k < end; ++k) {
            if constexpr (std::is_invocable_v<Body, Index, std::size_t>)
                body(k, worker);
            else
                body(k);
        }
    });
}

// The sum of part(k) for k = 0 ... n - 1, added in their order whichever threads compute them.
template <class Sum = double, class Index, class Part>
Sum sum_in_order(Index n, int grain, int threads, Part&& part) {
    std::vector<Sum> parts(at(n));
    parallel_for(n, grain, threads, [&](Index k) { parts[at(k)] = part(k); });
    return std::accumulate(parts.begin(), parts.end(), Sum{});
}

// Sets `found` to the numbers k = 0 ... n - 1 for which test(k), in their order; test(k) is called
// once for each.
template <class Test>
void find_all(std::size_t n, int grain, int threads, Test&& test, std::vector<int>& found) {
    const auto each = at(grain);
    found.resize(n);
    std::vector<std::size_t> ends((n + each - 1) / each);
    parallel_pieces(ends.size(), threads, [&](std::size_t piece, std::size_t) {
        std::size_t next = piece * each;
        for (std::size_t k = next, end = std::min(n, k + each); k < end; ++k) {
            found[next] = int(k);
            next += test(k) ? 1 : 0;
        }
        ends[piece] = next;
    });
    auto to = found.begin();
    for (std::size_t piece = 0; piece < ends.size(); ++piece)
        to = std::copy(found.data() + piece * each, found.data() + ends[piece], to);
    found.erase(to, found.end());
}

// Long loops check regularly whether they must stop.

// During its lifetime, stopping_point() on this thread calls `ask` at most every 50 ms; `ask`
// throws to stop the work.
class Watch {
public:
    explicit Watch(std::function<void()> ask);
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    ~Watch();

private:
    std::function<void()> ask_;
    Watch* before_;
    friend void stopping_point();
};

// Point at which an exception may end the work, with all data in a consistent state. In a parallel
// loop only the thread that has the watch checks it; the other threads then begin no further
// pieces.
void stopping_point();

}  // namespace rsc
