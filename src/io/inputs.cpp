#include "io/inputs.hpp"

#include <glob.h>

#include "base/error.hpp"
#include "case/units.hpp"
#include "io/formats.hpp"
#include "io/input_netcdf.hpp"
#include "surface/defects.hpp"

namespace rsc {

bool is_pattern(const std::string& name) { return name.find_first_of("*?[") != std::string::npos; }

std::vector<std::string> matching_files(const std::string& name) {
    if (!is_pattern(name)) return {name};
    glob_t found{};
    const int status = glob(name.c_str(), GLOB_NOSORT, nullptr, &found);
    std::vector<std::string> files;
    try {
        if (status == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    } catch (...) {
        globfree(&found);
        throw;
    }
    globfree(&found);
    if (status == GLOB_NOSPACE)
        throw Error(Failure::no_memory, "not enough memory for the files of " + name);
    if (files.empty()) bad_input(name + ": no file matches this pattern");
    std::sort(files.begin(), files.end());  // independent of the locale
    return files;
}

namespace {

constexpr double kUniform = 1e-6;      // tolerance of coordinates on a uniform grid, in steps
constexpr double kUniformText = 0.01;  // the same for coordinates in text files, which are rounded
constexpr double kSameL = 1e-6;        // relative tolerance of nx dx = L

void check_L(const std::string& path, double L) {
    if (!(L > 0 && std::isfinite(L)))
        bad_input(path + ": L must be positive and finite, not " + text_of(L));
}

// nx dx must equal the given L, if any.
void check_given_L(const std::string& path, const std::string& coordinate, int nx, double dx,
                   std::optional<double> L) {
    if (!L) return;
    check_L(path, *L);
    const double extent = nx * dx;
    if (!(std::abs(extent - *L) <= kSameL * *L))
        bad_input(path + ": its coordinate " + coordinate + " spans " + std::to_string(nx) +
                  " steps of " + text_of(dx) + " = " + text_of(extent) +
                  ", but L = " + text_of(*L) + " was given");
}

// The uniform grid of one coordinate of x y z triples.
struct TextAxis {
    double first = 0, step = 0;
    std::size_t count = 0;
    std::size_t index(double c) const {
        return static_cast<std::size_t>(std::lround((c - first) / step));
    }
};

TextAxis text_axis(const std::string& path, const TextTable& table, std::size_t column,
                   const char* name) {
    std::vector<double> c(table.rows);
    for (std::size_t i = 0; i < table.rows; ++i) {
        c[i] = table.values[3 * i + column];
        if (std::isnan(c[i]))
            bad_input(path + ":" + std::to_string(table.line[i]) +
                      ": three columns are read as x y z of a map; " + name + " is missing");
    }
    std::sort(c.begin(), c.end());
    TextAxis axis;
    axis.first = c.front();
    const double range = c.back() - c.front(),
                 same =
                     1e-3 * range / static_cast<double>(table.rows);  // less than any uniform step
    axis.count = 1;
    for (std::size_t i = 1; i < c.size(); ++i) axis.count += c[i] - c[i - 1] > same ? 1 : 0;
    if (axis.count < 2)
        bad_input(path + ": three columns are read as x y z of a map; column " + name + " is " +
                  text_of(axis.first) + " throughout");
    axis.step = range / static_cast<double>(axis.count - 1);
    for (std::size_t i = 0; i < table.rows; ++i) {
        const double v = table.values[3 * i + column];
        const double uniform = axis.first + static_cast<double>(axis.index(v)) * axis.step;
        if (!(std::abs(v - uniform) <= kUniformText * axis.step))
            bad_input(path + ":" + std::to_string(table.line[i]) +
                      ": three columns are read as x y z of a map; " + name + " = " + text_of(v) +
                      " is not on a uniform grid of " + std::to_string(axis.count) +
                      " values from " + text_of(c.front()) + " to " + text_of(c.back()));
    }
    return axis;
}

HeightMap read_text_triples(const std::string& path, const TextTable& table,
                            std::optional<double> L, bool missing, const TextMap& text) {
    if (text.pixel)
        bad_input(path +
                  ": three columns are read as x y z of a map, which define the step; "
                  "surface%pixel is for a matrix");
    const TextAxis x = text_axis(path, table, 0, "x"), y = text_axis(path, table, 1, "y");
    check_grid(path, x.count, y.count);
    HeightMap map = allocate_map(x.count, y.count);
    std::vector<long> line(x.count * y.count);
    for (std::size_t i = 0; i < table.rows; ++i) {
        const double* const row = table.values.data() + 3 * i;
        const std::size_t point = y.index(row[1]) * x.count + x.index(row[0]);
        if (line[point] > 0)
            bad_input(path + ":" + std::to_string(table.line[i]) + ": x = " + text_of(row[0]) +
                      ", y = " + text_of(row[1]) + " is already in line " +
                      std::to_string(line[point]));
        line[point] = table.line[i];
        map.data[point] = row[2];
    }
    for (std::size_t k = 0; missing && k < line.size();
         ++k)  // a point that is not listed is missing
        if (line[k] == 0) map.data[k] = std::nan(""), line[k] = -1;
    if (const auto empty = std::find(line.begin(), line.end(), 0L); empty != line.end()) {
        const auto point = static_cast<std::size_t>(empty - line.begin());
        bad_input(path + ": three columns are read as x y z of a map of " +
                  std::to_string(x.count) + " x " + std::to_string(y.count) +
                  " points, but there is none at x = " +
                  text_of(x.first + static_cast<double>(point % x.count) * x.step) +
                  ", y = " + text_of(y.first + static_cast<double>(point / x.count) * y.step));
    }
    map.x0 = x.first;
    map.y0 = y.first;
    map.dx = x.step;
    map.dy = y.step;
    check_given_L(path, "x", map.nx, map.dx, L);
    return map;
}

HeightMap read_text_points(const std::string& path, const TextTable& table, std::optional<double> L,
                           bool missing, const TextMap& text) {
    if (table.columns == 3) return read_text_triples(path, table, L, missing, text);
    if (table.columns == 4)
        bad_input(path +
                  ": four columns are a list of asperities x y z r (surface%source='asperities'), "
                  "not a map");
    if (!L && !text.pixel)
        bad_input(path +
                  ": a text matrix has no spacing; surface%pixel must be given, or of body 1 "
                  "surface%L, its extent in x");
    if (L) check_L(path, *L);
    check_grid(path, table.columns, table.rows);
    HeightMap map = allocate_map(table.columns, table.rows);
    std::copy(table.values.begin(), table.values.end(), map.data.get());
    map.dx = map.dy = text.pixel ? *text.pixel : *L / map.nx;
    if (text.pixel) check_given_L(path, "x", map.nx, map.dx, L);
    return map;
}

HeightMap read_text_heights(const std::string& path, std::optional<double> L, bool missing,
                            const TextMap& text, const std::string& length_unit) {
    const TextTable table = read_table(path, 0, missing);
    HeightMap map = read_text_points(path, table, L, missing, text);
    if (text.height_unit.empty() && !table.unit.empty() && table.unit != length_unit)
        bad_input(path + ": its heights are in '" + table.unit +
                  "', says a comment; surface%height_unit must be given");
    if (!text.height_unit.empty())
        scale_heights(map, length_factor(text.height_unit, length_unit, 1));
    return map;
}

// A uniform axis: value of point 0 (the smallest) and the step; `reversed` if the file counts
// downwards.
struct Axis {
    double first = 0, step = 0;
    bool reversed = false;
};

std::optional<Axis> read_axis(const NetcdfInput& file, const NetcdfInput::Variable& heights,
                              std::size_t dimension) {
    const std::string& name = heights.axes[dimension];
    const auto variable = file.find(name);
    if (!variable || variable->dimensions != std::vector<int>{heights.dimensions[dimension]} ||
        !variable->numeric())
        return std::nullopt;
    const std::size_t n = variable->lengths[0];
    std::vector<double> c(n);
    file.read(*variable, c.data());
    Axis axis;
    axis.reversed = c.back() < c.front();
    if (axis.reversed) std::reverse(c.begin(), c.end());
    axis.first = c.front();
    axis.step = (c.back() - c.front()) / static_cast<double>(n - 1);
    if (!(axis.step > 0))
        bad_input(file.path() + ": coordinate " + name + " does not vary: it begins and ends at " +
                  text_of(c.front()));
    // Tolerance for the rounding of coordinates stored in single precision.
    const double largest = std::max(std::abs(c.front()), std::abs(c.back()));
    const double rounding = variable->type == NC_FLOAT ? 1.2e-7 * largest : 4.5e-16 * largest;
    for (std::size_t i = 0; i < n; ++i) {
        const double uniform = axis.first + static_cast<double>(i) * axis.step;
        if (std::abs(c[i] - uniform) > kUniform * axis.step + rounding)
            bad_input(file.path() + ": coordinate " + name +
                      " is not uniform to 1e-6 of its step " + text_of(axis.step) + ": " + name +
                      "(" + std::to_string(axis.reversed ? n - 1 - i : i) +
                      "), counted from 0, is " + text_of(c[i]) + " where " + text_of(uniform) +
                      " was expected");
    }
    return axis;
}

NetcdfInput::Variable find_heights(const NetcdfInput& file, const std::string& channel) {
    const auto is_map = [](const NetcdfInput::Variable& v) {
        return v.lengths.size() == 2 && v.numeric();
    };
    if (const auto named = file.find(channel.empty() ? "height" : channel)) {
        if (is_map(*named)) return *named;
        bad_input(file.path() + ": " +
                  (channel.empty()
                       ? "height(y, x), numeric,"
                       : "channel '" + channel + "': a numeric variable of two dimensions") +
                  " was expected, not " + named->shape());
    }
    if (!channel.empty()) bad_input(file.path() + ": there is no variable '" + channel + "'");
    std::vector<NetcdfInput::Variable> maps;
    std::string names;
    for (const auto& v : file.variables())
        if (is_map(v)) {
            names += (maps.empty() ? "" : ", ") + v.shape();
            maps.push_back(v);
        }
    if (maps.empty())
        bad_input(file.path() +
                  ": there is no variable height(y, x) and no other of two dimensions");
    if (maps.size() > 1)
        bad_input(file.path() +
                  ": there is no variable height(y, x), and several others have two dimensions: " +
                  names);
    return maps[0];
}

// Factors of heights, x and y. Heights in nanometres with coordinates in micrometres are common,
// and without conversion slopes would be
// 1000 times too large. If only some variables have units, the unit of the others is unknown.
std::array<double, 3> unit_factors(const NetcdfInput& file, const NetcdfInput::Variable& heights,
                                   const std::string& length_unit, bool coordinates) {
    std::vector<NetcdfInput::Variable> all = {heights};
    if (coordinates)
        for (const std::size_t dimension : {1, 0})
            all.push_back(*file.find(heights.axes[dimension]));
    std::array<double, 3> factor{1, 1, 1};
    const NetcdfInput::Variable *with = nullptr, *without = nullptr;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto known = file.unit_factor(all[k], length_unit);
        if (!known)
            without = &all[k];
        else if ((factor[k] = *known) != 1)
            with = &all[k];
    }
    if (with && without)
        bad_input(file.path() + ": " + with->name + " is in '" +
                  file.text_attribute(*with, "units").value_or("") + "', but " + without->name +
                  " has no attribute units, so its unit is unknown");
    return factor;
}

HeightMap read_netcdf_heights(const std::string& path, std::optional<double> L,
                              const std::string& length_unit, const std::string& channel,
                              bool missing) {
    const NetcdfInput file(path);
    const auto variable = find_heights(file, channel);
    check_grid(path, variable.lengths[1], variable.lengths[0]);
    if (variable.axes[0] == "x" && variable.axes[1] == "y")
        bad_input(path + ": " + variable.shape() +
                  " has y running fastest; (y, x) was expected (ncpdq -a y,x makes it so)");
    const auto x = read_axis(file, variable, 1), y = read_axis(file, variable, 0);
    if (x.has_value() != y.has_value())
        bad_input(path + ": " + variable.shape() +
                  " has a coordinate variable for only one dimension; both or none were expected");
    if (!x && !L)
        bad_input(path + ": " + variable.shape() +
                  " has no coordinate variables; they must be given, or of body 1 surface%L, its "
                  "extent in x");
    HeightMap map = allocate_map(variable.lengths[1], variable.lengths[0]);
    if (L) {
        check_L(path, *L);
        map.dx = map.dy = *L / map.nx;
    }
    const auto [factor_z, factor_x, factor_y] =
        unit_factors(file, variable, length_unit, x.has_value());
    if (x) {
        map.x0 = x->first * factor_x;
        map.y0 = y->first * factor_y;
        map.dx = x->step * factor_x;
        map.dy = y->step * factor_y;
        check_given_L(path, variable.axes[1], map.nx, map.dx, L);
    }
    file.read(variable, map.data.get(), missing);
    scale_heights(map, factor_z);
    if (x && x->reversed) reverse_columns(map);
    if (y && y->reversed) reverse_rows(map);
    return map;
}

std::string first_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string start(4096, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    return start;
}

// The formats of instruments, recognised by a file's first bytes. They include sizes and units.
struct InstrumentFormat {
    const char* name;
    bool (*is)(const std::string& first_bytes);
    HeightMap (*read)(const std::string& path, const std::string& channel,
                      const std::string& length_unit);
    bool channels;  // a file has several maps, possibly with masks
};
constexpr InstrumentFormat kInstrumentFormats[] = {
    {".gwy", is_gwy, read_gwy, true},
    {".sdf", is_sdf,
     [](const std::string& path, const std::string&, const std::string& unit) {
         return read_sdf(path, unit);
     },
     false},
};

// A binary file of no known format is refused; the message says how to convert it.
void refuse_unknown(const std::string& path, const std::string& start) {
    if (start.find('\0') == std::string::npos || start.substr(0, 2) == "\xff\xfe" ||
        start.substr(0, 2) == "\xfe\xff")
        return;
    std::string names = ": neither NetCDF, ";
    for (const InstrumentFormat& format : kInstrumentFormats)
        names +=
            std::string(format.name) + (&format == std::end(kInstrumentFormats) - 1 ? " " : ", ");
    bad_input(path + names +
              "nor text. Gwyddion reads the files of most instruments: gwyddion "
              "--convert-to-gwy=map.gwy '" +
              path + "' makes one that rsc reads");
}

Asperities read_netcdf_asperities(const std::string& path, const std::string& length_unit) {
    const NetcdfInput file(path);
    Asperities a;
    const bool curvatures =
        file.find("asperity_kappa1") && file.find("asperity_kappa2") && file.find("asperity_angle");
    for (const AsperityColumn& column : kAsperityColumns) {
        const bool of_curvatures = column.values == &Asperities::kappa1 ||
                                   column.values == &Asperities::kappa2 ||
                                   column.values == &Asperities::angle;
        if (of_curvatures && !curvatures) continue;
        const std::string name = "asperity_" + std::string(column.name);
        const auto variable = file.find(name);
        if (!variable && !column.required && !of_curvatures) continue;
        std::vector<double>& values = a.*column.values;
        values =
            file.values(name, 1, length_unit, column.length_power,
                        "asperity_x, asperity_y, asperity_z and asperity_radius were expected");
        if (values.size() != a.x.size())
            bad_input(path + ": " + variable->shape() + ": " + std::to_string(a.x.size()) +
                      " values as of asperity_x were expected");
        if (values.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
            bad_input(path + ": " + variable->shape() + ": more than 2147483647 asperities");
    }
    if (a.size() == 0) bad_input(path + ": there is no asperity in it");
    validate(a, [&](std::size_t i) {
        return path + ": asperity " + std::to_string(i) + ", counted from 0";
    });
    return a;
}

Asperities read_text_asperities(const std::string& path) {
    const TextTable table = read_table(path, 4);
    Asperities a;
    for (std::size_t i = 0; i < table.rows; ++i) {
        const double* const row = table.values.data() + 4 * i;
        a.x.push_back(row[0]), a.y.push_back(row[1]), a.z.push_back(row[2]),
            a.radius.push_back(row[3]);
    }
    validate(a, [&](std::size_t i) { return path + ":" + std::to_string(table.line[i]); });
    return a;
}

}  // namespace

bool is_text_map(const std::string& path) {
    if (is_netcdf(path)) return false;
    const std::string start = first_bytes(path);
    return std::none_of(std::begin(kInstrumentFormats), std::end(kInstrumentFormats),
                        [&](const auto& format) { return format.is(start); });
}

HeightMap read_heights(const std::string& path, std::optional<double> L,
                       const std::string& length_unit, const std::string& channel, Missing missing,
                       const TextMap& text) {
    const bool fill = missing == Missing::fill;
    const bool netcdf = is_netcdf(path);
    const std::string start = first_bytes(path);
    const auto* const found =
        std::find_if(std::begin(kInstrumentFormats), std::end(kInstrumentFormats),
                     [&](const InstrumentFormat& format) { return !netcdf && format.is(start); });
    const InstrumentFormat* const instrument =
        found == std::end(kInstrumentFormats) ? nullptr : found;
    const bool channels = instrument && instrument->channels;
    if (!channel.empty() && !netcdf && !channels)
        bad_input(path + ": has no channel '" + channel +
                  "'; only .gwy and NetCDF files have channels");
    if (!netcdf && !instrument) refuse_unknown(path, start);
    if ((netcdf || instrument) && text.any())
        bad_input(
            path +
            ": is not a text file; surface%height_unit and surface%pixel are only for text files");
    HeightMap map = netcdf       ? read_netcdf_heights(path, L, length_unit, channel, fill)
                    : instrument ? instrument->read(path, channel, length_unit)
                                 : read_text_heights(path, L, fill, text, length_unit);
    if (instrument) check_given_L(path, "x", map.nx, map.dx, L);
    for (const double step : {map.dx, map.dy})
        if (!usable_positive(step))
            bad_input(path + ": the spacing " + kPositiveBounds + ", not " + text_of(step));
    for (const double origin : {map.x0, map.y0})
        if (!usable(origin))
            bad_input(path + ": the first coordinate " + kNumberBounds + ", not " +
                      text_of(origin));
    for (int j = 0; j < map.ny; ++j)
        for (int i = 0; i < map.nx; ++i) {
            const double z = map(i, j);
            if (usable(z) || (fill && std::isnan(z))) continue;
            const std::string place = " in column " + std::to_string(i) + " of row " +
                                      std::to_string(j) + ", counted from 0" +
                                      (instrument ? " with y upwards" : "");
            if (std::isnan(z))
                bad_input(path + ": " + std::to_string(count_missing(map)) + " of " +
                          std::to_string(static_cast<long>(map.nx) * map.ny) +
                          " points are missing" + (channels ? " or masked" : "") + ", the first" +
                          place + "; surface%missing = 'fill' fills them");
            bad_input(path + ": a height " + kNumberBounds + ", not " + text_of(z) + " as" + place);
        }
    return map;
}

Asperities read_asperities(const std::string& path, const std::string& length_unit) {
    return is_netcdf(path) ? read_netcdf_asperities(path, length_unit) : read_text_asperities(path);
}

InputSpectrum read_spectrum(const std::string& path, const std::string& length_unit,
                            bool by_direction, bool heights) {
    InputSpectrum found;
    try {
        std::vector<double> wavenumber, psd;
        if (is_netcdf(path)) {
            const NetcdfInput file(path);
            const auto read = [&](const char* name, int power, std::size_t rank = 1) {
                return file.values(name, rank, length_unit, power,
                                   "it was expected as in the result of a measured map "
                                   "(surface%source = 'heights')");
            };
            const auto exponent = [&](const char* name) {
                const auto given = file.numbers_attribute(*file.find(name), "twin_exponent");
                if (!given) return 0.0;
                if (given->size() != 1 || !(std::abs((*given)[0]) <= kMostExponent))
                    bad_input(
                        format("the attribute twin_exponent of %s must be one number from %g to %g",
                               name, -kMostExponent, kMostExponent));
                return (*given)[0];
            };
            if (by_direction) {
                const auto plane = read("psd_plane", 4, 2);
                const std::size_t angles = file.find("psd_plane")->lengths[1];
                const auto rings = read("plane_wavenumber", -1);
                found.table = std::make_shared<const SpectrumTable>(
                    rings, tilted(plane, rings, exponent("psd_plane")), angles);
            }
            if (heights)
                found.heights =
                    std::make_shared<const HeightDistribution>(HeightDistribution::of_quantiles(
                        read("normal_score", 0), read("height_quantile", 1)));
            wavenumber = read("wavenumber", -1);
            psd = read("psd", 4);
            psd = tilted(std::move(psd), wavenumber, exponent("psd"));
        } else {
            if (by_direction || heights)
                bad_input(
                    "a text file has only the radial spectrum; surface%twins = 'directional' and "
                    "surface%twin_heights = "
                    "'measured' need the result file of a measured map");
            const TextTable table = read_table(path, 2);
            for (std::size_t i = 0; i < table.rows; ++i)
                wavenumber.push_back(table.values[2 * i]), psd.push_back(table.values[2 * i + 1]);
        }
        const auto radial =
            std::make_shared<const SpectrumTable>(std::move(wavenumber), std::move(psd));
        found.sigma = radial->sigma();
        if (!found.table) found.table = radial;
    } catch (const Error& error) {
        const std::string what = error.what();
        throw Error(error.kind(), what.starts_with(path) ? what : path + ": " + what);
    }
    return found;
}

}  // namespace rsc
