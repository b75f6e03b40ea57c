#include "run/signals.hpp"

namespace rsc {
namespace {

std::atomic<int> caught{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may store it");

std::atomic<long> caught_at{0};  // seconds

long seconds_now() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);  // async-signal-safe
    return long(now.tv_sec);
}

// One request to stop often arrives twice, for the process and for its group (timeout, mpirun,
// batch systems). A second signal counts only if it arrives some seconds later.
extern "C" void remember(int signal) {
    if (caught_signal() == 0) {
        caught_at = seconds_now();
        note_signal(signal);
    } else if (seconds_now() - caught_at > 1) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

}  // namespace

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = remember;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    // Ignored signals stay ignored: SIGINT in background jobs, SIGHUP under nohup.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN || signal == SIGTERM) sigaction(signal, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);  // exceeding the file size limit is then an error of write()
}

int caught_signal() noexcept { return caught.load(std::memory_order_relaxed); }

void note_signal(int signal) noexcept {
    int none = 0;
    caught.compare_exchange_strong(none, signal);
}

const char* signal_name(int signal) noexcept {
    return signal == SIGINT    ? "SIGINT"
           : signal == SIGTERM ? "SIGTERM"
           : signal == SIGHUP  ? "SIGHUP"
                               : "a signal";
}

}  // namespace rsc
