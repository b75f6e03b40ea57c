// Reads and checks a case.
#pragma once

#include "case/case.hpp"
#include "case/options.hpp"
#include "case/registry.hpp"
#include "case/study.hpp"

namespace rsc {

struct ReadCase {
    Case settings;
    // With each value checked; expand_study(settings, *study) returns its members, checked.
    std::optional<Study> study;
    std::vector<std::string> warnings;  // "case.nml:3:9: ...", one line each
};

// Reads a case from the file options.case_path or from standard input, applies --set and --output,
// and checks it. Throws one Error(bad_input) whose text has a line for each error: "case.nml:12:5:
// &surface: unknown key 'simga'; did you mean 'sigma'?". With a &study, `settings` is the base of
// the members: errors in a key that the study varies are reported by the checks of the members, not
// here.
ReadCase read_case(const Options& options);
// Reads a case from any stream; `name` stands for the file name in messages.
ReadCase read_case(std::istream& in, const std::string& name, const Options& options = {});
ReadCase read_case_text(std::string_view text, const std::string& name,
                        const Options& options = {});

// The effective namelist of a case and its study: what --check prints.
std::string effective_namelist(const ReadCase& read);

// The contents of the text, before bounds and relations of the keys are checked. Never throws on
// invalid text.
struct Reading {
    Case settings;
    std::optional<Study> study;
    Ledger ledger;
    std::vector<std::string_view> groups;  // known groups found, in order
    std::vector<namelist::Fault> faults;   // errors that gfortran also reports, and unknown groups
    std::vector<namelist::Fault> duplicates;  // unknown groups; unknown keys are among the faults
    std::vector<namelist::Fault> warnings;
};
Reading read_namelist(std::string_view text);

}  // namespace rsc
