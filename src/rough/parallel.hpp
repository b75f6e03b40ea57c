// Loops that several threads share, and places where long work may be stopped.
//
// The threads belong to a pool of the process: they are started when they are first wanted and sleep between loops, so that other programs on
// the machine lose nothing and a loop beside a busy program waits for nobody but its own last pieces. OpenMP's threads spin at barriers,
// end the program where the system refuses to start one, and hang after a fork.
#pragma once

#include "std.hpp"

namespace rsc {

// Threads for loops and campaigns: `wanted`, or with 0 those of LoopThreads, of OMP_NUM_THREADS, or the processors of this process.
// At most 16 + 2 times the processors.
std::size_t most_threads(int wanted);

// While it lives, loops of this thread that say 0 use so many threads.
class LoopThreads {
public:
    explicit LoopThreads(int threads);
    LoopThreads(const LoopThreads&) = delete;
    LoopThreads& operator=(const LoopThreads&) = delete;
    ~LoopThreads();

private:
    int before_;
};

// Runs body(piece, worker) for the pieces 0 ... count - 1 on this thread and on helpers of the pool, at most most_threads(threads) in all and
// fewer where the system starts no more. `worker` is below the number of threads, and no two pieces run at once with the same one: it numbers
// buffers. Which thread takes which piece is left to chance, so results must depend on the pieces alone.
// A piece may throw: pieces not yet begun are then left out, and one of the exceptions is thrown here, this thread's own if there is one.
// Everything runs on this thread inside a piece of another loop, inside a caller's OpenMP region, and after a fork.
void parallel_pieces(std::size_t count, int threads, const std::function<void(std::size_t piece, std::size_t worker)>& body);

// Runs body(k) or body(k, worker) for k = 0 ... n - 1, `grain` of them in a piece.
template <class Index, class Body>
void parallel_for(Index n, int grain, int threads, Body&& body) {
    const auto each = static_cast<Index>(grain);
    parallel_pieces(static_cast<std::size_t>((n + each - 1) / each), threads, [&](std::size_t piece, std::size_t worker) {
        for (Index k = static_cast<Index>(piece) * each, end = std::min<Index>(n, k + each); k < end; ++k) {
            if constexpr (std::is_invocable_v<Body, Index, std::size_t>)
                body(k, worker);
            else
                body(k);
        }
    });
}

// Long loops check now and then whether they are to be stopped.

// While it lives, stopping_point() on this thread calls `ask`, at most every 50 ms. To stop the work `ask` throws.
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

// A place where work may be left by an exception: where nothing is half done. In a piece of a parallel loop it asks on the thread that has the
// watch; the other threads then begin no further piece.
void stopping_point();

}  // namespace rsc
