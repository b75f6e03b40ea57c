// The namelist reader and the key registry: values, positions, messages, round trips, limits, studies, the command line.
#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "case/namelist_value.hpp"
#include "case/read_case.hpp"
#include "check.hpp"
#include "error.hpp"

using namespace rsc;

namespace {

// What read_case has against a text; empty when it has nothing.
std::string complaint(const std::string& text, const Options& options = {}) {
    try {
        read_case_text(text, "case.nml", options);
        return {};
    } catch (const Error& error) {
        check::that(error.kind() == Failure::bad_input, "the failure is bad_input", __FILE__, __LINE__);
        return error.what();
    }
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

void expect_text(const std::string& got, const std::string& expected, int line) {
    check::that(got == expected, "the text is the expected one", __FILE__, line);
    if (got != expected) std::printf("  got:      %s\n  expected: %s\n", got.c_str(), expected.c_str());
}
#define CHECK_TEXT(got, expected) expect_text((got), (expected), __LINE__)
#define CHECK_CONTAINS(got, part)                                                                                       \
    do {                                                                                                                \
        const std::string text_ = (got);                                                                                \
        CHECK(contains(text_, part));                                                                                   \
        if (!contains(text_, part)) std::printf("  got: %s\n  wanted: %s\n", text_.c_str(), std::string(part).c_str()); \
    } while (0)

void test_values() {
    const struct {
        const char* word;
        double value;
    } reals[] = {{"3", 3.0},
                 {"1.5", 1.5},
                 {".5", 0.5},
                 {"5.", 5.0},
                 {"1e3", 1e3},
                 {"1d3", 1e3},
                 {"1Q0", 1.0},
                 {"1.5+3", 1500},
                 {"1.5-3", 1.5e-3},
                 {"+2.5E-2", 0.025},
                 {"-7", -7.0},
                 {"inf", Case::kInfinity},
                 {"-Infinity", -Case::kInfinity},
                 {"1e999", Case::kInfinity},
                 {"1d-999", 0.0},
                 {"0.1", 0.1}};
    for (const auto& real : reals) {
        const auto value = namelist::to_real(real.word);
        CHECK(value && std::bit_cast<std::uint64_t>(*value) == std::bit_cast<std::uint64_t>(real.value));
    }
    CHECK(namelist::to_real("NaN(x)") && std::isnan(*namelist::to_real("nan")));
    for (const char* word : {"", ".", "e5", ".e5", "1e", "1.2.3", "1x", "--1", "0x10", "infinit", "1e5.", "nan(a", "+"})
        CHECK(!namelist::to_real(word));
    for (const char* word : {"", "+", "-", "1.0", "1e3", "+-1", "9223372036854775808", "a"}) CHECK(!namelist::to_integer(word));
    CHECK(namelist::to_integer("-9223372036854775808") == std::numeric_limits<std::int64_t>::min());
    for (const char* word : {"t", "T", ".true.", ".t", "tfoo"}) CHECK(namelist::to_logical(word) == true);
    for (const char* word : {"f", "F", ".FALSE.", ".f", "fool"}) CHECK(namelist::to_logical(word) == false);
    for (const char* word : {"", ".", "1", "yes", "..t"}) CHECK(!namelist::to_logical(word));
}

void test_syntax() {
    const auto read = [](const std::string& text) { return read_case_text(text, "case.nml").settings; };
    const Case c = read(
        "A rough sphere, after Smith & Wesson\n"
        "! &surface sigma = 7 /\n"
        "&SURFACE  Sigma = 2d-2  ! rms height\n  hurst=.75, n = 1024; plateau = T\n l_lambda_s = 1.28+2 /\n"
        "$solids r = 5, 1*, nu(2) = .3  e(2:1:-1) = 2.1d5, 7.8d4 $end\n"
        "&run title = 'it''s\n two lines' &END\n"
        "&output pdf_levels = 3*1.5 /\n");
    CHECK(c.surface.sigma == 0.02 && c.surface.hurst == 0.75 && c.surface.n == 1024 && c.surface.plateau && c.surface.L_lambda_s == 128);
    CHECK(c.solids.R[0] == 5.0 && c.solids.R[1] == 2.5 && c.solids.nu[0] == 0.42 && c.solids.nu[1] == 0.3);
    CHECK(c.solids.E[0] == 7.8e4 && c.solids.E[1] == 2.1e5);
    CHECK(c.run.title == "it's two lines");
    CHECK((c.output.pdf_levels == std::vector<double>{1.5, 1.5, 1.5}));
    CHECK((read("&output pdf_levels = 1.0 /").output.pdf_levels == std::vector<double>{1.0}));
    CHECK((read("&output pdf_levels(2) = 2.25 /").output.pdf_levels == std::vector<double>{2.0, 2.25, 3.0}));
    CHECK(read("&run title(3:4) = 'cd' title(1:2) = 'ab' /").run.title == "abcd");
    CHECK(read("&surface sigma = , /").surface.sigma == std::nullopt);
    CHECK(read("&solver method = 'DIRECT ' /").solver.method == Method::direct);
}

void test_messages() {
    CHECK_TEXT(complaint("&surface\n  sigma = 0.01\n  hurst = 0.7\n\n    simga = 1 /"),
               "case.nml:5:5: &surface: unknown key 'simga'; did you mean 'sigma'?");
    CHECK_TEXT(complaint("&surfaces n = 64 /"), "case.nml:1:1: unknown group '&surfaces'; did you mean '&surface'?");
    CHECK_CONTAINS(complaint("&run sigma = 1 /"), "case.nml:1:6: &run: unknown key 'sigma'; 'sigma' belongs to &surface");
    CHECK_CONTAINS(complaint("&run seed = 1\n seed = 2 /"), "case.nml:2:9: &run: seed: given twice, first at line 1");
    CHECK_CONTAINS(complaint("&solids E = 1, 2\n E(2) = 3 /"), "case.nml:2:9: &solids: E: given twice, first at line 1");
    CHECK_CONTAINS(complaint("&run seed = 1 /\n\n&run threads = 2 /"), "case.nml:3:1: &run: this group is already at line 1");
    CHECK_CONTAINS(complaint("&surface n = 1.5 /"), "case.nml:1:14: &surface: n: expected an integer, found '1.5'");
    CHECK_CONTAINS(complaint("&surface n = 3000000000 /"), "is not an integer of 32 bits");
    CHECK_CONTAINS(complaint("&surface hurst = 'x' /"), "expected a real number");
    CHECK_CONTAINS(complaint("&surface plateau = 1 /"), "expected .true. or .false.");
    CHECK_CONTAINS(complaint("&surface source = heights /"), "must stand in quotes");
    CHECK_CONTAINS(complaint("&solver method = 'dgsev' /"), "did you mean 'dgesv'?");
    CHECK_CONTAINS(complaint("&surface hurst = 1.5 /"), "case.nml:1:18: &surface: hurst = 1.5: must be 0 to 1");
    CHECK_CONTAINS(complaint("&surface hurst = nan /"), "hurst = NaN: must be 0 to 1");
    CHECK_CONTAINS(complaint("&solids nu = 0.3, 0.6 /"), "case.nml:1:19: &solids: nu(2) = 0.6: must be > -1 and <= 0.5");
    CHECK_CONTAINS(complaint("&solids E = 0 /"), "must be > 0 (Infinity allowed)");
    CHECK_CONTAINS(complaint("&solids E = 2*inf /"), "one at most may be rigid");
    CHECK_CONTAINS(complaint("&surface n = 65 L_lambda_s = 30 /"), "n = 65: must be even");
    CHECK_CONTAINS(complaint("&surface n = 1024 /"), "must be larger than 2 L_lambda_s = 1024.0");
    CHECK_CONTAINS(complaint("&surface L_lambda_l = 600 /"), "must be larger than L_lambda_l = 600.0");
    CHECK_CONTAINS(complaint("&surface source = 'heights' /"), "needs a file");
    CHECK_CONTAINS(complaint("&indentation spacing = 'log', stop = 0 /"), "stop = 0.0: must be positive");
    CHECK_CONTAINS(complaint("&indentation centre = 3, 0.5 /"), "must lie on the surface");
    CHECK_CONTAINS(complaint("&indentation levels(2) = 1 /"), "element 1 has no value");
    CHECK_CONTAINS(complaint("&surface sigma = 0.01 0.02 /"), "too many values: one value at most, found '0.02'");
    CHECK_CONTAINS(complaint("&surface sigma(1) = 0.01 /"), "takes no subscript");
    CHECK_CONTAINS(complaint("&solids R(3) = 1 /"), "must be within 1 to 2");
    CHECK_CONTAINS(complaint("&surface sigma = 1\n"), "case.nml:1:1: &surface: the group is not closed");
    CHECK_CONTAINS(complaint("&run title = 'abc /\n"), "case.nml:1:14: &run: the text that begins here is not closed");
    CHECK_CONTAINS(complaint(""), "case.nml: no namelist group found; expected at least one of &run, &solids");
    CHECK_CONTAINS(complaint("nothing to see here\n"), "no namelist group found");
    CHECK_CONTAINS(complaint("&solver interaction = 'hertz' /"), "'hertz' is none of 'point', 'none'");
    CHECK_CONTAINS(complaint("&solids hardness = 250  size_effect = 1e-3 / &solver model = 'elements' /"),
                   "no radius to scale the hardness");
    CHECK_CONTAINS(complaint("&solids hardness = 250  size_effect = 1e-3 / &compare levels = 2 /"), "no radius to scale the hardness");
    CHECK_CONTAINS(complaint("&solids hardness = 250  friction = 0.3 /"), "friction is computed for elastic asperities only");
    CHECK_CONTAINS(complaint("&solids hardness = 250  E = Infinity, 1 /"), "E(1) = Infinity makes it rigid");
    CHECK_CONTAINS(complaint("&solids friction = 0.3 / &solver model = 'elements' /"), "with model = 'elements' it is not available yet");
    // All at once, in the order of the text.
    const std::string all = complaint("&surface simga = 1\n hurst = 2\n n = 'x' /\n&solvr /\n&run seed = 1 seed = 2 /");
    std::size_t last = 0;
    for (const char* part : {"case.nml:1:10:", "case.nml:2:10:", "case.nml:3:6:", "case.nml:4:1:", "case.nml:5:22:"}) {
        const std::size_t at = all.find(part);
        CHECK(at != std::string::npos && at >= last);
        if (at == std::string::npos) std::printf("  no %s in:\n%s\n", part, all.c_str());
        last = at;
    }
}

// gfortran takes a remark straight after a comma for an empty value; rsc does the same and says so.
void test_warnings() {
    const Reading reading = read_namelist("&indentation levels(1:3) = 1.0, ! first\n 2.0 /\n");
    CHECK(reading.warnings.size() == 1 && reading.warnings[0].at.line == 1 && reading.warnings[0].at.column == 33);
    CHECK(read_namelist("&indentation levels = 1.0, 2.0, ! last\n start = 3 /\n").warnings.empty());
    CHECK(read_namelist("&surface sigma = 1.0, ! rms\n n = 64, ! points\n /\n").warnings.empty());
}

// Realizations are numbered as far as 32 bits go.
void test_last_realization() {
    Case c;
    set_key(c, "run%first_realization", "2147483647");
    CHECK(check_case(c).empty());
    set_key(c, "run%realizations", "2");
    const auto problems = check_case(c);
    CHECK(problems.size() == 1 && problems[0].text.find("beyond 2147483647") != std::string::npos);
    set_key(c, "run%first_realization", "2147483646");
    CHECK(check_case(c).empty());
    // No more than 1e9 values of a curve.
    Case many;
    set_key(many, "run%realizations", "10000000");
    set_key(many, "indentation%steps", "100");
    CHECK(check_case(many).empty());
    set_key(many, "indentation%steps", "101");
    CHECK(check_case(many).size() == 1 && check_case(many)[0].text.find("values of each curve") != std::string::npos);
}

// Forces, pressures and levels in geometric steps are positive; separations may be anything.
void test_positive_levels() {
    const auto refused = [](std::initializer_list<std::pair<const char*, const char*>> keys) {
        Case c;
        for (const auto& [key, value] : keys) set_key(c, key, value);
        for (const Problem& problem : check_case(c))
            if (problem.text.find("must be positive") != std::string::npos) return true;
        return false;
    };
    CHECK(!refused({{"indentation%start", "1.0"}, {"indentation%stop", "-1.0"}}));
    CHECK(refused({{"indentation%control", "'force'"}, {"indentation%start", "1.0"}, {"indentation%stop", "-1.0"}}));
    CHECK(refused({{"indentation%control", "'force'"}, {"indentation%start", "0.0"}, {"indentation%stop", "1.0"}}));
    CHECK(refused({{"indentation%control", "'force'"}, {"indentation%levels", "1.0, 0.0"}}));
    CHECK(!refused({{"indentation%control", "'force'"}, {"indentation%levels", "1.0, 2.0"}}));
    CHECK(refused({{"indentation%control", "'pressure'"}, {"indentation%levels", "-1.0"}}));
    CHECK(refused({{"indentation%spacing", "'log'"}, {"indentation%start", "3.0"}, {"indentation%stop", "0.0"}}));
    CHECK(!refused({{"indentation%spacing", "'log'"}, {"indentation%levels", "1.0, -1.0"}}));
}

// What each number may be, written out once more: the last values in, the first values out. A key without a row here is one whose
// bounds nobody has looked at.
void test_bounds() {
    struct Row {
        const char* key;
        std::vector<const char*> in, out;
    };
    const std::vector<Row> rows = {
        {"run%seed", {"-9223372036854775808", "9223372036854775807"}, {}},
        {"run%realizations", {"1", "10000000"}, {"0", "-1", "10000001"}},
        {"run%first_realization", {"1", "2147483647"}, {"0", "2147483648"}},
        {"run%threads", {"0", "4096"}, {"-1", "4097"}},
        {"solids%E", {"1e-50", "Infinity"}, {"0", "-1", "NaN", "-Infinity"}},
        {"solids%nu", {"-0.999", "0", "0.5"}, {"-1", "0.5000001", "NaN"}},
        {"solids%R", {"1e-50", "Infinity"}, {"0", "-1", "NaN"}},
        {"solids%hardness", {"1e-50", "Infinity"}, {"0", "-1", "NaN"}},
        {"solids%size_effect", {"0", "1e50"}, {"-1e-9", "Infinity", "NaN"}},
        {"solids%resistivity", {"0", "1e50"}, {"-1e-9", "Infinity", "NaN"}},
        {"solids%friction", {"0", "1e50"}, {"-1e-9", "Infinity", "NaN"}},
        {"surface%L", {"1e-50", "1e50"}, {"0", "-1", "9e-51", "1.1e50", "Infinity", "NaN"}},
        {"surface%n", {"2", "32768"}, {"1", "32769"}},
        {"surface%hurst", {"0", "1"}, {"-0.001", "1.001", "NaN"}},
        {"surface%L_lambda_l", {"1", "32768"}, {"0.999", "32769", "NaN"}},
        {"surface%L_lambda_s", {"1", "32768"}, {"0.999", "32769", "NaN"}},
        {"surface%sigma", {"1e-50", "1e50"}, {"0", "-1", "9e-51", "1.1e50", "Infinity", "NaN"}},
        {"surface%filter_cutoff", {"0", "1e50"}, {"-1e-9", "1.1e50", "Infinity", "NaN"}},
        {"indentation%start", {"-1e50", "0", "1e50"}, {"1.1e50", "Infinity", "-Infinity", "NaN"}},
        {"indentation%stop", {"-1e50", "0", "1e50"}, {"1.1e50", "Infinity", "-Infinity", "NaN"}},
        {"indentation%steps", {"1", "1000000"}, {"0", "1000001"}},
        {"indentation%levels", {"-1e50", "0", "1e50"}, {"1.1e50", "Infinity", "NaN"}},
        {"indentation%centre", {"-1e50", "0", "1e50"}, {"1.1e50", "Infinity", "NaN"}},
        {"indentation%selection_factor", {"1e-50", "1e50"}, {"0", "-1", "9e-51", "1.1e50", "Infinity", "NaN"}},
        {"solver%tolerance", {"1e-14", "0.1"}, {"9e-15", "0", "-1", "0.1001", "Infinity", "NaN"}},
        {"solver%max_iterations", {"1", "1000000"}, {"0", "1000001"}},
        {"solver%delta0", {"1e-50", "1000"}, {"0", "-1", "1000.1", "NaN"}},
        {"elements%points_per_wave", {"4", "64"}, {"3.999", "64.001", "NaN"}},
        {"compare%levels", {"-1e50", "0", "1e50"}, {"1.1e50", "Infinity", "NaN"}},
        {"output%map_cells", {"1", "4096"}, {"0", "4097"}},
        {"output%radial_bins", {"1", "100000"}, {"0", "100001"}},
        {"output%pdf_levels", {"-1e50", "0", "1e50"}, {"1.1e50", "Infinity", "NaN"}},
        {"output%pdf_bins", {"1", "100000"}, {"0", "100001"}},
        {"output%compression", {"0", "9"}, {"-1", "10"}},
    };
    for (const Row& row : rows) {
        Case c;
        const bool element = find_key(std::string_view(row.key).substr(0, std::string_view(row.key).find('%')),
                                      std::string_view(row.key).substr(std::string_view(row.key).find('%') + 1))
                                 ->size == 2;
        const std::string name = row.key + std::string(element ? "(2)" : "");
        for (const char* value : row.in) {
            bool taken = true;
            try {
                set_key(c, name, value);
            } catch (const Error&) {
                taken = false;
            }
            if (!taken) std::printf("  %s = %s is refused\n", row.key, value);
            CHECK(taken);
        }
        for (const char* value : row.out) {
            bool refused = false;
            try {
                set_key(c, name, value);
            } catch (const Error&) {
                refused = true;
            }
            if (!refused) std::printf("  %s = %s is taken\n", row.key, value);
            CHECK(refused);
        }
    }
    for (const Key& key : registry()) {
        if (key.type != Type::real && key.type != Type::integer && key.type != Type::long_integer) continue;
        const std::string name = std::string(key.group) + "%" + key.name;
        const bool there = std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return name == row.key; });
        if (!there) std::printf("  %s has no row in test_bounds\n", name.c_str());
        CHECK(there);
    }
}

