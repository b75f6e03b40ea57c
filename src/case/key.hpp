// A key of the namelist: its name, its place in a Case, type, unit and meaning. The registry
// (registry.hpp) is made of such rows; rooms of physics/ write those of their physics.
#pragma once

#include "case/case.hpp"

namespace rsc {

// The effect of a key on a result: on its numbers, only on their storage in the file, or none.
enum class Changes { numbers, file, nothing };

enum class Type { logical, integer, long_integer, real, string, choice };

// Bounds of a real or integer. NaN is always refused, Infinity unless `infinity` is set.
struct Bounds {
    double low = -kInfinity, high = kInfinity;
    bool open = false;      // low itself is excluded
    bool infinity = false;  // Infinity is allowed
    bool nonzero = false;   // 0 is excluded
    bool hold(double value) const;
    std::string text() const;  // "> 0", "0 to 1", ... ; empty without bounds
};

// An enumeration, as the number of its choice in the key's list.
struct ChoiceSlot {
    void* object;
    int (*get)(const void*);
    void (*set)(void*, int);
};

// The place of a key in a Case: the value, the first of `size` values, or a list.
using Slot = std::variant<bool*, int*, std::int64_t*, double*, std::optional<double>*, std::string*,
                          std::vector<double>*, ChoiceSlot>;

struct Key {
    const char* group;
    const char* name;  // as documented; compared without case
    Type type;
    int size;          // number of elements, the maximum for a list; 1 for a scalar
    bool list;         // a list has as many elements as are given
    int length;        // of a string: maximum number of characters
    const char* unit;  // "1" for a pure number, "" for text
    Bounds bounds;
    std::vector<const char*> choices;
    const char* unset;  // for a key that may stay unset: its meaning then; otherwise ""
    const char* meaning;
    Slot (*slot)(Case&);
    Changes changes = Changes::numbers;
    // a list that may be one of `choices` instead, which applies while the list is empty
    Slot (*word)(Case&) = nullptr;
};

// How rows are written.
namespace keys {

inline constexpr double kNoLimit = kInfinity;
inline constexpr Bounds kAny{};
inline constexpr Bounds kPositive{0, kNoLimit, true, false};
inline constexpr Bounds kNotNegative{0, kNoLimit, false, false};
inline constexpr Bounds kPositiveOrInfinite{0, kNoLimit, true, true};
inline constexpr Bounds kRadius{-kNoLimit, kNoLimit, true, true, true};
constexpr Bounds between(double low, double high) { return {low, high, false, false}; }
constexpr Bounds above(double low, double high) { return {low, high, true, false}; }

template <class T>
Slot choice_slot(T& member) {
    return ChoiceSlot{&member, [](const void* p) { return int(*static_cast<const T*>(p)); },
                      [](void* p, int i) { *static_cast<T*>(p) = static_cast<T>(i); }};
}

// The place of a member of a Case; the first of an array.
template <class T>
Slot slot_of(T& member) {
    if constexpr (std::is_array_v<T>)
        return &member[0];
    else if constexpr (std::is_enum_v<T>)
        return choice_slot(member);
    else
        return &member;
}

// A key has the name of its member of Case, which also determines its type and the size of an
// array.
struct Place {
    const char *group, *name;
    std::size_t extent;
    Slot (*slot)(Case&);
};
#define RSC_KEY(group, name)                                                    \
    rsc::keys::place(#group, #name, std::extent_v<decltype(Case().group.name)>, \
                     [](Case& c) { return rsc::keys::slot_of(c.group.name); })
inline Place place(const char* group, const char* name, std::size_t extent, Slot (*slot)(Case&)) {
    return {group, name, extent, slot};
}

inline Key number(const Place& at, const char* unit, Bounds bounds, const char* meaning,
                  const char* unset = "") {
    static Case any;
    constexpr Type types[] = {Type::logical, Type::integer, Type::long_integer, Type::real,
                              Type::real,    Type::string,  Type::real,         Type::choice};
    const Type type = types[at.slot(any).index()];
    return {at.group, at.name, type,   std::max(int(at.extent), 1), false, 0, unit, bounds, {},
            unset,    meaning, at.slot};
}
inline Key list(const Place& at, int most, const char* unit, Bounds bounds, const char* unset,
                const char* meaning) {
    Key key = number(at, unit, bounds, meaning, unset);
    key.list = true;
    key.size = most;
    return key;
}
inline Key text(const Place& at, int length, const char* meaning) {
    Key key = number(at, "", kAny, meaning);
    key.length = length;
    return key;
}
// The order of the names is the order of the enumeration.
template <class Names>
Key choice(const Place& at, const Names& names, const char* meaning) {
    Key key = text(at, 32, meaning);
    key.type = Type::choice;
    key.choices.assign(names.begin(), names.end());
    return key;
}
// A list of choices, in any order.
inline Key words(Key key) {
    key.list = true;
    key.size = int(key.choices.size());
    key.unset = "none";
    return key;
}
// A list of numbers, or one of some words.
template <class Names>
Key or_word(const Names& names, Slot (*word)(Case&), Key key) {
    key.choices.assign(names.begin(), names.end());
    key.word = word;
    return key;
}

inline Key changing(Changes what, Key key) {
    key.changes = what;
    return key;
}

}  // namespace keys
}  // namespace rsc
