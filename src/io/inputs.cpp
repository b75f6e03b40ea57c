#include "io/inputs.hpp"

#include <glob.h>

#include "base/error.hpp"
#include "case/units.hpp"
#include "io/formats.hpp"
#include "io/input_netcdf.hpp"
#include "io/map_parts.hpp"
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
        throw Error(Failure::no_memory, "not enough memory for the files of ", name);
    if (files.empty()) bad_input(name, ": no file matches this pattern");
    std::ranges::sort(files);  // independent of the locale
    return files;
}

namespace {

using Mention = TextTable::UnitMention;

constexpr double kUniform = 1e-6;      // tolerance of coordinates on a uniform grid, in steps
constexpr double kUniformText = 0.01;  // the same for coordinates in text files, which are rounded
constexpr double kSameL = 1e-6;        // relative tolerance of nx dx = L

void check_L(const std::string& path, double L) {
    if (!(L > 0 && std::isfinite(L))) bad_input(path, ": L must be positive and finite, not ", L);
}

}  // namespace

// nx dx must equal the given L, if any.
void check_given_L(const std::string& path, const std::string& coordinate, int nx, double dx,
                   std::optional<double> L) {
    if (!L) return;
    check_L(path, *L);
    const double extent = nx * dx;
    if (!(std::abs(extent - *L) <= kSameL * *L))
        bad_input(path, ": its coordinate ", coordinate, " spans ", nx, " steps of ", dx, " = ",
                  extent, ", but L = ", *L, " was given");
}

namespace {

// The unit of the last decimal digit that values have in common.
double last_digit(const std::vector<double>& values) {
    double digit = 1e9;
    const auto rounded = [&](double v) {
        const double steps = v / digit;
        return std::abs(steps - std::round(steps)) <= 1e-12 * std::abs(steps);
    };
    while (digit > 1e-15 && !std::ranges::all_of(values, rounded)) digit /= 10;
    return digit;
}

}  // namespace

bool is_uniform(const std::vector<double>& c) {
    const double step = (c.back() - c.front()) / double(c.size() - 1);
    if (!(std::abs(step) > 0)) return false;  // also where one is missing
    const double rounding = 1.01 * last_digit(c);
    for (const auto i : indices(c))
        if (!(std::abs(c[i] - (c.front() + double(i) * step)) <= rounding)) return false;
    return true;
}

TextAxis text_axis(const std::string& path, const TextTable& table, std::size_t column,
                   const char* name) {
    const char* const read_as = table.columns == 2 ? ": two columns are read as x z of a profile; "
                                                   : ": three columns are read as x y z of a map; ";
    std::vector<double> c(table.rows);
    for (std::size_t i = 0; i < table.rows; ++i) {
        c[i] = table.values[table.columns * i + column];
        if (std::isnan(c[i])) bad_input(path, ":", table.line[i], read_as, name, " is missing");
    }
    std::ranges::sort(c);
    TextAxis axis;
    axis.first = c.front();
    const double range = c.back() - c.front();
    // Less than any uniform step.
    const double same = 1e-3 * range / double(table.rows);
    // The smallest gap between values is nearly the step; a wider one is several steps, where all
    // points of a column are missing.
    double least = range;
    for (std::size_t i = 1; i < c.size(); ++i)
        if (c[i] - c[i - 1] > same) least = std::min(least, c[i] - c[i - 1]);
    axis.count = 1;
    for (std::size_t i = 1; i < c.size(); ++i)
        if (c[i] - c[i - 1] > same) axis.count += at(std::lround((c[i] - c[i - 1]) / least));
    if (axis.count < 2)
        bad_input(path, read_as, "column ", name, " is ", axis.first, " throughout");
    axis.step = range / double(axis.count - 1);
    const auto uniform = [&](double v) { return axis.first + double(axis.index(v)) * axis.step; };
    double off = 0;
    for (const double v : c) off = std::max(off, std::abs(v - uniform(v)));
    if (off <= kUniformText * axis.step) return axis;
    // Rounding moves a coordinate by half a unit of its last digit, and the ends as much.
    if (const double digit = last_digit(c); off <= 1.01 * digit)
        bad_input(path, read_as, name, " has too few digits: it is rounded to ", digit,
                  ", and its step is about ", axis.step, "; a hundredth of the step is expected");
    for (std::size_t i = 0; i < table.rows; ++i) {
        const double v = table.values[table.columns * i + column];
        if (!(std::abs(v - uniform(v)) <= kUniformText * axis.step))
            bad_input(path, ":", table.line[i], read_as, name, " = ", v,
                      " is not on a uniform grid of ", axis.count, " values from ", c.front(),
                      " to ", c.back());
    }
    return axis;
}