// Values left out between commas keep what stands there, however many follow each other.
void test_nulls() {
    const auto pdf = [](const std::string& text) {
        return read_case_text("&output pdf_levels = " + text + " /", "case.nml").settings.output.pdf_levels;
    };
    CHECK((pdf(",,9.5") == std::vector<double>{2.0, 2.5, 9.5}));
    CHECK((pdf("1.5,,9.5") == std::vector<double>{1.5, 2.5, 9.5}));
    CHECK((pdf("2*,9.5") == std::vector<double>{2.0, 2.5, 9.5}));
    CHECK((pdf(" , , , 9.5") == std::vector<double>{2.0, 2.5, 3.0, 9.5}));
    // Nothing at all, and a list that cannot be read, which is told once.
    CHECK((pdf("") == std::vector<double>{2.0, 2.5, 3.0}));
    CHECK((pdf(",,,") == std::vector<double>{2.0, 2.5, 3.0}));
    CHECK_TEXT(complaint("&indentation levels(2) = x /"), "case.nml:1:26: &indentation: levels: expected a real number, found 'x'");
    const Case c = read_case_text("&solids E = ,7.5  nu = , 0.25  R = 3.5,, /", "case.nml").settings;
    CHECK(c.solids.E[0] == 78.0e3 && c.solids.E[1] == 7.5 && c.solids.nu[0] == 0.42 && c.solids.nu[1] == 0.25);
    CHECK(c.solids.R[0] == 3.5 && c.solids.R[1] == 2.5);
}

