// The one lock of libraries that several threads may not use at once: NetCDF with HDF5, and the planner of FFTW. All of rsc holds it while it is
// in them, and rsc_lock (rsc.h) gives it to programs that use these libraries, too.
#pragma once

namespace rsc {

// A mutex that its owner may lock again. A fork waits until no other thread holds it, so that the libraries are in order in the child.
class LibraryLock {
public:
    LibraryLock();
    void lock();
    bool unlock();  // false: this thread does not hold it
};

LibraryLock& library_lock();

}  // namespace rsc
