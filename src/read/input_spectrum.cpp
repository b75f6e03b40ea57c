#include "read/inputs.hpp"

#include "error.hpp"
#include "format.hpp"
#include "read/formats.hpp"
#include "read/input_netcdf.hpp"
#include "rough/measured_spectrum.hpp"

namespace rsc {
InputSpectrum read_spectrum(const std::string& path, const std::string& length_unit, bool by_direction, bool heights) {
    InputSpectrum found;
    try {
        std::vector<double> wavenumber, psd;
        if (is_netcdf(path)) {
            const NetcdfInput file(path);
            const auto read = [&](const char* name, int power, std::size_t rank = 1) {
                return file.values(name, rank, length_unit, power,
                                   "it was expected as in the result of a measured map (surface%source = 'heights')");
            };
            const auto exponent = [&](const char* name) {
                const auto given = file.numbers_attribute(*file.find(name), "twin_exponent");
                if (!given) return 0.0;
                if (given->size() != 1 || !(std::abs((*given)[0]) <= kMostExponent))
                    bad_input(
                        format("the attribute twin_exponent of %s must be one number from %g to %g", name, -kMostExponent, kMostExponent));
                return (*given)[0];
            };
            if (by_direction) {
                const auto plane = read("psd_plane", 4, 2);
                const std::size_t angles = file.find("psd_plane")->lengths[1];
                const auto rings = read("plane_wavenumber", -1);
                found.table = std::make_shared<const SpectrumTable>(rings, tilted(plane, rings, exponent("psd_plane")), angles);
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
        const auto radial = std::make_shared<const SpectrumTable>(std::move(wavenumber), std::move(psd));
        found.sigma = radial->sigma();
        if (!found.table) found.table = radial;
    } catch (const Error& error) {
        const std::string what = error.what();
        throw Error(error.kind(), what.starts_with(path) ? what : path + ": " + what);
    }
    return found;
}

}  // namespace rsc