// A value for a key that is not its default.
std::string another_value(const Key& key, int salt) {
    switch (key.type) {
        case Type::logical: return ".true.";
        case Type::integer:
        case Type::long_integer:
            return std::to_string(key.bounds.high < 1e9 && key.bounds.high > 0 ? static_cast<int>(key.bounds.high) - salt % 2
                                                                               : 12345 + salt);
        case Type::string: return "'it''s a \"text\", number " + std::to_string(salt) + "!'";
        case Type::choice: return std::string("'") + key.choices[static_cast<std::size_t>(salt) % key.choices.size()] + "'";
        case Type::real: break;
    }
    // No short decimal: all 17 digits are needed.
    const double low = std::isfinite(key.bounds.low) ? key.bounds.low : -3.0;
    const double high = std::isfinite(key.bounds.high) ? key.bounds.high : low + 10.0;
    std::string text;
    for (int i = 0; i < (key.list ? 3 : key.size); ++i)
        text += (i > 0 ? ", " : "") + namelist::from_real(low + (high - low) * (salt + i + 1) / (salt + i + 1 + std::sqrt(2.0)));
    return text;
}

void test_round_trip() {
    CHECK_TEXT(effective_namelist(read_namelist(effective_namelist(Case{})).settings), effective_namelist(Case{}));
    for (int salt = 0; salt < 40; ++salt) {
        std::string text;
        for (const std::string_view group : group_names()) {
            text += "&" + std::string(group) + "\n";
            for (const Key& key : registry())
                if (group == key.group) text += std::string(key.name) + " = " + another_value(key, salt) + "\n";
            text += group == "study" ? "run%seed = 1 /\n" : "/\n";
        }
        const Reading first = read_namelist(text);
        CHECK(first.faults.empty());
        const Case& c = first.settings;
        for (const Key& key : registry()) CHECK_TEXT(get_key(c, std::string(key.group) + "%" + key.name), another_value(key, salt));
        const Reading reading = read_namelist(effective_namelist(c));
        CHECK(reading.faults.empty() && reading.duplicates.empty());
        for (const namelist::Fault& fault : reading.faults) std::printf("  %s\n", fault.text.c_str());
        for (const Key& key : registry()) {
            const std::string name = std::string(key.group) + "%" + key.name;
            CHECK_TEXT(get_key(reading.settings, name), get_key(c, name));
        }
        CHECK_TEXT(effective_namelist(reading.settings), effective_namelist(c));
    }
    // The value of every bit pattern tried comes back as itself.
    std::uint64_t pattern = 0x9E3779B97F4A7C15U;
    for (int i = 0; i < 20000; ++i) {
        pattern = pattern * 6364136223846793005U + 1442695040888963407U;
        const double x = std::bit_cast<double>(pattern);
        if (std::isnan(x)) continue;
        const auto back = namelist::to_real(namelist::from_real(x));
        CHECK(back && std::bit_cast<std::uint64_t>(*back) == pattern);
    }
}

