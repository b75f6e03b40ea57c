#include "run/signals.hpp"

#include <csignal>

#include <atomic>

namespace rsc {
namespace {

std::atomic<int> caught{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may store it");

extern "C" void remember(int signal) { note_signal(signal); }

}  // namespace

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = remember;
    sigemptyset(&action.sa_mask);
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;  // the second one finds the default again
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

int caught_signal() noexcept { return caught.load(std::memory_order_relaxed); }

void note_signal(int signal) noexcept {
    int none = 0;
    caught.compare_exchange_strong(none, signal);
}

const char* signal_name(int signal) noexcept { return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "a signal"; }

}  // namespace rsc
