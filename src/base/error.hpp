// The one exception type of rsc. Every failure that a user can meet is thrown as an Error with a
// kind; the program turns the kind into an exit status and the library into a status code.
#pragma once

#include "base/format.hpp"

namespace rsc {

enum class Failure {
    bad_input,  // refused before running: namelist, file content, argument value (exit status 2)
    not_converged,  // ran, but a solver did not reach its tolerance (exit status 1)
    no_memory,      // out of memory (exit status 1)
    file_system,    // a file could not be written, disk full, ... (exit status 1)
    internal,       // a broken invariant of rsc itself (exit status 1)
};

class Error : public std::runtime_error {
public:
    // The message is made of texts and numbers, as by joined().
    template <class... Parts>
    Error(Failure kind, const Parts&... message)
        : std::runtime_error(joined(message...)), kind_(kind) {}
    Failure kind() const noexcept { return kind_; }

private:
    Failure kind_;
};

[[noreturn]] void bad_input(const auto&... message) { throw Error(Failure::bad_input, message...); }

}  // namespace rsc
