// The command line; main.cpp uses it.
#pragma once

#include "base/std.hpp"

namespace rsc {

enum class Progress { automatic, always, never };

struct Options {
    std::string case_path;              // empty: standard input
    std::optional<std::string> output;  // replaces &output file
    std::vector<std::string> set;       // "group%key=value", in the order given
    bool show_case = false;             // print the case inside the result case_path
    bool check = false;
    bool describe = false;
    std::string describe_what;  // "", "group" or "group%key"
    bool list = false;
    std::optional<int> member;       // 1-based
    std::vector<std::string> merge;  // results of parts of a campaign, to be merged into `output`
    bool resume = false;
    Progress progress = Progress::automatic;
    bool quiet = false;
    bool help = false;
    bool man = false;
    bool version = false;
};

// Throws Error(bad_input) for an invalid command line. Options after --help and --version are not
// read.
Options parse_options(int argc, const char* const* argv);

std::string usage_text();
std::string version_text();

}  // namespace rsc
