// The namelist reader and the key registry: values, positions, messages, round trips, studies, the
// command line.
#include "base/error.hpp"
#include "case/namelist.hpp"
#include "case/read_case.hpp"
#include "check.hpp"
#include "support/refused.hpp"

namespace test_namelist {

using namespace rsc;

// What read_case has against a text; empty when it has nothing.
std::string complaint(const std::string& text, const Options& options = {}) {
    return refusal([&] { read_case_text(text, "case.nml", options); });
}

void expect_text(const std::string& got, const std::string& expected, int line) {
    check::that(got == expected, "the text is the expected one", __FILE__, line);
    if (got != expected)
        std::printf("  got:      %s\n  expected: %s\n", got.c_str(), expected.c_str());
}
#define CHECK_TEXT(got, expected) expect_text((got), (expected), __LINE__)
TEST(test_values) {
    const std::pair<const char*, double> reals[] = {
        {"1.5+3", 1500},      {"1.5-3", 1.5e-3}, {"1Q0", 1.0}, {"-Infinity", -kInfinity},
        {"1e999", kInfinity}, {"1d-999", 0.0},   {"0.1", 0.1}};
    for (const auto& [word, wanted] : reals) {
        const auto value = namelist::to_real(word);
        CHECK(value &&
              std::bit_cast<std::uint64_t>(*value) == std::bit_cast<std::uint64_t>(wanted));
    }
    CHECK(namelist::to_real("NaN(x)") && std::isnan(*namelist::to_real("nan")));
    for (const char* word : {"", ".", "e5", ".e5", "1e", "1.2.3", "1x", "--1", "0x10", "infinit",
                             "1e5.", "nan(a", "+"})
        CHECK(!namelist::to_real(word));
    for (const char* word : {"", "+", "-", "1.0", "1e3", "+-1", "9223372036854775808", "a"})
        CHECK(!namelist::to_integer(word));
    CHECK(namelist::to_integer("-9223372036854775808") == std::numeric_limits<std::int64_t>::min());
    for (const char* word : {"t", "T", ".true.", ".t", "tfoo"})
        CHECK(namelist::to_logical(word) == true);
    for (const char* word : {"f", "F", ".FALSE.", ".f", "fool"})
        CHECK(namelist::to_logical(word) == false);
    for (const char* word : {"", ".", "1", "yes", "..t"}) CHECK(!namelist::to_logical(word));
}

// Against the Fortran runtime's own reader: fortran/test_namelist.f90.
TEST(test_syntax) {
    const auto read = [](const std::string& text) {
        return read_case_text(text, "case.nml").settings;
    };
    CHECK((read("&output pdf_levels = 1.0 /").output.pdf_levels == std::vector<double>{1.0}));
    CHECK((read("&output pdf_levels(2) = 2.25 /").output.pdf_levels ==
           std::vector<double>{2.0, 2.25, 3.0}));
    CHECK(read("&surface sigma = , /").surface.sigma == std::nullopt);
    CHECK((read("&output pdf_levels = , , , 9.5 /").output.pdf_levels ==
           std::vector<double>{2.0, 2.5, 3.0, 9.5}));
    CHECK_TEXT(complaint("&indentation levels(2) = x /"),
               "case.nml:1:26: &indentation: levels: expected a real number, found 'x'; numbers "
               "are written with a decimal point and without their unit, comments begin with '!'");
    CHECK(read("&solver method = 'DIRECT ' /").solver.method == Method::direct);
}

// A value for a key that is not its default.
std::string another_value(const Key& key, int salt) {
    switch (key.type) {
        case Type::logical: return ".true.";
        case Type::integer:
        case Type::long_integer:
            return std::to_string(key.bounds.high < 1e9 && key.bounds.high > 0
                                      ? int(key.bounds.high) - salt % 2
                                      : 12345 + salt);
        case Type::string: return "'it''s a \"text\", number " + std::to_string(salt) + "!'";
        case Type::choice: return std::string("'") + key.choices[salt % key.choices.size()] + "'";
        case Type::real: break;
    }
    // No short decimal: all 17 digits are needed.
    const double low = std::isfinite(key.bounds.low) ? key.bounds.low : -3.0;
    const double high = std::isfinite(key.bounds.high) ? key.bounds.high : low + 10.0;
    std::string text;
    for (const int i : indices((key.list ? 3 : key.size)))
        text +=
            (i > 0 ? ", " : "") + namelist::from_real(low + (high - low) * (salt + i + 1) /
                                                                (salt + i + 1 + std::sqrt(2.0)));
    return text;
}

TEST(test_round_trip) {
    CHECK_TEXT(effective_namelist(read_namelist(effective_namelist(Case{})).settings),
               effective_namelist(Case{}));
    for (const int salt : indices(40)) {
        std::string text;
        for (const std::string_view group : group_names()) {
            text += "&" + std::string(group) + "\n";
            for (const Key& key : registry())
                if (group == key.group)
                    text += std::string(key.name) + " = " + another_value(key, salt) + "\n";
            text += group == "study" ? "run%seed = 1 /\n" : "/\n";
        }
        const Reading first = read_namelist(text);
        CHECK(first.faults.empty());
        const Case& c = first.settings;
        for (const Key& key : registry())
            CHECK_TEXT(get_key(c, std::string(key.group) + "%" + key.name),
                       another_value(key, salt));
        const Reading reading = read_namelist(effective_namelist(c));
        CHECK(reading.faults.empty() && reading.duplicates.empty());
        for (const namelist::Fault& fault : reading.faults)
            std::printf("  %s\n", fault.text.c_str());
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

TEST(test_study) {
    const Reading reading = read_namelist(
        "&study surface%sigma = 0.001, 0.01, 0.1  solids%R(2) = 2*2.5, 5\n solver%method = "
        "'direct', 'mesh'  mode = 'product' "
        "/\n");
    CHECK(reading.faults.empty() && reading.study && reading.study->axes.size() == 3);
    const Study& study = *reading.study;
    const std::vector<Member> members = expand_study(Case{}, study);
    CHECK(members.size() == 18);
    CHECK(members[0].settings.surface.sigma == 0.001 &&
          members[17].settings.surface.sigma == 0.1);  // the first key is the slowest
    CHECK(members[5].settings.surface.sigma == 0.001 && members[6].settings.surface.sigma == 0.01);
    CHECK(members[0].settings.solver.method == Method::direct &&
          members[1].settings.solver.method == Method::mesh);
    CHECK(members[4].settings.solids.R[1] == 5.0 && members[4].settings.solids.R[0] == kInfinity);
    CHECK_TEXT(members[6].settings.output.file, "output/rsc_007.nc");
    CHECK_TEXT(effective_namelist(*read_namelist(effective_namelist(study)).study),
               effective_namelist(study));

    Study zip = study;
    zip.mode = StudyMode::zip;
    CHECK_THROWS(expand_study(Case{}, zip), Error);
    zip.axes.pop_back();
    CHECK(expand_study(Case{}, zip).size() == 3);
    CHECK_TEXT(member_file("a.b/result", 12, 2000), "a.b/result_0012");
}

TEST(test_options) {
    const auto parse = [](std::vector<const char*> words) {
        words.insert(words.begin(), "rsc");
        return parse_options(int(words.size()), words.data());
    };
    const Options o = parse({"-q", "--set", "surface%n=64", "-srun%seed=2", "--output=x.nc",
                             "case.nml", "--progress", "never", "--member", "3"});
    CHECK(o.quiet && o.case_path == "case.nml" && o.output == "x.nc" &&
          o.progress == Progress::never && o.member == 3);
    CHECK((o.set == std::vector<std::string>{"surface%n=64", "run%seed=2"}));
    CHECK(parse({}).case_path.empty() && parse({"-"}).case_path.empty() &&
          parse({"--", "-x"}).case_path == "-x");
    CHECK(parse({"--describe", "surface%sigma"}).describe_what == "surface%sigma");
    CHECK(parse({"-h", "--nonsense"}).help);
}

// What would be lost without a word outside of groups, and what is a comment there.
TEST(test_outside_groups) {
    const std::string run = "&run threads = 1 /\n";
    for (const char* const line :
         {"surface n=128 /", "& surface n=128 /", "&surface%n=128 /", "&-surface n=128 /",
          "&surfac\u00e9 n=128 /", "&surfce n=128 /", "E(1) = 3", "this & that"}) {
        CHECK(complaint(std::string(line) + "\n" + run).starts_with("case.nml:1:"));
        CHECK(complaint(run + line).starts_with("case.nml:2:"));
    }
    // One message for a group whose name is wrong, whatever is in it.
    const std::string all = complaint("&surfce\n n = 128\n sigma = 1e-3\n/\n" + run);
    CHECK(all.find('\n') == std::string::npos && all.find("did you mean '&surface'") != all.npos);
    for (const char* const line : {"a title", "2!n = 3", "! &surfce n = 1 /", "", "costs 5 $ only"})
        CHECK(complaint(std::string(line) + "\n" + run).empty());
}

// --set: words without quotes, defaults, keys of a study.
TEST(test_set) {
    const auto with = [](std::vector<std::string> set, const std::string& text = "&run /") {
        Options options;
        options.set = std::move(set);
        return read_case_text(text, "case.nml", options).settings;
    };
    const Case c = with({"solver%model=elements", "surface%source=heights", "surface%file=a b.nc",
                         "output%fields=pressure,gap", "compare%levels=none",
                         "surface%detrend='none'", "surface%L=2"});
    CHECK(c.solver.model == ModelKind::elements && c.surface.file == "a b.nc" &&
          c.surface.detrend == Detrend::none && c.surface.L == 2 && c.output.fields.size() == 2 &&
          c.compare.what == CompareWhat::none);
    const Case back = with({"surface%n=", "solids%E=", "run%title=", "surface%L=", "surface%twins=",
                            "indentation%levels=", "compare%levels="},
                           "&run title='t' / &solids E=1.0, 2.0 nu=0.3,0.3 /\n"
                           "&surface n=64 L=3 / &indentation levels=3.0 / &compare levels=2.0 /");
    CHECK(back.surface.n == Case().surface.n && back.solids.E[0] == Case().solids.E[0] &&
          back.solids.E[1] == Case().solids.E[1] && back.run.title.empty() && !back.surface.L &&
          back.indentation.levels.empty() && !back.compare.listed());
    const std::string study = "&study surface%sigma = 0.01, 0.02 solids%E(1) = 1.0, 2.0 /";
    REFUSED(with({"surface%sigma=0.03"}, study), "&study varies surface%sigma");
    REFUSED(with({"solids%E=1.0,2.0"}, study), "&study varies solids%E(1)");
    CHECK(with({"solids%E(2)=5.0"}, study).solids.E[1] == 5);
    REFUSED(with({"solids%E(1)="}), "no default of its own");
    REFUSED(with({"solver%model=element"}), "solver%model=element");
}

}  // namespace test_namelist
