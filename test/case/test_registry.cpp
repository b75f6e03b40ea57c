// The keys: their defaults and bounds as the documentation promises them, each number taken up to
// its bounds and refused beyond them, and the texts made of the registry (--describe, the manual
// page, the effective namelist), which name every key.
#include "base/version.h"
#include "case/namelist.hpp"
#include "case/options.hpp"
#include "case/registry.hpp"
#include "check.hpp"
#include "support/refused.hpp"

namespace test_registry {

using namespace rsc;

// Each key is in each text, and a key's own description is the one it has in the whole.
TEST(texts) {
    const std::string all = describe(""), page = manual_page(),
                      standard = effective_namelist(Case{});
    for (const Key& key : registry()) {
        const std::string one = describe(std::string("&") + key.group + "%" + key.name),
                          head = std::string("&") + key.group + "\n";
        CHECK(one.starts_with(head) && one.find(key.meaning) != std::string::npos);
        CHECK(all.find(one.substr(head.size())) != std::string::npos);
        CHECK(page.find(key.name) != std::string::npos &&
              standard.find(std::string("\n  ") + key.name + " ") != std::string::npos);
    }
    CHECK(version_text() == "rsc " RSC_VERSION "\n" &&
          page.find("\"rsc " RSC_VERSION "\"") != std::string::npos);
    // A word: what has it in its name or meaning, in either case, and nothing else.
    const std::string wear = describe("WORN"), levels = describe("pdf_levels");
    CHECK(wear.find("worn_volume") != wear.npos && wear.find("hurst") == wear.npos);
    CHECK(levels.starts_with("&output\n") && levels.find("pdf_bins") == levels.npos);
    for (const char* option : {"--check", "--describe", "--merge", "--resume", "--set", "--output"})
        CHECK(usage_text().find(option) != std::string::npos &&
              page.find(std::string(option).substr(2)) != std::string::npos);
}

// Why a value is refused; empty if it is taken and given back.
std::string refusal(const std::string& name, const std::string& value) {
    Case c;
    if (name.starts_with("indenter%radii("))
        c.indenter.radii[0] = c.indenter.radii[1] = 1.0;  // they are given both
    const std::string message = ::refusal([&] { set_key(c, name, value); });
    return message.empty() && get_key(c, name) != value ? "taken as " + get_key(c, name) : message;
}

void expect(const std::string& name, const std::string& value, const std::string& word) {
    const std::string got = refusal(name, value);
    const bool right = word.empty() ? got.empty() : got.find(word) != std::string::npos;
    if (!right)
        std::printf("  %s = %s: '%s', expected '%s'\n", name.c_str(), value.c_str(), got.c_str(),
                    word.c_str());
    CHECK(right);
}

void bounds_of(const Key& key, const std::string& name) {
    constexpr double infinity = kInfinity;
    const bool whole = key.type == Type::integer;
    const Bounds& b = key.bounds;
    const auto text = [&](double v) {
        return whole ? std::to_string(static_cast<long long>(v)) : namelist::from_real(v);
    };
    const auto taken = [&](double v) { expect(name, text(v), ""); };
    const auto refused = [&](double v) { expect(name, text(v), "must be"); };
    const auto next = [&](double v, double to) {
        return whole ? v + (to > v ? 1 : -1) : std::nextafter(v, to);
    };
    if (!std::isfinite(b.low)) {
        taken(-1e50);
        refused(std::nextafter(-1e50, -infinity));
        refused(-infinity);
        if (b.nonzero)
            for (const double v : {0.0, 9.99e-51, -9.99e-51}) refused(v);
    } else if (!b.open) {
        taken(b.low);
        refused(next(b.low, -infinity));
    } else if (b.low == 0) {
        refused(0);
        taken(1e-50);
        refused(9.99e-51);
    } else {
        refused(b.low);
        taken(std::nextafter(b.low, infinity));
    }
    if (!std::isfinite(b.high)) {
        taken(1e50);
        refused(std::nextafter(1e50, infinity));
    } else if (whole && b.high == std::numeric_limits<int>::max()) {
        taken(b.high);
        expect(name, "2147483648", "32 bits");
    } else {
        taken(b.high);
        refused(next(b.high, infinity));
    }
    if (whole) return;
    if (name == "solids%E(1)")  // body 2 is rigid already
        expect(name, "Infinity", "rigid");
    else if (b.infinity)
        taken(infinity);
    else
        refused(infinity);
    refused(std::nan(""));
}

TEST(bounds) {
    for (const Key& key : registry()) {
        const std::string name = std::string(key.group) + "%" + key.name,
                          size = std::to_string(key.size);
        if (key.type == Type::integer || key.type == Type::real)
            for (int element = 1; element <= (key.list ? 1 : key.size); ++element)
                bounds_of(key, name + (key.size > 1 ? "(" + std::to_string(element) + ")" : ""));
        // A list has as many values as it says; a text as many characters.
        const std::string value =
            key.type == Type::choice            ? namelist::from_string(key.choices.front())
            : name == "solids%relaxation_share" ? "0.03125"  // their sum is 1 at most
                                                : "0.25";
        const bool rises = name == "indentation%times" || name == "indentation%distances" ||
                           name == "output%stress_depths";
        if (key.list && !rises) CHECK(refusal(name, size + "*" + value).starts_with("taken"));
        if (key.list) expect(name, size + "*" + value + ", " + value, "too many values");
        if (!key.list && key.size == 2) expect(name, "0.25, 0.125, 1", "too many values");
        if (key.type == Type::string && name.find("unit") == std::string::npos) {
            const auto length = key.length;
            expect(name, "'" + std::string(length, 'x') + "'", "");
            expect(name, "'" + std::string(length + 1, 'x') + "'", std::to_string(length));
        }
        for (const char* choice : key.choices) expect(name, std::string("'") + choice + "'", "");
    }
}

}  // namespace test_registry
