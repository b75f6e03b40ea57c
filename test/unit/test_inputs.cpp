// Heights and asperities from files: what is read, and what is refused with which words.
#include "read/inputs.hpp"

#include <netcdf.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "check.hpp"
#include "error.hpp"
#include "read/input_spectrum.hpp"
#include "unit/refused.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;

namespace {

const Folder folder;

std::string in_folder(const std::string& name) { return folder / name; }

std::string write(const std::string& name, const std::string& content) { return folder.write(name, content); }

void ok(int status) {
    if (status != NC_NOERR) std::printf("NetCDF: %s\n", nc_strerror(status));
    CHECK(status == NC_NOERR);
}

struct NcFile {
    int id = -1;
    std::string path;
    explicit NcFile(const std::string& name, int format = NC_NETCDF4) : path(in_folder(name)) {
        ok(nc_create(path.c_str(), NC_CLOBBER | format, &id));
    }
    ~NcFile() { close(); }
    void close() {
        if (id >= 0) ok(nc_close(id));
        id = -1;
    }
    int dimension(const char* name, std::size_t length) {
        int d = -1;
        ok(nc_def_dim(id, name, length, &d));
        return d;
    }
    int variable(const char* name, nc_type type, std::vector<int> dimensions) {
        int v = -1;
        ok(nc_def_var(id, name, type, static_cast<int>(dimensions.size()), dimensions.data(), &v));
        return v;
    }
};

std::vector<double> ramp(std::size_t n, double first, double step) {
    std::vector<double> c(n);
    for (std::size_t i = 0; i < n; ++i) c[i] = first + static_cast<double>(i) * step;
    return c;
}

// height(y = 3, x = 5) = 10 y index + x index, with coordinates as given (empty: none), changed by `tamper` before the data go
// in.
std::string heights_file(const std::string& name, int format, std::vector<double> x, std::vector<double> y, const char* variable = "height",
                         nc_type type = NC_DOUBLE, const std::function<void(int, int)>& tamper = {}, std::vector<double> z = {}) {
    NcFile f(name, format);
    const int dy = f.dimension("y", 3), dx = f.dimension("x", 5);
    const int v = f.variable(variable, type, {dy, dx});
    const int vx = x.empty() ? -1 : f.variable("x", NC_DOUBLE, {dx}), vy = y.empty() ? -1 : f.variable("y", NC_DOUBLE, {dy});
    if (tamper) tamper(f.id, v);
    ok(nc_enddef(f.id));
    if (z.empty())
        for (int i = 0; i < 15; ++i) z.push_back(10 * (i / 5) + i % 5);
    ok(nc_put_var_double(f.id, v, z.data()));
    if (vx >= 0) ok(nc_put_var_double(f.id, vx, x.data()));
    if (vy >= 0) ok(nc_put_var_double(f.id, vy, y.data()));
    return f.path;
}

void heights_from_netcdf() {
    for (const int format : {0, int{NC_64BIT_OFFSET}, int{NC_64BIT_DATA}, int{NC_NETCDF4}}) {
        const HeightMap m = read_heights(heights_file("h", format, ramp(5, 0.05, 0.1), ramp(3, -1, 0.25)), std::nullopt);
        CHECK(m.nx == 5 && m.ny == 3 && !m.periodic);
        CHECK_CLOSE(m.dx, 0.1, 1e-15);
        CHECK_CLOSE(m.dy, 0.25, 1e-15);
        CHECK(m.x0 == 0.05 && m.y0 == -1);
        CHECK(m(3, 2) == 23 && m(0, 0) == 0);
        CHECK_CLOSE(m.Lx(), 0.5, 1e-15);
    }
    // Another name, no coordinates: L is the extent in x.
    const std::string bare = heights_file("bare", NC_NETCDF4, {}, {}, "Topography");
    const HeightMap m = read_heights(bare, 2.0);
    CHECK(m.dx == 0.4 && m.dy == 0.4 && m.x0 == 0 && m.y0 == 0 && m(4, 1) == 14);
    REFUSED(read_heights(bare, std::nullopt), ": Topography(y = 3, x = 5) has no coordinate variables; L, its extent in x, must be given");
    REFUSED(read_heights(bare, -1.0), "bare: L must be positive and finite, not -1");
    REFUSED(read_heights(bare, 0.0), "bare: L must be positive and finite, not 0");
    // L beside coordinates: the same or refused.
    const std::string both = heights_file("both", NC_NETCDF4, ramp(5, 0, 0.1), ramp(3, 0, 0.1));
    CHECK_CLOSE(read_heights(both, 0.5).dx, 0.1, 1e-15);
    REFUSED(read_heights(both, 0.4), ": its coordinate x spans 5 steps of 0.1 = 0.5, but L = 0.4 was given");
    // Falling coordinates are turned round.
    const HeightMap turned = read_heights(heights_file("turned", NC_NETCDF4, ramp(5, 0.4, -0.1), ramp(3, 2, -1)), std::nullopt);
    CHECK(turned(0, 0) == 24 && turned(4, 2) == 0 && turned(4, 0) == 20);
    CHECK_CLOSE(turned.x0, 0, 1e-15);
    CHECK(turned.y0 == 0 && turned.dy == 1);
    // Packed.
    const auto pack = [](int id, int v) {
        const double scale = 0.5, offset = -3;
        ok(nc_put_att_double(id, v, "scale_factor", NC_DOUBLE, 1, &scale));
        ok(nc_put_att_double(id, v, "add_offset", NC_DOUBLE, 1, &offset));
    };
    const HeightMap packed =
        read_heights(heights_file("packed", NC_NETCDF4, ramp(5, 0, 1), ramp(3, 0, 1), "height", NC_SHORT, pack), std::nullopt);
    CHECK(packed(3, 2) == 23 * 0.5 - 3);
}

void bad_heights_from_netcdf() {
    const std::vector<double> x = ramp(5, 0, 0.1), y = ramp(3, 0, 0.1);
    std::vector<double> uneven = x;
    uneven[2] += 1e-6;
    REFUSED(read_heights(heights_file("uneven", NC_NETCDF4, uneven, y), std::nullopt),
            ": coordinate x is not uniform to 1e-6 of its step 0.1: x(2), counted from 0, is 0.200001 where 0.2 was expected");
    uneven[2] = x[2] + 0.9e-7;  // within the tolerance
    CHECK(read_heights(heights_file("even", NC_NETCDF4, uneven, y), std::nullopt).nx == 5);
    REFUSED(read_heights(heights_file("flat", NC_NETCDF4, ramp(5, 1, 0), y), std::nullopt),
            ": coordinate x does not vary: it begins and ends at 1");
    REFUSED(read_heights(heights_file("one", NC_NETCDF4, x, {}), std::nullopt),
            ": height(y = 3, x = 5) has a coordinate variable for one dimension alone; for both or neither was expected");
    std::vector<double> nan_x = x;
    nan_x[4] = std::nan("");
    REFUSED(read_heights(heights_file("nanx", NC_NETCDF4, nan_x, y), std::nullopt),
            ": x(x = 4), counted from 0, is not finite; every value must be known");

    std::vector<double> z = ramp(15, 0, 1);
    z[7] = std::nan("");
    REFUSED(read_heights(heights_file("nan", NC_NETCDF4, x, y, "height", NC_DOUBLE, {}, z), std::nullopt),
            ": height(y = 1, x = 2), counted from 0, is not finite; every value must be known");
    z[7] = HUGE_VAL;
    REFUSED(read_heights(heights_file("inf", 0, x, y, "height", NC_DOUBLE, {}, z), std::nullopt), "height(y = 1, x = 2)");
    z[7] = -99;
    const auto fill = [](int id, int v) {
        const double value = -99;
        ok(nc_put_att_double(id, v, "_FillValue", NC_DOUBLE, 1, &value));
    };
    const auto missing = [](int id, int v) {
        const double values[] = {-98, -99};
        ok(nc_put_att_double(id, v, "missing_value", NC_DOUBLE, 2, values));
    };
    REFUSED(read_heights(heights_file("fill", NC_NETCDF4, x, y, "height", NC_DOUBLE, fill, z), std::nullopt),
            ": height(y = 1, x = 2), counted from 0, is missing (it holds the fill value -99); every value must be known");
    REFUSED(read_heights(heights_file("missing", NC_NETCDF4, x, y, "height", NC_DOUBLE, missing, z), std::nullopt), "is missing");
    z[7] = NC_FILL_DOUBLE;
    REFUSED(read_heights(heights_file("unwritten", NC_NETCDF4, x, y, "height", NC_DOUBLE, {}, z), std::nullopt), "is missing");

    {
        NcFile f("two");
        const int d = f.dimension("a", 4), e = f.dimension("b", 4);
        f.variable("first", NC_DOUBLE, {d, e});
        f.variable("second", NC_FLOAT, {d, e});
        f.close();
        REFUSED(read_heights(f.path, 1.0),
                ": there is no variable height(y, x), and it cannot be told which is meant: first(a = 4, b = 4), second(a = 4, b = 4)");
    }
    {
        NcFile f("cube");
        f.variable("height", NC_DOUBLE, {f.dimension("t", 2), f.dimension("y", 4), f.dimension("x", 4)});
        f.close();
        REFUSED(read_heights(f.path, 1.0), ": height(y, x), numeric, was expected, not height(t = 2, y = 4, x = 4)");
    }
    {
        NcFile f("none");
        f.variable("t", NC_DOUBLE, {f.dimension("t", 2)});
        f.close();
        REFUSED(read_heights(f.path, 1.0), ": there is no variable height(y, x) and no other of two dimensions");
        REFUSED(read_asperities(f.path),
                ": there is no variable asperity_x; asperity_x, asperity_y, asperity_z and asperity_radius were expected");
    }
    {
        NcFile f("absurd");  // an empty file may announce anything
        const int d = f.dimension("y", 2000000000), e = f.dimension("x", 2000000000);
        const int v = f.variable("height", NC_DOUBLE, {d, e});
        const std::size_t chunks[] = {100, 100};
        ok(nc_def_var_chunking(f.id, v, NC_CHUNKED, chunks));
        f.close();
        REFUSED(read_heights(f.path, 1.0), ": a height map of 2000000000 x 2000000000 points needs 3.2e+10 GB; this machine has ");
    }
    {
        NcFile f("wide");
        const int d = f.dimension("y", 3), e = f.dimension("x", 3000000000U);
        const std::size_t chunks[] = {3, 100};
        ok(nc_def_var_chunking(f.id, f.variable("height", NC_DOUBLE, {d, e}), NC_CHUNKED, chunks));
        f.close();
        REFUSED(read_heights(f.path, 1.0), "wide: a height map of 3000000000 x 3 points; at most 2147483647 a side are possible");
    }
    {
        NcFile f("small");
        f.variable("height", NC_DOUBLE, {f.dimension("y", 2), f.dimension("x", 9)});
        f.close();
        REFUSED(read_heights(f.path, 1.0), ": a height map of 9 x 2 points; at least 3 x 3 are needed");
    }
}

// Heights, x and y each in a unit of its own, converted to the run's.
void units() {
    const std::vector<double> x = ramp(5, 0.5, 1), y = ramp(3, 500, 2000);
    const auto file = [&](const char* height, const char* x_unit, const char* y_unit) {
        const auto tamper = [&](int id, int v) {
            for (const auto& [variable, unit] : {std::pair(v, height), {v + 1, x_unit}, {v + 2, y_unit}})
                if (unit) ok(nc_put_att_text(id, variable, "units", std::strlen(unit), unit));
        };
        return heights_file("units", NC_NETCDF4, x, y, "height", NC_DOUBLE, tamper);
    };
    const HeightMap m = read_heights(file("nm", "um", "nm"), 0.005, "mm");
    CHECK_CLOSE(m(3, 2), 23e-6, 1e-20);
    CHECK_CLOSE(m.dx, 1e-3, 1e-18);
    CHECK_CLOSE(m.x0, 0.5e-3, 1e-18);
    CHECK_CLOSE(m.dy, 2e-3, 1e-18);
    CHECK_CLOSE(m.y0, 0.5e-3, 1e-18);
    CHECK(read_heights(file("nm", "um", "nm"), std::nullopt, "um")(3, 2) == 23e-3);
    CHECK(read_heights(file(nullptr, nullptr, nullptr), std::nullopt, "um")(3, 2) == 23);
    CHECK(read_heights(file("um", nullptr, nullptr), std::nullopt, "um")(3, 2) == 23);
    CHECK(read_heights(file("1", "1", "1"), std::nullopt, "1")(3, 2) == 23);
    REFUSED(read_heights(file("um", nullptr, "um"), std::nullopt, "mm"),
            ": y is in 'um', but x has no attribute units: it cannot be told what it is in");
    REFUSED(read_heights(file("banana", "um", "um"), std::nullopt, "mm"),
            ": the units of height: 'banana' is no unit; a unit of length as UDUNITS spells it is expected, such as 'mm', 'um' or 'm'");
    REFUSED(read_heights(file("um", "s", "um"), std::nullopt, "mm"), ": the units of x: 's' is no unit of length; a unit");
    REFUSED(read_heights(file("1", "1", "1"), std::nullopt, "mm"), "the units of height: '1' is no unit of length");
    REFUSED(read_heights(file("um", "um", "nm"), 5.0, "mm"), ": its coordinate x spans 5 steps of 0.001 = 0.005, but L = 5 was given");

    NcFile f("list");
    const int d = f.dimension("asperity", 1);
    const std::pair<const char*, const char*> names[] = {
        {"asperity_x", "um"},        {"asperity_y", "um"},        {"asperity_z", "nm"},         {"asperity_radius", "um"},
        {"asperity_kappa1", "um-1"}, {"asperity_kappa2", "mm-1"}, {"asperity_angle", "radian"}, {"asperity_biharmonic", "um-3"}};
    std::vector<int> variables;
    for (const auto& [name, unit] : names) {
        variables.push_back(f.variable(name, NC_DOUBLE, {d}));
        ok(nc_put_att_text(f.id, variables.back(), "units", std::strlen(unit), unit));
    }
    ok(nc_enddef(f.id));
    const double two = 2;
    for (const int v : variables) ok(nc_put_var_double(f.id, v, &two));
    f.close();
    const Asperities a = read_asperities(f.path, "mm");
    CHECK_CLOSE(a.x[0], 2e-3, 1e-18);
    CHECK_CLOSE(a.z[0], 2e-6, 1e-20);
    CHECK_CLOSE(a.radius[0], 2e-3, 1e-18);
    CHECK_CLOSE(a.kappa1[0], 2e3, 1e-9);
    CHECK(a.kappa2[0] == 2 && a.angle[0] == 2);
    CHECK_CLOSE(a.biharmonic[0], 2e9, 1e-3);
}

void cut_files() {
    // However much is missing, it is said; a classic file would otherwise go on with zeros.
    for (const int format : {0, int{NC_64BIT_OFFSET}, int{NC_64BIT_DATA}, int{NC_NETCDF4}}) {
        const std::string whole = heights_file("whole", format, ramp(5, 0, 1), ramp(3, 0, 1));
        std::ifstream stream(whole, std::ios::binary);
        const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
        int said = 0, cuts = 0;
        for (std::size_t keep = 9; keep < bytes.size(); keep += 1 + bytes.size() / 100) {
            const std::string cut = write("cut", bytes.substr(0, keep));
            ++cuts;
            try {
                read_heights(cut, std::nullopt);
            } catch (const Error& e) {
                const bool clear = std::strstr(e.what(), "whole") || std::strstr(e.what(), "cut off");
                said += clear && e.kind() == Failure::bad_input ? 1 : 0;
            }
        }
        CHECK(said == cuts && cuts > 50);
        REFUSED(read_heights(write("cut", bytes.substr(0, 20)), std::nullopt),
                format == NC_NETCDF4 ? "cut: looks like NetCDF but cannot be opened; is it whole? ("
                                     : "cut: looks like NetCDF, but its header is cut off or damaged at byte " +
                                           std::to_string(format == NC_64BIT_DATA ? 16 : 20));
        REFUSED(read_heights(write("cut", bytes.substr(0, bytes.size() - 1)), std::nullopt), "whole");
    }
    // With a record dimension too.
    NcFile f("records", 0);
    const int y = f.dimension("y", NC_UNLIMITED), x = f.dimension("x", 3);
    const int v = f.variable("height", NC_DOUBLE, {y, x}), other = f.variable("other", NC_SHORT, {y});
    ok(nc_enddef(f.id));
    for (std::size_t j = 0; j < 4; ++j) {
        const std::size_t start[] = {j, 0}, count[] = {1, 3};
        const double row[] = {1, 2, static_cast<double>(j)};
        const short one = 1;
        ok(nc_put_vara_double(f.id, v, start, count, row));
        ok(nc_put_var1_short(f.id, other, start, &one));
    }
    f.close();
    CHECK(read_heights(f.path, 3.0)(2, 3) == 3);
    const auto whole = std::filesystem::file_size(f.path);
    std::filesystem::resize_file(f.path, whole - 8);
    REFUSED(read_heights(f.path, 3.0), ": ends at byte " + std::to_string(std::filesystem::file_size(f.path)) + " of the " +
                                           std::to_string(whole - 2) + " its header announces; the file is not whole");
}

void heights_from_text() {
    const HeightMap m = read_heights(RSC_TEST_DATA "/heights.txt", 8.0);
    CHECK(m.nx == 5 && m.ny == 3 && m.dx == 1.6 && m.dy == 1.6 && m.x0 == 0 && !m.periodic);
    CHECK(m(1, 0) == 1.5e-3 && m(3, 0) == 3 && m(2, 1) == 6.25 && m(3, 2) == -11);
    REFUSED(read_heights(RSC_TEST_DATA "/heights.txt", std::nullopt),
            "heights.txt: a text matrix has no spacing; L, its extent in x, must be given");
    // Windows' line ends, a byte order mark, no line end at the end, a number below the range of double.
    CHECK(read_heights(write("dos",
                             "\xef\xbb\xbf"
                             "1 2 3 0 0\r\n4 5 6 0 0\r\n\r\n7 8 1e-400 0 0"),
                       3.0)(1, 2) == 8);
    REFUSED(read_heights(write("t", "1 2 3\n4 5\n7 8 9\n"), 1.0), "t:2: 2 values where 3 as in line 1 were expected");
    REFUSED(read_heights(write("t", "# head\n1 2 3\n4 5 6 7\n"), 1.0), "t:3: 4 values where 3 as in line 2 were expected");
    REFUSED(read_heights(write("t", "1 2 3\n4 abc 6\n"), 1.0), "t:2: 'abc' in column 2 is not a number");
    REFUSED(read_heights(write("t", "1 2 3\n4 5.0.0 6\n"), 1.0), "'5.0.0' in column 2");
    REFUSED(read_heights(write("t", "1 2 3\n4 +-5 6\n"), 1.0), "'+-5' in column 2");
    REFUSED(read_heights(write("t", "1 2 3\n4 5 nan\n"), 1.0),
            "t:2: 'nan' in column 3 is not finite: every value must be known (missing points of a map: surface%missing)");
    REFUSED(read_heights(write("t", "1 2 3\n-inf 5 3\n"), 1.0), "'-inf' in column 1 is not finite");
    REFUSED(read_heights(write("t", "1 2 3\n1e999 5 3\n"), 1.0), "'1e999' in column 1");
    REFUSED(read_heights(write("t", "1 2 3 4 5\n1 1e60 3 4 5\n1 2 3 4 5\n"), 1.0),
            "t: a height must be finite, 1e50 at most, not 1e+60 as in column 1 of row 1, counted from 0");
    REFUSED(read_heights(write("t", "1 2 3 4 5\n1 2 3 4 5\n1 2 3 4 5\n"), 1e-60), "t: the spacing must be from 1e-50 to 1e50, not 2e-61");
    REFUSED(read_heights(write("t", "1,,3\n"), 1.0), "t:1: nothing between the separators at column 2");
    REFUSED(read_heights(write("t", "1 2 3 4 5\n1 2 3 4 5\n"), 1.0), "t: a height map of 5 x 2 points; at least 3 x 3 are needed");
    REFUSED(read_heights(write("t", "# nothing\n\n"), 1.0), "t: holds no numbers");
    REFUSED(read_heights(write("t", ""), 1.0), "t: is empty");
    REFUSED(read_heights(write("t", std::string("1 2\0 3\n", 7)), 1.0),
            "t: neither NetCDF, .gwy, .sdf nor text. Gwyddion reads the files of most instruments: gwyddion --convert-to-gwy=map.gwy '" +
                in_folder("t") + "' makes one that rsc reads");
    REFUSED(read_heights(write("t", std::string("\xff\xfe") + "1"), 1.0), "t: is text in UTF-16; save it as UTF-8 or plain ASCII");
    REFUSED(read_heights(write("t", "1 2 3 1\n4 5 6 1\n7 8 9 1\n"), 1.0),
            "t: four columns are a list of asperities x y z r (surface%source='asperities'), not a map");
    REFUSED(read_heights(in_folder("absent"), 1.0), "absent: No such file or directory");
    REFUSED(read_heights(folder.path.string(), 1.0), ": is a directory, not a file");
    REFUSED(read_heights(write("t.nc", "1 2 3\n4 5 x\n"), 1.0), "t.nc:2: 'x'");  // by content, not by name
}

// One separator throughout; decimal commas between semicolons.
void separators() {
    const auto second = [](const char* content) { return read_heights(write("t", content), 5.0)(1, 2); };
    CHECK(second("1 2\t3 4 5\n1 2 3 4 5\n1 2.5  3 4 5\n") == 2.5);
    CHECK(second("1,2, 3 ,4,5\n1,2,3,4,5,\n1,2.5,3,4,5\n") == 2.5);
    CHECK(second("1;2; 3 ;4;5\n1;2;3;4;5;\n1;2.5;3;4;5\n") == 2.5);
    CHECK(second("1;2; 3 ;4;0,5\n1;2;3;4;5;\n1;2,5e0;3;4;5\n") == 2.5);
    const auto row = [](const std::string& one) { return read_heights(write("t", one + "\n1;2;3;4;5\n1;2;3;4;5\n"), 5.0); };
    REFUSED(row("0,01;2;3;4.5;5"), "t:1: '4.5' in column 4: a decimal point, where line 1 has decimal commas");
    REFUSED(row("1;2;3;4.5;0,01"), "t:1: '0,01' in column 5: a decimal comma, where line 1 has decimal points");
    REFUSED(row("1.000,5;2;3;4;5"), "'1.000,5' in column 1 is not a number");
    REFUSED(row("1,000,5;2;3;4;5"), "'1,000,5' in column 1 is not a number");
    REFUSED(row("1 2;2;3;4;5"), "t:1: blanks before '2' where the rest of the line has semicolons: one separator is expected throughout");
    REFUSED(row("1 2 3 4 5"), "t:2: semicolons before the end where line 1 has blanks");
    REFUSED(row("1,2,3,4,5"), "t:2: semicolons before the end where line 1 has commas: one separator is expected throughout");
    REFUSED(read_heights(write("t", std::string("1 2 3\n4 5 6\n", 12) + std::string(5000, ' ') + std::string("\n1 \0", 4)), 1.0),
            "t:4: neither text nor a NetCDF file (there is a zero byte)");
    // 0,01 between blanks was twice the columns once.
    REFUSED(read_heights(write("t", "0,01 0,02 0,03 0,04 0,05\n"), 1.0), "t:1: blanks before '0' where the rest of the line has commas");
    REFUSED(read_heights(write("t", "0,01 0,02 0,03 0,04 0,05\n"), 1.0),
            ": one separator is expected throughout; decimal commas are read between semicolons only");
}

// x y z of a grid, in any order.
void triples() {
    std::string text;
    for (int k = 0; k < 15; ++k) {
        const int p = 7 * k % 15, i = p % 5, j = p / 5;
        text += std::to_string(0.333 * i - 1) + " " + std::to_string(0.25 * j) + " " + std::to_string(10 * j + i) + "\n";
    }
    const HeightMap m = read_heights(write("xyz", text), std::nullopt);
    CHECK(m.nx == 5 && m.ny == 3 && m(3, 2) == 23 && m(0, 1) == 10);
    CHECK_CLOSE(m.dx, 0.333, 1e-12);
    CHECK_CLOSE(m.dy, 0.25, 1e-12);
    CHECK_CLOSE(m.x0, -1, 1e-12);
    CHECK(read_heights(write("xyz", text), 5 * 0.333).nx == 5);
    REFUSED(read_heights(write("xyz", text), 2.0), "its coordinate x spans 5 steps of 0.333 = 1.665, but L = 2");
    REFUSED(read_heights(write("xyz", text.substr(0, text.rfind('\n', text.size() - 2) + 1)), std::nullopt),
            "xyz: three columns are read as x y z of a map of 5 x 3 points, but there is none at x = -0.001, y = 0.25");
    REFUSED(read_heights(write("xyz", text + "-1 0 3\n"), std::nullopt), "xyz:16: x = -1, y = 0 is already in line 1");
    REFUSED(read_heights(write("xyz", text + "-0.9 0 3\n"), std::nullopt),
            "xyz:2: three columns are read as x y z of a map; x = -0.334 is not on a uniform grid of 6 values from -1 to 0.332");
    REFUSED(read_heights(write("xyz", "1 2 3\n1 3 4\n1 4 5\n"), 1.0),
            "xyz: three columns are read as x y z of a map; column x is 1 throughout");
}

std::string asperities_file(const std::string& name, std::vector<double> x, std::vector<double> r, bool curvatures,
                            std::size_t lengths = 3) {
    NcFile f(name);
    const int d = f.dimension("asperity", 3), e = lengths == 3 ? d : f.dimension("other", lengths);
    const std::vector<double> y = {0, 0, 1}, z = {0.1, 0.2, 0.3}, k1 = {3, 2, 1}, k2 = {1, 2, 0.5}, angle = {0, 0.5, 1};
    std::vector<std::pair<int, std::vector<double>>> all = {{f.variable("asperity_x", NC_DOUBLE, {d}), x},
                                                            {f.variable("asperity_y", NC_DOUBLE, {d}), y},
                                                            {f.variable("asperity_z", NC_DOUBLE, {d}), z},
                                                            {f.variable("asperity_radius", NC_DOUBLE, {e}), r}};
    if (curvatures) {
        all.push_back({f.variable("asperity_kappa1", NC_DOUBLE, {d}), k1});
        all.push_back({f.variable("asperity_kappa2", NC_DOUBLE, {d}), k2});
        all.push_back({f.variable("asperity_angle", NC_DOUBLE, {d}), angle});
        all.push_back({f.variable("asperity_biharmonic", NC_DOUBLE, {d}), z});
    }
    ok(nc_enddef(f.id));
    for (const auto& [v, values] : all) ok(nc_put_var_double(f.id, v, values.data()));
    return f.path;
}

void asperities() {
    const Asperities text = read_asperities(RSC_TEST_DATA "/asperities.txt");
    CHECK(text.size() == 3 && text.x[2] == 0.4 && text.y[2] == 0.9 && text.z[1] == -0.001 && text.radius[1] == 0.15);
    CHECK(text.kappa1.empty() && text.biharmonic.empty());
    const Extent e = extent(text);
    CHECK(e.x_min == 0.1 && e.x_max == 0.4 && e.y_min == 0.2 && e.y_max == 0.9);

    const Asperities full = read_asperities(asperities_file("full", {0, 1, 1}, {1, 2, 3}, true));
    CHECK(full.size() == 3 && full.x[1] == 1 && full.radius[2] == 3 && full.kappa1[0] == 3 && full.kappa2[2] == 0.5 &&
          full.angle[1] == 0.5 && full.biharmonic[2] == 0.3);
    CHECK(read_asperities(asperities_file("plain", {0, 1, 1}, {1, 2, 3}, false)).kappa1.empty());

    REFUSED(read_asperities(asperities_file("bad", {1, 1, 1}, {1, 2, 3}, false)),
            ": asperity 1, counted from 0: lies at the same point as");
    REFUSED(read_asperities(asperities_file("bad", {0, 1, 1}, {1, 2, 0}, false)),
            "asperity 2, counted from 0: the radius must be positive");
    REFUSED(read_asperities(asperities_file("bad", {0, std::nan(""), 1}, {1, 2, 3}, false)),
            ": asperity_x(asperity = 1), counted from 0, is not finite; every value must be known");
    REFUSED(read_asperities(asperities_file("bad", {0, 1, 1}, {1, 2, 3, 4}, false, 4)),
            ": asperity_radius(other = 4): 3 values as of asperity_x were expected");
    {
        NcFile f("empty");
        const int d = f.dimension("asperity", NC_UNLIMITED);
        for (const char* name : {"asperity_x", "asperity_y", "asperity_z", "asperity_radius"}) f.variable(name, NC_DOUBLE, {d});
        f.close();
        REFUSED(read_asperities(f.path), ": there is no asperity in it");
    }
    {
        NcFile f("absurd");
        const int d = f.dimension("asperity", std::size_t{1} << 60);
        const std::size_t chunk = 100;
        ok(nc_def_var_chunking(f.id, f.variable("asperity_x", NC_DOUBLE, {d}), NC_CHUNKED, &chunk));
        f.close();
        REFUSED(read_asperities(f.path), ": asperity_x(asperity = 1152921504606846976): more asperities than rsc can number");
    }
    REFUSED(read_asperities(write("t", "1 2 3 4\n# remark\n1 2 3\n")), "t:3: 3 values where 4 were expected");
    REFUSED(read_asperities(write("t", "1 2 3 4\n2 2 3 -4\n")), "t:2: the radius must be positive, not -4");
    REFUSED(read_asperities(write("t", "1 2 3 4\n2 2 3 4\n\n1 2 9 9\n")), "t:4: lies at the same point as ");
    REFUSED(read_asperities(write("t", "1 2 nan 4\n")), "t:1: 'nan' in column 3 is not finite");
    REFUSED(read_asperities(in_folder("absent")), "No such file");
}

// Refusals of NetCDF files that no other test here brings about; x and y differ in all of them.
void more_words() {
    const std::vector<double> x = ramp(5, 0, 0.1), y = ramp(3, 1, 0.25);
    const auto with = [&](const std::function<void(int, int)>& tamper, std::vector<double> cx, std::vector<double> cy) {
        return heights_file("m", NC_NETCDF4, std::move(cx), std::move(cy), "height", NC_DOUBLE, tamper);
    };
    const std::string plain = heights_file("plain", NC_NETCDF4, x, y);
    REFUSED(read_heights(plain, std::nullopt, "mm", "Phase"), "plain: there is no variable 'Phase'");
    REFUSED(read_heights(plain, std::nullopt, "mm", "x"), "plain: channel 'x': two dimensions of numbers were expected, not x(x = 5)");
    CHECK(read_heights(plain, std::nullopt, "mm", "height")(4, 2) == 24);
    REFUSED(read_heights(write("t", "1 2 3\n"), 1.0, "mm", "Phase"),
            "t: has no channels to choose 'Phase' from; only .gwy and NetCDF files have");
    // Which variable is the map, where there are several.
    {
        NcFile f("channels");
        const int d = f.dimension("y", 3), e = f.dimension("x", 4);
        const int first = f.variable("first", NC_DOUBLE, {d, e}), second = f.variable("second", NC_INT, {d, e});
        const int height = f.variable("height", NC_CHAR, {d, e});
        (void)height;
        ok(nc_enddef(f.id));
        std::vector<double> z = ramp(12, 0, 1);
        ok(nc_put_var_double(f.id, first, z.data()));
        z = ramp(12, 100, 1);
        ok(nc_put_var_double(f.id, second, z.data()));
        f.close();
        CHECK(read_heights(f.path, 8.0, "mm", "second")(1, 2) == 109 && read_heights(f.path, 8.0, "mm", "first")(1, 2) == 9);
        CHECK(read_heights(f.path, 8.0, "mm", "second").dx == 2 && read_heights(f.path, 8.0, "mm", "second").dy == 2);
        REFUSED(read_heights(f.path, 8.0), "channels: height(y, x), numeric, was expected, not height(y = 3, x = 4)");
        REFUSED(read_heights(f.path, 8.0, "mm", "height"),
                "channel 'height': two dimensions of numbers were expected, not height(y = 3, x = 4)");
    }
    const auto text = [](const char* name) { return [name](int id, int v) { ok(nc_put_att_text(id, v, name, 3, "two")); }; };
    for (const char* name : {"missing_value", "scale_factor", "add_offset"})
        REFUSED(read_heights(with(text(name), x, y), std::nullopt),
                std::string("m: attribute height:") + name + " is text; a number was expected");
    const auto numbers = [](const char* name, std::vector<double> values) {
        return [=](int id, int v) { ok(nc_put_att_double(id, v, name, NC_DOUBLE, values.size(), values.data())); };
    };
    for (const char* name : {"scale_factor", "add_offset"}) {
        REFUSED(read_heights(with(numbers(name, {1, 2}), x, y), std::nullopt),
                std::string("m: attribute height:") + name + " must be one finite number");
        REFUSED(read_heights(with(numbers(name, {HUGE_VAL}), x, y), std::nullopt), "must be one finite number");
    }
    CHECK(read_heights(with(numbers("scale_factor", {3}), x, y), std::nullopt)(3, 2) == 69);
    CHECK(read_heights(with(numbers("add_offset", {3}), x, y), std::nullopt)(3, 2) == 26);
    // One point by missing_value, one by _FillValue: both are missing where they may be.
    const auto both = [](int id, int v) {
        const double fill = 12, missing = 3;
        ok(nc_put_att_double(id, v, "_FillValue", NC_DOUBLE, 1, &fill));
        ok(nc_put_att_double(id, v, "missing_value", NC_DOUBLE, 1, &missing));
    };
    const HeightMap holes = read_heights(with(both, x, y), std::nullopt, "mm", "", Missing::fill);
    CHECK(std::isnan(holes(2, 1)) && std::isnan(holes(3, 0)) && holes(3, 1) == 13);
    // What was never written is missing, whatever the type; units as a string of NetCDF-4 are units.
    const std::pair<nc_type, double> fills[] = {{NC_FLOAT, static_cast<double>(NC_FILL_FLOAT)},
                                                {NC_DOUBLE, NC_FILL_DOUBLE},
                                                {NC_INT, static_cast<double>(NC_FILL_INT)},
                                                {NC_SHORT, static_cast<double>(NC_FILL_SHORT)},
                                                {NC_INT64, static_cast<double>(NC_FILL_INT64)}};
    for (const auto& [type, fill] : fills) {
        std::vector<double> z = ramp(15, 0, 1);
        z[7] = fill;
        const std::string file = heights_file("m", NC_NETCDF4, x, y, "height", type, {}, z);
        REFUSED(read_heights(file, std::nullopt), "m: height(y = 1, x = 2), counted from 0, is missing (it holds the fill value ");
        const HeightMap map = read_heights(file, std::nullopt, "mm", "", Missing::fill);
        CHECK(std::isnan(map(2, 1)) && map(3, 1) == 8);
    }
    const auto strings = [](int id, int v) {
        const char* const um = "um";
        for (int k = 0; k < 3; ++k) ok(nc_put_att_string(id, v + k, "units", 1, const_cast<const char**>(&um)));
    };
    const HeightMap converted = read_heights(with(strings, x, y), std::nullopt, "mm");
    CHECK_CLOSE(converted(3, 2), 23e-3, 1e-17);
    CHECK_CLOSE(converted.dy, 0.25e-3, 1e-18);
    // Reversed in one of the two directions alone.
    const HeightMap left = read_heights(with({}, ramp(5, 0.4, -0.1), y), std::nullopt),
                    down = read_heights(with({}, x, ramp(3, 1.5, -0.25)), std::nullopt);
    CHECK(left(0, 0) == 4 && left(4, 2) == 20 && left.x0 == 0 && left.y0 == 1 && down(0, 0) == 20 && down(4, 2) == 4 && down.x0 == 0 &&
          down.y0 == 1);
    // The other coordinate, at its tolerance: 1e-6 of its step.
    std::vector<double> uneven = y;
    uneven[1] += 0.24e-6;
    CHECK(read_heights(with({}, x, uneven), std::nullopt).dy == 0.25);
    uneven[1] += 0.02e-6;
    REFUSED(read_heights(with({}, x, uneven), std::nullopt),
            "m: coordinate y is not uniform to 1e-6 of its step 0.25: y(1), counted from 0, is 1.25000026 where 1.25 was expected");
    // The number is that of the file, also where the coordinate runs backwards.
    std::vector<double> backwards = ramp(5, 0.4, -0.1);
    backwards[1] += 0.01;
    REFUSED(read_heights(with({}, backwards, y), std::nullopt), "x(1), counted from 0, is 0.31 where 0.3 was expected");
    REFUSED(read_heights(with({}, ramp(5, 0.4, -0.1), ramp(3, 2, 0)), std::nullopt),
            "m: coordinate y does not vary: it begins and ends at 2");
    REFUSED(read_heights(with({}, ramp(5, 3e50, 1e49), y), std::nullopt),
            "m: the first coordinate must be finite, 1e50 at most, not 3e+50");
    // L beside coordinates: the same to 1e-6.
    CHECK(read_heights(plain, 0.5 * (1 + 0.99e-6)).nx == 5);
    REFUSED(read_heights(plain, 0.5 * (1 + 1.01e-6)), "plain: its coordinate x spans 5 steps of 0.1 = 0.5, but L = 0.500000505 was given");
    // A text's grid: to a hundredth of a step.
    const auto triples = [](const char* middle) {
        return std::string("0 0 1\n0 2 2\n0 4 3\n") + middle + " 0 4\n1 2 5\n1 4 6\n2 0 7\n2 2 8\n2 4 9\n";
    };
    const HeightMap nine = read_heights(write("t", triples("1.0")), std::nullopt);
    CHECK(nine.nx == 3 && nine.ny == 3 && nine.dx == 1 && nine.dy == 2 && nine(0, 2) == 3 && nine(2, 0) == 7 && nine(1, 0) == 4);
    REFUSED(read_heights(write("t", triples("1.02")), std::nullopt),
            "t:4: three columns are read as x y z of a map; x = 1.02 is not on a uniform grid of 4 values from 0 to 2");
    REFUSED(read_heights(write("t", "0 0 1\n0 2 2\n1.02 0 3\n1.02 2 4\n2 0 5\n2 2 6\n"), std::nullopt),
            "t:3: three columns are read as x y z of a map; x = 1.02 is not on a uniform grid of 3 values from 0 to 2");
    REFUSED(read_heights(write("t", "0 0 1\n1 nan 2\n"), std::nullopt, "mm", "", Missing::fill),
            "t:2: three columns are read as x y z of a map; y is missing");

    NcFile f("list");
    const int d = f.dimension("asperity", 2);
    std::vector<int> all;
    for (const char* name :
         {"asperity_x", "asperity_y", "asperity_z", "asperity_radius", "asperity_kappa1", "asperity_kappa2", "asperity_angle"})
        all.push_back(f.variable(name, NC_DOUBLE, {d}));
    ok(nc_put_att_text(f.id, all.back(), "units", 6, "degree"));
    ok(nc_enddef(f.id));
    const double values[] = {1, 2};
    for (const int v : all) ok(nc_put_var_double(f.id, v, values));
    f.close();
    REFUSED(read_asperities(f.path), "list: asperity_angle is in 'degree'; radian is expected");
    for (const char* name : {"radian", "radians", "rad", "1"}) {
        NcFile g("list");
        const int e = g.dimension("asperity", 2);
        all.clear();
        for (const char* v :
             {"asperity_x", "asperity_y", "asperity_z", "asperity_radius", "asperity_kappa1", "asperity_kappa2", "asperity_angle"})
            all.push_back(g.variable(v, NC_DOUBLE, {e}));
        ok(nc_put_att_text(g.id, all.back(), "units", std::strlen(name), name));
        ok(nc_enddef(g.id));
        for (const int v : all) ok(nc_put_var_double(g.id, v, values));
        g.close();
        CHECK(read_asperities(g.path).angle[1] == 2);
    }
    NcFile g("square");
    g.variable("asperity_x", NC_DOUBLE, {g.dimension("a", 2), g.dimension("b", 3)});
    g.close();
    REFUSED(read_asperities(g.path), "square: asperity_x(asperity), numeric, was expected, not asperity_x(a = 2, b = 3)");

    // Spectra: two columns, or wavenumber and psd each in its unit.
    CHECK_RELATIVE((*read_spectrum(write("t", "1 4\n2 3\n3 2\n"), "mm"))(2), 3.0, 1e-14);
    REFUSED(read_spectrum(write("t", "1 4 5\n"), "mm"), "t:1: 3 values where 2 were expected");
    REFUSED(
        read_spectrum(plain, "mm"),
        "plain: there is no variable wavenumber; wavenumber and psd were expected, as in the result of a measured map (surface%source = 'heights')");
    NcFile h("spectrum");
    const int k = h.dimension("k", 3);
    const int w = h.variable("wavenumber", NC_DOUBLE, {k}), p = h.variable("psd", NC_DOUBLE, {k, k});
    ok(nc_enddef(h.id));
    const double three[] = {1, 2, 3};
    ok(nc_put_var_double(h.id, w, three));
    (void)p;
    h.close();
    REFUSED(read_spectrum(h.path, "mm"), "spectrum: psd over one dimension was expected, not psd(k = 3, k = 3)");
    for (const auto& [unit, words] : {std::pair("s", "spectrum: the units of wavenumber: 's' where a unit like (mm)-1 is expected"),
                                      std::pair("um-1", "spectrum: there is no variable psd; wavenumber and psd were expected")}) {
        NcFile s("spectrum");
        const int n = s.dimension("k", 3), v = s.variable("wavenumber", NC_DOUBLE, {n});
        ok(nc_put_att_text(s.id, v, "units", std::strlen(unit), unit));
        ok(nc_enddef(s.id));
        ok(nc_put_var_double(s.id, v, three));
        s.close();
        REFUSED(read_spectrum(s.path, "mm"), words);
    }
}

// The libraries are not made for it: without turns this breaks within some readings.
void several_threads() {
    const std::string path = heights_file("shared", NC_NETCDF4, ramp(5, 0, 1), ramp(3, 0, 1));
    std::atomic<int> right{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int k = 0; k < 50; ++k) right += read_heights(path, std::nullopt)(3, 2) == 23 ? 1 : 0;
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(right == 200);
}

}  // namespace

int main() {
    heights_from_netcdf();
    bad_heights_from_netcdf();
    cut_files();
    heights_from_text();
    separators();
    triples();
    units();
    asperities();
    more_words();
    several_threads();
    return check::summary();
}