namespace {

// Three columns, unless the heading says that they are a matrix.
bool is_triples(const TextTable& table) { return table.columns == 3 && !table.matrix(); }

HeightMap read_text_triples(const std::string& path, const TextTable& table,
                            std::optional<double> L, bool missing, const MapKeys& keys,
                            double factor) {
    if (keys.pixel)
        bad_input(path,
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
            bad_input(path, ":", table.line[i], ": x = ", row[0], ", y = ", row[1],
                      " is already in line ", line[point],
                      "; have the coordinates too few digits?");
        line[point] = table.line[i];
        map.data[point] = row[2];
    }
    for (std::size_t k = 0; missing && k < line.size();
         ++k)  // a point that is not listed is missing
        if (line[k] == 0) {
            map.data[k] = std::nan("");
            line[k] = -1;
        }
    if (const auto empty = std::ranges::find(line, 0L); empty != line.end()) {
        const auto point = at(empty - line.begin());
        bad_input(path, ": three columns are read as x y z of a map of ", x.count, " x ", y.count,
                  " points, but there is none at x = ", x.first + double(point % x.count) * x.step,
                  ", y = ", y.first + double(point / x.count) * y.step,
                  "; surface%missing = 'fill' fills such points");
    }
    map.x0 = x.first * factor;
    map.y0 = y.first * factor;
    map.dx = x.step * factor;
    map.dy = y.step * factor;
    check_given_L(path, "x", map.nx, map.dx, L);
    return map;
}

HeightMap read_text_matrix(const std::string& path, const TextTable& table, std::optional<double> L,
                           const MapKeys& keys, const std::string& length_unit) {
    if (table.columns == 4 && !table.matrix())
        bad_input(path,
                  ": four columns are a list of asperities x y z r (surface%source='asperities'), "
                  "not a map");
    if (!keys.coordinate_unit.empty())
        bad_input(path,
                  ": a matrix has no coordinates; surface%coordinate_unit is for three columns x y "
                  "z, and surface%pixel is in run%length_unit");
    const auto side = [&](Mention::Kind kind) -> std::optional<double> {
        const Mention* const stated = table.mention(kind);
        if (!stated || !(stated->size > 0)) return {};
        return stated->size * length_factor(stated->unit, length_unit, 1);
    };
    const auto width = side(Mention::width), height = side(Mention::height);
    if (!L && !keys.pixel && !width)
        bad_input(path,
                  ": a text matrix has no spacing; surface%pixel must be given, or of body 1 "
                  "surface%L, its extent in x");
    if (L) check_L(path, *L);
    check_grid(path, table.columns, table.rows);
    HeightMap map = allocate_map(table.columns, table.rows);
    std::ranges::copy(table.values, map.data.get());
    map.dx = keys.pixel ? *keys.pixel : L ? *L / map.nx : *width / map.nx;
    map.dy = keys.pixel || !height ? map.dx : *height / map.ny;
    if (keys.pixel) check_given_L(path, "x", map.nx, map.dx, L);
    constexpr double kSameSide = 0.01;  // relative; a header is rounded
    const auto check_side = [&](Mention::Kind kind, std::optional<double> stated, double side,
                                const char* extent) {
        if (!stated || std::abs(side - *stated) <= kSameSide * *stated) return;
        bad_input(path, ":", table.mention(kind)->line, ": a comment says that the map is ",
                  *stated, " ", length_unit, extent, ", but surface%pixel or surface%L makes it ",
                  side);
    };
    check_side(Mention::width, width, map.Lx(), " wide");
    check_side(Mention::height, height, map.Ly(), " high");
    if (table.picture()) reverse_rows(map);
    return map;
}

}  // namespace

// Marks heights that mean "no data", and looks for others that may mean it.
void mark_missing(HeightMap& map, const std::vector<double>& codes, MapOrigin* origin) {
    constexpr double kSingle = 1e-7;  // a code may have been rounded to single precision
    for (std::size_t k = 0; !codes.empty() && k < map.points(); ++k)
        for (const double code : codes)
            if (std::abs(map.data[k] - code) <= kSingle * std::abs(code))
                map.data[k] = std::nan("");
    if (origin) origin->code = likely_code(map, origin->coded);
}

