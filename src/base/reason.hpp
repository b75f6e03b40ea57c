// Why a file cannot be read.
#pragma once

#include "base/std.hpp"

namespace rsc {

// For messages: why a file cannot be opened for reading; empty if it can.
inline std::string why_not_opened(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) return "is a folder, not a file";
    errno = 0;
    if (std::ifstream(path, std::ios::binary)) return {};
    return errno != 0 ? std::generic_category().message(errno) : "cannot be opened";
}

}  // namespace rsc
