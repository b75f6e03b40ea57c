// Profiles: heights along a line, from texts, NetCDF and .sdf files.

#include "base/error.hpp"
#include "case/namelist.hpp"
#include "case/units.hpp"
#include "io/formats.hpp"
#include "io/inputs.hpp"
#include "io/map_parts.hpp"

namespace rsc {

HeightMap allocate_profile(const std::string& path, std::size_t points) {
    constexpr std::size_t fewest = 16;
    if (points < fewest)
        bad_input(path, ": a profile of ", points, " points; at least ", fewest, " are needed");
    if (points > at(std::numeric_limits<int>::max()))
        bad_input(path, ": a profile of ", points, " points; at most 2147483647 are possible");
    check_memory(path, joined("a profile of ", points, " points"), double(points));
    return allocate_map(points, 1);
}

namespace {

using Mention = TextTable::UnitMention;

constexpr char kEndOfRecord = '\3';  // of SMD

// Profiles of ISO 5436-2 (.smd): records that end with the byte 3. The first has the axes, as in
// "CX I 22401 mm 1.0e0 D 2.5e-4": incremental, points, unit, scale, type and step, and "CZ A 22401
// um 1.0e0 D": absolute; the third has the heights.
struct SmdAxis {
    std::string unit;
    double points = 0, scale = 0, step = 0;
};

SmdAxis smd_axis(const std::string& path, const std::string& record, const std::string& name,
                 char kind) {
    std::istringstream lines(record);
    std::string line;
    for (long number = 1; std::getline(lines, line); ++number) {
        std::istringstream words(line);
        std::vector<std::string> all;
        for (std::string word; words >> word;) all.push_back(word);
        if (all.empty() || all[0] != name) continue;
        const auto value = [&](std::size_t k) -> double {
            const auto read = k < all.size() ? number_in_file(all[k]) : std::nullopt;
            if (!read)
                bad_input(path, ":", number, ": ", name, ": a number was expected as word ", k + 1);
            return *read;
        };
        if (all.size() < 6 || all[1] != std::string(1, kind))
            bad_input(path, ":", number, ": ", name, " ", kind,
                      ", points, unit, scale and type were expected");
        return {all[3], value(2), value(4), kind == 'I' ? value(6) : 0.0};
    }
    bad_input(path, ": its first record has no axis ", name, "; is it a profile of ISO 5436-2?");
}

HeightMap read_smd(const std::string& path, const std::string& length_unit, const MapKeys& keys,
                   bool missing) {
    keys.require_use(path, false, false);
    std::string bytes = read_bytes(path);
    std::ranges::replace(bytes, '\0', ' ');
    std::vector<std::string> records;
    for (std::size_t from = 0, end; (end = bytes.find(kEndOfRecord, from)) != std::string::npos;
         from = end + 1)
        records.push_back(bytes.substr(from, end - from));
    if (records.size() < 3)
        bad_input(path, ": ", records.size(),
                  " records where three were expected; is the file complete?");
    const SmdAxis x = smd_axis(path, records[0], "CX", 'I'),
                  z = smd_axis(path, records[0], "CZ", 'A');
    std::istringstream words(records[2]);
    std::vector<double> heights;
    for (std::string word; words >> word;) {
        const std::string lower = namelist::lower_case(word);
        const auto value =
            missing && (lower == "bad" || lower == "nan") ? std::nan("") : number_in_file(word);
        if (!value)
            bad_input(path, ": height ", heights.size() + 1, ", ", shown(word),
                      ", is not a number; surface%missing = 'fill' accepts BAD");
        heights.push_back(*value);
    }
    if (double(heights.size()) != z.points)
        bad_input(path, ": ", heights.size(), " heights where ", z.points,
                  " were expected; is the file complete?");
    HeightMap map = allocate_profile(path, heights.size());
    std::ranges::copy(heights, map.data.get());
    scale_heights(map, z.scale * length_factor(z.unit, length_unit));
    map.dx = x.step * x.scale * length_factor(x.unit, length_unit);
    return map;
}

// Of a table of more columns, x in the first, and the heights in the one of this number.
TextTable two_columns(const std::string& path, const TextTable& all, const std::string& channel) {
    const auto number = number_in_file(channel);
    if (!number || !(*number >= 2 && *number <= double(all.columns)))
        bad_input(path, ":", all.line[0], ": ", all.columns,
                  " columns; a profile has one, of heights, or two, x and z; of more, x in the "
                  "first, surface%channel must be the number of that with the heights, from '2' to "
                  "'",
                  all.columns, "'");
    TextTable two = all;
    two.columns = 2;
    two.values.clear();
    for (std::size_t row = 0; row < all.rows; ++row)
        for (const std::size_t column : {std::size_t{0}, std::size_t(*number) - 1})
            two.values.push_back(all.values[row * all.columns + column]);
    return two;
}

// The heights of x z pairs: as they follow each other, with x rounded to any digit, or at the
// places of x on a uniform grid, in any order and with places left out.
HeightMap place_pairs(const std::string& path, const TextTable& table) {
    std::vector<double> x;
    std::vector<double> z;
    for (std::size_t i = 0; i < table.rows; ++i) {
        x.push_back(table.values[2 * i]);
        z.push_back(table.values[2 * i + 1]);
    }
    HeightMap map;
    if (x.size() > 1 && is_uniform(x)) {
        if (x.back() < x.front()) {
            std::ranges::reverse(x);
            std::ranges::reverse(z);
        }
        map = allocate_profile(path, z.size());
        std::ranges::copy(z, map.data.get());
        map.x0 = x.front();
        map.dx = (x.back() - x.front()) / double(x.size() - 1);
        return map;
    }
    const TextAxis axis = text_axis(path, table, 0, "x");
    map = allocate_profile(path, axis.count);
    std::fill_n(map.data.get(), axis.count, std::nan(""));
    std::vector<long> line(axis.count, 0);
    for (std::size_t i = 0; i < table.rows; ++i) {
        const std::size_t k = axis.index(x[i]);
        if (line[k] > 0)
            bad_input(path, ":", table.line[i], ": x = ", x[i], " is already in line ", line[k],
                      "; has x too few digits?");
        line[k] = table.line[i];
        map.data[k] = z[i];
    }
    map.x0 = axis.first;
    map.dx = axis.step;
    return map;
}

// Two columns x z, or one column of heights.
HeightMap read_text_profile(const std::string& path, std::optional<double> L,
                            const std::string& channel, bool missing, const MapKeys& keys,
                            const std::string& length_unit, MapOrigin* origin) {
    TextTable table = read_profile_table(path, missing);
    if (table.columns > 2)
        table = two_columns(path, table, channel);
    else if (!channel.empty())
        bad_input(path, ": has no channel '", channel, "'; it has ", table.columns, " columns");
    const bool with_x = table.columns == 2;
    const UnitFactors factors = text_factors(path, table, keys, length_unit, with_x);
    if (with_x && keys.pixel)
        bad_input(path, ": two columns are x and z of a profile; surface%pixel is for one column");
    if (!with_x && !keys.coordinate_unit.empty())
        bad_input(path, ": one column has no x; surface%coordinate_unit is for two columns");
    HeightMap map;
    if (with_x) {
        map = place_pairs(path, table);
        map.x0 *= factors.coordinates;
        map.dx *= factors.coordinates;
    } else {
        map = allocate_profile(path, table.rows);
        std::ranges::copy(table.values, map.data.get());
        const Mention* const spacing = table.mention(Mention::spacing);
        if (keys.pixel)
            map.dx = *keys.pixel;
        else if (spacing)
            map.dx = spacing->size * length_factor(spacing->unit, length_unit);
        else if (L)
            map.dx = *L / map.nx;
        else
            bad_input(path,
                      ": one column has no spacing; surface%pixel, the step between its heights, "
                      "or surface%L, its length, must be given");
    }
    check_given_L(path, "x", map.nx, map.dx, L);
    mark_missing(map, keys.missing_value, origin);
    scale_heights(map, factors.heights);
    return map;
}

bool is_smd(const std::string& start) {
    return start.starts_with("ISO 5436") && start.find("PRF") != std::string::npos;
}

}  // namespace

HeightMap read_profile(const std::string& path, std::optional<double> L,
                       const std::string& length_unit, const std::string& channel, Missing missing,
                       const MapKeys& keys, double thickness, MapOrigin* origin) {
    const bool fill = missing == Missing::fill;
    const bool netcdf = is_netcdf(path);
    const std::string start = first_bytes(path);
    if (!channel.empty() && !netcdf && (is_smd(start) || is_sdf(start)))
        bad_input(path, ": has no channel '", channel,
                  "'; only NetCDF files and texts of several columns have them");
    HeightMap map;
    if (netcdf) {
        map = read_netcdf_heights(path, L, length_unit, channel, fill, keys, origin, 1);
    } else if (is_smd(start)) {
        map = read_smd(path, length_unit, keys, fill);
        check_given_L(path, "x", map.nx, map.dx, L);
    } else if (is_sdf(start)) {
        map = read_sdf(path, "", length_unit, keys, nullptr);
        if (map.ny != 1)
            bad_input(path, ": ", map.ny, " profiles of ", map.nx,
                      " points are a map; surface%source = 'heights' reads it");
        check_given_L(path, "x", map.nx, map.dx, L);
    } else {
        refuse_unknown(path, start);
        map = read_text_profile(path, L, channel, fill, keys, length_unit, origin);
    }
    map.dy = thickness;
    check_heights(path, map, fill, false, "");
    return map;
}

}  // namespace rsc