// A unit in a comment that is not understood, and is another than those that apply, is refused, as
// are coordinates without a unit if the heights have one.
UnitFactors text_factors(const std::string& path, const TextTable& table, const MapKeys& keys,
                         const std::string& length_unit, bool triples) {
    const Mention* const stated = table.mention(Mention::values);
    const Mention* const lateral = table.mention(Mention::coordinates);
    const bool known = !keys.height_unit.empty() || stated;
    const bool known_coordinates = !keys.coordinate_unit.empty() || lateral;
    const std::string heights = !keys.height_unit.empty() ? keys.height_unit
                                : stated                  ? stated->unit
                                                          : length_unit;
    const std::string coordinates = !triples || !known_coordinates  ? length_unit
                                    : !keys.coordinate_unit.empty() ? keys.coordinate_unit
                                                                    : lateral->unit;
    if (triples && known && !known_coordinates)
        bad_input(path, ": the heights are in '", heights,
                  "', but neither the file nor the case has the unit of x and y; "
                  "surface%coordinate_unit must be given");
    for (const Mention& other : table.units) {
        const auto same = [&](const std::string& unit) {
            return other.unit == unit || unit_factor(other.unit, unit) == 1;
        };
        const bool lateral_one = triples && other.kind == Mention::coordinates;
        const bool understood =
            lateral_one ? !keys.coordinate_unit.empty() : known && (!triples || known_coordinates);
        if (&other == stated || understood || same(coordinates) || (!lateral_one && same(heights)))
            continue;
        bad_input(
            path, ":", other.line, ": a comment names the unit '", other.unit,
            "'; surface%height_unit, the unit of the heights, ",
            triples && !known_coordinates ? "and surface%coordinate_unit, that of x and y, " : "",
            "must be given");
    }
    UnitFactors factors;
    try {
        factors.heights = length_factor(heights, length_unit, 1);
    } catch (const Error& error) {
        bad_input(path,
                  stated && keys.height_unit.empty()
                      ? ":" + std::to_string(stated->line) + ": a comment: "
                      : ": ",
                  error.what(), "; surface%height_unit replaces it");
    }
    factors.coordinates = length_factor(coordinates, length_unit, 1);
    return factors;
}

