#include "read/inputs.hpp"

#include "case/units.hpp"
#include "error.hpp"
#include "format.hpp"
#include "read/bytes.hpp"
#include "read/formats.hpp"
#include "read/input_netcdf.hpp"
#include "rough/measured_spectrum.hpp"

namespace rsc {
namespace {

std::vector<double> read_variable(const NetcdfInput& file, const char* name, const std::string& length_unit, int power,
                                  std::size_t rank = 1) {
    const auto variable = file.find(name);
    const auto refuse = [&](const std::string& what) { bad_input(file.path() + ": " + what); };
    if (!variable)
        refuse(std::string("there is no variable ") + name +
               "; it was expected as in the result of a measured map (surface%source = 'heights')");
    if (variable->lengths.size() != rank || !variable->numeric())
        refuse(std::string(name) + " over " + (rank == 1 ? "one dimension" : "two dimensions") + " was expected, not " + variable->shape());
    std::size_t count = 1;
    for (const std::size_t length : variable->lengths) count *= length;
    check_memory(file.path(), variable->shape(), 4.0 * static_cast<double>(count));
    std::vector<double> values(count);
    file.read(*variable, values.data());
    double factor = 1;
    if (const auto units = file.text_attribute(*variable, "units")) try {
            factor = length_factor(*units, length_unit, power);
        } catch (const Error& error) {
            refuse(std::string("the units of ") + name + ": " + error.what());
        }
    for (double& v : values) v *= factor;
    return values;
}

}  // namespace

InputSpectrum read_spectrum(const std::string& path, const std::string& length_unit, bool by_direction, bool heights) {
    InputSpectrum found;
    try {
        std::vector<double> wavenumber, psd;
        if (is_netcdf(path)) {
            const NetcdfInput file(path);
            const auto read = [&](const char* name, int power, std::size_t rank = 1) {
                return read_variable(file, name, length_unit, power, rank);
            };
            const auto exponent = [&](const char* name) {
                const auto given = file.numbers_attribute(*file.find(name), "twin_exponent");
                if (!given) return 0.0;
                if (given->size() != 1 || !((*given)[0] >= -kMostExponent && (*given)[0] <= 0))
                    bad_input(format("the attribute twin_exponent of %s must be one number from %g to 0", name, -kMostExponent));
                return (*given)[0];
            };
            if (by_direction) {
                const auto plane = read("psd_plane", 4, 2);
                const std::size_t angles = file.find("psd_plane")->lengths[1];
                const auto rings = read("plane_wavenumber", -1);
                found.plane = std::make_shared<const PlaneSpectrum>(rings, angles, tilted(plane, rings, exponent("psd_plane")));
            }
            if (heights)
                found.heights = std::make_shared<const HeightDistribution>(
                    HeightDistribution::of_quantiles(read("normal_score", 0), read("height_quantile", 1)));
            wavenumber = read("wavenumber", -1);
            psd = read("psd", 4);
            psd = tilted(std::move(psd), wavenumber, exponent("psd"));
        } else {
            if (by_direction || heights)
                bad_input(
                    "a text file has only the radial spectrum; surface%twins = 'directional' and surface%twin_heights = "
                    "'measured' need the result file of a measured map");
            const TextTable table = read_table(path, 2);
            for (std::size_t i = 0; i < table.rows; ++i) wavenumber.push_back(table.values[2 * i]), psd.push_back(table.values[2 * i + 1]);
        }
        found.table = std::make_shared<const SpectrumTable>(std::move(wavenumber), std::move(psd));
    } catch (const Error& error) {
        const std::string what = error.what();
        throw Error(error.kind(), what.starts_with(path) ? what : path + ": " + what);
    }
    return found;
}

}  // namespace rsc
