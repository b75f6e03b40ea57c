// What a fuzzer asserts: a broken promise ends the process, and libFuzzer keeps the input.
#pragma once

#include "base/std.hpp"

// A file for this fuzzer alone.
inline std::string scratch(const char* name) {
    const char* const folder = std::getenv("RSC_FUZZ_FOLDER");
    return std::string(folder ? folder : "/dev/shm") + "/" + name;
}

#define PROMISE(condition, what)                                                            \
    do {                                                                                    \
        if (!(condition)) {                                                                 \
            std::fprintf(stderr, "%s:%d: broken: %s\n%s\n", __FILE__, __LINE__, #condition, \
                         std::string(what).c_str());                                        \
            std::abort();                                                                   \
        }                                                                                   \
    } while (0)