namespace {

// Refuses a matrix whose first line and first column are the coordinates, with an empty corner.
void refuse_coordinates(const std::string& path, const TextTable& table) {
    if (!std::isnan(table.values[0]) || table.rows < 4 || table.columns < 4) return;
    const std::vector<double> x(table.values.begin() + 1,
                                table.values.begin() + std::ptrdiff_t(table.columns));
    std::vector<double> y;
    for (std::size_t j = 1; j < table.rows; ++j) y.push_back(table.values[j * table.columns]);
    if (!is_uniform(x) || !is_uniform(y)) return;
    bad_input(path, ":", table.line[0],
              ": the corner is empty, the first line and the first column are uniform as "
              "coordinates are: a matrix contains heights alone; remove them, and give the step as "
              "surface%pixel");
}

HeightMap read_text_heights(const std::string& path, std::optional<double> L, bool missing,
                            const MapKeys& keys, const std::string& length_unit,
                            MapOrigin* origin) {
    const TextTable table = read_table(path, 0, missing);
    refuse_coordinates(path, table);
    const UnitFactors factors = text_factors(path, table, keys, length_unit, is_triples(table));
    HeightMap map = is_triples(table)
                        ? read_text_triples(path, table, L, missing, keys, factors.coordinates)
                        : read_text_matrix(path, table, L, keys, length_unit);
    mark_missing(map, keys.missing_value, origin);
    scale_heights(map, factors.heights);
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
    if (axis.reversed) std::ranges::reverse(c);
    axis.first = c.front();
    axis.step = (c.back() - c.front()) / double(n - 1);
    if (!(axis.step > 0))
        bad_input(file.path(), ": coordinate ", name, " does not vary: it begins and ends at ",
                  c.front());
    // Tolerance for the rounding of coordinates stored in single precision.
    const double largest = std::max(std::abs(c.front()), std::abs(c.back()));
    const double rounding = variable->type == NC_FLOAT ? 1.2e-7 * largest : 4.5e-16 * largest;
    if (rounding > kUniformText * axis.step)
        bad_input(file.path(), ": coordinate ", name, " has too few digits: it is rounded to ",
                  rounding, " in its type, ", variable->type == NC_FLOAT ? "float" : "double",
                  ", and its step is about ", axis.step, "; a hundredth of the step is expected");
    for (const auto i : indices(n)) {
        const double uniform = axis.first + double(i) * axis.step;
        if (std::abs(c[i] - uniform) > kUniform * axis.step + rounding)
            bad_input(file.path(), ": coordinate ", name, " is not uniform to 1e-6 of its step ",
                      axis.step, ": ", name, "(", axis.reversed ? n - 1 - i : i,
                      "), counted from 0, is ", c[i], " where ", uniform, " was expected");
    }
    return axis;
}

// The variable `channel`, or `height`, or the only one of `rank` dimensions.
NetcdfInput::Variable find_heights(const NetcdfInput& file, const std::string& channel,
                                   std::size_t rank) {
    const char* const place = rank == 2 ? "height(y, x)" : "height(x)";
    const std::string dimensions = rank == 2 ? "two dimensions" : "one dimension";
    const auto is_map = [&](const NetcdfInput::Variable& v) {
        return v.lengths.size() == rank && v.numeric() && (rank > 1 || v.name != v.axes[0]);
    };
    if (const auto named = file.find(channel.empty() ? "height" : channel)) {
        if (is_map(*named)) return *named;
        bad_input(file.path(), ": ",
                  channel.empty()
                      ? joined(place, ", numeric,")
                      : "channel '" + channel + "': a numeric variable of " + dimensions,
                  " was expected, not ", named->shape());
    }
    if (!channel.empty()) bad_input(file.path(), ": there is no variable '", channel, "'");
    std::vector<NetcdfInput::Variable> maps;
    std::string names;
    for (const auto& v : file.variables())
        if (is_map(v) && v.name != "mask") {
            enlist(names, ", ", v.shape());
            maps.push_back(v);
        }
    if (maps.empty())
        bad_input(file.path(), ": there is no variable ", place, " and no other of ", dimensions);
    if (maps.size() > 1)
        bad_input(file.path(), ": there is no variable ", place, ", and several others have ",
                  dimensions, ": ", names);
    return maps[0];
}

// Factors of heights, x and y. Heights in nanometres with coordinates in micrometres are common,
// and without conversion slopes would be 1000 times too large. If only some variables have units,
// in the file or by the keys, the unit of the others is unknown.
std::array<double, 3> unit_factors(const NetcdfInput& file, const NetcdfInput::Variable& heights,
                                   const std::string& length_unit, const MapKeys& keys,
                                   bool coordinates, std::size_t of_x) {
    std::vector<NetcdfInput::Variable> all = {heights};
    if (coordinates)
        for (const std::size_t dimension : {of_x, 1 - of_x})
            if (dimension < heights.axes.size()) all.push_back(*file.find(heights.axes[dimension]));
    std::array<double, 3> factor{1, 1, 1};
    const NetcdfInput::Variable *with = nullptr, *without = nullptr;
    std::string unit;  // of `with`
    for (const auto k : indices(all)) {
        const std::string& key = k == 0 ? keys.height_unit : keys.coordinate_unit;
        auto known = file.unit_factor(all[k], length_unit);
        if (!known && !key.empty()) known = length_factor(key, length_unit);
        if (!known) {
            without = &all[k];
        } else if ((factor[k] = *known) != 1) {
            with = &all[k];
            unit = file.unit(*with).value_or(key);
        }
    }
    if (with && without)
        bad_input(file.path(), ": ", with->name, " is in '", unit, "', but ", without->name,
                  " has no attribute units or unit; surface%",
                  without == &all[0] ? "height_unit" : "coordinate_unit", " must be given");
    return factor;
}

// Sets points under the variable `mask` to NaN, if there is one of the shape of the heights.
void apply_mask(const NetcdfInput& file, const NetcdfInput::Variable& heights, HeightMap& map) {
    const auto mask = file.find("mask");
    if (!mask || !mask->numeric() || mask->dimensions != heights.dimensions) return;
    std::vector<double> masked(mask->count());
    file.read(*mask, masked.data(), true);
    for (const auto k : indices(masked))
        if (masked[k] != 0) map.data[k] = std::nan("");
}

// Exchanges the axes of a map without padding.
HeightMap transposed(const HeightMap& map) {
    HeightMap turned = allocate_map(at(map.ny), at(map.nx));
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) turned.row(i)[j] = map(i, j);
    return turned;
}

}  // namespace

