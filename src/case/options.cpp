#include "case/options.hpp"

#include "base/error.hpp"
#include "base/version.h"
#include "case/namelist.hpp"

namespace rsc {
namespace {

struct Flag {
    char letter;  // '\0': none
    std::string_view name;
    bool Options::*set = nullptr;  // the options that take no value
    bool takes_value = false;
};

constexpr Flag kFlags[] = {
    {'\0', "case", &Options::show_case},
    {'o', "output", nullptr, true},
    {'s', "set", nullptr, true},
    {'\0', "check", &Options::check},
    {'\0', "describe", &Options::describe},
    {'\0', "list", &Options::list},
    {'\0', "member", nullptr, true},
    {'\0', "resume", &Options::resume},
    {'\0', "merge"},
    {'\0', "progress", nullptr, true},
    {'q', "quiet", &Options::quiet},
    {'h', "help", &Options::help},
    {'\0', "man", &Options::man},
    {'\0', "version", &Options::version},
};

[[noreturn]] void refuse(const auto&... text) { bad_input(text..., " (--help lists the options)"); }

const Flag& find_long(std::string_view name) {
    std::vector<std::string_view> names;
    for (const Flag& flag : kFlags) {
        if (flag.name == name) return flag;
        names.push_back(flag.name);
    }
    refuse("unknown option '--", name, "'", namelist::suggestion(name, names, "--"));
}

const Flag& find_short(char letter) {
    for (const Flag& flag : kFlags)
        if (flag.letter == letter && letter != '\0') return flag;
    refuse("unknown option '-", std::string(1, letter), "'");
}

void apply(Options& options, const Flag& flag, const std::string& value) {
    if (flag.name == "output") {
        if (value.empty()) refuse("--output needs a file name");
        if (options.output) refuse("--output is given twice");
        options.output = value;
    } else if (flag.name == "set") {
        if (value.find('=') == std::string::npos)
            refuse("--set ", value, ": expected 'group%key=value'");
        options.set.push_back(value);
    } else if (flag.name == "member") {
        int member = 0;
        const auto [end, error] =
            std::from_chars(value.data(), value.data() + value.size(), member);
        if (error != std::errc{} || end != value.data() + value.size() || member < 1)
            refuse("--member ", value, ": expected the number of a member, 1 or more");
        options.member = member;
    } else if (flag.name == "progress") {
        constexpr std::string_view kWords[] = {"auto", "always", "never"};
        const auto* const word = std::ranges::find(kWords, value);
        if (word == std::end(kWords))
            refuse("--progress ", value, ": expected auto, always or never");
        options.progress = static_cast<Progress>(word - kWords);
    } else if (flag.name == "merge") {
        options.merge.emplace_back();
    } else {
        options.*flag.set = true;
    }
}

// Gives the words that are no options their meaning.
void take_paths(Options& options, const std::vector<std::string>& paths) {
    if (options.describe) {
        if (paths.size() > 1) refuse("--describe takes one group or group%key");
        if (!paths.empty()) options.describe_what = paths.front();
        return;
    }
    if (!options.merge.empty()) {
        if (paths.size() < 2) refuse("--merge needs two result files or more");
        if (!options.output) refuse("--merge needs --output FILE, the result to write");
        if (!options.set.empty() || options.check || options.list || options.member ||
            options.resume || options.show_case)
            refuse("--merge can only be combined with --output, --quiet and --progress");
        options.merge = paths;
        return;
    }
    if (paths.size() > 1)
        refuse("one case at a time: both '", paths[0], "' and '", paths[1], "' are given");
    if (options.show_case && paths.empty()) refuse("--case needs the name of a result file");
    if (!paths.empty()) {
        if (paths.front().empty()) refuse("the name of the case is empty");
        if (paths.front() != "-") options.case_path = paths.front();
    }
}

}  // namespace

Options parse_options(int argc, const char* const* argv) {
    Options options;
    std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
    std::vector<std::string> paths;
    bool only_paths = false;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (only_paths || word.size() < 2 || word[0] != '-') {
            paths.push_back(word);
            continue;
        }
        if (word == "--") {
            only_paths = true;
            continue;
        }
        const auto value_after = [&](const Flag& flag) {
            if (i + 1 == words.size()) refuse("--", flag.name, " needs a value");
            return words[++i];
        };
        if (word[1] == '-') {
            const std::size_t equals = word.find('=');
            const bool attached = equals != std::string::npos;
            const Flag& flag = find_long(
                std::string_view(word).substr(2, attached ? equals - 2 : std::string::npos));
            if (attached && !flag.takes_value) refuse("--", flag.name, " takes no value");
            apply(options, flag,
                  attached           ? word.substr(equals + 1)
                  : flag.takes_value ? value_after(flag)
                                     : "");
        } else {
            // -q, -qh, -oFILE, -o FILE
            for (std::size_t k = 1; k < word.size(); ++k) {
                const Flag& flag = find_short(word[k]);
                if (flag.takes_value) {
                    apply(options, flag,
                          k + 1 < word.size() ? word.substr(k + 1) : value_after(flag));
                    break;
                }
                apply(options, flag, "");
            }
        }
        if (options.help || options.version) return options;
    }
    take_paths(options, paths);
    return options;
}

std::string usage_text() {
    return "usage: rsc [options] case.nml      run a case, or the case of a result file\n"
           "       rsc [options] < case.nml    the same\n"
           "  -o, --output FILE                write the result to FILE\n"
           "  -s, --set 'group%key=value'      override one key (repeats); a word needs no\n"
           "                                   quotes, nothing after '=' is the default\n"
           "      --check                      read and check the case, print it with every\n"
           "                                   default, run nothing\n"
           "      --case FILE.nc               print the case inside a result file\n"
           "      --describe [group[%key]]     describe keys: type, unit, default, bounds,\n"
           "                                   meaning\n"
           "      --describe WORD              keys and results whose name or meaning has it\n"
           "      --list                       list the members of a &study\n"
           "      --member K                   run only member K of a &study\n"
           "      --resume                     resume an interrupted campaign, or add\n"
           "                                   realizations to a finished one\n"
           "      --merge FILE.nc FILE.nc ...  merge parts of a campaign into --output\n"
           "      --progress auto|always|never show progress on stderr (auto: terminal)\n"
           "  -q, --quiet                      no table on stdout\n"
           "  -h, --help                       print this text\n"
           "      --man                        print the manual page: rsc --man | man -l -\n"
           "      --version                    print the version\n"
           "Exit status: 0 success, 1 failed while running, 2 refused before running,\n"
           "130 or 143 stopped by a signal.\n";
}

std::string version_text() { return "rsc " RSC_VERSION "\n"; }

}  // namespace rsc
