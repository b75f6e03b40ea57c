// Text by the rules of printf.
#pragma once

#include <cstdio>
#include <string>

namespace rsc {

// At most 599 characters; longer texts are cut.
template <class... Args>
std::string format(const char* text, Args... args) {
    char buffer[600];
    std::snprintf(buffer, sizeof buffer, text, args...);
    return buffer;
}

}  // namespace rsc
