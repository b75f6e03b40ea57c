// Every number that comes out of a file: values, units, axes and their directions, whatever the
// file's format, type and length. All numbers of an input differ from each other.
#include "check.hpp"
#include "io/input_netcdf.hpp"
#include "io/inputs.hpp"
#include "support/netcdf_file.hpp"
#include "support/refused.hpp"
#include "support/temporary_folder.hpp"

namespace test_input_values {

using namespace rsc;
using namespace netcdf_file;

const Folder folder;

std::string netcdf(const std::string& name, const Dimensions& dimensions,
                   const std::vector<Variable>& variables) {
    return netcdf_file::write(folder / name, dimensions, variables);
}

using Values = std::vector<double>;

// height(y = 3, x = 4): 10 row + column.
std::vector<double> heights() {
    std::vector<double> z;
    for (const int k : indices(12)) z.push_back(10 * (k / 4) + k % 4);
    return z;
}

// Each coordinate in its own unit, each running up or down: where a point lies and how high it is,
// in every run's unit.
TEST(units_and_directions) {
    const std::vector<std::pair<const char*, double>> units = {
        {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}, {"inch", 0.0254}};
    for (const auto& [wanted, metre] : units)
        for (const auto k : indices(units))
            for (const bool left : {false, true})
                for (const bool down : {false, true}) {
                    const auto& [uz, z] = units[k];
                    const auto& [ux, x] = units[(k + 1) % 4];
                    const auto& [uy, y] = units[(k + 2) % 4];
                    const std::string path =
                        netcdf("u.nc", {{"y", 3}, {"x", 4}},
                               {{"height", NC_DOUBLE, {"y", "x"}, heights(), {{"units", uz}}},
                                {"x",
                                 NC_DOUBLE,
                                 {"x"},
                                 left ? counted(4, 9.5, -1.5) : counted(4, 5, 1.5),
                                 {{"units", ux}}},
                                {"y",
                                 NC_DOUBLE,
                                 {"y"},
                                 down ? counted(3, -2, -2.5) : counted(3, -7, 2.5),
                                 {{"units", uy}}}});
                    const HeightMap m = read_heights(path, std::nullopt, wanted);
                    CHECK(m.nx == 4 && m.ny == 3 && !m.periodic);
                    CHECK_RELATIVE(m.x0, 5 * x / metre, 1e-13);
                    CHECK_RELATIVE(m.dx, 1.5 * x / metre, 1e-13);
                    CHECK_RELATIVE(m.y0, -7 * y / metre, 1e-13);
                    CHECK_RELATIVE(m.dy, 2.5 * y / metre, 1e-13);
                    for (const int j : indices(3))
                        for (const int i : indices(4))
                            CHECK_RELATIVE(
                                m(i, j), (10 * (down ? 2 - j : j) + (left ? 3 - i : i)) * z / metre,
                                1e-13);
                }
}

HeightMap filled(const std::vector<Variable>& variables) {
    return read_heights(netcdf("t.nc", {{"y", 3}, {"x", 4}}, variables), 2.0, "mm", "",
                        Missing::fill);
}

// The numbers of every type, as they are and packed, and what each type has for "nothing was
// written".
TEST(types) {
    const std::vector<std::tuple<nc_type, double, bool>> all = {
        {NC_DOUBLE, NC_FILL_DOUBLE, true},
        {NC_FLOAT, double(NC_FILL_FLOAT), true},
        {NC_INT, double(NC_FILL_INT), true},
        {NC_SHORT, double(NC_FILL_SHORT), true},
        {NC_INT64, double(NC_FILL_INT64), true},
        {NC_BYTE, -127, false},
        {NC_UBYTE, 255, false},
        {NC_USHORT, 65535, false}};
    for (const auto& [type, fill, is_missing] : all) {
        for (const double scale : {1.0, 0.25})
            for (const double offset : {0.0, -3.0}) {
                Variable v{"height", type, {"y", "x"}, heights()};
                if (scale != 1) v.numbers.push_back({"scale_factor", {scale}});
                if (offset != 0) v.numbers.push_back({"add_offset", {offset}});
                const HeightMap m = read_heights(netcdf("t.nc", {{"y", 3}, {"x", 4}}, {v}), 2.0);
                CHECK(m.dx == 0.5 && m.dy == 0.5 && m.x0 == 0 && m.y0 == 0);
                for (const int j : indices(3))
                    for (const int i : indices(4)) CHECK(m(i, j) == (10 * j + i) * scale + offset);
            }
        std::vector<double> z = heights();
        z[6] = fill;
        const std::string path =
            netcdf("t.nc", {{"y", 3}, {"x", 4}}, {{"height", type, {"y", "x"}, z}});
        CHECK(accepted([&] { read_heights(path, 2.0); }) == !is_missing);
        const HeightMap m = read_heights(path, 2.0, "mm", "", Missing::fill);
        CHECK(std::isnan(m(2, 1)) == is_missing && m(1, 1) == 11);
    }
    // A fill value of its own takes the place of the type's; what is packed is compared as it is
    // stored.
    for (const bool own : {false, true}) {
        std::vector<double> z = heights();
        z[6] = NC_FILL_SHORT;
        z[7] = 12;
        Variable v{"height", NC_SHORT, {"y", "x"}, z, {}, {{"scale_factor", {3}}}};
        if (own) v.numbers.push_back({"_FillValue", {12}});
        const HeightMap m = filled({v});
        CHECK(std::isnan(m(2, 1)) == !own && std::isnan(m(3, 1)) == own && m(0, 1) == 30);
        CHECK(std::isnan(m(0, 2)) == false && m(0, 2) == 60);
    }
    // Values marked in another type, or by their range, and unsigned ones of the classic formats,
    // of which 65535 is marked.
    for (const auto& [name, numbers] : {std::pair{"missing_value", Values{0.1}},
                                        {"valid_max", {30}},
                                        {"valid_range", {-9, 30}},
                                        {"valid_min", {1}}}) {
        Values z = heights();
        z[6] = numbers == Values{1} ? 0.5 : numbers.back() + (numbers.back() > 1 ? 10 : 0);
        const HeightMap m = filled({{"height", NC_FLOAT, {"y", "x"}, z, {}, {{name, numbers}}}});
        CHECK(std::isnan(m(2, 1)) && m(1, 1) == 11 && m(3, 2) == 23);
    }
    // Limits of packed integers are packed, too; real numbers are heights.
    Variable v{"height", NC_SHORT, {"y", "x"}, heights()};
    v.numbers = {{"scale_factor", {-0.1}}, {"add_offset", {5}}, {"valid_range", {2.8, 9}}};
    const HeightMap packed = filled({v});
    CHECK(std::isnan(packed(3, 2)) && !std::isnan(packed(2, 2)) && packed(0, 0) == 5);
    v.numbers = {{"scale_factor", {0.1}}, {"add_offset", {5}}, {"valid_min", {5.2}}};
    const HeightMap high = filled({v});
    CHECK(std::isnan(high(1, 0)) && !std::isnan(high(2, 0)) && !std::isnan(high(3, 2)));
    Values z = heights();
    z[5] = -25536;
    z[6] = -1;
    const HeightMap u = filled(
        {{"height", NC_SHORT, {"y", "x"}, z, {{"_Unsigned", "true"}}, {{"_FillValue", {-1}}}}});
    CHECK(u(1, 1) == 40000 && std::isnan(u(2, 1)) && u(3, 2) == 23);
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
                                    {{"height", NC_DOUBLE, {"y", "x"}, heights()},
                                     {"x", NC_DOUBLE, {"other"}, counted(4, 0, 1)}});
    CHECK(read_heights(text, 6.0).dx == 1.5 &&
          !accepted([&] { read_heights(text, std::nullopt); }));
}

