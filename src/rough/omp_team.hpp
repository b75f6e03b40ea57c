// How many OpenMP threads a parallel region gets: no more than the machine starts.
//
// libgomp ends the program where the machine refuses to start a thread, and crashes where tens of thousands are asked for. Every parallel
// region of rsc therefore says num_threads(omp_team(...)), which tries first, by threads of the C++ library, whose refusal is an
// exception. What a region answers depends on no number of threads.
#pragma once

#include <cstddef>

namespace rsc {

// `work`: pieces there are to share out, kEveryThread where they are many; 0 or 1: one thread. `wanted`: threads asked for; 0: omp_get_max_threads().
// Returns 1 inside a parallel region, and in a process that was forked from one that had used threads: libgomp's do not live there, and waiting
// for them would not end.
inline constexpr std::size_t kEveryThread = static_cast<std::size_t>(-1);  // more work than threads
int omp_team(std::size_t work, int wanted = 0);

// Threads that a campaign or a study may start: `wanted`, or with 0 what the machine offers this process.
std::size_t most_threads(int wanted);

}  // namespace rsc
