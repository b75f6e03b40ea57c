#include "api/guard.hpp"

#include "base/library_lock.hpp"
#include "base/version.h"
#include "io/input_netcdf.hpp"
#include "surface/asperities.hpp"

namespace rsc::api {
namespace {

// A plain array, which needs no allocation and no destruction at the end of a thread.
constexpr std::size_t kMessageSize = 4096;
thread_local char last_message[kMessageSize];

#define RSC_TEXT(x) #x
#define RSC_DOTTED(a, b, c) RSC_TEXT(a) "." RSC_TEXT(b) "." RSC_TEXT(c)
static_assert(std::string_view(RSC_VERSION) ==
              RSC_DOTTED(RSC_VERSION_MAJOR, RSC_VERSION_MINOR, RSC_VERSION_PATCH));
#undef RSC_DOTTED
#undef RSC_TEXT

const char* meaning(std::int32_t status) {
    switch (status) {
#define RSC_CASE(name, value, text) \
    case value: return text;
        RSC_STATUS_LIST(RSC_CASE)
#undef RSC_CASE
        default: return status < 0 ? "" : "not a status code of rsc";
    }
}

}  // namespace

std::int32_t failed(std::int32_t status, std::string_view message) noexcept {
    const std::size_t n = std::min(message.size(), kMessageSize - 1);
    std::memcpy(last_message, message.data(), n);
    if (n < message.size()) std::memcpy(last_message + n - 4, " ...", 4);
    last_message[n] = '\0';
    return status;
}

std::int32_t status_of(const Error& error, int input) noexcept {
    switch (error.kind()) {
        case Failure::bad_input: return input > 0 ? -input : RSC_INTERNAL;
        case Failure::not_converged: return RSC_NOT_CONVERGED;
        case Failure::no_memory: return RSC_NO_MEMORY;
        case Failure::file_system: return RSC_FILE;
        case Failure::internal: break;
    }
    return RSC_INTERNAL;
}

void require_finite(double value, int argument, const char* name) {
    if (!usable(value)) refuse(argument, name, kNumberBounds);
}

void require_finite(const double* values, std::int64_t n, int argument, const char* name) {
    require(values, argument, name);
    for (std::int64_t k = 0; k < n; ++k) {
        if (!usable(values[k])) refuse(argument, name, kNumberBounds, ": entry ", k, " is not");
        // NetCDF's value for unwritten or masked data; in single precision it differs in the eighth
        // digit.
        constexpr double fill = 9.969209968386869e36;
        if (std::abs(values[k] / fill - 1) < 1e-6)
            refuse(argument, name, "holds the fill value of NetCDF: entry ", k, " is missing");
    }
}

void put_text(std::string_view text, char* buffer, std::int64_t size, std::int64_t* length,
              int first) {
    if (size < 0) refuse(first + 1, "size", "must not be negative");
    if (!buffer && size > 0) refuse(first, "buffer", "must not be null unless size is 0");
    if (size > 0) {
        const std::size_t n = std::min(text.size(), at(size - 1));
        std::memcpy(buffer, text.data(), n);
        buffer[n] = '\0';
    }
    put(length, text.size());
}

}  // namespace rsc::api

using namespace rsc;
using namespace rsc::api;

int32_t rsc_version(char* buffer, int64_t size, int64_t* length) {
    return guarded(0, [&] { put_text(RSC_VERSION, buffer, size, length, 1); });
}

int32_t rsc_lock(void) {
    return guarded(0, [] {
        library_lock().lock();
        suppress_hdf5_messages();
    });
}

int32_t rsc_unlock(void) {
    return guarded(0, [] {
        if (!library_lock().unlock())
            throw Outcome{RSC_NO_RESULT, "this thread does not hold the lock"};
    });
}

int32_t rsc_message(char* buffer, int64_t size, int64_t* length) {
    // An error of this call must not replace the message.
    if (size < 0) return -2;
    if (!buffer && size > 0) return -1;
    return guarded(0, [&] { put_text(last_message, buffer, size, length, 1); });
}

int32_t rsc_status_text(int32_t status, char* buffer, int64_t size, int64_t* length) {
    return guarded(0, [&] {
        const std::string text =
            status < 0 ? "argument " + std::to_string(-static_cast<int64_t>(status)) + " is wrong"
                       : meaning(status);
        put_text(text, buffer, size, length, 2);
    });
}
