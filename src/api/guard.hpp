// Every function of rsc.h runs inside guarded(), which converts every exception into a status and a
// message.
#pragma once

#include <cfenv>

#include "base/error.hpp"
#include "rsc.h"
#include "run/signals.hpp"

namespace rsc::api {

// Argument number `argument` (from 1) is wrong.
struct Refusal {
    int argument;
    std::string message;
};

// A status other than success that is not an exception of the core.
struct Outcome {
    std::int32_t status;
    const char* message;
};

// Stores the message for rsc_message, truncated if too long, and returns the status. Never fails,
// because it also reports lack of memory.
std::int32_t failed(std::int32_t status, std::string_view message) noexcept;
std::int32_t status_of(const Error& error, int input) noexcept;

// A comparison with "not estimated" (NaN) is an invalid operation to the processor: callers that
// trap these, or test the flags, meet none from here.
struct QuietArithmetic {
    std::fenv_t callers;
    QuietArithmetic() { std::feholdexcept(&callers); }
    ~QuietArithmetic() { std::fesetenv(&callers); }
    QuietArithmetic(const QuietArithmetic&) = delete;
};

// Runs the body of a function. `input`: the number of the argument to blame if the core throws
// bad_input; 0: none.
template <class Body>
std::int32_t guarded(int input, Body&& body) noexcept {
    const QuietArithmetic quiet;
    try {
        body();
        return RSC_SUCCESS;
    } catch (const Refusal& refusal) {
        return failed(-refusal.argument, refusal.message);
    } catch (const Outcome& outcome) {
        return failed(outcome.status, outcome.message);
    } catch (const Error& error) {
        return failed(status_of(error, input), error.what());
    } catch (const std::bad_alloc&) {
        return failed(RSC_NO_MEMORY, "out of memory");
    } catch (const std::length_error&) {  // an array longer than any memory
        return failed(RSC_NO_MEMORY, "out of memory");
    } catch (const Interrupted& stop) {
        return failed(RSC_STOPPED, stop.what());
    } catch (const std::exception& error) {
        return failed(RSC_INTERNAL, error.what());
    } catch (...) {
        return failed(RSC_INTERNAL, "an error of unknown kind");
    }
}

// The message has the name, because other languages number arguments differently.
[[noreturn]] void refuse(int argument, const char* name, const auto&... why) {
    throw Refusal{argument, joined("argument ", name, " ", why...)};
}

// For handles (api/handles.hpp) also checks their kind.
template <class T>
void require(T* pointer, int argument, const char* name) {
    if (!pointer) refuse(argument, name, "must not be null");
    if constexpr (requires { pointer->tag.sound(); })
        if (!pointer->tag.sound())
            refuse(argument, name, "was already released, or is a handle of another kind");
}

// Within the limits of rsc.h, "Numbers".
void require_finite(double value, int argument, const char* name);
// Arrays: not null, all values within these limits.
void require_finite(const double* values, std::int64_t n, int argument, const char* name);

template <class T, class U>
void put(T* output, const U& value) {
    if (output) *output = static_cast<T>(value);
}

// Copies text into a caller's buffer: arguments number `first` (buffer) and first + 1 (size).
void put_text(std::string_view text, char* buffer, std::int64_t size, std::int64_t* length,
              int first);

// guarded() for a function of an object, its argument 1.
template <class Handle, class Body>
std::int32_t on(Handle* handle, const char* name, int input, Body&& body) noexcept {
    return guarded(input, [&] {
        require(handle, 1, name);
        body();
    });
}

// guarded() for a function that creates a handle, its argument 1. The handle is null unless the
// function succeeds.
template <class Handle, class Make>
std::int32_t constructed(int input, Handle** handle, const char* name, Make&& make) noexcept {
    return guarded(input, [&] {
        require(handle, 1, name);
        *handle = nullptr;
        *handle = make();
    });
}

// guarded() for a function that releases a handle and sets it to null.
template <class Handle>
std::int32_t destroyed(Handle** handle, const char* name) noexcept {
    return guarded(0, [&] {
        require(handle, 1, name);
        if (*handle) require(*handle, 1, name);
        delete *handle;
        *handle = nullptr;
    });
}

}  // namespace rsc::api