// Every column of every asperity, each column in a unit of its own.
TEST(lists) {
    struct Column {
        const char *name, *unit;
        double factor;  // to mm
        std::vector<double> Asperities::*values;
        std::vector<double> given;
    };
    const std::vector<Column> columns = {
        {"asperity_x", "um", 1e-3, &Asperities::x, {1, 2, 3}},
        {"asperity_y", "nm", 1e-6, &Asperities::y, {11, 12.5, 13}},
        {"asperity_z", "m", 1e3, &Asperities::z, {-21, 22, 23.25}},
        {"asperity_radius", "inch", 25.4, &Asperities::radius, {31, 32, 33}},
        {"asperity_kappa1", "um-1", 1e3, &Asperities::kappa1, {41, 42, 43}},
        {"asperity_kappa2", "m-1", 1e-3, &Asperities::kappa2, {1, 2, 4}},
        {"asperity_angle", "degree", pi / 180, &Asperities::angle, {0.1, 0.2, 0.4}},
        {"asperity_biharmonic", "um-3", 1e9, &Asperities::biharmonic, {-5, 6, 7}}};
    const auto file = [&](const std::set<std::string>& without, bool units) {
        std::vector<Variable> variables;
        for (const Column& c : columns)
            if (!without.contains(c.name))
                variables.push_back(
                    {c.name,
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
        CHECK(a.kappa1.empty() && a.kappa2.empty() && a.angle.empty() && a.biharmonic.size() == 3 &&
              a.radius.size() == 3);
    }
    CHECK(read_asperities(file({"asperity_biharmonic"}, true), "mm").angle.size() == 3);
    for (const char* one : {"asperity_x", "asperity_y", "asperity_z", "asperity_radius"})
        CHECK(!accepted([&] { read_asperities(file({one}, true), "mm"); }));
    const Asperities text = read_asperities(
        folder.write("l.txt", "# x y z r\n1.5 -2 3e-3 4 # first\n\n+5 6d0 7D-1 8\n"));
    CHECK((text.x == std::vector{1.5, 5.0} && text.y == std::vector{-2.0, 6.0} &&
           text.z == std::vector{3e-3, 0.7} && text.radius == std::vector{4.0, 8.0}));
    // Spectra: wavenumbers and densities each in a unit of its own, in NetCDF and as two columns.
    const auto table =
        read_spectrum(netcdf("s.nc", {{"k", 3}},
                             {{"wavenumber", NC_DOUBLE, {"k"}, {2, 3, 5}, {{"units", "um-1"}}},
                              {"psd", NC_DOUBLE, {"k"}, {7, 11, 13}, {{"units", "nm4"}}}}),
                      "mm")
            .table;
    CHECK_RELATIVE(table->lowest(), 2e3, 1e-13);
    CHECK_RELATIVE(table->highest(), 5e3, 1e-13);
    CHECK_RELATIVE((*table)(3e3), 11e-24, 1e-12);
    CHECK_RELATIVE((*table)(std::sqrt(15.0) * 1e3), std::sqrt(143.0) * 1e-24, 1e-12);
    const auto columns_of_two =
        read_spectrum(folder.write("s.txt", "2 7\n3 11\n5 13\n"), "um").table;
    CHECK(columns_of_two->lowest() == 2 && columns_of_two->highest() == 5 &&
          columns_of_two->largest() == 13);
    const auto bare = read_spectrum(netcdf("s.nc", {{"k", 3}},
                                           {{"wavenumber", NC_DOUBLE, {"k"}, {2, 3, 5}},
                                            {"psd", NC_DOUBLE, {"k"}, {7, 11, 13}}}),
                                    "um")
                          .table;
    CHECK(bare->lowest() == 2 && bare->largest() == 13);
    // The exponent by which the spectrum of a map is multiplied for its twins; densities or
    // wavenumbers that are missing.
    const auto with = [](double exponent, const char* name = "psd") {
        return read_spectrum(netcdf("s.nc", {{"k", 3}},
                                    {{"wavenumber", NC_DOUBLE, {"k"}, {2, 3, 8}},
                                     {name,
                                      NC_DOUBLE,
                                      {"k"},
                                      {7, 11, 13},
                                      {},
                                      {{"twin_exponent", {exponent}}}}}),
                             "um")
            .table;
    };
    CHECK_RELATIVE((*with(-0.5))(8), 13.0 / 2, 1e-12);
    CHECK_RELATIVE((*with(0.5))(8), 13.0 * 2, 1e-12);
    for (const double exponent : {-3.0, 0.7, std::nan("")})
        CHECK(!accepted([&] { with(exponent); }));
    CHECK(!accepted([&] { with(-0.5, "other"); }));
    CHECK(!accepted([] {
        read_spectrum(
            netcdf("s.nc", {{"k", 3}, {"none", 0}},
                   {{"wavenumber", NC_DOUBLE, {"none"}, {}},
                    {"psd", NC_DOUBLE, {"k"}, {7, 11, 13}, {}, {{"twin_exponent", {-0.5}}}}}),
            "um");
    }));
}

TEST(texts) {
    // A matrix is row by row from y = 0; one spacing, L over its columns.
    const HeightMap m = read_heights(
        folder.write("m.txt", "1 2 3 4 5\n6 7 8 9 10\n-11 +12 1.3d1 14e0 15.5\n"), 10.0);
    CHECK(m.nx == 5 && m.ny == 3 && m.dx == 2 && m.dy == 2 && m.x0 == 0 && m.y0 == 0 &&
          !m.periodic);
    const double wanted[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, -11, 12, 13, 14, 15.5};
    for (const int k : indices(15)) CHECK(m(k % 5, k / 5) == wanted[k]);
    // Triples in any order: 5 columns of 0.5 from -1, 4 rows of 2 from 3; a line left out and a
    // word for it.
    std::string all, some;
    for (const int k : indices(20)) {
        const int p = 3 * k % 20, i = p % 5, j = p / 5;
        const std::string place =
            std::to_string(-1 + 0.5 * i) + " " + std::to_string(3 + 2 * j) + " ";
        all += place + std::to_string(100 * j + i) + "\n";
        if (p != 7)
            some += place +
                    (p == 13   ? "BAD"
                     : p == 16 ? "NaN"
                               : std::to_string(100 * j + i)) +
                    "\n";
    }
    const HeightMap t = read_heights(folder.write("t.txt", all), 2.5),
                    h = read_heights(folder.write("h.txt", some), std::nullopt, "mm", "",
                                     Missing::fill);
    for (const HeightMap* map : {&t, &h}) {
        CHECK(map->nx == 5 && map->ny == 4);
        CHECK_CLOSE(map->x0, -1, 1e-14);
        CHECK_CLOSE(map->y0, 3, 1e-14);
        CHECK_CLOSE(map->dx, 0.5, 1e-14);
        CHECK_CLOSE(map->dy, 2, 1e-14);
        for (const int p : indices(20)) {
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
        CHECK(accepted([&] { read_heights(folder / "t.txt", 2.5 * (1 + off)); }) ==
              (std::abs(off) < 1e-6));
}

}  // namespace test_input_values
