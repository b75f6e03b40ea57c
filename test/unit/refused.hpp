// What is refused as bad input, and with which words.
#pragma once

#include "check.hpp"
#include "error.hpp"

inline bool accepted(const std::function<void()>& what) {
    try {
        what();
        return true;
    } catch (const rsc::Error& e) {
        CHECK(e.kind() == rsc::Failure::bad_input);
        return false;
    }
}

inline void refused(const std::function<void()>& what, const std::string& expected, int line) {
    const char* const words = expected.c_str();
    try {
        what();
        std::printf("line %d: accepted, though '%s' was expected\n", line, words);
        CHECK(!"refused");
    } catch (const rsc::Error& e) {
        CHECK(e.kind() == rsc::Failure::bad_input);
        if (!std::strstr(e.what(), words)) std::printf("line %d: '%s' is not in: %s\n", line, words, e.what());
        CHECK(std::strstr(e.what(), words));
    }
}
#define REFUSED(expression, words) refused([&] { (void)(expression); }, words, __LINE__)
