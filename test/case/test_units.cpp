// Units of length and force: what UDUNITS knows, what is refused, factors to the last bit.
#include "case/units.hpp"

#include <netcdf.h>

#include "support/refused.hpp"
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"

namespace test_units {

using namespace rsc;

TEST(factors) {
    CHECK(length_factor("um", "mm") == 1e-3);
    CHECK(length_factor("mm", "um") == 1e3);
    CHECK(length_factor("\u00b5m", "m") == 1e-6);  // micro sign in UTF-8
    CHECK(length_factor("\xb5m", "m") == 1e-6);    // and in Latin-1
    CHECK(length_factor("\u00c5", "nm") == 0.1);
    CHECK(length_factor(" m ", "mm") == 1e3);
    CHECK(length_factor("inch", "mm") == 25.4);
    CHECK(length_factor("mm-1", "um", -1) == 1e-3);
    CHECK(length_factor("1/um", "mm", -1) == 1e3);
    CHECK(length_factor("mm-3", "um", -3) == 1e-9);
    CHECK(length_factor("1", "", 1) == 1);
    CHECK(length_factor("banana", "banana") == 1);  // equal texts are not looked up
    CHECK(unit_factor("mN nm-2", "Pa") == 1e15 && unit_factor("1", "Pa") == 0 &&
          unit_factor("N", "Pa") == 0);
}

TEST(refusals) {
    REFUSED(length_factor("banana", "mm"), "'banana' is no unit;");
    REFUSED(length_factor("mm", "s"), "'s' is no unit of length");
    REFUSED(length_factor("mm2", "mm"), "'mm2' is no unit of length");
    REFUSED(length_factor("1", "mm"), "'1' is no unit of length");
    REFUSED(length_factor("mm", "mm", -1), "'mm' where a unit like (mm)-1 is expected");
    REFUSED(length_factor("banana", "mm", -1), "'banana' where a unit like (mm)-1 is expected");
    REFUSED(length_factor("m @ 5", "mm"),
            "'m @ 5' is no unit of length");  // its zero lies elsewhere
    for (const char* good : {"mm", "um", "m", "inch", "1", "", "10 um"})
        CHECK(unit_problem(good, Quantity::length).empty());
    for (const char* good : {"N", "mN", "kgf", "1", ""})
        CHECK(unit_problem(good, Quantity::force).empty());
    for (const char* bad : {"banana", "N", "s", "MM", "mm2"})
        CHECK(!unit_problem(bad, Quantity::length).empty());
    for (const char* bad : {"banana", "mm", "Pa"})
        CHECK(!unit_problem(bad, Quantity::force).empty());
}

// The same case in millimetres and newtons and in micrometres and millinewtons: every variable of
// the result changes as its units say.
void same_in_other_units(const Reader& mm, const Reader& um) {
    int variables = 0;
    nc_inq_nvars(mm.id(), &variables);
    CHECK(variables > 60);
    for (const int v : indices(variables)) {
        char name[NC_MAX_NAME + 1] = "";
        nc_inq_varname(mm.id(), v, name);
        // Numbers that round otherwise; the logarithm of a number with a unit.
        if (std::set<std::string>{"iterations", "products", "residual", "certificate",
                                  "permeability_log_mean"}
                .contains(name))
            continue;
        std::istringstream words(mm.text(name, "units"));
        std::string wanted;
        double factor = 1;
        for (std::string word; words >> word;) {
            const std::size_t letters = word.find_first_not_of("abcdefghijklmnopqrstuvwxyzN");
            const std::string unit = word.substr(0, letters);
            const double power =
                letters == std::string::npos ? 1 : std::atoi(word.c_str() + letters);
            if (unit == "mm" || unit == "N") factor *= std::pow(1e3, power);
            wanted += (wanted.empty() ? "" : " ") +
                      (unit == "mm"  ? "um"
                       : unit == "N" ? "mN"
                                     : unit) +
                      word.substr(unit.size());
        }
        const std::vector<double> one = mm.values(name), other = um.values(name);
        double largest = 0, worst = 0;
        for (std::size_t k = 0; k < std::min(one.size(), other.size()); ++k) {
            if (one[k] == NC_FILL_DOUBLE && other[k] == NC_FILL_DOUBLE) continue;
            largest = std::max(largest, std::abs(other[k]));
            worst = check::worse(worst, std::abs(other[k] - factor * one[k]));
        }
        const bool same = um.text(name, "units") == wanted && one.size() == other.size() &&
                          worst <= 1e-5 * largest;
        if (!same)
            std::printf("%s: %s, then %s, %g of %g\n", name, mm.text(name, "units").c_str(),
                        um.text(name, "units").c_str(), worst, largest);
        CHECK(same);
    }
}

const std::string kMm = "&run length_unit='mm' force_unit='N' / ",
                  kUm = "&run length_unit='um' force_unit='mN' / ";

TEST(every_variable) {
    const Folder folder;
    const auto result = [&](const std::string& units, const std::string& lengths,
                            const std::string& moduli) {
        return run_to(folder / "units.nc",
                      units + "&surface n=64 L_lambda_l=2 L_lambda_s=8 " + lengths +
                          " friction=0.25 " + moduli +
                          " / &indentation levels=1, 0.5 / &output map_cells=6 heights=.true. /");
    };
    const Reader mm = result(kMm, "L=2.0 sigma=0.01 / &solids R=3.0,5.0",
                             "E=1e3,3e3 resistivity=1e-5,3e-5"),
                 um = result(kUm, "L=2e3 sigma=10.0 / &solids R=3e3,5e3",
                             "E=1.0,3.0 resistivity=1e-2,3e-2");
    CHECK(mm.text("radial_pressure", "units") == "N mm-2" &&
          mm.text("map_pressure", "units") == "N mm-2");
    same_in_other_units(mm, um);
}

TEST(every_variable_of_flats) {
    const Folder folder;
    const auto result = [&](const std::string& units, const std::string& lengths,
                            const std::string& solids, const std::string& leak) {
        return run_to(folder / "units.nc",
                      units + "&surface n=64 L_lambda_l=4 L_lambda_s=12 " + lengths +
                          " / &solids R=Infinity,Infinity " + solids +
                          " / &solver model='elements' tolerance=1e-9 / &indentation "
                          "boundary='periodic' control='pressure' unit='relative' levels=0.02,0.1 "
                          "/ &output flow=.true. fields='gap','flow' field_levels=0.1 " +
                          leak + " /");
    };
    same_in_other_units(result(kMm, "L=2.0 sigma=0.01", "E=1e3,3e3 hardness=60.0 viscosity=1e-9",
                               "leak_drop=0.3 leak_length=2.0 leak_width=50.0"),
                        result(kUm, "L=2e3 sigma=10.0", "E=1.0,3.0 hardness=0.06 viscosity=1e-12",
                               "leak_drop=3e-4 leak_length=2e3 leak_width=5e4"));
}

TEST(every_variable_of_wear) {
    const Folder folder;
    const auto result = [&](const std::string& units, const std::string& lengths,
                            const std::string& solids, const std::string& sliding) {
        return run_to(folder / "units.nc",
                      units + "&surface n=64 L_lambda_l=2 L_lambda_s=8 " + lengths + " / &solids " +
                          solids +
                          " / &solver model='elements' tolerance=1e-9 / &indentation levels=1, 1 " +
                          sliding + " / &output map_cells=6 heights=.true. /");
    };
    same_in_other_units(result(kMm, "L=2.0 sigma=0.01", "R=3.0,5.0 E=1e3,3e3 wear_coefficient=1e-7",
                               "sliding=100.0"),
                        result(kUm, "L=2e3 sigma=10.0", "R=3e3,5e3 E=1.0,3.0 wear_coefficient=1e-4",
                               "sliding=1e5"));
}

}  // namespace test_units
