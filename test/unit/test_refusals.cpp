// The table of refusals, test/data/said/refusals.txt: each case and command line in it is refused with the words it says, no more and no
// less, and the neighbour of each that is right is taken. What needs files is in test_inputs.cpp, test_maps.cpp and cli/refusals.sh.
#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "case/options.hpp"
#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "check.hpp"
#include "error.hpp"

using namespace rsc;

namespace {

std::string unescaped(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\') {
            result += text[i];
        } else if (text[++i] == 'x') {
            result += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            result += text[i] == 'n' ? '\n' : '\t';
        }
    }
    return result;
}

template <class Act>
std::string refusal(Act act) {
    try {
        act();
    } catch (const Error& error) {
        return error.kind() == Failure::bad_input ? error.what() : std::string("of another kind: ") + error.what();
    }
    return {};
}

// What the case is refused for, its study expanded.
std::string of_case(const std::string& text, const std::vector<std::string>& set) {
    Options options;
    options.set = set;
    return refusal([&] {
        const ReadCase read = read_case_text(unescaped(text), "<stdin>", options);
        if (read.study) expand_study(read.settings, *read.study);
    });
}

std::string of_words(const std::string& line) {
    std::vector<std::string> words = {"rsc", ""};
    for (const char c : line)
        if (c == '|')
            words.emplace_back();
        else
            words.back() += c;
    std::vector<const char*> pointers;
    for (const std::string& word : words) pointers.push_back(word.c_str());
    return refusal([&] { parse_options(static_cast<int>(pointers.size()), pointers.data()); });
}

void table() {
    std::ifstream in(RSC_TEST_DATA "/said/refusals.txt");
    std::vector<std::string> set;
    std::string line, what, got, said;
    int refused = 0, taken = 0;
    const auto compare = [&] {
        if (what.empty()) return;
        ++refused;
        if (got != said) std::printf("  %s\n  said:     %s\n  expected: %s\n", what.c_str(), got.c_str(), said.c_str());
        CHECK(got == said && !said.empty());
        what.clear();
    };
    while (std::getline(in, line)) {
        if (line.starts_with("> ")) {
            said += (said.empty() ? "" : "\n") + line.substr(2);
            continue;
        }
        compare();
        if (line.starts_with("-s ")) set.push_back(line.substr(3));
        if (line.starts_with("< ") || line.starts_with("$ ")) {
            what = line;
            said.clear();
            got = line[0] == '<' ? of_case(line.substr(2), set) : of_words(line.substr(2));
            set.clear();
        }
        if (line.starts_with("+ ")) {
            ++taken;
            got = of_case(line.substr(2), set);
            if (!got.empty()) std::printf("  %s\n  is refused: %s\n", line.c_str(), got.c_str());
            CHECK(got.empty());
            set.clear();
        }
    }
    compare();
    CHECK(refused > 150 && taken > 70);
}

// What is too long for a table.
void large() {
    const std::string most(namelist::kLargestText, ' ');
    CHECK(of_case(most + " ", {}) == "<stdin>: larger than 4194304 bytes: no case is");
    CHECK(of_case("&run seed = 1 /" + most.substr(15), {}).empty());
    std::string words;
    for (int i = 0; i < 100001; ++i) words += "1 ";
    CHECK(of_case("&study surface%sigma = " + words + "/", {}).find("&study: more than 100000 values for 'surface%sigma'") !=
          std::string::npos);
    const std::string many = of_case("&output pdf_levels = " + words + "/", {});
    CHECK(many.find("&output: more than 100000 values for 'pdf_levels'") != std::string::npos);
    CHECK(of_case("\xff\xfe&", {}) == "<stdin>: is text in UTF-16; save it as UTF-8 or plain ASCII");
    CHECK(of_case("\xfe\xff&", {}) == "<stdin>: is text in UTF-16; save it as UTF-8 or plain ASCII");
    for (const char* start : {"CDF\1", "\x89HDF\r"})
        CHECK(of_case(start, {}) == "<stdin>: is a NetCDF file; the case in a result of rsc runs by the file's name: rsc FILE.nc");
    // The hundred first faults are told.
    std::string wrong = "&run ";
    for (int i = 0; i < 101; ++i) wrong += "a" + std::to_string(i) + "= 1\n";
    const std::string told = of_case(wrong + "/", {});
    CHECK(std::count(told.begin(), told.end(), '\n') == 99);
}

