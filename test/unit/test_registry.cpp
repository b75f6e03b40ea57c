// What rsc tells of its keys and options, word by word, against test/data/said (defaults, units, bounds and meanings as interface and
// README promise them); and that every number is taken up to its bound and refused beyond it, with the bound named.
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "case/manual.hpp"
#include "case/namelist_value.hpp"
#include "case/options.hpp"
#include "case/registry.hpp"
#include "check.hpp"
#include "error.hpp"
#include "version.h"

using namespace rsc;

namespace {

// Line by line, so that the one that differs is shown. Where a change is meant: ./rsc OPTION > test/data/said/NAME.
void same_text(const std::string& said, const char* name) {
    std::ifstream in(std::string(RSC_TEST_DATA "/said/") + name, std::ios::binary);
    const std::string expected((std::istreambuf_iterator<char>(in)), {});
    CHECK(!expected.empty() && said == expected);
    std::size_t at = 0;
    while (at < said.size() && at < expected.size() && said[at] == expected[at]) ++at;
    if (said == expected) return;
    const auto line = [&](const std::string& text) {
        const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
        return text.substr(begin, text.find('\n', at) - begin);
    };
    std::printf("  %s: said      %s\n  expected: %s\n", name, line(said).c_str(), line(expected).c_str());
}

void texts() {
    same_text(describe(""), "describe.txt");
    same_text(usage_text(), "help.txt");
    same_text(effective_namelist(Case{}), "defaults.txt");
    std::string page = manual_page();
    const std::string version = "\"rsc " RSC_VERSION "\"";
    CHECK(page.find(version) != std::string::npos);
    if (const auto at = page.find(version); at != std::string::npos) page.replace(at, version.size(), "\"rsc VERSION\"");
    same_text(page, "manual.txt");
    CHECK(version_text() == "rsc " RSC_VERSION "\n");
    // A group, and a key, are their part of the whole.
    std::string all;
    for (const std::string_view group : group_names()) all += (all.empty() ? "" : "\n") + describe(group);
    CHECK(all == describe(""));
    for (const Key& key : registry()) {
        const std::string one = describe(std::string("&") + key.group + "%" + key.name), head = std::string("&") + key.group + "\n";
        CHECK(one.starts_with(head) && describe(key.group).find(one.substr(head.size())) != std::string::npos);
    }
}

std::string refusal(const std::string& name, const std::string& value) {
    Case c;
    try {
        set_key(c, name, value);
    } catch (const Error& error) {
        return error.kind() == Failure::bad_input ? error.what() : "of another kind";
    }
    // What was taken is what is there.
    if (get_key(c, name) != value) return "taken as " + get_key(c, name);
    return {};
}

void expect(const std::string& name, const std::string& value, const std::string& said) {
    const std::string got = refusal(name, value);
    if (got != said) std::printf("  %s = %s: '%s', expected '%s'\n", name.c_str(), value.c_str(), got.c_str(), said.c_str());
    CHECK(got == said);
}

// At the bounds of describe.txt, for each element of an array.
void bounds() {
    constexpr double infinity = Case::kInfinity;
    int numbers = 0;
    for (const Key& key : registry()) {
        const bool whole = key.type == Type::integer;
        if (!whole && key.type != Type::real) continue;
        ++numbers;
        const Bounds& b = key.bounds;
        for (int element = 1; element <= (key.list ? 1 : key.size); ++element) {
            const std::string index = key.size > 1 ? "(" + std::to_string(element) + ")" : "";
            const std::string name = std::string(key.group) + "%" + key.name + index, at_start = key.name + index + " = ";
            const auto text = [&](double v) { return whole ? std::to_string(static_cast<long long>(v)) : namelist::from_real(v); };
            const auto taken = [&](double v) { expect(name, text(v), ""); };
            const auto refused = [&](double v, const std::string& must) {
                expect(name, text(v), at_start + text(v) + ": must be " + must);
            };
            const auto next = [&](double v, double to) { return whole ? v + (to > v ? 1 : -1) : std::nextafter(v, to); };
            const std::string must = b.text().empty() ? "finite" : b.text(), magnitude = "of a magnitude from 1e-50 to 1e50";
            if (std::isfinite(b.low)) {
                if (b.open)
                    refused(b.low, must);
                else
                    taken(b.low), refused(next(b.low, -infinity), must);
                if (b.open && b.low == 0)
                    taken(1e-50), refused(9.99e-51, magnitude);
                else if (b.open)
                    taken(std::nextafter(b.low, infinity));
            } else {
                taken(-1e50), refused(std::nextafter(-1e50, -infinity), magnitude), refused(-infinity, must);
            }
            if (std::isfinite(b.high)) {
                taken(b.high);
                if (whole && b.high == std::numeric_limits<int>::max())
                    expect(name, "2147483648", std::string(key.name) + ": '2147483648' is not an integer of 32 bits");
                else
                    refused(next(b.high, infinity), must);
            } else {
                taken(1e50), refused(std::nextafter(1e50, infinity), magnitude);
            }
            if (whole) continue;
            if (name == "solids%E(1)")  // body 2 is rigid already
                expect(name, "Infinity", "E = Infinity, Infinity: two rigid bodies do not deform, one at most may be rigid");
            else if (b.infinity)
                taken(infinity);
            else
                refused(infinity, must);
            refused(std::nan(""), must);
        }
    }
    CHECK(numbers == 33);
    // A list has as many values as it says; a text as many characters.
    for (const Key& key : registry()) {
        const std::string name = std::string(key.group) + "%" + key.name;
        const auto said = [&](const std::string& value) {
            Case c;
            try {
                set_key(c, name, value);
            } catch (const Error& error) {
                return std::string(error.what());
            }
            return std::string();
        };
        const std::string size = std::to_string(key.size);
        if (key.list) {
            CHECK(said(size + "*1.5").empty());
            CHECK(said(size + "*1.5, 2.5") == key.name + (": too many values: " + size) + " values at most, found '2.5'");
        } else if (key.size == 2) {
            CHECK(said("0.25, 0.125").empty() &&
                  said("0.25, 0.125, 1") == key.name + std::string(": too many values: 2 values at most, found '1'"));
        }
        if (key.type == Type::string && std::string(key.name).find("unit") == std::string::npos) {
            const auto length = static_cast<std::size_t>(key.length);
            CHECK(said("'" + std::string(length, 'x') + "'").empty());
            CHECK(said("'" + std::string(length + 1, 'x') + "'") ==
                  key.name + (": a text of more than " + std::to_string(key.length)) + " characters");
        }
        // Each choice is the one of its name.
        for (const char* choice : key.choices) expect(name, std::string("'") + choice + "'", "");
    }
}

// The names of enumerations, beside the enumerators.
void names() {
    const struct {
        const char *key, *value;
        bool (*is)(const Case&);
    } rows[] = {
        {"surface%source", "'synthetic'", [](const Case& c) { return c.surface.source == Source::synthetic; }},
        {"surface%source", "'heights'", [](const Case& c) { return c.surface.source == Source::heights; }},
        {"surface%source", "'asperities'", [](const Case& c) { return c.surface.source == Source::asperities; }},
        {"surface%source", "'spectrum'", [](const Case& c) { return c.surface.source == Source::spectrum; }},
        {"surface%normalise", "'sample'", [](const Case& c) { return c.surface.normalise == Normalise::sample; }},
        {"surface%normalise", "'ensemble'", [](const Case& c) { return c.surface.normalise == Normalise::ensemble; }},
        {"surface%detrend", "'none'", [](const Case& c) { return c.surface.detrend == Detrend::none; }},
        {"surface%detrend", "'mean'", [](const Case& c) { return c.surface.detrend == Detrend::mean; }},
        {"surface%detrend", "'plane'", [](const Case& c) { return c.surface.detrend == Detrend::plane; }},
        {"surface%detrend", "'quadratic'", [](const Case& c) { return c.surface.detrend == Detrend::quadratic; }},
        {"surface%detrend", "'sphere'", [](const Case& c) { return c.surface.detrend == Detrend::sphere; }},
        {"surface%missing", "'refuse'", [](const Case& c) { return c.surface.missing == Missing::refuse; }},
        {"surface%missing", "'fill'", [](const Case& c) { return c.surface.missing == Missing::fill; }},
        {"asperities%curvature", "'geometric'", [](const Case& c) { return c.asperities.curvature == Curvature::geometric; }},
        {"asperities%curvature", "'algebraic'", [](const Case& c) { return c.asperities.curvature == Curvature::algebraic; }},
        {"asperities%law", "'hertz'", [](const Case& c) { return c.asperities.law == LawKind::hertz; }},
        {"asperities%law", "'elliptic'", [](const Case& c) { return c.asperities.law == LawKind::elliptic; }},
        {"asperities%law", "'fourth_order'", [](const Case& c) { return c.asperities.law == LawKind::fourth_order; }},
        {"indentation%boundary", "'free'", [](const Case& c) { return c.indentation.boundary == Boundary::free; }},
        {"indentation%boundary", "'periodic'", [](const Case& c) { return c.indentation.boundary == Boundary::periodic; }},
        {"indentation%control", "'separation'", [](const Case& c) { return c.indentation.control == Control::separation; }},
        {"indentation%control", "'force'", [](const Case& c) { return c.indentation.control == Control::force; }},
        {"indentation%control", "'pressure'", [](const Case& c) { return c.indentation.control == Control::pressure; }},
        {"indentation%unit", "'sigma'", [](const Case& c) { return c.indentation.unit == LevelUnit::sigma; }},
        {"indentation%unit", "'length'", [](const Case& c) { return c.indentation.unit == LevelUnit::length; }},
        {"indentation%unit", "'relative'", [](const Case& c) { return c.indentation.unit == LevelUnit::relative; }},
        {"indentation%unit", "'pressure'", [](const Case& c) { return c.indentation.unit == LevelUnit::pressure; }},
        {"indentation%spacing", "'linear'", [](const Case& c) { return c.indentation.spacing == Spacing::linear; }},
        {"indentation%spacing", "'log'", [](const Case& c) { return c.indentation.spacing == Spacing::log; }},
        {"indentation%selection", "'overlap'", [](const Case& c) { return c.indentation.selection == Selection::overlap; }},
        {"indentation%selection", "'paper'", [](const Case& c) { return c.indentation.selection == Selection::paper; }},
        {"solver%method", "'auto'", [](const Case& c) { return c.solver.method == Method::automatic; }},
        {"solver%method", "'dgesv'", [](const Case& c) { return c.solver.method == Method::dgesv; }},
        {"solver%method", "'direct'", [](const Case& c) { return c.solver.method == Method::direct; }},
        {"solver%method", "'mesh'", [](const Case& c) { return c.solver.method == Method::mesh; }},
        {"solver%interaction", "'point'", [](const Case& c) { return c.solver.interaction == Interaction::point; }},
        {"solver%interaction", "'none'", [](const Case& c) { return c.solver.interaction == Interaction::none; }},
        {"solver%model", "'asperities'", [](const Case& c) { return c.solver.model == Model::asperities; }},
        {"solver%model", "'elements'", [](const Case& c) { return c.solver.model == Model::elements; }},
        {"output%format", "'netcdf4'", [](const Case& c) { return c.output.format == Format::netcdf4; }},
        {"output%format", "'cdf5'", [](const Case& c) { return c.output.format == Format::cdf5; }},
        {"output%format", "'classic'", [](const Case& c) { return c.output.format == Format::classic; }},
        {"output%contacts", "'auto'", [](const Case& c) { return c.output.contacts == Contacts::automatic; }},
        {"output%contacts", "'none'", [](const Case& c) { return c.output.contacts == Contacts::none; }},
        {"output%contacts", "'last'", [](const Case& c) { return c.output.contacts == Contacts::last; }},
        {"output%contacts", "'all'", [](const Case& c) { return c.output.contacts == Contacts::all; }},
    };
    std::size_t choices = 0;
    for (const Key& key : registry()) choices += key.choices.size();
    CHECK(choices == std::size(rows));
    for (const auto& row : rows) {
        Case c;
        set_key(c, row.key, row.value);
        if (!row.is(c)) std::printf("  %s = %s is another\n", row.key, row.value);
        CHECK(row.is(c));
    }
}

}  // namespace

int main() {
    texts();
    bounds();
    names();
    return check::summary();
}
