// SIGINT, SIGTERM and SIGHUP are recorded, so that a run can stop in an orderly state.
#pragma once

#include "std.hpp"

namespace rsc {

// From now on the first of them is remembered instead of ending the program; a second one, some seconds later, ends it
// at once. SIGINT and SIGHUP stay ignored where they are, and a file beyond the limit of file sizes becomes an error instead of a signal. A
// program calls this; the library never does, and caught_signal() is then 0 for ever.
void catch_signals();

// Their number once one has come, 0 before.
int caught_signal() noexcept;

// As if the signal had come to this process: another rank was told to stop.
void note_signal(int signal) noexcept;

// The run was stopped by a signal; the text says how to continue. The exit status is 128 + signal.
class Interrupted : public std::runtime_error {
public:
    Interrupted(int signal, const std::string& message) : std::runtime_error(message), signal_(signal) {}
    int signal() const noexcept { return signal_; }

private:
    int signal_;
};

// "SIGINT", "SIGTERM", "SIGHUP".
const char* signal_name(int signal) noexcept;

}  // namespace rsc