void test_set_and_get() {
    Case c;
    set_key(c, "surface%SIGMA", "2d-2");
    CHECK(c.surface.sigma == 0.02);
    set_key(c, "solids%R(2)", "7");
    CHECK(c.solids.R[0] == Case::kInfinity && c.solids.R[1] == 7.0);
    CHECK_TEXT(get_key(c, "solids%r(2)"), "7.0");
    CHECK_TEXT(get_key(c, "solids%R"), "Infinity, 7.0");
    CHECK_TEXT(get_key(c, "surface%L"), "");
    CHECK_TEXT(get_key(c, "indentation%levels"), "");
    const auto refusal = [&](const char* name, const char* value) {
        const std::string before = effective_namelist(c);
        try {
            set_key(c, name, value);
        } catch (const Error& error) {
            CHECK_TEXT(effective_namelist(c), before);
            return std::string(error.what());
        }
        return std::string("nothing");
    };
    CHECK_CONTAINS(refusal("surface%simga", "1"), "unknown key 'simga'; did you mean 'sigma'?");
    CHECK_CONTAINS(refusal("surfac%sigma", "1"), "unknown group 'surfac'; did you mean 'surface'?");
    CHECK_CONTAINS(refusal("sigma", "1"), "expected group%key");
    CHECK_CONTAINS(refusal("surface%sigma", "-1"), "must be > 0");
    CHECK_CONTAINS(refusal("surface%sigma", "1 n = 4"), "expected one value for one key");
    CHECK_CONTAINS(refusal("surface%sigma", "1 / &run seed = 2"), "nothing may follow the value");
    CHECK_CONTAINS(refusal("surface%hurst", "'a'"), "expected a real number");
    CHECK_CONTAINS(refusal("run%title", "'a"), "not closed");
    Options options;
    options.set = {"surface%simga=1", "surface%n=64", "solver%method='mesh"};
    const std::string text = complaint("&run seed = 3 /", options);
    CHECK_CONTAINS(text, "--set surface%simga=1: unknown key 'simga'; did you mean 'sigma'?");
    CHECK_CONTAINS(text, "--set solver%method='mesh: ");
    options.set = {"surface%n=64", "surface%L_lambda_s=20", "surface%L_lambda_l=2"};
    options.output = "elsewhere.nc";
    const ReadCase read = read_case_text("&surface n = 512 / &output file = 'here.nc' /", "case.nml", options);
    CHECK(read.settings.surface.n == 64 && read.settings.output.file == "elsewhere.nc");
}