HeightMap read_netcdf_heights(const std::string& path, std::optional<double> L,
                              const std::string& length_unit, const std::string& channel,
                              bool missing, const MapKeys& keys, MapOrigin* origin,
                              std::size_t rank) {
    const NetcdfInput file(path);
    const auto variable = find_heights(file, channel, rank);
    if (origin) origin->channel = variable.name;
    const bool profile = rank == 1;
    // SurfaceTopography and others let y run fastest.
    const bool turned = !profile && variable.axes[0] == "x" && variable.axes[1] == "y";
    const std::size_t of_x = turned ? 0 : rank - 1, of_y = 1 - of_x;
    if (!profile) check_grid(path, variable.lengths[of_x], variable.lengths[of_y]);
    const auto x = read_axis(file, variable, of_x);
    const auto y = profile ? std::nullopt : read_axis(file, variable, of_y);
    if (!profile && x.has_value() != y.has_value())
        bad_input(path, ": ", variable.shape(),
                  " has a coordinate variable for only one dimension; both or none were expected");
    if (!x && !L && !keys.pixel)
        bad_input(
            path, ": ", variable.shape(),
            " has no coordinate variables; they must be given, or surface%pixel, or of body 1 "
            "surface%L, its extent in x");
    if (x && keys.pixel)
        bad_input(path,
                  ": the step follows from its coordinates; surface%pixel is for files "
                  "without them");
    if (!x && !keys.coordinate_unit.empty())
        bad_input(path, ": has no coordinates; surface%coordinate_unit does not apply");
    keys.require_use(path, !file.unit(variable),
                     !x || !file.unit(*file.find(variable.axes[of_x])) || keys.pixel);
    HeightMap map = profile ? allocate_profile(path, variable.lengths[0])
                            : allocate_map(variable.lengths[1], variable.lengths[0]);
    file.read(variable, map.data.get(), missing);
    apply_mask(file, variable, map);
    mark_missing(map, keys.missing_value, origin);
    if (turned) map = transposed(map);
    const auto [factor_z, factor_x, factor_y] =
        unit_factors(file, variable, length_unit, keys, x.has_value(), of_x);
    if (x) {
        map.x0 = x->first * factor_x;
        map.dx = x->step * factor_x;
    } else {
        map.dx = map.dy = keys.pixel ? *keys.pixel : *L / map.nx;
    }
    if (y) {
        map.y0 = y->first * factor_y;
        map.dy = y->step * factor_y;
    }
    check_given_L(path, variable.axes[of_x], map.nx, map.dx, L);
    scale_heights(map, factor_z);
    if (x && x->reversed) reverse_columns(map);
    if (y && y->reversed) reverse_rows(map);
    return map;
}

