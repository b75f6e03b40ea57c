// rsc and gfortran's runtime read the same namelist inputs and must agree on every value, bit for bit, or both refuse.
// Usage: namelist_differential READER FOLDER, where READER is the program of namelist_reader.f90
//        namelist_differential --write FILE: the groups of that program
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "case/read_case.hpp"
#include "check.hpp"
#include "namelist_cases.hpp"

using namespace rsc;

namespace {

using Values = std::map<std::string, std::string>;

struct Answer {
    std::map<std::string, int> status;
    Values values;
};

std::string bits(double x) {
    if (std::isnan(x)) return "nan";
    char text[32];
    std::snprintf(text, sizeof text, "%016llX", static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(x)));
    return text;
}

std::string hex(const std::string& text) {
    std::string result;
    for (const char c : text) {
        char byte[4];
        std::snprintf(byte, sizeof byte, "%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
        result += byte;
    }
    return result + ".";
}

// A case in the words of namelist_reader.f90.
Values values_of(const Case& settings) {
    Values values;
    for (const Key& key : registry()) {
        const std::string name = std::string(key.group) + "%" + key.name;
        const Slot slot = key.slot(const_cast<Case&>(settings));
        const auto element = [&](long i) { return key.size > 1 ? name + "(" + std::to_string(i + 1) + ")" : name; };
        for (long i = 0; i < (key.list ? 0 : key.size); ++i) {
            std::string& value = values[element(i)];
            if (auto* b = std::get_if<bool*>(&slot))
                value = **b ? "T" : "F";
            else if (auto* n = std::get_if<int*>(&slot))
                value = std::to_string((*n)[i]);
            else if (auto* m = std::get_if<std::int64_t*>(&slot))
                value = std::to_string((*m)[i]);
            else if (auto* x = std::get_if<double*>(&slot))
                value = bits((*x)[i]);
            else if (auto* o = std::get_if<std::optional<double>*>(&slot))
                value = (*o)[i] ? bits(*(*o)[i]) : "unset";
            else if (auto* s = std::get_if<std::string*>(&slot))
                value = hex(**s);
            else if (auto* c = std::get_if<ChoiceSlot>(&slot))
                value = hex(key.choices[static_cast<std::size_t>(c->get(c->object))]);
        }
        if (key.list) {
            const std::vector<double>& list = **std::get_if<std::vector<double>*>(&slot);
            for (std::size_t i = 0; i < list.size(); ++i) values[element(static_cast<long>(i))] = bits(list[i]);
        }
    }
    return values;
}

std::vector<Answer> read_answers(const std::string& path) {
    std::ifstream in(path);
    std::vector<Answer> answers;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string first, second;
        words >> first >> second;
        if (first == "case")
            answers.emplace_back();
        else if (first == "status")
            words >> answers.back().status[second];
        else
            answers.back().values[first] = second;
    }
    return answers;
}

// rsc refuses more than gfortran, on purpose. Each kind is known by its message.
struct Stricter {
    const char* message;
    const char* reason;
};
constexpr Stricter kStricter[] = {
    {"unknown group", "a misspelt group would be ignored without a word"},
    {"this group is already", "gfortran reads the first of two groups of a name and ignores the second"},
    {"after the last group would be ignored", "gfortran reads no farther: a key there would be ignored without a message"},
    {"given twice", "gfortran lets the last one win: one of the two is a mistake"},
    {"is none of", "the choices are words of their own, not just texts"},
    {"has no value", "a hole in a list has no default to keep"},
    {"a text of more than", "gfortran cuts a text that is too long"},
    {"must stand in quotes", "without quotes a remark or what follows becomes part of the text"},
    {"an integer, found '+'", "gfortran passes over a lone sign"},
    {"an integer, found '-'", "gfortran passes over a lone sign"},
    {"&end'", "gfortran drops a number that runs into the end of the group"},
    {"$end'", "gfortran drops a number that runs into the end of the group"},
    {"found '='", "the same, before the next key"},
    {"step), found '?", "gfortran passes over a line end inside of a subscript"},
    {"'=' must follow", "gfortran passes over a key with no value before the end of a group, and over separators inside of a name"},
};