void test_limits() {
    CHECK_CONTAINS(complaint("&indentation levels = 200000001*1 /"), "the repeat count is larger than");
    CHECK_CONTAINS(complaint("&indentation levels = 99999999999999999999999*1 /"), "the repeat count is larger than");
    CHECK_CONTAINS(complaint("&indentation levels = 100000000*1 /"), "the repeat count is too large");
    CHECK_CONTAINS(complaint("&indentation levels = 0*1 /"), "the repeat count is zero");
    CHECK(complaint("&indentation levels = 10000*1 /").empty() && complaint("&output pdf_levels = 100*1 /").empty());
    CHECK(!complaint("&indentation levels = 10001*1 /").empty() && !complaint("&output pdf_levels = 101*1 /").empty());
    CHECK_CONTAINS(complaint("&surface n = 40000 /"), "must be 2 to 32768");
    CHECK_CONTAINS(complaint("&indentation steps = 2000000 /"), "must be 1 to 1000000");
    CHECK_CONTAINS(complaint("&indentation steps = 1000000 / &output map_cells = 4096 /"), "would hold more than 1000000000 values");
    CHECK_CONTAINS(complaint("&run title = '" + std::string(2000, 'x') + "' /"), "more than 1024 characters");
    CHECK_CONTAINS(complaint(std::string(namelist::kLargestText + 1, ' ')), "larger than");
    // Large and hostile texts end soon; the reader has no recursion to exhaust.
    CHECK(!complaint("&surface " + std::string(1000000, '(')).empty());
    CHECK(!complaint("&surface sigma = " + std::string(1000000, ',')).empty());
    CHECK(!complaint("&indentation levels = " + std::string(1000000, '\n')).empty());
    std::string words, twice;
    for (int i = 0; i < 100000; ++i) {
        words += "ab( ";
        twice += "seed=1 ";
    }
    CHECK(!complaint("&surface " + words + "/").empty());
    CHECK(!complaint("&surface sigma = " + words + "/").empty());
    CHECK(!complaint("&run " + twice + "/").empty());
    CHECK(complaint("&run " + words + twice + "/").size() < 100000);
    const std::string zero("&run seed = 1\0 /", 16);
    CHECK_CONTAINS(complaint(zero), "expected an integer");
}