namespace {

// The formats of instruments, recognised by a file's first bytes. They include sizes and units.
struct InstrumentFormat {
    const char* name;
    bool (*is)(const std::string& first_bytes);
    HeightMap (*read)(const std::string& path, const std::string& channel,
                      const std::string& length_unit, const MapKeys& keys, std::string* title);
    bool channels;  // a file has several maps, possibly with masks
};
constexpr InstrumentFormat kInstrumentFormats[] = {{".gwy", is_gwy, read_gwy, true},
                                                   {".sdf", is_sdf, read_sdf, false}};

// Null: the file has none of these formats.
const InstrumentFormat* instrument_format(const std::string& first_bytes) {
    for (const InstrumentFormat& format : kInstrumentFormats)
        if (format.is(first_bytes)) return &format;
    return nullptr;
}

// Packed files, other than by gzip: what they begin with, and the command that unpacks them to
// standard output.
struct Packed {
    std::string_view start;
    const char *name, *command;
};
constexpr Packed kPacked[] = {{{"\xfd"
                                "7zXZ\0",
                                6},
                               "xz",
                               "xz -dc"},
                              {"BZh", "bzip2", "bzip2 -dc"},
                              {"\x28\xb5\x2f\xfd", "zstd", "zstd -dc"}};

// Refuses packed files, with the command that unpacks them.
void refuse_packed(const std::string& path, const std::string& start) {
    for (const Packed& packed : kPacked)
        if (start.starts_with(packed.start))
            bad_input(path, ": is packed by ", packed.name, "; this unpacks it: ", packed.command,
                      " ", for_shell(path), " > ", copy_for_shell(path, "_unpacked"));
    if (start.starts_with("CDF") || start.starts_with("\x89HDF"))
        bad_input(path, ": is a NetCDF file packed by gzip; this unpacks it: gzip -dc ",
                  for_shell(path), " > ", copy_for_shell(path, "_unpacked"));
    if (!start.starts_with("PK\3\4") || start.size() < 30) return;
    // The name of the first file in an archive follows 30 bytes; archives of instruments (.x3p,
    // .plux) begin with XML.
    const std::size_t length = ByteReader::value<std::uint16_t>(start.data() + 26);
    if (start.substr(30, length).ends_with(".xml"))
        bad_input(path, ": is an archive of an instrument. ", gwyddion_advice(path));
    bad_input(path, ": is a zip archive; this unpacks it: unzip ", for_shell(path));
}

// Refuses meshes: STL, which begins with its name and triangles, or with 80 bytes and their number,
// and PLY.
void refuse_mesh(const std::string& path, const std::string& start) {
    constexpr std::size_t head = 84, triangle = 50;  // bytes
    std::error_code error;
    const bool text = start.starts_with("solid") && start.find("facet") != std::string::npos;
    const bool binary =
        start.size() >= head &&
        std::filesystem::file_size(path, error) ==
            head + triangle * ByteReader::value<std::uint32_t>(start.data() + head - 4);
    if (text || binary || start.starts_with("ply\n") || start.starts_with("ply\r"))
        bad_input(path, ": is a mesh of triangles (", start.starts_with("ply") ? "PLY" : "STL",
                  "), not a height map: heights on a grid are expected");
}

}  // namespace

// A file of no known format is refused; the message says how to convert it.
void refuse_unknown(const std::string& path, const std::string& start) {
    refuse_packed(path, start);
    refuse_mesh(path, start);
    if (start.find('\0') == std::string::npos || start.substr(0, 2) == "\xff\xfe" ||
        start.substr(0, 2) == "\xfe\xff")
        return;
    std::string names = ": neither NetCDF, ";
    for (const InstrumentFormat& format : kInstrumentFormats)
        names +=
            std::string(format.name) + (&format == std::end(kInstrumentFormats) - 1 ? " " : ", ");
    bad_input(path, names, "nor text. ", gwyddion_advice(path));
}

namespace {

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
            bad_input(path, ": ", variable->shape(), ": ", a.x.size(),
                      " values as of asperity_x were expected");
        if (values.size() > at(std::numeric_limits<int>::max()))
            bad_input(path, ": ", variable->shape(), ": more than 2147483647 asperities");
    }
    if (a.size() == 0) bad_input(path, ": there is no asperity in it");
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
        a.x.push_back(row[0]);
        a.y.push_back(row[1]);
        a.z.push_back(row[2]);
        a.radius.push_back(row[3]);
    }
    validate(a, [&](std::size_t i) { return path + ":" + std::to_string(table.line[i]); });
    return a;
}

}  // namespace

void MapKeys::require_use(const std::string& path, bool heights, bool sides) const {
    const auto refuse = [&path](const char* key, const char* what) {
        bad_input(path, ": has a unit of its ", what, "; surface%", key,
                  " is for files without it");
    };
    if (!heights && !height_unit.empty()) refuse("height_unit", "heights");
    if (!sides && !coordinate_unit.empty()) refuse("coordinate_unit", "x and y");
    if (!sides && pixel) refuse("pixel", "x and y");
}

bool lacks_units(const std::string& path, const std::string& channel) {
    if (is_netcdf(path)) {
        const NetcdfInput file(path);
        const auto heights = find_heights(file, channel, 2);
        const auto x = file.find(heights.axes[1]);
        return !file.unit(heights) || !x || !file.unit(*x);
    }
    const std::string start = first_bytes(path);
    return is_gwy(start) ? gwy_lacks_units(path, channel) : !is_sdf(start);
}

// The lowest and the highest height other than `code`; infinities if there is none.
static std::pair<double, double> range_of(const HeightMap& map, double code) {
    double low = kInfinity, high = -kInfinity;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx))
            if (const double z = map(i, j); z != code) {
                low = std::fmin(low, z);
                high = std::fmax(high, z);
            }
    return {low, high};
}

