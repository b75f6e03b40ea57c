// Cases and command lines that are refused: the table test/data/refusals.txt, and what is too large
// for a table. What needs files is in test_inputs.cpp, test_maps.cpp and door/cli/files.sh.
#include "case/options.hpp"
#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "check.hpp"
#include "support/refused.hpp"

namespace test_refusals {

using namespace rsc;

std::string unescaped(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\') {
            result += text[i];
        } else if (text[++i] == 'x') {
            result += char(std::stoi(text.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            result += text[i] == 'n' ? '\n' : '\t';
        }
    }
    return result;
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
    return refusal([&] { parse_options(int(pointers.size()), pointers.data()); });
}

// One message for each place, in order; each begins with the place and contains the word.
bool says(const std::string& messages, const std::string& expected) {
    std::size_t at = 0, place = 0;
    while (true) {
        const std::string message = messages.substr(at, messages.find('\n', at) - at);
        const std::string row = expected.substr(place, expected.find(" ;; ", place) - place);
        const std::size_t word = row.find(" ~ ");
        if (!message.starts_with(row.substr(0, word)) ||
            message.find(row.substr(word + 3)) == std::string::npos)
            return false;
        at = messages.find('\n', at);
        place = expected.find(" ;; ", place);
        if (at == std::string::npos || place == std::string::npos) return at == place;
        at += 1;
        place += 4;
    }
}

TEST(table) {
    std::ifstream in(RSC_TEST_DATA "/refusals.txt");
    std::vector<std::string> set;
    int refused = 0, taken = 0;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("-s ")) set.push_back(line.substr(3));
        const std::size_t arrow = line.find(" => ");
        if ((!line.starts_with("+ ") && arrow == std::string::npos) || line[0] == '#') continue;
        const std::string what = line.substr(2, arrow - 2),
                          got = line[0] == '$' ? of_words(what) : of_case(what, set);
        const bool right = line[0] == '+' ? got.empty() : says(got, line.substr(arrow + 4));
        if (!right) std::printf("  %s\n  said: %s\n", line.c_str(), got.c_str());
        CHECK(right);
        ++(line[0] == '+' ? taken : refused);
        set.clear();
    }
    CHECK(refused > 100 && taken > 20);
}

// What is too long for a table.
TEST(large) {
    const std::string most(namelist::kLargestText, ' ');
    CHECK(of_case(most + " ", {}).find("4194304") != std::string::npos);
    CHECK(of_case("&run seed = 1 /" + most.substr(15), {}).empty());
    std::string words;
    for (int i = 0; i < 100001; ++i) words += "1 ";
    for (const char* start : {"&study surface%sigma = ", "&output pdf_levels = "})
        CHECK(of_case(start + words + "/", {}).find("more than 100000 values") !=
              std::string::npos);
    for (const char* start : {"\xff\xfe&", "\xfe\xff&"})
        CHECK(of_case(start, {}).find("UTF-16") != std::string::npos);
    for (const char* start : {"CDF\1", "\x89HDF\r"})
        CHECK(of_case(start, {}).find("NetCDF") != std::string::npos);
    // The hundred first faults are told.
    std::string wrong = "&run ";
    for (const int i : indices(101)) wrong += "a" + std::to_string(i) + "= 1\n";
    const std::string told = of_case(wrong + "/", {});
    CHECK(std::ranges::count(told, '\n') == 99);
}

// Keys by name, as the libraries set and get them.
TEST(by_name) {
    Case c;
    const auto refused = [](const auto& act, const char* word) {
        const std::string got = refusal(act);
        if (got.find(word) == std::string::npos) std::printf("  said: %s\n", got.c_str());
        CHECK(got.find(word) != std::string::npos);
    };
    refused([&] { set_key(c, "solids%R", "5", true); }, "has 2 values");
    CHECK(refusal([&] { set_key(c, "solids%R", "5", false); }).empty() && c.solids.R[0] == 5 &&
          c.solids.R[1] == 2.5);
    CHECK(refusal([&] { set_key(c, "solids%R", "5, 6", true); }).empty() && c.solids.R[1] == 6);
    CHECK(refusal([&] { set_key(c, "solids%R(1)", "7", true); }).empty() && c.solids.R[0] == 7);
    CHECK(refusal([&] { set_key(c, "output%pdf_levels", "7", true); }).empty() &&
          c.output.pdf_levels.size() == 1);
    CHECK(get_key(c, "solids%R(1:2)") == "7.0, 6.0" && get_key(c, "solids%R(2)") == "6.0");
    refused([&] { get_key(c, "run%seed(1)"); }, "no array");
    refused([&] { get_key(c, "solids%R(3)"); }, "1 to 2");
    refused([&] { get_key(c, "solids%X"); }, "unknown key 'X'");
    refused([&] { describe("surfce"); }, "did you mean 'surface'");
    refused([&] { get_key(c, "levels"); }, "indentation%levels or compare%levels");
    c = {};
    c.output.pdf_levels.clear();
    c.run.title = "ends with a blank ";
    c.surface.channel = std::string(1025, 'x');
    c.compare.levels.assign(1001, 1.0);
    CHECK(says(refusal([&] { require_valid(c); }),
               "&run: title ~ blank ;; &surface: channel ~ 1024 ;; &compare: levels ~ 1000 ;; "
               "&output: pdf_levels ~ one value"));
    // Two members of a study that are wrong as a whole.
    const Reading reading = read_namelist("&study surface%n = 2048, 512, 256 /");
    CHECK(says(refusal([&] { expand_study(Case{}, *reading.study); }),
               "&study: member 2 (surface%n=512) ~ L_lambda_s ;; &study: member 3 (surface%n=256) "
               "~ L_lambda_s"));
}

// Warnings, of what is taken nevertheless.
TEST(warnings) {
    const auto warned = [](const std::string& text) {
        std::string all;
        for (const std::string& w : read_case_text(text, "case.nml").warnings) all += w + "\n";
        return all;
    };
    CHECK(warned("&indentation start = 1 stop = 1.5 /").find("separations increase") !=
          std::string::npos);
    for (const char* quiet : {"&indentation start = 1 stop = 1 /", "&indentation levels = 1, 1.5 /",
                              "&indentation start = 1 stop = 1.5 control = 'force' /",
                              "&output pdf_levels(1:3) = 1.0 ! first\n 2.0 /"})
        CHECK(warned(quiet).empty());
    CHECK(warned("&output pdf_levels(1:3) = 1.0, ! first\n 2.0 /")
              .starts_with("case.nml:1:32: &output: the value of 'pdf_levels' here is empty"));
}

}  // namespace test_refusals
