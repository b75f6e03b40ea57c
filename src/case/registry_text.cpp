// The registry as text: the effective namelist, --describe and the manual page.

#include "base/error.hpp"
#include "base/version.h"
#include "case/options.hpp"
#include "case/registry.hpp"
#include "contact/quantities.hpp"

namespace rsc {
namespace {

// In the order of Type.
constexpr const char* kTypeNames[] = {"logical", "integer", "integer (64 bits)",
                                      "real",    "text",    "choice"};

void describe_key(std::ostream& out, const Key& key) {
    static const Case defaults;
    out << "  " << key.name;
    if (key.list)
        out << "(1 to " << key.size << " values" << (key.word ? ", or a word" : "") << ")";
    else if (key.size > 1)
        out << "(" << key.size << ")";
    const std::string value = get_key(defaults, full_name(key));
    out << " = " << (value.empty() ? "(unset: " + std::string(key.unset) + ")" : value)
        << "\n      " << kTypeNames[at(key.type)];
    if (key.type == Type::string) out << " of at most " << key.length << " characters";
    if (*key.unit) out << ", unit " << key.unit;
    const std::string bounds = key.bounds.text();
    if (!bounds.empty()) out << ", " << bounds;
    for (const auto i : indices(key.choices)) {
        out << (i == 0 ? ": " : ", ") << "'" << key.choices[i] << "'";
    }
    out << "\n      " << key.meaning << "\n";
}

void describe_group(std::ostream& out, std::string_view group) {
    out << "&" << group << ": " << group_meaning(group) << "\n";
    for (const Key& key : registry())
        if (group == key.group) describe_key(out, key);
    if (group == "study") {
        out << "  group%key = value, value, ...   for any key of any group; elements of arrays "
               "with a subscript: "
               "solids%R(2)\n"
               "  mode = 'product'\n      choice: 'product' (every combination, the first key "
               "slowest), 'zip' (the lists side by "
               "side)\n";
    }
}

// Whether a word occurs in one of two texts, without regard to case.
bool mentions(std::string_view word, const char* name, const char* meaning) {
    const std::string text = std::string(name) + "\n" + meaning;
    return namelist::lower_case(text).find(word) != std::string::npos;
}

// The keys and the quantities of a level whose name or meaning has a word; "" if there are none.
std::string search(const std::string& word) {
    std::ostringstream out;
    const char* group = "";
    for (const Key& key : registry()) {
        if (!mentions(word, key.name, key.meaning)) continue;
        if (std::string_view(group) != key.group) out << "&" << key.group << "\n";
        group = key.group;
        describe_key(out, key);
    }
    bool first = true;
    for (const LevelQuantity& quantity : level_quantities()) {
        if (!mentions(word, quantity.name, quantity.meaning)) continue;
        out << (first ? "variables of results\n" : "");
        first = false;
        out << "  " << quantity.name << "\n      " << quantity.meaning << "\n";
    }
    return out.str();
}

}  // namespace

Case without_idle_keys(const Case& settings) {
    static const Case defaults;
    Case result = settings;
    for (const Key& key : registry())
        if (key.changes == Changes::nothing)
            set_key(result, full_name(key), get_key(defaults, full_name(key)));
    return result;
}

std::string effective_namelist(const Case& settings) {
    std::string text;
    for (const std::string_view group : group_names()) {
        if (group == "study") continue;
        text += "&" + std::string(group) + "\n";
        for (const Key& key : registry()) {
            if (group != key.group) continue;
            const std::string value = get_key(settings, full_name(key));
            text += format("  %-17s = ", key.name) +
                    (value.empty() ? ",  ! unset: " + std::string(key.unset) : value) + "\n";
        }
        text += "/\n";
    }
    return text;
}

std::string describe(std::string_view name) {
    std::ostringstream out;
    if (name.starts_with('&')) name.remove_prefix(1);
    if (name.empty()) {
        for (const std::string_view group : group_names()) {
            if (group != group_names().front()) out << "\n";
            describe_group(out, group);
        }
        return out.str();
    }
    if (const std::string group = namelist::lower_case(name); group_meaning(group)) {
        describe_group(out, group);
    } else if (const std::string found = search(group);
               name.find('%') == name.npos && !found.empty()) {
        return found;
    } else if (name.find('%') == name.npos) {
        bad_input("no group, key or result has '", name, "' in its name or meaning",
                  namelist::suggestion(name, group_names()));
    } else {
        const Key& key = key_of(name);
        out << "&" << key.group << "\n";
        describe_key(out, key);
    }
    return out.str();
}

std::string manual_page() {
    std::string page = ".TH RSC 1 \"\" \"rsc " RSC_VERSION
                       "\"\n.SH NAME\nrsc \\- elastic contact of rough spheres by a deterministic "
                       "multi\\-asperity model\n";
    for (const auto& [section, text] :
         {std::pair{"SYNOPSIS", usage_text()}, {"CASES", describe("")}}) {
        page += std::string(".SH ") + section + "\n.nf\n";
        for (const char c : text) {
            if (page.back() == '\n' && (c == '.' || c == '\''))
                page += "\\&";  // not a command of roff
            page += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
        }
        page += ".fi\n";
    }
    return page + ".SH SEE ALSO\n.BR ncdump (1)\n";
}

}  // namespace rsc