void test_study() {
    const Reading reading = read_namelist(
        "&study surface%sigma = 0.001, 0.01, 0.1  solids%R(2) = 2*2.5, 5\n solver%method = 'direct', 'mesh'  mode = 'product' "
        "/\n");
    CHECK(reading.faults.empty() && reading.study && reading.study->axes.size() == 3);
    const Study& study = *reading.study;
    const std::vector<Member> members = expand_study(Case{}, study);
    CHECK(members.size() == 18);
    CHECK(members[0].settings.surface.sigma == 0.001 && members[17].settings.surface.sigma == 0.1);  // the first key is the slowest
    CHECK(members[5].settings.surface.sigma == 0.001 && members[6].settings.surface.sigma == 0.01);
    CHECK(members[0].settings.solver.method == Method::direct && members[1].settings.solver.method == Method::mesh);
    CHECK(members[4].settings.solids.R[1] == 5.0 && members[4].settings.solids.R[0] == Case::kInfinity);
    CHECK_TEXT(members[6].settings.output.file, "output/rsc_007.nc");
    CHECK_TEXT(effective_namelist(*read_namelist(effective_namelist(study)).study), effective_namelist(study));

    Study zip = study;
    zip.mode = StudyMode::zip;
    CHECK_THROWS(expand_study(Case{}, zip), Error);
    zip.axes.pop_back();
    CHECK(expand_study(Case{}, zip).size() == 3);
    const auto first_fault = [](const std::string& text) {
        const Reading r = read_namelist(text);
        return r.faults.empty() ? std::string() : namelist::format("case.nml", r.faults.front());
    };
    CHECK_CONTAINS(first_fault("&study surface%simga = 1, 2 /"),
                   "case.nml:1:8: &study: unknown key 'surface%simga'; did you mean 'sigma'?");
    CHECK_CONTAINS(first_fault("&study solids%R = 1, 2 /"), "vary one element");
    CHECK_CONTAINS(first_fault("&study mode = 'both' /"), "must be 'product' or 'zip'");
    CHECK_CONTAINS(first_fault("&study surface%sigma = 1,,2 /"), "a value is missing");
    CHECK_CONTAINS(first_fault("&study surface%sigma = 100000*1 /"), "more than 10000 values");
    CHECK_CONTAINS(first_fault("&study /"), "no lists of values");
    CHECK_CONTAINS(first_fault("&study surface%sigma = 1, 2\n surface%hurst = 0.5\n surface%sigma = 3 /"),
                   "case.nml:3:2: &study: surface%sigma: given twice");
    // A value out of bounds, and one that is wrong only beside another.
    CHECK_CONTAINS(check_study(Case{}, *read_namelist("&study surface%hurst = 0.5, 1.5 /").study).at(0).text, "must be 0 to 1");
    try {
        expand_study(Case{}, *read_namelist("&study surface%n = 2048, 512 /").study);
        CHECK(!"a member with n < 2 L_lambda_s is refused");
    } catch (const Error& error) {
        CHECK_CONTAINS(error.what(), "member 2 (surface%n=512)");
    }
    CHECK_TEXT(member_file("a.b/result", 12, 2000), "a.b/result_0012");
}

