// Stores the assignments of a namelist in a Case, and returns values by name.

#include "base/error.hpp"
#include "case/registry.hpp"

namespace rsc {

using namespace namelist;

namespace {

// Elements of an assignment, counted from 1: `count` from `first` on.
struct Walk {
    long first = 1, count = 1;
};

std::string list_choices(const Key& key) {
    std::string text;
    for (const char* choice : key.choices) enlist(text, ", ", "'", choice, "'");
    return text;
}

std::string quote(const Item& item) {
    const std::string shown = item.text.size() > 60 ? item.text.substr(0, 60) + "..." : item.text;
    return item.quoted ? from_string(shown) : "'" + shown + "'";
}

// For a number that is wrong, or surplus: the most frequent causes.
std::string hint(const Item& item) {
    return item.quoted ? "; numbers are written without quotes"
                       : "; numbers are written with a decimal point and without their unit, "
                         "comments begin with '!'";
}

// Trailing blanks are not significant in Fortran.
std::string trimmed(std::string text) {
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

// The elements of a subscript, or an error message. (i) alone extends to the end of the array, as
// in gfortran.
std::string resolve(const Assignment& a, long size, Walk& walk, const std::string& what) {
    const Subscript& s = *a.subscript;
    const long first = s.first.value_or(1);
    const long last = s.section ? s.last.value_or(size) : size;
    const auto outside = [&](long i) { return i < 1 || i > size; };
    if (outside(first) || outside(last))
        return "the subscript of " + what + " must be within 1 to " + std::to_string(size);
    if (last < first) return "the subscript of " + what + " runs the wrong way";
    walk = {first, last - first + 1};
    return {};
}

template <class Number>
void put(Slot& slot, long element, Number value) {
    std::visit(
        [&](auto& place) {
            using T = std::remove_reference_t<decltype(place)>;
            if constexpr (std::is_same_v<T, int*> || std::is_same_v<T, std::int64_t*> ||
                          std::is_same_v<T, double*>)
                place[element - 1] = static_cast<std::remove_pointer_t<T>>(value);
            else if constexpr (std::is_same_v<T, std::optional<double>*>)
                place[element - 1] = double(value);
        },
        slot);
}

// Converts and stores one value; returns an error message.
std::string store(Slot slot, const Key& key, long element, const Item& item, Ledger::Entry& entry) {
    const auto to_list = [&](double value) {
        const auto i = at(element);
        if (entry.values.size() < i) entry.values.resize(i);
        entry.values[i - 1] = value;
    };
    const bool word = key.type == Type::choice || (key.word && item.quoted);
    if (key.type == Type::logical) {
        const auto value = item.quoted ? std::nullopt : to_logical(item.text);
        if (!value) return "expected .true. or .false., found " + quote(item);
        *std::get<bool*>(slot) = *value;
    } else if (key.type == Type::integer || key.type == Type::long_integer) {
        const auto value = item.quoted ? std::nullopt : to_integer(item.text);
        const bool small = key.type == Type::integer;
        if (!value || (small && *value != int(*value))) {
            const bool digits = !item.quoted &&
                                item.text.find_first_not_of("+-0123456789") == std::string::npos &&
                                item.text.size() > 5;
            return digits ? quote(item) + " is not an integer of " + (small ? "32" : "64") + " bits"
                          : "expected an integer, found " + quote(item) +
                                (item.quoted ? hint(item) : "");
        }
        put(slot, element, *value);
    } else if (key.type == Type::real && !word) {
        if (entry.word) return "one word, or a list of numbers";
        const auto value = item.quoted ? std::nullopt : to_real(item.text);
        if (!value) return "expected a real number, found " + quote(item) + hint(item);
        key.list ? to_list(*value) : put(slot, element, *value);
    } else {
        // gfortran takes a text without quotes when a digit or a repeat count comes first.
        if (!item.quoted &&
            (item.commented || !(item.counted || (item.text[0] >= '0' && item.text[0] <= '9'))))
            return "text must be in quotes, found " + quote(item);
        const std::string text = trimmed(item.text);
        if (!word && long(text.size()) > key.length)
            return "a text of more than " + std::to_string(key.length) + " characters";
        if (!word) {
            *std::get<std::string*>(slot) = text;
            return {};
        }
        const std::string lower = lower_case(text);
        const auto found = std::ranges::find(key.choices, lower);
        if (found == key.choices.end())
            return quote(item) + " is none of " + list_choices(key) +
                   suggestion(lower, {key.choices.begin(), key.choices.end()});
        const auto number = int(found - key.choices.begin());
        if (key.word && (element != 1 || !entry.values.empty() || entry.word))
            return "one word, or a list of numbers";
        if (key.word)
            entry.word = number;
        else if (key.list)
            to_list(number);
        else
            std::get<ChoiceSlot>(slot).set(std::get<ChoiceSlot>(slot).object, number);
    }
    return {};
}

std::string at_line(const Position& at) {
    return at.line > 0 ? " at line " + std::to_string(at.line) : "";
}

std::string too_many(const Item& item, long elements, bool is_text) {
    const std::string room = elements == 1 ? "one value" : std::to_string(elements) + " values";
    if (item.counted) return "the repeat count is too large: " + room + " at most";
    return "too many values: " + room + " at most, found " + quote(item) +
           (is_text ? "" : hint(item));
}

}  // namespace

Ledger::Entry& Ledger::entry(const Key& key) {
    if (const Entry* found = find(key)) return entries_[at(found - entries_.data())];
    entries_.emplace_back().key = &key;
    return entries_.back();
}

const Ledger::Entry* Ledger::find(const Key& key) const {
    for (const Entry& e : entries_)
        if (e.key == &key) return &e;
    return nullptr;
}

void assign(Case& settings, const Key& key, const Assignment& a, Ledger& ledger,
            std::vector<Fault>& faults) {
    Ledger::Entry& entry = ledger.entry(key);
    if (entry.at.line == 0) entry.at = a.at;
    const std::string context = joined("&", key.group, ": ", key.name, ": ");
    const auto fault = [&](const Position& at, const auto&... text) {
        faults.emplace_back(at, context, text...);
        entry.faulty = true;
    };
    const bool is_text = key.type == Type::string || key.type == Type::choice;
    Walk walk{1, key.size};
    if (a.subscript) {
        const std::string problem = key.size == 1 ? "this key is no array: it takes no subscript"
                                                  : resolve(a, key.size, walk, "this key");
        if (!problem.empty()) return fault(a.subscript->at, problem);
    } else {
        entry.whole = true;
    }

    // Elements are marked as given if a value, not a null, is stored in them.
    const long before = long(entry.given.size());
    const auto mark = [&](long given, const Position& place) {
        if (entry.faulty) return;  // one message for a key given several times is enough
        for (const auto& [element, where] : std::span(entry.given).first(at(before)))
            if (element == given) {
                fault(place, "given twice, first", at_line(where));
                break;
            }
        entry.given.push_back({given, place});
    };
    const Slot slot = key.slot(settings);
    long done = 0;
    for (const Item& item : a.items) {
        const long left = walk.count - done;
        if (item.null && !item.counted) {
            done += std::min(left, item.repeat);
            continue;
        }
        if (left == 0 || item.repeat > left)
            return fault(item.at, too_many(item, walk.count, is_text));
        for (long k = 0; !item.null && k < item.repeat; ++k) {
            const long element = walk.first + done + k;
            const std::string problem = store(slot, key, element, item, entry);
            if (!problem.empty()) {
                fault(item.at, problem);
                break;
            }
            mark(element, item.at);
        }
        done += item.repeat;
    }
}

void finish_lists(Case& settings, Ledger& ledger, std::vector<Fault>& faults) {
    for (Ledger::Entry& entry : ledger.entries()) {
        if (!entry.key->list || (entry.values.empty() && !entry.word) || entry.faulty) continue;
        std::vector<double>& list = *std::get<std::vector<double>*>(entry.key->slot(settings));
        if (entry.word) {
            const ChoiceSlot word = std::get<ChoiceSlot>(entry.key->word(settings));
            word.set(word.object, *entry.word);
            list.clear();
            continue;
        }
        const std::vector<double> old = list;
        std::vector<double> next;
        const std::size_t size =
            entry.whole ? entry.values.size() : std::max(entry.values.size(), old.size());
        for (const auto i : indices(size)) {
            const bool given = i < entry.values.size() && entry.values[i];
            if (!given && i >= old.size()) {
                faults.emplace_back(entry.at, "&", entry.key->group, ": ", entry.key->name,
                                    ": element ", i + 1, " has no value");
                entry.faulty = true;
                break;
            }
            next.push_back(given ? *entry.values[i] : old[i]);
        }
        if (!entry.faulty) list = std::move(next);
    }
}

namespace {

// Splits "group%key(2)" into the key and the assignment `key(2) = value`.
struct Named {
    const Key* key;
    Assignment assignment;
};

Named named(std::string_view name, std::string_view value) {
    const Key& key = key_of(name.substr(0, name.find('(')));
    const std::string_view rest = name.substr(name.find_first_not_of(' ', name.find('%') + 1));
    const Document document = parse_assignments(joined(rest, " = ", value));
    if (!document.faults.empty()) bad_input(document.faults.front().text);
    const std::vector<Assignment>& assignments = document.groups.front().assignments;
    if (assignments.size() != 1) bad_input("expected one value for one key");
    return {&key, assignments.front()};
}

std::string element_text(const Key& key, const Slot& slot, long element) {
    const auto i = at(element - 1);
    if (auto* b = std::get_if<bool*>(&slot)) return from_logical(**b);
    if (auto* n = std::get_if<int*>(&slot)) return std::to_string((*n)[i]);
    if (auto* n = std::get_if<std::int64_t*>(&slot)) return std::to_string((*n)[i]);
    if (auto* x = std::get_if<double*>(&slot)) return from_real((*x)[i]);
    if (auto* o = std::get_if<std::optional<double>*>(&slot))
        return (*o)[i] ? from_real(*(*o)[i]) : "";
    if (auto* s = std::get_if<std::string*>(&slot)) return from_string(**s);
    if (auto* v = std::get_if<std::vector<double>*>(&slot)) {
        if (i >= (*v)->size()) return "";
        return key.type == Type::choice ? from_string(key.choices.at(at((**v)[i])))
                                        : from_real((**v)[i]);
    }
    const ChoiceSlot& choice = std::get<ChoiceSlot>(slot);
    return from_string(key.choices.at(at(choice.get(choice.object))));
}

// The part of check_case for one key.
std::string out_of_bounds(Case& settings, const Key& key) {
    for (const Problem& problem : check_case(settings))
        if (problem.keys.size() == 1 && problem.keys.front() == &key) return problem.text;
    return {};
}

void set_default(Case& settings, const Key& key) {
    Case fresh;
    const auto copy = [&key](const Slot& from, const Slot& to) {
        std::visit(
            [&](auto place) {
                const auto origin = std::get<decltype(place)>(from);
                if constexpr (std::is_pointer_v<decltype(place)>)
                    std::copy_n(origin, key.list ? 1 : key.size, place);
                else
                    place.set(place.object, origin.get(origin.object));
            },
            to);
    };
    copy(key.slot(fresh), key.slot(settings));
    if (key.word) copy(key.word(fresh), key.word(settings));
}

}  // namespace

void set_key(Case& settings, std::string_view name, std::string_view value, bool whole) {
    const auto [key, assignment] = named(name, value);
    if (value.find_first_not_of(" \t\r\n") == std::string_view::npos) {
        if (assignment.subscript)
            bad_input("an element has no default of its own: give it a value, or leave ",
                      full_name(*key), " as a whole without one");
        return set_default(settings, *key);
    }
    if (whole && key->size > 1 && !key->list && !assignment.subscript) {
        long given = 0;
        for (const auto& item : assignment.items) given += item.repeat;
        if (given > 0 && given < key->size)
            bad_input(key->name, " has ", key->size, " values: give all of them, or one as ",
                      full_name(*key), "(1)");
    }
    Case changed = settings;
    Ledger ledger;
    std::vector<Fault> faults;
    assign(changed, *key, assignment, ledger, faults);
    finish_lists(changed, ledger, faults);
    if (!faults.empty()) {
        // The name includes the group.
        const std::string context = joined("&", key->group, ": ");
        const std::string& text = faults.front().text;
        bad_input(text.starts_with(context) ? text.substr(context.size()) : text);
    }
    if (const std::string problem = out_of_bounds(changed, *key); !problem.empty())
        bad_input(problem);
    settings = std::move(changed);
}

std::string get_key(const Case& settings, std::string_view name) {
    const auto [key, assignment] = named(name, "");
    // Slots point to non-const values; here they are only read.
    const Slot slot = key->slot(const_cast<Case&>(settings));
    long size = key->size;
    if (const auto* list = std::get_if<std::vector<double>*>(&slot)) size = long((*list)->size());
    if (key->word && size == 0) {
        const ChoiceSlot word = std::get<ChoiceSlot>(key->word(const_cast<Case&>(settings)));
        return from_string(key->choices.at(at(word.get(word.object))));
    }
    Walk walk{1, size};
    if (assignment.subscript) {
        if (key->size == 1) bad_input(key->name, " is no array: it takes no subscript");
        if (std::string problem = resolve(assignment, size, walk, key->name); !problem.empty())
            bad_input(problem);
        if (!assignment.subscript->section) walk.count = 1;
    }
    std::string text;
    bool any = false;
    for (long k = 0; k < walk.count; ++k) {
        const std::string element = element_text(*key, slot, walk.first + k);
        text += (k > 0 ? ", " : "") + element;
        any = any || !element.empty();
    }
    return any ? text : "";
}

}  // namespace rsc
