// Units of length and force: what UDUNITS knows, what is refused, factors to the last bit.
#include "case/units.hpp"

#include <cstring>

#include "case/read_case.hpp"
#include "check.hpp"
#include "error.hpp"

using namespace rsc;

namespace {

void factors() {
    CHECK(length_factor("um", "mm") == 1e-3);
    CHECK(length_factor("mm", "um") == 1e3);
    CHECK(length_factor("nm", "mm") == 1e-6);
    CHECK(length_factor("\u00b5m", "m") == 1e-6);  // micro sign in UTF-8
    CHECK(length_factor("\xb5m", "m") == 1e-6);    // and in Latin-1
    CHECK(length_factor("\u00c5", "nm") == 0.1);
    CHECK(length_factor("micrometers", "um") == 1);
    CHECK(length_factor(" m ", "mm") == 1e3);
    CHECK(length_factor("inch", "mm") == 25.4);
    CHECK(length_factor("mile", "m") == 1609.344);
    CHECK(length_factor("mm-1", "um", -1) == 1e-3);
    CHECK(length_factor("1/um", "mm", -1) == 1e3);
    CHECK(length_factor("mm-3", "um", -3) == 1e-9);
    CHECK(length_factor("1", "", 1) == 1);
    CHECK(length_factor("banana", "banana") == 1);  // equal texts are not looked up
}

void refused(const char* from, const char* to, const char* words, int power = 1) {
    try {
        length_factor(from, to, power);
        CHECK(!"refused");
    } catch (const Error& error) {
        CHECK(error.kind() == Failure::bad_input);
        CHECK(std::strstr(error.what(), words));
    }
}

void refusals() {
    refused("banana", "mm", "'banana' is no unit;");
    refused("mm", "s", "'s' is no unit of length");
    refused("mm2", "mm", "'mm2' is no unit of length");
    refused("1", "mm", "'1' is no unit of length");
    refused("mm", "mm", "'mm' where a unit like (mm)-1 is expected", -1);
    refused("banana", "mm", "'banana' where a unit like (mm)-1 is expected", -1);
    refused("m @ 5", "mm", "'m @ 5' is no unit of length");  // its zero lies elsewhere
    for (const char* good : {"mm", "um", "m", "inch", "1", "", "10 um"}) CHECK(unit_problem(good, Quantity::length).empty());
    for (const char* good : {"N", "mN", "kgf", "1", ""}) CHECK(unit_problem(good, Quantity::force).empty());
    for (const char* bad : {"banana", "N", "s", "MM", "mm2"}) CHECK(!unit_problem(bad, Quantity::length).empty());
    for (const char* bad : {"banana", "mm", "Pa"}) CHECK(!unit_problem(bad, Quantity::force).empty());
}

// A case with a unit that is none is refused where it stands.
void in_a_case() {
    const auto message = [](const char* text) -> std::string {
        try {
            read_case_text(text, "case.nml");
            return "accepted";
        } catch (const Error& error) {
            return error.what();
        }
    };
    CHECK(message("&run length_unit='banana' /").starts_with("case.nml:1:18: &run: length_unit: 'banana' is no unit"));
    CHECK(message("&run\n force_unit='mm' /").starts_with("case.nml:2:13: &run: force_unit: 'mm' is no unit of force"));
    CHECK(message("&run length_unit='um', force_unit='mN' /") == "accepted");
}

}  // namespace

TESTS {
    factors();
    refusals();
    in_a_case();
}