void test_options() {
    const auto parse = [](std::vector<const char*> words) {
        words.insert(words.begin(), "rsc");
        return parse_options(static_cast<int>(words.size()), words.data());
    };
    const Options o =
        parse({"-q", "--set", "surface%n=64", "-srun%seed=2", "--output=x.nc", "case.nml", "--progress", "never", "--member", "3"});
    CHECK(o.quiet && o.case_path == "case.nml" && o.output == "x.nc" && o.progress == Progress::never && o.member == 3);
    CHECK((o.set == std::vector<std::string>{"surface%n=64", "run%seed=2"}));
    CHECK(parse({}).case_path.empty() && parse({"-"}).case_path.empty() && parse({"--", "-x"}).case_path == "-x");
    CHECK(parse({"--describe", "surface%sigma"}).describe_what == "surface%sigma");
    CHECK(parse({"-h", "--nonsense"}).help);
    const std::vector<std::vector<const char*>> wrong = {{"--chek"},
                                                         {"-x"},
                                                         {"a.nml", "b.nml"},
                                                         {"--output"},
                                                         {"--check=yes"},
                                                         {"--member", "0"},
                                                         {"--member", "2x"},
                                                         {"--progress", "often"},
                                                         {"--set", "surface%n"},
                                                         {"-o", ""}};
    for (const auto& words : wrong) CHECK_THROWS(parse(words), Error);
    try {
        parse({"--chek"});
    } catch (const Error& error) {
        CHECK_CONTAINS(error.what(), "unknown option '--chek'; did you mean '--check'?");
    }
}

void test_describe() {
    const std::string all = describe("");
    for (const Key& key : registry()) {
        CHECK_CONTAINS(all, std::string("\n  ") + key.name);
        CHECK_CONTAINS(describe(std::string(key.group) + "%" + key.name), key.meaning);
    }
    CHECK_CONTAINS(describe("surface%hurst"), "hurst = 0.8\n      real, unit 1, 0 to 1\n");
    CHECK_THROWS(describe("surfac"), Error);
    CHECK_THROWS(describe("surface%simga"), Error);
}

}  // namespace

int main() {
    test_values();
    test_syntax();
    test_messages();
    test_warnings();
    test_bounds();
    test_last_realization();
    test_positive_levels();
    test_nulls();
    test_round_trip();
    test_set_and_get();
    test_limits();
    test_study();
    test_options();
    test_describe();
    return check::summary();
}