bool stricter_only(const Reading& reading) {
    const auto listed = [](const namelist::Fault& fault) {
        // A piece of a key: gfortran passes over separators, line ends included, inside of a name.
        for (const std::string before : {"unknown key '", "found '"}) {
            const std::size_t at = fault.text.find(before);
            if (at == std::string::npos) continue;
            const std::size_t first = at + before.size();
            const std::string piece = namelist::lower_case(fault.text.substr(first, fault.text.find('\'', first) - first));
            for (const Key& key : registry())
                if (namelist::lower_case(key.name) != piece && namelist::lower_case(key.name).find(piece) != std::string::npos) return true;
            // A number that runs into the next key: gfortran drops the number.
            for (const Key& key : registry())
                if (piece.size() > std::string(key.name).size() && piece.ends_with(namelist::lower_case(key.name))) return true;
        }
        return std::any_of(std::begin(kStricter), std::end(kStricter),
                           [&](const Stricter& s) { return fault.text.find(s.message) != std::string::npos; });
    };
    const bool swallowed_end = std::any_of(reading.faults.begin(), reading.faults.end(),
                                           [](const namelist::Fault& fault) { return fault.text.ends_with("end'"); });
    return std::all_of(reading.faults.begin(), reading.faults.end(), [&](const namelist::Fault& fault) {
        return listed(fault) || (swallowed_end && fault.text.find("before the end of the text") != std::string::npos);
    });
}

// Two commas with nothing but blanks, line ends and remarks between. `whole` texts in quotes are passed over as such.
bool has_stray_commas(const std::string& text, bool whole) {
    bool comma = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '!')
            i = std::min(text.find('\n', i), text.size());
        else if (whole && (c == '\'' || c == '"')) {
            i = std::min(text.find(c, i + 1), text.size());
            comma = false;
        } else if (c == ',' || c == ';') {
            if (comma) return true;
            comma = true;
        } else if (c != ' ' && c != '\t' && c != '\n' && c != '\r')
            comma = false;
    }
    return false;
}

// A line of its own for a remark, between a key and its equals sign.
bool has_remark_before_equals(const std::string& text) {
    for (std::size_t i = text.find('!'); i != std::string::npos; i = text.find('!', i + 1)) {
        const std::size_t before = text.find_last_not_of(" \t\r\n", i == 0 ? 0 : i - 1);
        if (before == std::string::npos || text.find('\n', before) > i) continue;
        std::size_t after = i;
        while (after < text.size() && text[after] == '!')
            after = text.find_first_not_of(" \t\r\n", std::min(text.find('\n', after), text.size()));
        if (after < text.size() && text[after] == '=') return true;
    }
    return false;
}

// What rsc reads and gfortran trips over, now and then: commas too many, queries (?), a remark straight after a key.
bool is_lenient(const std::string& text) {
    if (has_remark_before_equals(text)) return true;
    if (has_stray_commas(text, true) || has_stray_commas(text, false) || text.find('?') != std::string::npos) return true;
    for (std::size_t i = 1; i < text.size(); ++i)
        if (text[i] == '!' && std::isalpha(static_cast<unsigned char>(text[i - 1]))) return true;
    return false;
}

