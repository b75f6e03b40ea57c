#include "read/input_spectrum.hpp"

#include "case/units.hpp"
#include "error.hpp"
#include "read/grid.hpp"
#include "read/input_netcdf.hpp"
#include "read/input_text.hpp"

namespace rsc {
namespace {

std::vector<double> read_variable(const NetcdfInput& file, const char* name, const std::string& length_unit, int power) {
    const auto variable = file.find(name);
    const auto refuse = [&](const std::string& what) { throw Error(Failure::bad_input, file.path() + ": " + what); };
    if (!variable)
        refuse(std::string("there is no variable ") + name +
               "; wavenumber and psd were expected, as in the result of a measured map (surface%source = 'heights')");
    if (variable->lengths.size() != 1 || !variable->numeric())
        refuse(std::string(name) + " over one dimension was expected, not " + variable->shape());
    check_memory(file.path(), variable->shape(), 4.0 * static_cast<double>(variable->lengths[0]));
    std::vector<double> values(variable->lengths[0]);
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

std::shared_ptr<const SpectrumTable> read_spectrum(const std::string& path, const std::string& length_unit) {
    std::vector<double> wavenumber, psd;
    if (is_netcdf(path)) {
        const NetcdfInput file(path);
        wavenumber = read_variable(file, "wavenumber", length_unit, -1);
        psd = read_variable(file, "psd", length_unit, 4);
    } else {
        const TextTable table = read_table(path, 2);
        for (std::size_t i = 0; i < table.rows; ++i) wavenumber.push_back(table.values[2 * i]), psd.push_back(table.values[2 * i + 1]);
    }
    try {
        return std::make_shared<const SpectrumTable>(std::move(wavenumber), std::move(psd));
    } catch (const Error& error) {
        throw Error(error.kind(), path + ": " + error.what());
    }
}

}  // namespace rsc
