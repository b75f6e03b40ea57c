#include "case/study.hpp"

#include "base/error.hpp"
#include "case/registry.hpp"

namespace rsc {

using namespace namelist;

namespace {

// "solids%r" with subscript (2) -> "solids%R(2)"; empty and a fault if there is no such key.
std::string axis_key(const Assignment& a, std::vector<Fault>& faults) {
    const auto fault = [&](const auto&... text) {
        faults.emplace_back(a.at, "&study: ", text...);
        return std::string();
    };
    if (a.key.find('%') == std::string::npos)
        return fault("unknown key '", a.key, "'; expected group%key = values, or mode");
    const Key* key = nullptr;
    try {
        key = &key_of(a.key);
    } catch (const Error& error) {
        return fault(error.what());
    }
    const std::string full = full_name(*key);
    const bool array = key->size > 1;
    if (!a.subscript)
        return array
                   ? fault(full, " is an array: vary one element of it, as in ", full, "(1) = ...")
                   : full;
    if (!array) return fault(full, " is no array: it takes no subscript");
    if (a.subscript->section || !a.subscript->first)
        return fault(full, ": vary one element of it, as in ", full, "(1) = ...");
    return full + "(" + std::to_string(*a.subscript->first) + ")";
}

std::size_t member_count(const Study& study) {
    if (study.mode == StudyMode::zip) return study.axes.front().values.size();
    std::size_t count = 1;
    for (const Study::Axis& axis : study.axes)
        count = std::min(count * axis.values.size(), kMostMembers + 1);
    return count;
}

}  // namespace

std::string values_text(const Member& member) {
    std::string text;
    for (const auto& [key, value] : member.values) enlist(text, " ", key, "=", value);
    return text;
}

Study read_study(const Group& group, std::vector<Fault>& faults) {
    Study study;
    study.at = group.at;
    bool mode_given = false;
    for (const Assignment& a : group.assignments) {
        if (faults.size() >= kMostFaults) break;
        const auto fault = [&](const Position& at, const auto&... text) {
            faults.emplace_back(at, "&study: ", text...);
        };
        if (a.key == "mode") {
            if (mode_given) fault(a.at, "mode: given twice");
            mode_given = true;
            const std::string word = !a.items.empty() && a.items[0].quoted && !a.subscript
                                         ? lower_case(a.items[0].text)
                                         : "";
            study.mode = word == "zip" ? StudyMode::zip : StudyMode::product;
            const bool more = std::any_of(a.items.begin() + !a.items.empty(), a.items.end(),
                                          [](const auto& item) { return !item.null; });
            if (more || (word != "zip" && word != "product"))
                fault(a.at, "mode: must be 'product' or 'zip'");
            continue;
        }
        Study::Axis axis;
        axis.at = a.at;
        axis.key = axis_key(a, faults);
        if (axis.key.empty()) continue;
        if (std::ranges::find(study.axes, axis.key, &Study::Axis::key) != study.axes.end()) {
            fault(a.at, axis.key, ": given twice");
            continue;
        }
        const std::size_t before = faults.size();
        for (const auto i : indices(a.items)) {
            const Item& item = a.items[i];
            if (item.null && !item.counted && i + 1 == a.items.size())
                break;  // a comma after the last value
            if (item.null) {
                fault(item.at, axis.key, ": a value is missing");
                break;
            }
            if (axis.values.size() + at(item.repeat) > kMostMembers) {
                fault(item.at, axis.key, ": more than ", kMostMembers, " values");
                break;
            }
            const std::string value = item.quoted ? from_string(item.text) : item.text;
            axis.values.insert(axis.values.end(), at(item.repeat), value);
            axis.places.insert(axis.places.end(), at(item.repeat), item.at);
        }
        if (axis.values.empty()) {
            if (faults.size() == before) fault(a.at, axis.key, ": no values");
        } else {
            study.axes.push_back(std::move(axis));
        }
    }
    if (study.axes.empty() && faults.empty())
        faults.emplace_back(group.at, "&study: no lists of values");
    return study;
}

std::vector<Fault> check_study(const Case& base, const Study& study) {
    std::vector<Fault> faults;
    if (study.axes.empty()) return {{study.at, "&study: no lists of values"}};
    // Every member stores a copy of the list of levels: without this limit a short text could use
    // all memory.
    const std::size_t held = member_count(study) * base.indentation.levels.size();
    if (held > kMostLevels)
        return {{study.at, "&study: ", member_count(study), " members of ",
                 base.indentation.levels.size(), " explicit levels each: more than ", kMostLevels,
                 " levels in all; give indentation%start, stop and steps instead"}};
    for (const Study::Axis& axis : study.axes)
        for (std::size_t i = 0; i < axis.values.size() && faults.size() < kMostFaults; ++i) {
            if (i > 0 && axis.values[i] == axis.values[i - 1])
                continue;  // a repeated value, 10000*0.1, is checked and reported once
            Case trial = base;
            try {
                set_key(trial, axis.key, axis.values[i]);
            } catch (const Error& error) {
                faults.emplace_back(i < axis.places.size() ? axis.places[i] : axis.at,
                                    "&study: ", axis.key, ": ", error.what());
            }
        }
    const std::size_t length = study.axes.front().values.size();
    if (study.mode == StudyMode::zip)
        for (const Study::Axis& axis : study.axes)
            if (axis.values.size() != length)
                faults.emplace_back(axis.at, "&study: ", axis.key, " has ", axis.values.size(),
                                    " values, ", study.axes.front().key, " has ", length,
                                    ": mode = 'zip' needs the same number of values for every key");
    if (member_count(study) > kMostMembers)
        faults.emplace_back(study.at, "&study: more than ", kMostMembers, " members");
    return faults;
}

std::vector<Member> expand_study(const Case& base, const Study& study) {
    std::string wrong;
    for (const Fault& fault : check_study(base, study)) enlist(wrong, "\n", fault.text);
    if (!wrong.empty()) bad_input(wrong);

    const std::size_t count = member_count(study);
    std::vector<Member> members(count);
    std::size_t wrong_members = 0;
    for (const auto m : indices(count)) {
        Member& member = members[m];
        member.index = int(m + 1);
        member.settings = base;
        std::size_t slower = count;
        for (const Study::Axis& axis : study.axes) {
            slower /= study.mode == StudyMode::product ? axis.values.size() : 1;
            const std::size_t i =
                study.mode == StudyMode::product ? m / slower % axis.values.size() : m;
            member.values.emplace_back(axis.key, axis.values[i]);
        }
        // The bounds of each key were checked before; only relations between keys remain.
        for (const auto& [key, value] : member.values) set_key(member.settings, key, value);
        member.settings.output.file = member_file(member.settings.output.file, member.index, count);
        for (const Problem& problem : check_case(member.settings))
            if (++wrong_members <= kMostFaults)
                enlist(wrong, "\n", "&study: member ", member.index, " (", values_text(member),
                       "): &", problem.keys.front()->group, ": ", problem.text);
    }
    if (!wrong.empty()) bad_input(wrong);
    return members;
}

std::string member_file(const std::string& file, int index, std::size_t members) {
    std::string number = std::to_string(index);
    const std::size_t width = std::max<std::size_t>(3, std::to_string(members).size());
    number.insert(0, width > number.size() ? width - number.size() : 0, '0');
    const std::size_t slash = file.rfind('/');
    const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
    const std::size_t dot = file.rfind('.');
    const std::size_t stem = dot == std::string::npos || dot <= name ? file.size() : dot;
    return file.substr(0, stem) + "_" + number + file.substr(stem);
}

std::string effective_namelist(const Study& study) {
    std::string text = "&study\n";
    for (const Study::Axis& axis : study.axes) {
        text += "  " + axis.key + " = ";
        for (const auto i : indices(axis.values)) text += (i > 0 ? ", " : "") + axis.values[i];
        text += "\n";
    }
    return text + "  mode = " + (study.mode == StudyMode::product ? "'product'" : "'zip'") +
           "\n/\n";
}

}  // namespace rsc