// What differs, or nothing.
std::string difference(const std::string& text, const Reading& reading, const Answer& answer) {
    const auto status = [&](std::string_view group) { return answer.status.at(std::string(group)); };
    const bool refused = !reading.faults.empty() || !reading.duplicates.empty();
    const auto& groups = reading.groups;
    const auto present = [&](const std::string& group) { return std::find(groups.begin(), groups.end(), group) != groups.end(); };
    bool gfortran_refused = false;
    for (const auto& [group, ios] : answer.status) gfortran_refused = gfortran_refused || ios > 0 || (ios < 0 && present(group));
    if (refused) {
        if (gfortran_refused || stricter_only(reading)) return {};
        return "rsc refuses, gfortran reads: " + reading.faults.front().text;
    }
    for (const auto& [group, ios] : answer.status) {
        if (present(group) && status(group) != 0 && is_lenient(text)) return {};
        if (present(group) && status(group) != 0) return "rsc reads &" + group + ", gfortran does not";
        if (!present(group) && status(group) >= 0) return "gfortran sees &" + group + ", rsc does not";
    }
    const Values ours = values_of(reading.settings);
    const Values defaults = values_of(Case{});
    for (const auto& [name, value] : ours) {
        const auto theirs = answer.values.find(name);
        // The elements of a list that gfortran has not read keep their default.
        const bool unset = theirs == answer.values.end() || (theirs->second == "unset" && value != "unset");
        const auto standing = defaults.find(name);
        const std::string expected = !unset ? theirs->second : standing == defaults.end() ? "nothing" : standing->second;
        if (value != expected) return name + ": rsc " + value + ", gfortran " + expected;
    }
    for (const auto& [name, value] : answer.values)
        if (!ours.contains(name)) return name + ": gfortran " + value + ", rsc nothing";
    return {};
}

// One group of the registry: declarations, namelist, defaults, the read, and every value printed.
void write_group(std::ostream& out, const std::string& group) {
    std::string names, declared, defaults, printed;
    Case standing;
    for (const Key& key : registry()) {
        if (group != key.group) continue;
        const std::string name = key.name, full = "'" + group + "%" + name + "', " + name;
        const std::string shape = key.size > 1 ? "(" + std::to_string(key.size) + ")" : "";
        const Slot slot = key.slot(standing);
        std::string kind = "real(real64), save", value = "unset", call = "    call put_real(" + full + ")\n";
        const auto real = [](double x) { return "transfer(int(z'" + bits(x) + "', int64), unset)"; };
        if (auto* b = std::get_if<bool*>(&slot)) {
            kind = "logical", value = **b ? ".true." : ".false.", call = "    call put_logical(" + full + ")\n";
        } else if (auto* n = std::get_if<int*>(&slot)) {
            kind = "integer(int32)", value = std::to_string(**n),
            call = "    call put_integer(" + full.substr(0, full.rfind(' ')) + " int(" + name + ", int64))\n";
        } else if (auto* m = std::get_if<std::int64_t*>(&slot)) {
            kind = "integer(int64)", value = std::to_string(**m), call = "    call put_integer(" + full + ")\n";
        } else if (key.type == Type::string || key.type == Type::choice) {
            kind = "character(len=" + std::to_string(key.type == Type::choice ? 32 : key.length) + ")";
            value = "'" + get_key(standing, group + "%" + name);
            value = value.size() > 1 ? value.substr(1) : "''";  // get_key gives it in quotes
            call = "    call put_text(" + full + ")\n";
        } else if (key.list) {
            call = "    call put_list(" + full + ")\n";
        } else if (key.size > 1) {
            call = "    do k = 1, " + std::to_string(key.size) + "\n      call put_real(" + full + "(k), k)\n    end do\n";
        }
        for (int i = 0; auto* x = std::get_if<double*>(&slot); ++i) {
            if (i == key.size) break;
            defaults += "    " + name + (key.size > 1 ? "(" + std::to_string(i + 1) + ")" : "") + " = " + real((*x)[i]) + "\n";
        }
        if (auto* o = std::get_if<std::optional<double>*>(&slot); o && **o) value = real(***o);
        if (!std::holds_alternative<double*>(slot)) defaults += "    " + name + " = " + value + "\n";
        names += (names.empty() ? "" : ", &\n      ") + name;
        declared += "    " + kind + " :: " + name + shape + "\n";
        printed += call;
    }
    out << "  subroutine read_" << group << "()\n"
        << declared << "    integer :: ios, k\n    namelist /" << group << "/ " << names << "\n    k = 0\n"
        << defaults << "    read (unit_in, nml=" << group << ", iostat=ios)\n    call status('" << group << "', ios)\n"
        << printed << "  end subroutine\n\n";
}

