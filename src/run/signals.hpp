// SIGINT, SIGTERM and SIGHUP are recorded, so that a run can stop in an orderly state.
#pragma once

#include "base/format.hpp"

namespace rsc {

// Installs handlers: the first of these signals is recorded instead of ending the program; a second
// one, some seconds later, ends it at once. SIGINT and SIGHUP stay ignored if they were, and
// exceeding the file size limit becomes an error instead of a signal. Called by programs; the
// library never calls it, so that caught_signal() stays 0.
void catch_signals();

// Number of the signal that was caught, 0 before.
int caught_signal() noexcept;

// Records a signal received by another rank.
void note_signal(int signal) noexcept;

// Thrown if the run was stopped by a signal; the text states how to continue. The exit status is
// 128 + signal.
class Interrupted : public std::runtime_error {
public:
    Interrupted(int signal, const auto&... message)
        : std::runtime_error(joined(message...)), signal_(signal) {}
    int signal() const noexcept { return signal_; }

private:
    int signal_;
};

// "SIGINT", "SIGTERM", "SIGHUP".
const char* signal_name(int signal) noexcept;

}  // namespace rsc
