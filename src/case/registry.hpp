// The key registry: one row for each key of the namelist, used by the reader, --describe, --check, the `case` attribute of result files,
// and the functions that set and get keys by name.
#pragma once

#include "case/case.hpp"
#include "case/namelist.hpp"

namespace rsc {

// The nominal pressure, over E* sqrt(2 m2), from which on two flats touch nearly everywhere: less than 5 % of the area is gap, by Persson's
// erf(sqrt(2) p/(E* h')).
inline constexpr double kClosingPressure = 1;

// The effect of a key on a result: on its numbers, only on how the file stores them, or none.
enum class Changes { numbers, file, nothing };

enum class Type { logical, integer, long_integer, real, string, choice };

// Bounds of a real or integer. NaN is always refused, Infinity unless `infinity` is set.
struct Bounds {
    double low = -Case::kInfinity, high = Case::kInfinity;
    bool open = false;      // low itself is excluded
    bool infinity = false;  // Infinity is allowed
    bool hold(double value) const;
    std::string text() const;  // "> 0", "0 to 1", ... ; empty when anything goes
};

// An enumeration seen as the number of its choice in the key's list.
struct ChoiceSlot {
    void* object;
    int (*get)(const void*);
    void (*set)(void*, int);
};

// The place of a key in a Case: the value, the first of `size` values, or a list.
using Slot = std::variant<bool*, int*, std::int64_t*, double*, std::optional<double>*, std::string*, std::vector<double>*, ChoiceSlot>;

struct Key {
    const char* group;
    const char* name;  // as documented; compared without case
    Type type;
    int size;          // number of elements, the most of them for a list; 1 for a scalar
    bool list;         // a list has as many elements as are given
    int length;        // of a string: the most characters
    const char* unit;  // "1" for a pure number, "" for text
    Bounds bounds;
    std::vector<const char*> choices;
    const char* unset;  // for a key that may stay unset: what then holds; otherwise ""
    const char* meaning;
    Slot (*slot)(Case&);
    Changes changes = Changes::numbers;
    Slot (*word)(Case&) = nullptr;  // a list that may be one of `choices` instead, which holds while it is empty
};

// All keys, group by group in the documented order.
std::span<const Key> registry();
// The groups, in order, &study last.
const std::vector<std::string_view>& group_names();
const char* group_meaning(std::string_view group);
// Null when there is none. Any case.
const Key* find_key(std::string_view group, std::string_view name);
// "; did you mean 'sigma'?", "; it belongs to &surface" or nothing.
std::string suggest_key(std::string_view group, std::string_view name);
// "surface%sigma", several with "or", for the name of a key without its group; empty when there is none. Any case.
std::string keys_named(std::string_view name);

// --- values by name -----------------------------------------------------------------------------------------------------------

// The elements of keys that have been given, with their places: finds duplicates, and gives messages their position.
class Ledger {
public:
    // The elements given are remembered per key; for a list the values, too, until finish().
    struct Entry {
        const Key* key;
        std::vector<std::pair<long, namelist::Position>> given;  // 1-based element (character of a string), where
        std::vector<std::optional<double>> values;               // lists only
        bool whole = false;                                      // a list was given without a subscript
        std::optional<int> word;                                 // the number of the word given instead of a list
        namelist::Position at;                                   // of the key
        bool faulty = false;
    };
    Entry& entry(const Key& key);
    const Entry* find(const Key& key) const;
    std::vector<Entry>& entries() { return entries_; }

private:
    std::vector<Entry> entries_;
};

// Stores the values of one assignment and reports what is wrong with them. Lists are stored by finish_lists.
void assign(Case& settings, const Key& key, const namelist::Assignment& assignment, Ledger& ledger, std::vector<namelist::Fault>& faults);
void finish_lists(Case& settings, Ledger& ledger, std::vector<namelist::Fault>& faults);

// Sets "group%key", "group%key(2)" or "group%key(1:2)" to a value (or values) in namelist syntax. Checks type, choice, shape and
// the key's own bounds, not its relation to other keys (check_case does). Throws Error(bad_input); the case is then unchanged.
// `whole`: a name without subscript needs all values of an array of fixed size.
void set_key(Case& settings, std::string_view name, std::string_view value, bool whole = false);

// The value in namelist syntax, as set_key takes it; an element with "group%key(2)". Empty for an unset value. Throws
// Error(bad_input) for an unknown name.
std::string get_key(const Case& settings, std::string_view name);

// --- a whole case -------------------------------------------------------------------------------------------------------------

// Something wrong with a case or a single value, and the keys ("surface%n") it concerns, the most important first.
struct Problem {
    std::vector<const Key*> keys;
    long element;      // 1-based for arrays, 0 otherwise
    std::string text;  // begins with the key: "n must be even"
};
std::vector<Problem> check_case(const Case& settings);
// Throws Error(bad_input) with a line for each problem.
void require_valid(const Case& settings);

// The case with the default of every key that changes nothing in a result.
Case without_idle_keys(const Case& settings);

// Every key with its value, as namelist input that reads back to the same bits.
std::string effective_namelist(const Case& settings);

// Text about everything (empty name), a group or a group%key. Throws Error(bad_input) for an unknown one.
std::string describe(std::string_view name);

// The manual page rsc(1) in roff, made of what --help and --describe print.
std::string manual_page();

}  // namespace rsc
