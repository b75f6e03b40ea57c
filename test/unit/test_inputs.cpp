// Heights and asperities from files: what is read, and what is refused with which words.
#include "read/inputs.hpp"

#include <netcdf.h>
#include <unistd.h>

#include "check.hpp"
#include "error.hpp"
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

void bad_heights_from_netcdf() {
    const std::vector<double> x = ramp(5, 0, 0.1), y = ramp(3, 0, 0.1);
    std::vector<double> uneven = x;
    uneven[2] += 1e-6;
    REFUSED(read_heights(heights_file("uneven", NC_NETCDF4, uneven, y), std::nullopt), "coordinate x is not uniform to 1e-6 of its");
    uneven[2] = x[2] + 0.9e-7;  // within the tolerance
    CHECK(read_heights(heights_file("even", NC_NETCDF4, uneven, y), std::nullopt).nx == 5);
    REFUSED(read_heights(heights_file("flat", NC_NETCDF4, ramp(5, 1, 0), y), std::nullopt), "coordinate x does not vary: it begins and");
    REFUSED(read_heights(heights_file("one", NC_NETCDF4, x, {}), std::nullopt), "height(y = 3, x = 5) has a coordinate");
    std::vector<double> nan_x = x;
    nan_x[4] = std::nan("");
    REFUSED(read_heights(heights_file("nanx", NC_NETCDF4, nan_x, y), std::nullopt), "x(x = 4), counted from 0, is not finite;");

    std::vector<double> z = ramp(15, 0, 1);
    z[7] = std::nan("");
    REFUSED(read_heights(heights_file("nan", NC_NETCDF4, x, y, "height", NC_DOUBLE, {}, z), std::nullopt), "height(y = 1, x = 2),");
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
    REFUSED(read_heights(heights_file("fill", NC_NETCDF4, x, y, "height", NC_DOUBLE, fill, z), std::nullopt), "height(y = 1, x = 2),");
    REFUSED(read_heights(heights_file("missing", NC_NETCDF4, x, y, "height", NC_DOUBLE, missing, z), std::nullopt), "is missing");
    z[7] = NC_FILL_DOUBLE;
    REFUSED(read_heights(heights_file("unwritten", NC_NETCDF4, x, y, "height", NC_DOUBLE, {}, z), std::nullopt), "is missing");

    {
        NcFile f("two");
        const int d = f.dimension("a", 4), e = f.dimension("b", 4);
        f.variable("first", NC_DOUBLE, {d, e});
        f.variable("second", NC_FLOAT, {d, e});
        f.close();
        REFUSED(read_heights(f.path, 1.0), "there is no variable height(y, x), and");
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
        REFUSED(read_asperities(f.path), "there is no variable asperity_x; asperity_x,");
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
}

void heights_from_text() {
    const HeightMap m = read_heights(RSC_TEST_DATA "/heights.txt", 8.0);
    CHECK(m.nx == 5 && m.ny == 3 && m.dx == 1.6 && m.dy == 1.6 && m.x0 == 0 && !m.periodic);
    CHECK(m(1, 0) == 1.5e-3 && m(3, 0) == 3 && m(2, 1) == 6.25 && m(3, 2) == -11);
    REFUSED(read_heights(RSC_TEST_DATA "/heights.txt", std::nullopt), "a text matrix has no spacing; L, its extent");
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
    REFUSED(read_heights(write("t", "1 2 3\n4 5 nan\n"), 1.0), "t:2: 'nan' in column 3 is not finite: every");
    REFUSED(read_heights(write("t", "1 2 3\n-inf 5 3\n"), 1.0), "'-inf' in column 1 is not finite");
    REFUSED(read_heights(write("t", "1 2 3\n1e999 5 3\n"), 1.0), "'1e999' in column 1");
    REFUSED(read_heights(write("t", "1 2 3 4 5\n1 1e60 3 4 5\n1 2 3 4 5\n"), 1.0), "a height must be finite and at most 1e50, not");
    REFUSED(read_heights(write("t", "1 2 3 4 5\n1 2 3 4 5\n1 2 3 4 5\n"), 1e-60), "t: the spacing must be from 1e-50 to 1e50, not 2e-61");
    REFUSED(read_heights(write("t", "1,,3\n"), 1.0), "t:1: nothing between the separators at column 2");
    REFUSED(read_heights(write("t", "1 2 3 4 5\n1 2 3 4 5\n"), 1.0), "t: a height map of 5 x 2 points; at least 3 x 3 are needed");
    REFUSED(read_heights(write("t", "# nothing\n\n"), 1.0), "t: contains no numbers");
    REFUSED(read_heights(write("t", ""), 1.0), "t: is empty");
    REFUSED(read_heights(write("t", std::string("1 2\0 3\n", 7)), 1.0),
            "t: neither NetCDF, .gwy, .sdf nor text. Gwyddion reads the files of most instruments: gwyddion --convert-to-gwy=map.gwy '" +
                in_folder("t") + "' makes one that rsc reads");
    REFUSED(read_heights(write("t", std::string("\xff\xfe") + "1"), 1.0), "t: is text in UTF-16; save it as UTF-8 or plain ASCII");
    REFUSED(read_heights(write("t", "1 2 3 1\n4 5 6 1\n7 8 9 1\n"), 1.0), "four columns are a list of asperities x y z");
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
    // Decimal commas between blanks must not be read as separators, which would give twice the columns.
    REFUSED(read_heights(write("t", "0,01 0,02 0,03 0,04 0,05\n"), 1.0), "t:1: blanks before '0' where the rest of the line has commas");
    REFUSED(read_heights(write("t", "0,01 0,02 0,03 0,04 0,05\n"), 1.0), "one separator is expected throughout;");
}

std::string asperities_file(const std::string& name, std::vector<double> x, std::vector<double> r, std::size_t lengths = 3) {
    NcFile f(name);
    const int d = f.dimension("asperity", 3), e = lengths == 3 ? d : f.dimension("other", lengths);
    const std::vector<double> y = {0, 0, 1}, z = {0.1, 0.2, 0.3};
    std::vector<std::pair<int, std::vector<double>>> all = {{f.variable("asperity_x", NC_DOUBLE, {d}), x},
                                                            {f.variable("asperity_y", NC_DOUBLE, {d}), y},
                                                            {f.variable("asperity_z", NC_DOUBLE, {d}), z},
                                                            {f.variable("asperity_radius", NC_DOUBLE, {e}), r}};
    ok(nc_enddef(f.id));
    for (const auto& [v, values] : all) ok(nc_put_var_double(f.id, v, values.data()));
    return f.path;
}

void asperities() {
    const Asperities text = read_asperities(RSC_TEST_DATA "/asperities.txt");
    CHECK(text.size() == 3 && text.x[2] == 0.4 && text.y[2] == 0.9 && text.z[1] == -0.001 && text.radius[1] == 0.15);
    CHECK(text.kappa1.empty() && text.biharmonic.empty());
    REFUSED(read_asperities(asperities_file("bad", {1, 1, 1}, {1, 2, 3})), "asperity 1, counted from 0: lies at the same");
    REFUSED(read_asperities(asperities_file("bad", {0, 1, 1}, {1, 2, 0})), "asperity 2, counted from 0: the radius must");
    REFUSED(read_asperities(asperities_file("bad", {0, std::nan(""), 1}, {1, 2, 3})), "asperity_x(asperity = 1), counted from 0,");
    REFUSED(read_asperities(asperities_file("bad", {0, 1, 1}, {1, 2, 3, 4}, 4)), "asperity_radius(other = 4): 3 values as of");
    {
        NcFile f("empty");
        const int d = f.dimension("asperity", NC_UNLIMITED);
        for (const char* name : {"asperity_x", "asperity_y", "asperity_z", "asperity_radius"}) f.variable(name, NC_DOUBLE, {d});
        f.close();
        REFUSED(read_asperities(f.path), ": there is no asperity in it");
    }
    REFUSED(read_asperities(write("t", "1 2 3 4\n# remark\n1 2 3\n")), "t:3: 3 values where 4 were expected");
    REFUSED(read_asperities(write("t", "1 2 3 4\n2 2 3 -4\n")), "t:2: the radius must be positive, not -4");
    REFUSED(read_asperities(write("t", "1 2 3 4\n2 2 3 4\n\n1 2 9 9\n")), "t:4: lies at the same point as ");
    REFUSED(read_asperities(write("t", "1 2 nan 4\n")), "t:1: 'nan' in column 3 is not finite");
    REFUSED(read_asperities(in_folder("absent")), "No such file");
}

}  // namespace

TESTS {
    bad_heights_from_netcdf();
    heights_from_text();
    separators();
    asperities();
}
