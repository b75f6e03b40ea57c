#include "case/read_case.hpp"

#include "base/error.hpp"
#include "base/reason.hpp"

namespace rsc {

using namespace namelist;

namespace {

// The position where a key, or an element of it, was given; line 0 if it was not.
Position place(const Ledger& ledger, const Problem& problem) {
    for (const Key* key : problem.keys) {
        const Ledger::Entry* entry = ledger.find(*key);
        if (!entry || entry->given.empty()) continue;
        if (key == problem.keys.front())
            for (const auto& [element, at] : entry->given)
                if (element == problem.element) return at;
        return entry->given.front().second;
    }
    return {};
}

// True if the value of a key of the problem could not be read. That key still has its default, so
// that the problem is not reported.
bool concerns_faulty(const Ledger& ledger, const Problem& problem) {
    return std::ranges::any_of(problem.keys, [&](const Key* key) {
        const Ledger::Entry* entry = ledger.find(*key);
        return entry && entry->faulty;
    });
}

// True if the study varies a key of the problem. Each member is checked later, so the problem is
// reported there; the case itself is not run.
bool varied(const Study& study, const Problem& problem) {
    return std::ranges::any_of(study.axes, [&](const Study::Axis& axis) {
        const std::string_view name = std::string_view(axis.key).substr(0, axis.key.find('('));
        return std::ranges::any_of(problem.keys,
                                   [&](const Key* key) { return name == full_name(*key); });
    });
}

std::string known_groups_text() {
    std::string text;
    for (const std::string_view group : group_names()) enlist(text, ", ", "&", group);
    return text;
}

std::string limited_text(std::istream& in, const std::string& name) {
    std::string text;
    char buffer[65536];
    while (in.read(buffer, sizeof buffer) || in.gcount() > 0) {
        text.append(buffer, at(in.gcount()));
        if (text.size() > kLargestText) break;  // read_case_text refuses it
    }
    if (in.bad()) bad_input(name, ": cannot be read");
    return text;
}

// Refuses keys without effect: those of a synthetic surface if the surface is read from a file, and
// those replaced by a list of levels.
// Their defaults are accepted, because the effective namelist contains every key.
void keys_without_meaning(const Reading& reading, std::vector<Fault>& faults) {
    static const Case defaults;
    const auto given = [&](const char* name) -> const Ledger::Entry* {
        const Ledger::Entry* entry = reading.ledger.find(key_of(name));
        return entry && !entry->given.empty() && !entry->faulty ? entry : nullptr;
    };
    const auto refuse = [&](const char* name, const auto&... why) {
        const Ledger::Entry* const entry = given(name);
        const std::string value = get_key(reading.settings, name);
        if (!entry || value == get_key(defaults, name)) return;
        const Key& key = *entry->key;
        faults.emplace_back(entry->given.front().second, "&", key.group, ": ", key.name, " = ",
                            value, ": has no effect ", why...);
    };
    // A namelist with all of these keys was printed by rsc.
    const std::array replaced = {"indentation%start", "indentation%stop", "indentation%steps",
                                 "indentation%spacing"};
    if (given("indentation%levels") && !std::ranges::all_of(replaced, given))
        for (const char* name : replaced) refuse(name, "beside levels");
    const Source source = reading.settings.surface.source;
    if (!given("surface%source") ||
        (!reads_heights(reading.settings) && source != Source::asperities))
        return;
    for (const char* name : {"surface%n", "surface%hurst", "surface%L_lambda_l",
                             "surface%L_lambda_s", "surface%plateau", "surface%normalise"})
        refuse(name, "with source = ", get_key(reading.settings, "surface%source"),
               ", whose surface is read from the file");
}

// A value of a command line in namelist syntax: the shell removes the quotes of words, so that they
// are put back for a key that takes text.
std::string quoted_words(const Key& key, const std::string& value) {
    const std::size_t first = value.find_first_not_of(' ');
    if (first == std::string::npos || value[first] == '\'' || value[first] == '"') return value;
    const std::string word = value.substr(first, value.find_last_not_of(' ') + 1 - first);
    if (key.type == Type::string) return from_string(word);
    if (key.choices.empty() || (key.type != Type::choice && to_real(word)) ||
        (key.type != Type::choice && std::isalpha(static_cast<unsigned char>(word[0])) == 0))
        return value;
    if (!key.list || key.type != Type::choice) return from_string(word);
    std::string all;
    std::istringstream words(word);
    for (std::string one; std::getline(words, one, ',');)
        enlist(all, ",", quoted_words(key_of("output%file"), one));
    return all;
}

// Refuses an option that replaces a key of which the study gives every member its own value.
void require_not_varied(const std::string& name, const std::optional<Study>& study) {
    if (!study) return;
    const std::string_view base = std::string_view(name).substr(0, name.find('('));
    const Key& key = key_of(base);
    const std::string subscript = base.size() < name.size() ? name.substr(base.size()) : "";
    for (const Study::Axis& axis : study->axes) {
        const std::size_t bracket = axis.key.find('(');
        if (axis.key.substr(0, bracket) != full_name(key)) continue;
        const bool other_element = !subscript.empty() && bracket != std::string::npos &&
                                   axis.key.substr(bracket) != subscript;
        if (!other_element)
            bad_input("&study varies ", axis.key, ", so that the option has no effect");
    }
}

// Applies "--set surface%sigma=1"; returns an error message, or nothing.
std::string apply_set(Case& settings, const std::string& argument,
                      const std::optional<Study>& study) {
    const std::size_t equals = argument.find('=');
    try {
        if (equals == std::string::npos) bad_input("expected 'group%key=value'");
        const std::string name = argument.substr(0, equals);
        require_not_varied(name, study);
        const Key& key = key_of(std::string_view(name).substr(0, name.find('(')));
        set_key(settings, name, quoted_words(key, argument.substr(equals + 1)));
        return {};
    } catch (const Error& error) {
        return "--set " + argument + ": " + error.what();
    }
}

}  // namespace

Reading read_namelist(std::string_view text) {
    Reading reading;
    Document document = parse(text, group_names());
    reading.faults = std::move(document.faults);
    reading.warnings = std::move(document.warnings);
    std::vector<const Group*> seen;
    for (const Group& group : document.groups) {
        const auto same =
            std::ranges::find_if(seen, [&](const Group* g) { return g->name == group.name; });
        if (same != seen.end()) {
            if (reading.duplicates.size() < kMostFaults)
                reading.duplicates.emplace_back(group.at, "&", group.name,
                                                ": this group is already at line ",
                                                (*same)->at.line);
            continue;
        }
        seen.push_back(&group);
        reading.groups.push_back(*std::ranges::find(group_names(), group.name));
        if (group.name == "study") {
            reading.study = read_study(group, reading.faults);
            continue;
        }
        for (const Assignment& assignment : group.assignments) {
            if (reading.faults.size() >= kMostFaults) break;
            if (const Key* key = find_key(group.name, assignment.key))
                assign(reading.settings, *key, assignment, reading.ledger, reading.faults);
            else
                reading.faults.emplace_back(assignment.at, "&", group.name, ": unknown key '",
                                            assignment.key.substr(0, 63), "'",
                                            suggest_key(group.name, assignment.key));
        }
    }
    finish_lists(reading.settings, reading.ledger, reading.faults);
    return reading;
}

namespace {

void require_text(std::string_view text, const std::string& name) {
    if (text.size() > kLargestText)
        bad_input(name, ": larger than ", kLargestText, " bytes, the limit for a case");
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        bad_input(name, ": is text in UTF-16; save it as UTF-8 or plain ASCII");
    if (text.starts_with("CDF") || text.starts_with("\x89HDF"))
        bad_input(
            name,
            ": is a NetCDF file; to run the case of a result again, give its name: rsc FILE.nc");
}

// Files that cannot be opened; other errors in them are reported when they are read.
void check_files(const Reading& reading, std::vector<Fault>& faults) {
    for (const char* const group : {"surface", "indenter"}) {
        const Ledger::Entry* const entry = reading.ledger.find(*find_key(group, "file"));
        const std::string& file = group == std::string_view("surface")
                                      ? reading.settings.surface.file
                                      : reading.settings.indenter.file;
        if (!entry || entry->given.empty() || entry->faulty || file.empty() ||
            file.find_first_of("*?[") != std::string::npos)
            continue;
        if (const std::string why = why_not_opened(file); !why.empty())
            faults.emplace_back(entry->given.front().second, "&", group, ": file = '", file,
                                "': ", why);
    }
}

// Throws one error with a line for each fault, by their places in the case.
void refuse_faults(const std::string& name, std::vector<Fault>& faults,
                   const std::vector<std::string>& set_faults) {
    std::ranges::stable_sort(faults, [](const Fault& a, const Fault& b) {
        return a.at.line != b.at.line ? a.at.line < b.at.line : a.at.column < b.at.column;
    });
    std::string message;
    std::size_t count = 0;
    const auto line = [&](const std::string& text_line) {
        if (++count <= kMostFaults) enlist(message, "\n", text_line);
    };
    for (const Fault& fault : faults) line(format(name, fault));
    for (const std::string& fault : set_faults) line(fault);
    if (count > 0) bad_input(message);
}

void warn(const std::string& name, const Reading& reading, ReadCase& read) {
    for (const Fault& warning : reading.warnings) read.warnings.push_back(format(name, warning));
    for (const char* const key_name : {"E", "nu", "R"}) {
        const Ledger::Entry* entry = reading.ledger.find(*find_key("solids", key_name));
        if (!entry || entry->given.size() != 1) continue;
        const std::string other =
            joined("solids%", key_name, entry->given.front().first == 1 ? "(2)" : "(1)");
        read.warnings.push_back(name + ": &solids: " + key_name + ": one value of two; " + other +
                                " = " + get_key(read.settings, other) + " taken by default");
    }
    const auto& indentation = read.settings.indentation;
    if (indentation.levels.empty() && indentation.control == Control::separation &&
        indentation.start < indentation.stop)
        read.warnings.push_back(
            name + ": &indentation: start = " + get_key(read.settings, "indentation%start") +
            " is less than stop = " + get_key(read.settings, "indentation%stop") +
            ": separations increase, so that the levels are an unloading");
}

}  // namespace

ReadCase read_case_text(std::string_view text, const std::string& name, const Options& options) {
    require_text(text, name);
    Reading reading = read_namelist(text);
    std::vector<Fault> faults = std::move(reading.faults);
    append(faults, reading.duplicates);
    keys_without_meaning(reading, faults);
    if (reading.groups.empty() && faults.empty())
        faults.emplace_back(Position{}, "no namelist group found; expected at least one of ",
                            known_groups_text());

    Case& settings = reading.settings;
    std::vector<std::string> set_faults;
    for (const std::string& argument : options.set)
        if (std::string problem = apply_set(settings, argument, reading.study); !problem.empty())
            set_faults.push_back(std::move(problem));
    if (options.output) settings.output.file = *options.output;

    for (const Problem& problem : check_case(settings))
        if (!concerns_faulty(reading.ledger, problem) &&
            !(reading.study && varied(*reading.study, problem)))
            faults.emplace_back(place(reading.ledger, problem), "&", problem.keys.front()->group,
                                ": ", problem.text);
    if (reading.study && faults.empty() && set_faults.empty())
        faults = check_study(settings, *reading.study);
    if (!faults.empty() || !set_faults.empty()) check_files(reading, faults);
    refuse_faults(name, faults, set_faults);

    ReadCase read{std::move(settings), std::move(reading.study), {}};
    warn(name, reading, read);
    return read;
}

ReadCase read_case(std::istream& in, const std::string& name, const Options& options) {
    return read_case_text(limited_text(in, name), name, options);
}

ReadCase read_case(const Options& options) {
    if (options.case_path.empty()) return read_case(std::cin, "<stdin>", options);
    std::ifstream in(options.case_path, std::ios::binary);
    std::error_code ignored;  // a folder can be opened, but not read
    if (!in || std::filesystem::is_directory(options.case_path, ignored))
        bad_input(options.case_path, ": ", why_not_opened(options.case_path));
    return read_case(in, options.case_path, options);
}

std::string effective_namelist(const ReadCase& read) {
    return effective_namelist(read.settings) + (read.study ? effective_namelist(*read.study) : "");
}

}  // namespace rsc
