#include "read/file_list.hpp"

#include <glob.h>

#include <algorithm>

#include "error.hpp"

namespace rsc {

bool is_pattern(const std::string& name) { return name.find_first_of("*?[") != std::string::npos; }

std::vector<std::string> matching_files(const std::string& name) {
    if (!is_pattern(name)) return {name};
    glob_t found{};
    const int status = glob(name.c_str(), GLOB_NOSORT, nullptr, &found);
    std::vector<std::string> files;
    try {
        if (status == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    } catch (...) {
        globfree(&found);
        throw;
    }
    globfree(&found);
    if (status == GLOB_NOSPACE) throw Error(Failure::no_memory, "no memory for the files of " + name);
    if (files.empty()) throw Error(Failure::bad_input, name + ": no file matches this pattern");
    std::sort(files.begin(), files.end());  // not by the locale: the same everywhere
    return files;
}

}  // namespace rsc
