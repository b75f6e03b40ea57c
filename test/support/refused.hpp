// What is refused as bad input, and with which words.
#pragma once

#include "base/error.hpp"
#include "check.hpp"

// The message of the refusal; empty if there is none.
inline std::string refusal(const std::function<void()>& what,
                           rsc::Failure kind = rsc::Failure::bad_input) {
    try {
        what();
        return {};
    } catch (const rsc::Error& e) {
        CHECK(e.kind() == kind);
        return e.what();
    }
}
inline bool accepted(const std::function<void()>& what) { return refusal(what).empty(); }

inline void refused(const std::string& message, const std::string& words, int line) {
    const bool right = !message.empty() && message.find(words) != std::string::npos;
    if (!right) std::printf("line %d: '%s' is not in: %s\n", line, words.c_str(), message.c_str());
    CHECK(right);
}
#define REFUSED(expression, words) refused(refusal([&] { (void)(expression); }), words, __LINE__)
