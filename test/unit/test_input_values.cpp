// Every number that comes out of a file: values, units, axes and their directions, whatever the file's format, type and length. All
// numbers of an input differ from each other.
#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "check.hpp"
#include "error.hpp"
#include "read/file_list.hpp"
#include "read/input_netcdf.hpp"
#include "read/input_spectrum.hpp"
#include "read/inputs.hpp"
#include "unit/map_files.hpp"
#include "unit/refused.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;
using namespace map_files;

namespace {

const Folder folder;

std::string write(const std::string& name, const std::string& content) { return folder.write(name, content); }

void ok(int status) {
    if (status != NC_NOERR) std::printf("NetCDF: %s\n", nc_strerror(status));
    CHECK(status == NC_NOERR);
}

// A NetCDF file of variables over named dimensions, each with text and number attributes.
struct Variable {
    std::string name;
    nc_type type;
    std::vector<std::string> dimensions;
    std::vector<double> values;
    std::vector<std::pair<std::string, std::string>> texts = {};
    std::vector<std::pair<std::string, double>> numbers = {};
};

std::string netcdf(const std::string& name, const std::vector<std::pair<std::string, std::size_t>>& dimensions,
                   const std::vector<Variable>& variables, int format = NC_NETCDF4) {
    int id = -1;
    ok(nc_create((folder / name).c_str(), NC_CLOBBER | format, &id));
    std::vector<int> ids;
    std::size_t records = 0;
    for (const auto& [d, length] : dimensions) {
        int dimension = -1;
        const bool record = d == "record";
        ok(nc_def_dim(id, d.c_str(), record ? NC_UNLIMITED : length, &dimension));
        if (record) records = length;
        ids.push_back(dimension);
    }
    std::vector<int> all;
    for (const Variable& v : variables) {
        std::vector<int> of;
        for (const std::string& d : v.dimensions)
            for (std::size_t k = 0; k < dimensions.size(); ++k)
                if (dimensions[k].first == d) of.push_back(ids[k]);
        int variable = -1;
        ok(nc_def_var(id, v.name.c_str(), v.type, static_cast<int>(of.size()), of.data(), &variable));
        for (const auto& [key, text] : v.texts) ok(nc_put_att_text(id, variable, key.c_str(), text.size(), text.c_str()));
        for (const auto& [key, number] : v.numbers) ok(nc_put_att_double(id, variable, key.c_str(), v.type, 1, &number));
        all.push_back(variable);
    }
    ok(nc_enddef(id));
    for (std::size_t k = 0; k < variables.size(); ++k) {
        const Variable& v = variables[k];
        std::vector<std::size_t> start(v.dimensions.size(), 0), count;
        for (const std::string& d : v.dimensions)
            for (const auto& [named, length] : dimensions)
                if (named == d) count.push_back(d == "record" ? records : length);
        ok(nc_put_vara_double(id, all[k], start.data(), count.data(), v.values.data()));
    }
    ok(nc_close(id));
    return folder / name;
}

std::vector<double> counted(std::size_t n, double first, double step) {
    std::vector<double> v;
    for (std::size_t k = 0; k < n; ++k) v.push_back(first + static_cast<double>(k) * step);
    return v;
}

// height(y = 3, x = 4): 10 row + column.
std::vector<double> heights() {
    std::vector<double> z;
    for (int k = 0; k < 12; ++k) z.push_back(10 * (k / 4) + k % 4);
    return z;
}

// Each coordinate in its own unit, each running up or down: where a point lies and how high it is, in every run's unit.
void units_and_directions() {
    const std::vector<std::pair<const char*, double>> units = {{"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}, {"inch", 0.0254}};
    for (const auto& [wanted, metre] : units)
        for (std::size_t k = 0; k < units.size(); ++k)
            for (const bool left : {false, true})
                for (const bool down : {false, true}) {
                    const auto& [uz, z] = units[k];
                    const auto& [ux, x] = units[(k + 1) % 4];
                    const auto& [uy, y] = units[(k + 2) % 4];
                    const std::string path =
                        netcdf("u.nc", {{"y", 3}, {"x", 4}},
                               {{"height", NC_DOUBLE, {"y", "x"}, heights(), {{"units", uz}}},
                                {"x", NC_DOUBLE, {"x"}, left ? counted(4, 9.5, -1.5) : counted(4, 5, 1.5), {{"units", ux}}},
                                {"y", NC_DOUBLE, {"y"}, down ? counted(3, -2, -2.5) : counted(3, -7, 2.5), {{"units", uy}}}});
                    const HeightMap m = read_heights(path, std::nullopt, wanted);
                    CHECK(m.nx == 4 && m.ny == 3 && !m.periodic);
                    CHECK_RELATIVE(m.x0, 5 * x / metre, 1e-13);
                    CHECK_RELATIVE(m.dx, 1.5 * x / metre, 1e-13);
                    CHECK_RELATIVE(m.y0, -7 * y / metre, 1e-13);
                    CHECK_RELATIVE(m.dy, 2.5 * y / metre, 1e-13);
                    for (int j = 0; j < 3; ++j)
                        for (int i = 0; i < 4; ++i)
                            CHECK_RELATIVE(m(i, j), (10 * (down ? 2 - j : j) + (left ? 3 - i : i)) * z / metre, 1e-13);
                }
}

// The numbers of every type, as they are and packed, and what each type has for "nothing was written".
void types() {
    const std::vector<std::tuple<nc_type, double, bool>> all = {{NC_DOUBLE, NC_FILL_DOUBLE, true},
                                                                {NC_FLOAT, static_cast<double>(NC_FILL_FLOAT), true},
                                                                {NC_INT, static_cast<double>(NC_FILL_INT), true},
                                                                {NC_SHORT, static_cast<double>(NC_FILL_SHORT), true},
                                                                {NC_INT64, static_cast<double>(NC_FILL_INT64), true},
                                                                {NC_BYTE, -127, false},
                                                                {NC_UBYTE, 255, false},
                                                                {NC_USHORT, 65535, false}};
    for (const auto& [type, fill, is_missing] : all) {
        for (const double scale : {1.0, 0.25})
            for (const double offset : {0.0, -3.0}) {
                Variable v{"height", type, {"y", "x"}, heights()};
                // Attributes of the type of the packed values are those of a real number here.
                const std::string path = netcdf("t.nc", {{"y", 3}, {"x", 4}}, {v});
                int id = -1;
                ok(nc_open(path.c_str(), NC_WRITE, &id));
                ok(nc_redef(id));
                if (scale != 1) ok(nc_put_att_double(id, 0, "scale_factor", NC_DOUBLE, 1, &scale));
                if (offset != 0) ok(nc_put_att_double(id, 0, "add_offset", NC_DOUBLE, 1, &offset));
                ok(nc_close(id));
                const HeightMap m = read_heights(path, 2.0);
                CHECK(m.dx == 0.5 && m.dy == 0.5 && m.x0 == 0 && m.y0 == 0);
                for (int j = 0; j < 3; ++j)
                    for (int i = 0; i < 4; ++i) CHECK(m(i, j) == (10 * j + i) * scale + offset);
            }
        std::vector<double> z = heights();
        z[6] = fill;
        const std::string path = netcdf("t.nc", {{"y", 3}, {"x", 4}}, {{"height", type, {"y", "x"}, z}});
        CHECK(accepted([&] { read_heights(path, 2.0); }) == !is_missing);
        const HeightMap m = read_heights(path, 2.0, "mm", "", Missing::fill);
        CHECK(std::isnan(m(2, 1)) == is_missing && m(1, 1) == 11);
    }
    // A fill value of its own takes the place of the type's; what is packed is compared as it is stored.
    for (const bool own : {false, true}) {
        std::vector<double> z = heights();
        z[6] = NC_FILL_SHORT, z[7] = 12;
        Variable v{"height", NC_SHORT, {"y", "x"}, z, {}, {{"scale_factor", 3}}};
        if (own) v.numbers.push_back({"_FillValue", 12});
        const HeightMap m = read_heights(netcdf("t.nc", {{"y", 3}, {"x", 4}}, {v}), 2.0, "mm", "", Missing::fill);
        CHECK(std::isnan(m(2, 1)) == !own && std::isnan(m(3, 1)) == own && m(0, 1) == 30);
        CHECK(std::isnan(m(0, 2)) == false && m(0, 2) == 60);
    }
    // Coordinates in single precision are as uniform as that allows, no less.
    for (const auto& [off, even] : {std::pair{0.0, true}, {1e-5, true}, {1e-3, false}}) {
        std::vector<double> x = counted(4, 100, 0.1);
        x[2] += off;
        CHECK(accepted([&] {
                  read_heights(netcdf("t.nc", {{"y", 3}, {"x", 4}},
                                      {{"height", NC_FLOAT, {"y", "x"}, heights()},
                                       {"x", NC_FLOAT, {"x"}, x},
                                       {"y", NC_DOUBLE, {"y"}, counted(3, 0, 1)}}),
                               std::nullopt);
              }) == even);
    }
    // What is no axis: text, or over another dimension.
    const std::string text = netcdf("t.nc", {{"y", 3}, {"x", 4}, {"other", 4}},
                                    {{"height", NC_DOUBLE, {"y", "x"}, heights()}, {"x", NC_DOUBLE, {"other"}, counted(4, 0, 1)}});
    CHECK(read_heights(text, 6.0).dx == 1.5 && !accepted([&] { read_heights(text, std::nullopt); }));
}

// A classic file is whole to the last byte of its last value, whatever the type, the format, the number of variables and records; less
// is refused.
void lengths() {
    long cut = 0;
    for (const int format : {0, int{NC_64BIT_OFFSET}, int{NC_64BIT_DATA}})
        for (const nc_type type : {NC_BYTE, NC_SHORT, NC_INT, NC_FLOAT, NC_DOUBLE, NC_UBYTE, NC_USHORT, NC_UINT, NC_INT64, NC_UINT64}) {
            if (type > NC_DOUBLE && format != int{NC_64BIT_DATA}) continue;
            const std::size_t size = type == NC_BYTE || type == NC_UBYTE                          ? 1
                                     : type == NC_SHORT || type == NC_USHORT                      ? 2
                                     : type == NC_DOUBLE || type == NC_INT64 || type == NC_UINT64 ? 8
                                                                                                  : 4;
            for (const int kind : {0, 1, 2, 3}) {
                // 0: fixed, the map last; 1: fixed, with axes before; 2: records, one variable; 3: records, two variables of unlike sizes.
                const std::string y = kind >= 2 ? "record" : "y";
                std::vector<Variable> variables;
                std::vector<double> z = counted(15, 1, 1);
                if (kind == 1) variables.push_back({"y", NC_DOUBLE, {"y"}, counted(5, 2, 0.5), {{"units", "mm"}, {"long_name", "odd"}}});
                if (kind == 1) variables.push_back({"x", NC_FLOAT, {"x"}, counted(3, 1, 0.5), {{"units", "mm"}}, {{"valid_min", 0}}});
                if (kind == 3) variables.push_back({"other", NC_BYTE, {y}, counted(5, 0, 1)});
                variables.push_back({"height", type, {y, "x"}, z, {{"units", "mm"}}});
                const std::string path = netcdf("c.nc", {{y, 5}, {"x", 3}}, variables, format), bytes = ::bytes(path);
                const auto same = [&](const std::string& file) {
                    const HeightMap m = read_heights(file, kind == 1 ? std::nullopt : std::optional<double>(1.5), "mm", "height");
                    bool equal = m.nx == 3 && m.ny == 5;
                    for (int k = 0; equal && k < 15; ++k) equal = m(k % 3, k / 3) == k + 1;
                    return equal;
                };
                CHECK(same(path));
                // Up to three bytes fill the last value, or the last record, up to four; what ends within the last value is cut.
                const std::size_t padding = (kind == 2 ? 0 : (4 - (kind == 3 ? 3 : 15) * size % 4) % 4);
                CHECK(same(write("c.nc", bytes.substr(0, bytes.size() - padding))));
                for (const std::size_t less : {1, 2, 5, 9})
                    CHECK(!accepted([&] { same(write("c.nc", bytes.substr(0, bytes.size() - padding - less))); })), ++cut;
                CHECK(same(write("c.nc", bytes + "more")));
            }
        }
    CHECK(cut > 200);
    // HDF5 after a user block.
    const std::string hdf = ::bytes(netcdf("h.nc", {{"y", 3}, {"x", 4}}, {{"height", NC_DOUBLE, {"y", "x"}, heights()}}));
    for (const std::size_t block : {0, 512, 1024, 2048}) CHECK(is_netcdf(write("b.nc", std::string(block, '#') + hdf)));
    for (const std::size_t block : {1, 256, 513, 4096}) CHECK(!is_netcdf(write("b.nc", std::string(block, '#') + hdf)));
    for (const char version : {'\1', '\2', '\5'}) CHECK(is_netcdf(write("b.nc", std::string("CDF") + version)));
    for (const char version : {'\0', '\3', '\4', '\6'}) CHECK(!is_netcdf(write("b.nc", std::string("CDF") + version)));
}

// Every column of every asperity, each column in a unit of its own.
void lists() {
    struct Column {
        const char *name, *unit;
        double factor;  // to mm
        std::vector<double> Asperities::*values;
        std::vector<double> given;
    };
    const std::vector<Column> columns = {{"asperity_x", "um", 1e-3, &Asperities::x, {1, 2, 3}},
                                         {"asperity_y", "nm", 1e-6, &Asperities::y, {11, 12.5, 13}},
                                         {"asperity_z", "m", 1e3, &Asperities::z, {-21, 22, 23.25}},
                                         {"asperity_radius", "inch", 25.4, &Asperities::radius, {31, 32, 33}},
                                         {"asperity_kappa1", "um-1", 1e3, &Asperities::kappa1, {41, 42, 43}},
                                         {"asperity_kappa2", "m-1", 1e-3, &Asperities::kappa2, {1, 2, 4}},
                                         {"asperity_angle", "rad", 1, &Asperities::angle, {0.1, 0.2, 0.4}},
                                         {"asperity_biharmonic", "um-3", 1e9, &Asperities::biharmonic, {-5, 6, 7}}};
    const auto file = [&](const std::set<std::string>& without, bool units) {
        std::vector<Variable> variables;
        for (const Column& c : columns)
            if (!without.contains(c.name))
                variables.push_back({c.name,
                                     NC_DOUBLE,
                                     {"asperity"},
                                     c.given,
                                     units ? std::vector{std::pair<std::string, std::string>{"units", c.unit}}
                                           : std::vector<std::pair<std::string, std::string>>{}});
        return netcdf("l.nc", {{"asperity", 3}}, variables);
    };
    for (const bool units : {true, false}) {
        const Asperities a = read_asperities(file({}, units), "mm");
        for (const Column& c : columns) {
            CHECK((a.*c.values).size() == 3);
            for (std::size_t k = 0; k < (a.*c.values).size(); ++k)
                CHECK_RELATIVE((a.*c.values)[k], c.given[k] * (units ? c.factor : 1), 1e-13);
        }
    }
    // Three curvatures or none; the biharmonic by itself; none of the first four may lack.
    for (const char* one : {"asperity_kappa1", "asperity_kappa2", "asperity_angle"}) {
        const Asperities a = read_asperities(file({one}, true), "mm");
        CHECK(a.kappa1.empty() && a.kappa2.empty() && a.angle.empty() && a.biharmonic.size() == 3 && a.radius.size() == 3);
    }
    CHECK(read_asperities(file({"asperity_biharmonic"}, true), "mm").angle.size() == 3);
    for (const char* one : {"asperity_x", "asperity_y", "asperity_z", "asperity_radius"})
        CHECK(!accepted([&] { read_asperities(file({one}, true), "mm"); }));
    const Asperities text = read_asperities(write("l.txt", "# x y z r\n1.5 -2 3e-3 4 # first\n\n+5 6d0 7D-1 8\n"));
    CHECK((text.x == std::vector{1.5, 5.0} && text.y == std::vector{-2.0, 6.0} && text.z == std::vector{3e-3, 0.7} &&
           text.radius == std::vector{4.0, 8.0}));
    const Extent e = extent(
        Asperities{.x = {3, 1, 2}, .y = {7, 9, 5}, .z = {}, .radius = {}, .kappa1 = {}, .kappa2 = {}, .angle = {}, .biharmonic = {}});
    CHECK(e.x_min == 1 && e.x_max == 3 && e.y_min == 5 && e.y_max == 9);
    const Extent none = extent({});
    CHECK(none.x_min == 0 && none.x_max == 0 && none.y_min == 0 && none.y_max == 0);
    // Spectra: wavenumbers and densities each in a unit of its own, in NetCDF and as two columns.
    const auto table = read_spectrum(netcdf("s.nc", {{"k", 3}},
                                            {{"wavenumber", NC_DOUBLE, {"k"}, {2, 3, 5}, {{"units", "um-1"}}},
                                             {"psd", NC_DOUBLE, {"k"}, {7, 11, 13}, {{"units", "nm4"}}}}),
                                     "mm")
                           .table;
    CHECK_RELATIVE(table->lowest(), 2e3, 1e-13);
    CHECK_RELATIVE(table->highest(), 5e3, 1e-13);
    CHECK_RELATIVE((*table)(3e3), 11e-24, 1e-12);
    CHECK_RELATIVE((*table)(std::sqrt(15.0) * 1e3), std::sqrt(143.0) * 1e-24, 1e-12);
    const auto columns_of_two = read_spectrum(write("s.txt", "2 7\n3 11\n5 13\n"), "um").table;
    CHECK(columns_of_two->lowest() == 2 && columns_of_two->highest() == 5 && columns_of_two->largest() == 13);
    const auto bare =
        read_spectrum(netcdf("s.nc", {{"k", 3}}, {{"wavenumber", NC_DOUBLE, {"k"}, {2, 3, 5}}, {"psd", NC_DOUBLE, {"k"}, {7, 11, 13}}}),
                      "um")
            .table;
    CHECK(bare->lowest() == 2 && bare->largest() == 13);
}

void texts() {
    // A matrix is row by row from y = 0; one spacing, L over its columns.
    const HeightMap m = read_heights(write("m.txt", "1 2 3 4 5\n6 7 8 9 10\n-11 +12 1.3d1 14e0 15.5\n"), 10.0);
    CHECK(m.nx == 5 && m.ny == 3 && m.dx == 2 && m.dy == 2 && m.x0 == 0 && m.y0 == 0 && !m.periodic);
    const double wanted[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, -11, 12, 13, 14, 15.5};
    for (int k = 0; k < 15; ++k) CHECK(m(k % 5, k / 5) == wanted[k]);
    // Triples in any order: 5 columns of 0.5 from -1, 4 rows of 2 from 3; a line left out and a word for it.
    std::string all, some;
    for (int k = 0; k < 20; ++k) {
        const int p = 3 * k % 20, i = p % 5, j = p / 5;
        const std::string place = std::to_string(-1 + 0.5 * i) + " " + std::to_string(3 + 2 * j) + " ";
        all += place + std::to_string(100 * j + i) + "\n";
        if (p != 7) some += place + (p == 13 ? "BAD" : p == 16 ? "NaN" : std::to_string(100 * j + i)) + "\n";
    }
    const HeightMap t = read_heights(write("t.txt", all), 2.5),
                    h = read_heights(write("h.txt", some), std::nullopt, "mm", "", Missing::fill);
    for (const HeightMap* map : {&t, &h}) {
        CHECK(map->nx == 5 && map->ny == 4);
        CHECK_CLOSE(map->x0, -1, 1e-14);
        CHECK_CLOSE(map->y0, 3, 1e-14);
        CHECK_CLOSE(map->dx, 0.5, 1e-14);
        CHECK_CLOSE(map->dy, 2, 1e-14);
        for (int p = 0; p < 20; ++p) {
            const double z = (*map)(p % 5, p / 5);
            if (map == &h && (p == 7 || p == 13 || p == 16))
                CHECK(std::isnan(z));
            else
                CHECK(z == 100 * (p / 5) + p % 5);
        }
    }
    CHECK(!accepted([&] { read_heights(folder / "h.txt", std::nullopt); }));
    // L is nx dx to a relative 1e-6, in every format that says its size itself.
    for (const double off : {-1.1e-6, -0.9e-6, 0.9e-6, 1.1e-6})
        CHECK(accepted([&] { read_heights(folder / "t.txt", 2.5 * (1 + off)); }) == (std::abs(off) < 1e-6));
}

// Instruments: sides of unlike steps, told in other units than the run's, scales of heights, no sides at all, masks.
void instruments() {
    Map map{4, 3, 2e-6, 5e-6, {}};
    for (int k = 0; k < 12; ++k) map.z.push_back(1e-9 * (10 * (k / 4) + k % 4 + 1));  // rows from the top
    std::vector<std::int16_t> numbers;
    std::vector<std::string> words;
    for (const double z : map.z)
        numbers.push_back(static_cast<std::int16_t>(std::lround(z * 1e9))), words.push_back(std::to_string(numbers.back()));
    for (const auto& [unit, metre] : {std::pair{"mm", 1e-3}, {"nm", 1e-9}})
        for (const double scale : {1e-9, 3e-9})
            for (const std::string& path : {write("b.sdf", sdf_binary(map, 5, scale, numbers)), write("a.sdf", sdf_text(map, scale, words)),
                                            write("c.gwy", gwy_file(gwy_channel(3, "T", map)))}) {
                const bool gwy = path.ends_with("gwy");
                const HeightMap m = read_heights(path, 8e-6 / metre, unit);
                CHECK(m.nx == 4 && m.ny == 3 && m.x0 == 0 && m.y0 == 0 && !m.periodic);
                CHECK_RELATIVE(m.dx, 2e-6 / metre, 1e-12);
                CHECK_RELATIVE(m.dy, 5e-6 / metre, 1e-12);
                for (int j = 0; j < 3; ++j)
                    for (int i = 0; i < 4; ++i) CHECK_RELATIVE(m(i, j), (10 * (2 - j) + i + 1) * (gwy ? 1e-9 : scale) / metre, 1e-12);
                CHECK(!accepted([&] { read_heights(path, 8.1e-6 / metre, unit); }));
            }
    // Words that may be written in another way.
    const HeightMap odd = read_heights(
        write("o.sdf",
              "aBCR-1.0\nNUMPOINTS\t=\t3\nnumprofiles=+3\nXSCALE = 1e-6\nYscale   2E-6\nzscale=1e-9\n; Zscale = 5\nDataType=6\n*\n"
              "1 +2 3\n4 -2147483648 bad\nNaN 8 9\n*\n"),
        std::nullopt, "um", "", Missing::fill);
    CHECK_RELATIVE(odd.dx, 1.0, 1e-12);
    CHECK_RELATIVE(odd.dy, 2.0, 1e-12);
    CHECK(std::isnan(odd(1, 1)) && std::isnan(odd(2, 1)) && std::isnan(odd(0, 0)));
    CHECK_RELATIVE(odd(1, 2), 2e-3, 1e-12);
    CHECK_RELATIVE(odd(2, 0), 9e-3, 1e-12);
    // Gwyddion: what has no sides has sides of 1; a mask is of its own channel, and any number above 0 masks; a channel without title.
    const auto channel = [&](int number, const Map& of, const std::string& title) {
        std::string c;
        const std::string base = "/" + std::to_string(number) + "/data";
        gwy_component(c, base, 'o', gwy_field(of, "m", "m"));
        if (!title.empty()) gwy_component(c, base + "/title", 's', title + '\0');
        return c;
    };
    Map bare = map;
    bare.dx = bare.dy = 0;
    const HeightMap sides = read_heights(write("s.gwy", gwy_file(channel(0, bare, "T"))), std::nullopt, "m");
    CHECK_RELATIVE(sides.dx, 1.0 / 4, 1e-14);
    CHECK_RELATIVE(sides.dy, 1.0 / 3, 1e-14);
    Map second = map, mask = map;
    for (double& z : second.z) z *= 7;
    for (double& z : mask.z) z = 0;
    mask.z[1] = 0.01, mask.z[6] = -1, mask.z[11] = 2;
    std::string both = channel(5, map, "") + channel(12, second, "S");
    gwy_component(both, "/12/mask", 'o', gwy_field(mask, "m", ""));
    const std::string two = write("two.gwy", gwy_file(both));
    const auto read = [&](const std::string& name) { return read_heights(two, std::nullopt, "nm", name, Missing::fill); };
    CHECK_RELATIVE(read("")(0, 2), 1.0, 1e-12);  // the lowest number
    CHECK_RELATIVE(read("channel 5")(3, 0), 24.0, 1e-12);
    const HeightMap s = read("S");
    for (int k = 0; k < 12; ++k) {
        const double z = s(k % 4, 2 - k / 4);
        if (k == 1 || k == 11)
            CHECK(std::isnan(z));
        else
            CHECK_RELATIVE(z, 7 * (10 * (k / 4) + k % 4 + 1.0), 1e-12);
    }
}

void patterns() {
    for (const char* name : {"p10.txt", "p2.txt", "P3.txt", "q.txt", "p.txt"}) write(name, "1\n");
    using Names = std::vector<std::string>;
    CHECK((matching_files(folder / "p*.txt") == Names{folder / "p.txt", folder / "p10.txt", folder / "p2.txt"}));
    CHECK((matching_files(folder / "p?.txt") == Names{folder / "p2.txt"}));
    CHECK((matching_files(folder / "[pP][23].txt") == Names{folder / "P3.txt", folder / "p2.txt"}));
    CHECK((matching_files("no such file") == Names{"no such file"}));
    CHECK(!accepted([&] { matching_files(folder / "r*"); }));
    CHECK(is_pattern("a*") && is_pattern("a?b") && is_pattern("[a") && !is_pattern("a]b{c}.txt"));
}

}  // namespace

TESTS {
    units_and_directions();
    types();
    lengths();
    lists();
    texts();
    instruments();
    patterns();
}