// What only a library asks.
void by_name() {
    Case c;
    CHECK(refusal([&] { set_key(c, "solids%R", "5", true); }) == "R has 2 values: give all of them, or one as solids%R(1)");
    CHECK(refusal([&] { set_key(c, "solids%R", "5", false); }).empty() && c.solids.R[0] == 5 && c.solids.R[1] == 2.5);
    CHECK(refusal([&] { set_key(c, "solids%R", "5, 6", true); }).empty() && c.solids.R[1] == 6);
    CHECK(refusal([&] { set_key(c, "solids%R(1)", "7", true); }).empty() && c.solids.R[0] == 7);
    CHECK(refusal([&] { set_key(c, "output%pdf_levels", "7", true); }).empty() && c.output.pdf_levels.size() == 1);
    CHECK(refusal([&] { get_key(c, "run%seed(1)"); }) == "seed is no array: it takes no subscript");
    CHECK(refusal([&] { get_key(c, "solids%R(3)"); }) == "the subscript of R must be within 1 to 2");
    CHECK(refusal([&] { get_key(c, "solids%X"); }) == "unknown key 'X'; did you mean 'E'?");
    CHECK(get_key(c, "solids%R(1:2)") == "7.0, 6.0" && get_key(c, "solids%R(2:1:-1)") == "6.0, 7.0" && get_key(c, "solids%R(2)") == "6.0");
    c = {};
    c.output.pdf_levels.clear();
    c.run.title = "ends with a blank ";
    c.surface.channel = std::string(1025, 'x');
    c.compare.levels.assign(1001, 1.0);
    CHECK(refusal([&] { require_valid(c); }) ==
          "&run: title: blanks at the end are not allowed\n&surface: channel: at most 1024 characters\n"
          "&compare: levels: at most 1000 values\n&output: pdf_levels: at least one value");
    CHECK(refusal([&] { describe("surfac"); }) == "unknown group 'surfac'; did you mean 'surface'?");
    CHECK(refusal([&] { describe("xxxxxx"); }) == "unknown group 'xxxxxx'");
    CHECK(refusal([&] { describe("levels"); }) == "'levels' is a key, not a group; did you mean indentation%levels or compare%levels?");
    CHECK(refusal([&] { describe("surface%simga"); }) == "&surface: unknown key 'simga'; did you mean 'sigma'?");
    // A member that is wrong as a whole, and all members that are.
    const Reading reading = read_namelist("&study surface%n = 2048, 512, 256 /");
    CHECK(
        refusal([&] { expand_study(Case{}, *reading.study); }) ==
        "&study: member 2 (surface%n=512): &surface: n = 512: must be larger than 2 L_lambda_s = 1024.0 for the grid to carry the shortest "
        "wavelength\n&study: member 3 (surface%n=256): &surface: n = 256: must be larger than 2 L_lambda_s = 1024.0 for the grid to carry "
        "the shortest wavelength");
}

// What is told and taken nevertheless.
void warnings() {
    const auto warned = [](const std::string& text) {
        std::string all;
        for (const std::string& w : read_case_text(text, "case.nml").warnings) all += w + "\n";
        return all;
    };
    const std::string grows = ": separations grow, the sphere is drawn back from level to level\n";
    CHECK(warned("&indentation start = 1 stop = 1.5 /") == "case.nml: &indentation: start = 1.0 is less than stop = 1.5" + grows);
    CHECK(warned("&indentation start = 1 stop = 1 /").empty() && warned("&indentation start = 1 stop = 1.5 levels = 1 /").empty());
    CHECK(warned("&indentation start = 1 stop = 1.5 control = 'force' /").empty());
    CHECK(
        warned("&output pdf_levels(1:3) = 1.0, ! first\n 2.0 /") ==
        "case.nml:1:32: &output: the value of 'pdf_levels' here is empty, as gfortran reads it: a comment straight after '=' or ',', or a "
        "line that begins with a comma, makes a null value\n");
    CHECK(warned("&output pdf_levels(1:3) = 1.0 ! first\n 2.0 /").empty());
}

}  // namespace

int main() {
    table();
    large();
    by_name();
    warnings();
    return check::summary();
}
