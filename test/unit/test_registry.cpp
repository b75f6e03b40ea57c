// The keys: their defaults and bounds as the documentation promises them, each number taken up to its bounds and refused beyond them, and
// the texts made of the registry (--describe, the manual page, the effective namelist), which name every key.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "case/manual.hpp"
#include "case/namelist_value.hpp"
#include "case/options.hpp"
#include "case/registry.hpp"
#include "check.hpp"
#include "error.hpp"
#include "version.h"

using namespace rsc;

namespace {

struct Promise {
    const char *key, *standard, *bounds;
};

const Promise kPromises[] = {
    {"run%title", "''", ""},
    {"run%seed", "1", ""},
    {"run%realizations", "1", "1 to 10000000"},
    {"run%first_realization", "1", "1 to 2147483647"},
    {"run%threads", "0", "0 to 4096"},
    {"run%length_unit", "'mm'", ""},
    {"run%force_unit", "'N'", ""},
    {"solids%E", "78000.0, Infinity", "> 0 (Infinity allowed)"},
    {"solids%nu", "0.42, 0.0", "> -1 and <= 0.5"},
    {"solids%R", "Infinity, 2.5", "> 0 (Infinity allowed)"},
    {"solids%hardness", "Infinity", "> 0 (Infinity allowed)"},
    {"solids%size_effect", "0.0", ">= 0"},
    {"solids%resistivity", "0.0, 0.0", ">= 0"},
    {"solids%friction", "0.0", ">= 0"},
    {"surface%source", "'synthetic'", ""},
    {"surface%n", "2048", "2 to 32768"},
    {"surface%hurst", "0.8", "0 to 1"},
    {"surface%L_lambda_l", "24.0", "1 to 32768"},
    {"surface%L_lambda_s", "512.0", "1 to 32768"},
    {"surface%L", "", "> 0"},
    {"surface%plateau", ".false.", ""},
    {"surface%sigma", "", "> 0"},
    {"surface%normalise", "'sample'", ""},
    {"surface%detrend", "'plane'", ""},
    {"surface%missing", "'refuse'", ""},
    {"surface%filter_cutoff", "0.0", ">= 0"},
    {"asperities%curvature", "'geometric'", ""},
    {"asperities%law", "'hertz'", ""},
    {"indentation%boundary", "'free'", ""},
    {"indentation%control", "'separation'", ""},
    {"indentation%start", "4.0", ""},
    {"indentation%stop", "1.0", ""},
    {"indentation%steps", "100", "1 to 1000000"},
    {"indentation%unit", "'sigma'", ""},
    {"indentation%spacing", "'linear'", ""},
    {"indentation%selection", "'overlap'", ""},
    {"indentation%selection_factor", "1.5", "> 0"},
    {"solver%method", "'auto'", ""},
    {"solver%tolerance", "1e-06", "1e-14 to 0.1"},
    {"solver%max_iterations", "100", "1 to 1000000"},
    {"solver%delta0", "0.01", "> 0 and <= 1000"},
    {"solver%interaction", "'point'", ""},
    {"elements%points_per_wave", "8.0", "4 to 64"},
    {"output%file", "'output/rsc.nc'", ""},
    {"output%contacts", "'auto'", ""},
    {"output%heights", ".false.", ""},
    {"output%map_cells", "50", "1 to 4096"},
    {"output%radial_bins", "50", "1 to 100000"},
    {"output%pdf_levels", "2.0, 2.5, 3.0", ""},
    {"output%pdf_bins", "60", "1 to 100000"},
    {"output%compression", "4", "0 to 9"},
};

void promises() {
    for (const Promise& p : kPromises) {
        const std::string name = p.key;
        const Key* key = find_key(name.substr(0, name.find('%')), name.substr(name.find('%') + 1));
        const bool as_promised = key && get_key(Case{}, name) == p.standard && key->bounds.text() == p.bounds;
        if (!as_promised)
            std::printf("%s: %s, %s\n", p.key, key ? get_key(Case{}, name).c_str() : "", key ? key->bounds.text().c_str() : "");
        CHECK(as_promised);
    }
}

// Each key is in each text, and a key's own description is the one it has in the whole.
void texts() {
    const std::string all = describe(""), page = manual_page(), standard = effective_namelist(Case{});
    for (const Key& key : registry()) {
        const std::string one = describe(std::string("&") + key.group + "%" + key.name), head = std::string("&") + key.group + "\n";
        CHECK(one.starts_with(head) && one.find(key.meaning) != std::string::npos);
        CHECK(all.find(one.substr(head.size())) != std::string::npos);
        CHECK(page.find(key.name) != std::string::npos && standard.find(std::string("\n  ") + key.name + " ") != std::string::npos);
    }
    CHECK(version_text() == "rsc " RSC_VERSION "\n" && page.find("\"rsc " RSC_VERSION "\"") != std::string::npos);
    for (const char* option : {"--check", "--describe", "--merge", "--resume", "--set", "--output"})
        CHECK(usage_text().find(option) != std::string::npos && page.find(std::string(option).substr(2)) != std::string::npos);
}

// Why a value is refused; empty if it is taken and given back.
std::string refusal(const std::string& name, const std::string& value) {
    Case c;
    if (name.starts_with("indenter%radii(")) c.indenter.radii[0] = c.indenter.radii[1] = 1.0;  // they are given both
    try {
        set_key(c, name, value);
    } catch (const Error& error) {
        return error.kind() == Failure::bad_input ? error.what() : "of another kind";
    }
    if (get_key(c, name) != value) return "taken as " + get_key(c, name);
    return {};
}

void expect(const std::string& name, const std::string& value, const std::string& word) {
    const std::string got = refusal(name, value);
    const bool right = word.empty() ? got.empty() : got.find(word) != std::string::npos;
    if (!right) std::printf("  %s = %s: '%s', expected '%s'\n", name.c_str(), value.c_str(), got.c_str(), word.c_str());
    CHECK(right);
}

void bounds_of(const Key& key, const std::string& name) {
    constexpr double infinity = Case::kInfinity;
    const bool whole = key.type == Type::integer;
    const Bounds& b = key.bounds;
    const auto text = [&](double v) { return whole ? std::to_string(static_cast<long long>(v)) : namelist::from_real(v); };
    const auto taken = [&](double v) { expect(name, text(v), ""); };
    const auto refused = [&](double v) { expect(name, text(v), "must be"); };
    const auto next = [&](double v, double to) { return whole ? v + (to > v ? 1 : -1) : std::nextafter(v, to); };
    if (!std::isfinite(b.low))
        taken(-1e50), refused(std::nextafter(-1e50, -infinity)), refused(-infinity);
    else if (!b.open)
        taken(b.low), refused(next(b.low, -infinity));
    else if (b.low == 0)
        refused(0), taken(1e-50), refused(9.99e-51);
    else
        refused(b.low), taken(std::nextafter(b.low, infinity));
    if (!std::isfinite(b.high))
        taken(1e50), refused(std::nextafter(1e50, infinity));
    else if (whole && b.high == std::numeric_limits<int>::max())
        taken(b.high), expect(name, "2147483648", "32 bits");
    else
        taken(b.high), refused(next(b.high, infinity));
    if (whole) return;
    if (name == "solids%E(1)")  // body 2 is rigid already
        expect(name, "Infinity", "rigid");
    else if (b.infinity)
        taken(infinity);
    else
        refused(infinity);
    refused(std::nan(""));
}

void bounds() {
    for (const Key& key : registry()) {
        const std::string name = std::string(key.group) + "%" + key.name, size = std::to_string(key.size);
        if (key.type == Type::integer || key.type == Type::real)
            for (int element = 1; element <= (key.list ? 1 : key.size); ++element)
                bounds_of(key, name + (key.size > 1 ? "(" + std::to_string(element) + ")" : ""));
        // A list has as many values as it says; a text as many characters.
        if (key.list) CHECK(refusal(name, size + "*0.25").starts_with("taken"));
        if (key.list) expect(name, size + "*0.25, 0.375", "too many values");
        if (!key.list && key.size == 2) expect(name, "0.25, 0.125, 1", "too many values");
        if (key.type == Type::string && name.find("unit") == std::string::npos) {
            const auto length = static_cast<std::size_t>(key.length);
            expect(name, "'" + std::string(length, 'x') + "'", "");
            expect(name, "'" + std::string(length + 1, 'x') + "'", std::to_string(length));
        }
        for (const char* choice : key.choices) expect(name, std::string("'") + choice + "'", "");
    }
}

}  // namespace

TESTS {
    promises();
    texts();
    bounds();
}