static long count_of(const HeightMap& map, double height) {
    long count = 0;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) count += map(i, j) == height;
    return count;
}

// True if `code`, the lowest or highest height, is farther from the others than these are from each
// other, or is met more often than the height next to it, by five standard deviations of counts:
// towards its end a distribution of heights only becomes thinner.
static bool ends_in_code(const HeightMap& map, double code, bool lowest, double many,
                         long& points) {
    const auto [least, most] = range_of(map, code);
    points = count_of(map, code);
    if (points < 2 || !(least < most)) return false;  // one is an outlier
    const double next = lowest ? least : most;
    if (double(points) > many && std::abs(next - code) > most - least) return true;
    const long at_next = count_of(map, next);
    constexpr double kDeviations = 5;
    const auto more = double(points - at_next);
    return 2 * points < long(map.points()) &&
           more > kDeviations * std::sqrt(double(points + at_next));
}

std::optional<double> likely_code(const HeightMap& map, long& points) {
    constexpr double kShare = 1e-3;
    const auto [low, high] = range_of(map, std::nan(""));
    const double many = kShare * double(map.points());
    for (const double code : {low, high})
        if (ends_in_code(map, code, code == low, many, points)) return code;
    long zero_blocks = 0, other_blocks = 0;
    points = count_of(map, 0);
    for (int j = 1; j + 1 < map.ny; ++j)
        for (int i = 1; i + 1 < map.nx; ++i) {
            bool block = true;
            for (int b = -1; b <= 1; ++b)
                for (int a = -1; a <= 1; ++a) block = block && map(i + a, j + b) == map(i, j);
            if (block) ++(map(i, j) == 0 ? zero_blocks : other_blocks);
        }
    const bool blocks = double(zero_blocks) > many && zero_blocks > 100 * other_blocks;
    if (blocks && 2 * points < long(map.points())) return 0.0;
    return {};
}

void check_heights(const std::string& path, const HeightMap& map, bool fill, bool upwards,
                   const char* masked) {
    for (const double step : {map.dx, map.dy})
        if (!usable_positive(step))
            bad_input(path, ": the spacing ", kPositiveBounds, ", not ", step);
    for (const double origin : {map.x0, map.y0})
        if (!usable(origin))
            bad_input(path, ": the first coordinate ", kNumberBounds, ", not ", origin);
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) {
            const double z = map(i, j);
            if (usable(z) || (fill && std::isnan(z))) continue;
            const std::string place =
                map.ny > 1 ? joined(" in column ", i, " of row ", j, ", counted from 0",
                                    upwards ? " with y upwards" : "")
                           : joined(" at point ", i, ", counted from 0");
            if (std::isnan(z))
                bad_input(path, ": ", count_missing(map), " of ", long(map.nx) * map.ny,
                          " points are missing", masked, ", the first", place,
                          "; surface%missing = 'fill' fills them");
            bad_input(path, ": a height ", kNumberBounds, ", not ", z, " as", place);
        }
}

HeightMap read_heights(const std::string& path, std::optional<double> L,
                       const std::string& length_unit, const std::string& channel, Missing missing,
                       const MapKeys& keys, MapOrigin* origin) {
    const bool fill = missing == Missing::fill;
    const bool netcdf = is_netcdf(path);
    const std::string start = first_bytes(path);
    const InstrumentFormat* const instrument = netcdf ? nullptr : instrument_format(start);
    const bool channels = instrument && instrument->channels;
    if (!channel.empty() && !netcdf && !channels)
        bad_input(path, ": has no channel '", channel,
                  "'; only .gwy and NetCDF files have channels");
    if (!netcdf && !instrument) refuse_unknown(path, start);
    HeightMap map = netcdf
                        ? read_netcdf_heights(path, L, length_unit, channel, fill, keys, origin, 2)
                    : instrument ? instrument->read(path, channel, length_unit, keys,
                                                    origin ? &origin->channel : nullptr)
                                 : read_text_heights(path, L, fill, keys, length_unit, origin);
    if (instrument) {
        mark_missing(map, keys.missing_value, origin);
        check_given_L(path, "x", map.nx, map.dx, L);
    }
    const char* const note = channels ? " or masked" : "";
    check_heights(path, map, fill, instrument != nullptr, note);
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
            for (std::size_t i = 0; i < table.rows; ++i) {
                wavenumber.push_back(table.values[2 * i]);
                psd.push_back(table.values[2 * i + 1]);
            }
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
