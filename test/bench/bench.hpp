// What the parts of the bench share. A part is a function without arguments that prints its rows;
// bench.cpp lists them all.
#pragma once

#include <sys/resource.h>

#include "contact/indentation.hpp"

namespace bench {

// Processor time of all threads: a machine busy with other things spoils it less than the time on
// the wall.
inline double now() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

// The shortest of several runs: what the code costs when nothing else disturbs it.
inline double shortest(int runs, const std::function<void()>& work) {
    double best = 1e300;
    for (int i = 0; i < runs; ++i) {
        const double start = now();
        work();
        best = std::min(best, now() - start);
    }
    return best;
}

// The median of several runs.
inline double middle(int runs, const std::function<void()>& work) {
    std::vector<double> times;
    for (int i = 0; i < runs; ++i) times.push_back(shortest(1, work));
    std::ranges::sort(times);
    return times[times.size() / 2];
}

inline double peak_memory_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

inline const rsc::Indenter kGold{78.0e3 / (1 - 0.42 * 0.42), 2.5, 0.5, 0.5};

// bench_scaling.cpp
void scaling();
// bench_elements.cpp
void elements();
void flats();
// bench_calls.cpp
void calls();

}  // namespace bench
