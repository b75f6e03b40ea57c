// The lock of libraries that are not thread-safe, and plans of FFTW.
#pragma once

#include "std.hpp"

#include <fftw3.h>

namespace rsc {

// The one lock for NetCDF with HDF5 and for the planner of FFTW, which are not thread-safe. rsc holds it while it calls them; rsc_lock
// (rsc.h) gives it to programs that use these libraries, too.
// It is recursive. A fork waits until no other thread holds it, so that the libraries are in a consistent state in the child.
class LibraryLock {
public:
    LibraryLock();
    void lock();
    bool unlock();  // false: this thread does not hold it
};

LibraryLock& library_lock();

// Plans are made and destroyed under library_lock(), always with FFTW_ESTIMATE: measured plans, and the bits of results, differ from run to
// run.

// The lock, to be held while plans are made. FFTW ends the program if it is out of memory: some memory is allocated for a test first. Throws
// std::bad_alloc.
inline std::unique_lock<LibraryLock> fftw_planning() {
    constexpr std::size_t most = std::size_t{8} << 20;  // tables of the longest transforms included
    std::unique_lock lock(library_lock());
    void* const probe = std::malloc(most);
    if (!probe) throw std::bad_alloc();
    std::free(probe);
    return lock;
}

struct FftwPlanDestroyer {
    void operator()(fftw_plan plan) const noexcept {
        const std::lock_guard lock(library_lock());
        fftw_destroy_plan(plan);
    }
};

// Owns a plan; executing it from several threads at once, each on its own arrays, is safe (fftw_execute_dft and its kin).
using FftwPlan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, FftwPlanDestroyer>;

// The same in single precision.
struct FftwfPlanDestroyer {
    void operator()(fftwf_plan plan) const noexcept {
        const std::lock_guard lock(library_lock());
        fftwf_destroy_plan(plan);
    }
};
using FftwfPlan = std::unique_ptr<std::remove_pointer_t<fftwf_plan>, FftwfPlanDestroyer>;

}  // namespace rsc
