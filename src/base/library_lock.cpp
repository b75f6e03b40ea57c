#include "base/library_lock.hpp"

#include <pthread.h>

extern "C" void fftw_make_planner_thread_safe();  // of libfftw3_threads
extern "C" void fftwf_make_planner_thread_safe();

namespace rsc {
namespace {

// Not a std::recursive_mutex, because the child of a fork could not unlock it.
std::mutex mutex;
thread_local int depth = 0;

// Protects programs that create FFTW plans themselves without rsc's lock.
[[maybe_unused]] const bool planner_is_safe =
    (fftw_make_planner_thread_safe(), fftwf_make_planner_thread_safe(), true);

}  // namespace

LibraryLock::LibraryLock() {
    pthread_atfork([] { library_lock().lock(); }, [] { library_lock().unlock(); },
                   [] { library_lock().unlock(); });
}

void LibraryLock::lock() {
    if (depth == 0) mutex.lock();
    ++depth;
}

bool LibraryLock::unlock() {
    if (depth == 0) return false;
    if (--depth == 0) mutex.unlock();
    return true;
}

LibraryLock& library_lock() {
    static LibraryLock lock;
    return lock;
}

}  // namespace rsc
