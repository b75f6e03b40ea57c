// Lock for libraries that are not thread-safe, and FFTW plans.
#pragma once

#include "base/std.hpp"

#include <fftw3.h>

namespace rsc {

// One lock for NetCDF with HDF5 and for the FFTW planner, which are not thread-safe. rsc holds it
// during calls to them; programs that also use these libraries lock it by rsc_lock (rsc.h). It is
// recursive. A fork waits until no other thread holds it, so that the libraries are in a consistent
// state in the child.
class LibraryLock {
public:
    LibraryLock();
    void lock();
    bool unlock();  // false: this thread does not hold it
};

LibraryLock& library_lock();

// Plans are created and destroyed under library_lock(), always with FFTW_ESTIMATE: with measured
// plans results would differ between runs.

// Returns the lock to be held while plans are created. Throws std::bad_alloc if a test allocation
// fails, because FFTW would terminate the program when it is out of memory.
inline std::unique_lock<LibraryLock> fftw_planning() {
    constexpr std::size_t most = std::size_t{8} << 20;  // tables of the longest transforms included
    std::unique_lock lock(library_lock());
    void* const probe = std::malloc(most);
    if (!probe) throw std::bad_alloc();
    std::free(probe);
    return lock;
}

// The smallest multiple of `even`, 1 or 2, of at least `least` points whose transforms are fast.
inline int fast_size(int least, int even = 1) {
    for (int n = least + least % even;; n += even) {
        int rest = n;
        for (const int factor : {2, 3, 5, 7})
            while (rest % factor == 0) rest /= factor;
        if (rest == 1) return n;
    }
}

struct FftwDestroyer {
    void operator()(auto* plan) const noexcept {
        const std::lock_guard lock(library_lock());
        if constexpr (std::is_same_v<decltype(plan), fftw_plan>)
            fftw_destroy_plan(plan);
        else
            fftwf_destroy_plan(plan);
    }
};

// Own a plan in double and single precision. Several threads may execute it at once, each on its
// own arrays (fftw_execute_dft, ...).
using FftwPlan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, FftwDestroyer>;
using FftwfPlan = std::unique_ptr<std::remove_pointer_t<fftwf_plan>, FftwDestroyer>;

}  // namespace rsc
