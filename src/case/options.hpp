// The command line. The intended calls, in the order a main program makes them:
//
//     const Options options = parse_options(argc, argv);          // Error(bad_input) on wrong usage: exit status 2
//     if (options.help) { std::cout << usage_text(); return 0; }
//     if (options.version) { std::cout << version_text(); return 0; }
//     if (options.man) { std::cout << manual_page(); return 0; }  // case/manual.hpp
//     if (options.describe) { std::cout << describe(options.describe_what); return 0; }       // case/registry.hpp
//     const ReadCase read = read_case(options);                   // case/read_case.hpp: the file or standard input
//     for (const std::string& warning : read.warnings) std::cerr << warning << '\n';
//     if (options.check) { std::cout << effective_namelist(read); return 0; }
//     if (options.list) ...                                       // expand_study(read.settings, *read.study), case/study.hpp
#pragma once

#include "std.hpp"

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
    std::vector<std::string> merge;  // results of parts of a campaign, to be put together into `output`
    bool resume = false;
    Progress progress = Progress::automatic;
    bool quiet = false;
    bool help = false;
    bool man = false;
    bool version = false;
};

// Throws Error(bad_input) saying what is wrong with the command line. --help, --man and --version win over all that follows them.
Options parse_options(int argc, const char* const* argv);

std::string usage_text();
std::string version_text();

}  // namespace rsc