int write_groups(const std::string& path) {
    std::ofstream out(path);
    std::string calls;
    for (const std::string_view group : group_names()) {
        if (group == "study") continue;
        write_group(out, std::string(group));
        calls += "    call read_" + std::string(group) + "()\n";
    }
    out << "  subroutine read_groups()\n" << calls << "  end subroutine\n";
    return out.good() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    if (std::string(argv[1]) == "--write") return write_groups(argv[2]);
    const std::string reader = argv[1], folder = argv[2];
    const char* many = std::getenv("RSC_NAMELIST_CASES");  // more than the test's own, for a longer search
    const char* seed = std::getenv("RSC_NAMELIST_SEED");
    const int count = many ? std::atoi(many) : 800;
    std::filesystem::create_directories(folder);
    // Several seeds: what one does not meet another does. And what none may miss.
    std::vector<CaseMaker> makers;
    for (unsigned k = 0; k < 4; ++k) makers.emplace_back((seed ? static_cast<unsigned>(std::atoi(seed)) : 20180417U) + 1000003 * k);
    std::set<std::size_t> damaged_ones;
    std::vector<std::string> texts = {"&output pdf_levels = ,,9.5 /\n",
                                      "&output pdf_levels = 1.5,,9.5 /\n",
                                      "&output pdf_levels = 2*,9.5 /\n",
                                      "&output pdf_levels = , ,\n , 9.5 /\n",
                                      "&solids E = ,2*7.5 /\n",
                                      "&solids E = ,\n nu = ,,\n R = 1*, 9.5 /\n",
                                      "&solids E = 7.5,, nu = 0.3 /\n",
                                      "&solids nu(2:1:-1) = ,0.25 /\n",
                                      "&solids R(2) = ,\n E = 3.5 /\n",
                                      "&indentation centre = ,0.25 stop = 2. /\n",
                                      "&indentation centre = 0.25,, stop = 2. /\n"};
    for (int i = 0; static_cast<int>(texts.size()) < count; ++i) {
        CaseMaker& maker = makers[static_cast<std::size_t>(i) % makers.size()];
        const bool damaged = i / 4 % 4 == 3;
        if (damaged) damaged_ones.insert(texts.size());
        texts.push_back(damaged ? maker.damaged() : maker.well_formed());
    }
    for (std::size_t i = 0; i < texts.size(); ++i) {
        std::ofstream(folder + "/" + std::to_string(i + 1) + ".nml", std::ios::binary) << texts[i];
    }
    const std::string output = folder + "/answers.txt";
    const std::string command = "'" + reader + "' '" + folder + "' " + std::to_string(count) + " > '" + output + "'";
    if (std::system(command.c_str()) != 0) {
        std::printf("the Fortran reader failed\n");
        return 1;
    }
    const std::vector<Answer> answers = read_answers(output);
    CHECK(answers.size() == texts.size());
    int read = 0, refused = 0, stricter = 0, refused_alone = 0;
    for (std::size_t i = 0; i < std::min(answers.size(), texts.size()); ++i) {
        const Reading reading = read_namelist(texts[i]);
        const std::string what = difference(texts[i], reading, answers[i]);
        // In damaged text gfortran passes over a thing or two that rsc would rather name; never the other way round.
        const bool told = damaged_ones.contains(i) && what.starts_with("rsc refuses");
        refused_alone += told;
        CHECK(what.empty() || told);
        if (!what.empty() && !told) std::printf("%s/%zu.nml: %s\n", folder.c_str(), i + 1, what.c_str());
        if (reading.faults.empty() && reading.duplicates.empty())
            ++read;
        else if (stricter_only(reading))
            ++stricter;
        else
            ++refused;
    }
    std::printf("%d read, %d refused by both, %d refused by rsc alone or with a stricter rule\n", read, refused, stricter);
    // The comparison is worth something only when a good part of the inputs is read, and some is refused.
    CHECK(read >= count / 4);
    CHECK(refused >= count / 20);
    CHECK(refused_alone <= count / 200);
    for (int i = 1; i <= count && check::failures == 0; ++i) std::filesystem::remove(folder + "/" + std::to_string(i) + ".nml");
    return check::summary();
}
