// The key registry: one row for each key of the namelist, used by the reader, --describe, --check,
// the `case` attribute of result files, and the functions that set and get keys by name.
#pragma once

#include "case/key.hpp"
#include "case/namelist.hpp"

namespace rsc {

// Nominal pressure over E* sqrt(2 m2) above which two flats are near full contact: less than 5 % of
// the area is gap, by Persson's erf(sqrt(2) p/(E* h')).
inline constexpr double kClosingPressure = 1;

// All keys, group by group in the documented order.
std::span<const Key> registry();
// The groups, in order, &study last.
const std::vector<std::string_view>& group_names();
const char* group_meaning(std::string_view group);
// Null if there is none. Case is ignored.
const Key* find_key(std::string_view group, std::string_view name);
// "; did you mean 'sigma'?", "; it belongs to &surface" or nothing.
std::string suggest_key(std::string_view group, std::string_view name);
// The key "group%key", blanks around the names ignored. Throws Error(bad_input) with the nearest
// names.
const Key& key_of(std::string_view name);
std::string full_name(const Key& key);  // "group%key"

// --- values by name

// The elements of keys that have been given, with their positions, to detect duplicates and to
// locate messages.
class Ledger {
public:
    // The elements given, for each key; for a list also the values, until finish().
    struct Entry {
        const Key* key;
        std::vector<std::pair<long, namelist::Position>>
            given;  // 1-based element (character of a string), where
        std::vector<std::optional<double>> values;  // lists only
        bool whole = false;                         // a list was given without a subscript
        std::optional<int> word;  // the number of the word given instead of a list
        namelist::Position at;    // of the key
        bool faulty = false;
    };
    Entry& entry(const Key& key);
    const Entry* find(const Key& key) const;
    std::vector<Entry>& entries() { return entries_; }

private:
    std::vector<Entry> entries_;
};

// Stores the values of one assignment and reports errors in them. Lists are stored by finish_lists.
void assign(Case& settings, const Key& key, const namelist::Assignment& assignment, Ledger& ledger,
            std::vector<namelist::Fault>& faults);
void finish_lists(Case& settings, Ledger& ledger, std::vector<namelist::Fault>& faults);

// Sets "group%key", "group%key(2)" or "group%key(1:2)" to a value (or values) in namelist syntax,
// or without a value "group%key" to its default.
// Checks type, choice, shape and the key's own bounds, not its relation to other keys (check_case
// does). Throws Error(bad_input); the case is then unchanged.
// A blank value gives the key its default.
// `whole`: a name without subscript needs all values of an array of fixed size.
void set_key(Case& settings, std::string_view name, std::string_view value, bool whole = false);

// The value in namelist syntax, as set_key accepts it; an element with "group%key(2)". Empty for an
// unset value. Throws Error(bad_input) for an unknown name.
std::string get_key(const Case& settings, std::string_view name);

// --- a whole case

// An error in a case or a single value, and the keys ("surface%n") it concerns, the most important
// first.
struct Problem {
    std::vector<const Key*> keys;
    long element;      // 1-based for arrays, 0 otherwise
    std::string text;  // begins with the key: "n must be even"
};
std::vector<Problem> check_case(const Case& settings);
// Throws Error(bad_input) with a line for each problem; if names are given, for those whose first
// key is one of these ("group%key"), or in one of these groups.
void require_valid(const Case& settings, std::initializer_list<std::string_view> names = {});

// The case with all keys that do not affect a result at their defaults.
Case without_idle_keys(const Case& settings);

// Every key with its value, as namelist input that restores the same bits.
std::string effective_namelist(const Case& settings);

// Describes all keys (empty name), a group, a group%key, or the keys and quantities of a level
// whose name or meaning has this word. Throws Error(bad_input) if there is none.
std::string describe(std::string_view name);

// The manual page rsc(1) in roff, composed of the texts of --help and --describe.
std::string manual_page();

}  // namespace rsc
