// Parser of Fortran namelist text, independent of the keys: groups of assignments, each with its
// subscript and its list of values.
// Separators, repeat counts, null values and comments are interpreted as by gfortran's runtime.
//
// Existing parsers are parts of Fortran runtimes: they need the keys declared beforehand, and stop
// at the first error without its position.
#pragma once

#include "base/format.hpp"

namespace rsc::namelist {

// A place in the text, counted from 1; line 0 means no place.
struct Position {
    int line = 0, column = 0;
};

// An error or a warning at a place of the text.
struct Fault {
    Fault(Position at_, const auto&... parts) : at(at_), text(joined(parts...)) {}
    Position at;
    std::string text;
};

// One value of a list, or a null value (which keeps the default), repeated `repeat` times.
struct Item {
    std::string
        text;  // as written; if `quoted`, without the quotes and with doubled ones replaced by one
    bool null = false;
    bool quoted = false;
    bool counted = false;    // a repeat count was written
    bool commented = false;  // a comment follows without a blank between
    long repeat = 1;         // >= 1
    Position at;
};

// (first) or (first:last); omitted parts are empty.
struct Subscript {
    std::optional<long> first, last;
    bool section = false;  // a colon was written
    Position at;
};

struct Assignment {
    std::string key;  // lower case
    std::optional<Subscript> subscript;
    std::vector<Item> items;
    Position at;
};

struct Group {
    std::string name;  // lower case
    std::vector<Assignment> assignments;
    Position at;
};

struct Document {
    std::vector<Group> groups;
    std::vector<Fault> faults;    // errors that gfortran also reports, and unknown groups
    std::vector<Fault> warnings;  // text that gfortran reads differently from the Fortran standard
};

inline constexpr std::size_t kLargestText = std::size_t{4} << 20;  // bytes
inline constexpr long kLargestRepeat = 200'000'000;                // gfortran's
inline constexpr std::size_t kMostItems = 100'000;                 // in one assignment
inline constexpr std::size_t kMostFaults = 100;                    // reported at once

// Parses a whole text: groups of the given (lower case) names; text outside of groups is ignored.
// Never throws on invalid text: faults are collected.
Document parse(std::string_view text, const std::vector<std::string_view>& known_groups);

// Parses the assignments of one group, without its &name and its end: `sigma = 0.01`.
Document parse_assignments(std::string_view text);

// The candidate closest in spelling to `word`; empty if none is close.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates);
// "; did you mean 'sigma'?" for the nearest candidate, with `mark` ('&', '--') before it; empty if
// none is close.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& candidates,
                       const char* mark = "");

std::string lower_case(std::string_view word);

// "name:line:column: text", or "name: text" for a fault without a place.
std::string format(const std::string& name, const Fault& fault);

// Conversion of values from and to text, independent of the locale and exact for doubles.

// Empty if gfortran would reject the text for a variable of that type.
std::optional<std::int64_t> to_integer(std::string_view word);  // empty also beyond 64 bits
std::optional<double> to_real(
    std::string_view word);  // 1.5, .5, 5., 1e3, 1d3, 1q3, 1.5+3, Inf, Infinity, NaN, NaN(...)
std::optional<bool> to_logical(std::string_view word);  // any text that begins with t, f, .t or .f

// Shortest spelling that reads back to the same bits and is a Fortran real: 0.01, 3.0, 1e-06,
// Infinity.
std::string from_real(double value);
std::string from_logical(bool value);
std::string from_string(std::string_view value);  // in single quotes, with quotes inside doubled

}  // namespace rsc::namelist
