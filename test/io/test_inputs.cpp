// Heights and asperities from files: what is read, and what is refused with which words.
#include "io/inputs.hpp"

#include "check.hpp"
#include "support/netcdf_file.hpp"
#include "support/refused.hpp"
#include "support/temporary_folder.hpp"

namespace test_inputs {

using namespace rsc;
using namespace netcdf_file;

const Folder folder;

std::string write(const std::string& name, const std::string& content) {
    return folder.write(name, content);
}

// height(y = 3, x = 5) = 10 y index + x index, with coordinates as given (empty: none).
std::string heights_file(const std::string& name, std::vector<double> x, std::vector<double> y,
                         std::vector<double> z = {},
                         std::vector<std::pair<std::string, std::vector<double>>> attributes = {},
                         int format = NC_NETCDF4) {
    if (z.empty())
        for (const int i : indices(15)) z.push_back(10 * (i / 5) + i % 5);
    std::vector<Variable> all = {{"height", NC_DOUBLE, {"y", "x"}, z, {}, attributes}};
    if (!x.empty()) all.push_back({"x", NC_DOUBLE, {"x"}, x});
    if (!y.empty()) all.push_back({"y", NC_DOUBLE, {"y"}, y});
    return write(folder / name, Dimensions{{"y", 3}, {"x", 5}}, all, format);
}

TEST(bad_heights_from_netcdf) {
    const std::vector<double> x = counted(5, 0, 0.1), y = counted(3, 0, 0.1);
    std::vector<double> uneven = x;
    uneven[2] += 1e-6;
    REFUSED(read_heights(heights_file("uneven", uneven, y), std::nullopt),
            "coordinate x is not uniform to 1e-6 of its");
    uneven[2] = x[2] + 0.9e-7;  // within the tolerance
    CHECK(read_heights(heights_file("even", uneven, y), std::nullopt).nx == 5);
    REFUSED(read_heights(heights_file("flat", counted(5, 1, 0), y), std::nullopt),
            "coordinate x does not vary: it begins and");
    REFUSED(read_heights(heights_file("one", x, {}), std::nullopt),
            "height(y = 3, x = 5) has a coordinate");
    // Single precision: far from 0 it cannot hold the spacing.
    for (const double far : {0.0, 5438.0}) {
        const std::string file =
            write(folder / "single", Dimensions{{"y", 3}, {"x", 5}},
                  std::vector<Variable>{{"x", NC_FLOAT, {"x"}, counted(5, far, 1e-3)},
                                        {"y", NC_FLOAT, {"y"}, counted(3, 0, 1e-3)},
                                        {"height", NC_DOUBLE, {"y", "x"}, counted(15, 0, 1)}});
        if (far == 0)
            CHECK_RELATIVE(read_heights(file, std::nullopt).dx, 1e-3, 1e-6);
        else
            REFUSED(read_heights(file, std::nullopt), "coordinate x has too few digits");
    }
    std::vector<double> nan_x = x;
    nan_x[4] = std::nan("");
    REFUSED(read_heights(heights_file("nanx", nan_x, y), std::nullopt),
            "x(x = 4), counted from 0, is not finite;");

    std::vector<double> z = counted(15, 0, 1);
    z[7] = std::nan("");
    REFUSED(read_heights(heights_file("nan", x, y, z), std::nullopt), "height(y = 1, x = 2),");
    z[7] = kInfinity;
    REFUSED(read_heights(heights_file("inf", x, y, z, {}, 0), std::nullopt),
            "height(y = 1, x = 2)");
    z[7] = -99;
    REFUSED(read_heights(heights_file("missing", x, y, z, {{"missing_value", {-98, -99}}}),
                         std::nullopt),
            "is missing");

    const auto of = [](const Dimensions& dimensions, const std::vector<Variable>& variables) {
        return write(folder / "other.nc", dimensions, variables);
    };
    REFUSED(read_heights(of({{"a", 4}, {"b", 4}},
                            {{"first", NC_DOUBLE, {"a", "b"}}, {"second", NC_FLOAT, {"a", "b"}}}),
                         1.0),
            "there is no variable height(y, x), and");
    REFUSED(read_heights(
                of({{"t", 2}, {"y", 4}, {"x", 4}}, {{"height", NC_DOUBLE, {"t", "y", "x"}}}), 1.0),
            ": height(y, x), numeric, was expected, not height(t = 2, y = 4, x = 4)");
    REFUSED(read_heights(
                of({{"y", 4}, {"x", 4}},
                   {{"height", NC_DOUBLE, {"y", "x"}, counted(16, 0, 1), {{"scale_factor", "2"}}}}),
                1.0),
            "attribute height:scale_factor is text; a number was expected");
    REFUSED(
        read_heights(
            of({{"y", 4}, {"x", 4}},
               {{"height", NC_DOUBLE, {"y", "x"}, counted(16, 0, 1), {}, {{"valid_range", {1}}}}}),
            1.0),
        "attribute height:valid_range must be two numbers");
    REFUSED(read_asperities(of({{"y", 4}, {"x", 4}},
                               {{"asperity_x", NC_DOUBLE, {"y", "x"}, counted(16, 0, 1)}})),
            "asperity_x, numeric over one dimension, was expected, not asperity_x(y = 4, x = 4)");
    const std::string none = of({{"t", 2}}, {{"t", NC_DOUBLE, {"t"}}});
    REFUSED(read_heights(none, 1.0),
            ": there is no variable height(y, x) and no other of two dimensions");
    REFUSED(read_asperities(none), "there is no variable asperity_x; asperity_x,");
    int id = -1, dims[2], v = -1;  // an empty file may announce anything
    const std::size_t chunks[] = {100, 100};
    ok(nc_create((folder / "absurd").c_str(), NC_CLOBBER | NC_NETCDF4, &id));
    ok(nc_def_dim(id, "y", 2000000000, &dims[0]));
    ok(nc_def_dim(id, "x", 2000000000, &dims[1]));
    ok(nc_def_var(id, "height", NC_DOUBLE, 2, dims, &v));
    ok(nc_def_var_chunking(id, v, NC_CHUNKED, chunks));
    ok(nc_close(id));
    REFUSED(read_heights(folder / "absurd", 1.0),
            ": a height map of 2000000000 x 2000000000 points needs 3.2e+10 GB; this machine has ");
}

HeightMap heights(const std::string& text) { return read_heights(write("t", text), 1.0); }

TEST(heights_from_text) {
    REFUSED(read_heights(write("t", "1 2 3 4 5\n1 2 3 4 5\n1 2 3 4 5\n"), std::nullopt),
            "a text matrix has no spacing; surface%pixel must be given");
    // Windows' line ends, a byte order mark, no line end at the end, a number below the range of
    // double.
    CHECK(read_heights(write("dos",
                             "\xef\xbb\xbf"
                             "1 2 3 0 0\r\n4 5 6 0 0\r\n\r\n7 8 1e-400 0 0"),
                       3.0)(1, 2) == 8);
    REFUSED(heights("1 2 3\n4 5\n7 8 9\n"), "t:2: 2 values where 3 as in line 1 were expected");
    REFUSED(heights("# head\n1 2 3\n4 5 6 7\n"),
            "t:3: 4 values where 3 as in line 2 were expected");
    REFUSED(heights("1 2 3\n4 abc 6\n"), "t:2: 'abc' in column 2 is not a number");
    REFUSED(heights("1 2 3\n4 12-3 6\n"),
            "t:2: '12-3'");  // two numbers, though Fortran reads 0.012
    REFUSED(heights("1 2 3\n4 5 nan\n"), "t:2: 'nan' in column 3 is not finite: every");
    REFUSED(heights("1 2 3\n1e999 5 3\n"), "'1e999' in column 1");
    REFUSED(heights("1 2 3 4 5\n1 1e60 3 4 5\n1 2 3 4 5\n"),
            "a height must be finite and at most 1e50, not");
    REFUSED(read_heights(write("t", "1 2 3 4 5\n1 2 3 4 5\n1 2 3 4 5\n"), 1e-60),
            "t: the spacing must be from 1e-50 to 1e50, not 2e-61");
    REFUSED(heights("1,,3\n"), "t:1: nothing between the separators at column 2: empty cells");
    REFUSED(heights("1 2 3 4 5\n1 2 3 4 5\n"),
            "t: a height map of 5 x 2 points; at least 3 x 3 are needed");
    REFUSED(heights("# nothing\n\n"), "t: contains no numbers");
    REFUSED(heights(""), "t: is empty");
    REFUSED(heights(std::string("1 2\0 3\n", 7)),
            "t: neither NetCDF, .gwy, .sdf nor text. If Gwyddion reads it, this makes a file that "
            "rsc reads: gwyddion --convert-to-gwy='" +
                folder / "t_converted.gwy" + "' '" + folder / "t" + "'");
    REFUSED(heights(std::string("\xff\xfe") + "1"),
            "t: is text in UTF-16; this makes a file that rsc reads: iconv -f UTF-16 -t UTF-8 '");
    // Heads of files: named with their lines, and what to do about them.
    REFUSED(heights("x,y (um)\n1,2\n3,4\n"),
            "t:1: line 1 begins with a word, not a number: put '#'");
    REFUSED(heights("# a\nNCOLS 3\nnrows 3\ncellsize 50\n1 2 3\n"),
            "t:2: lines 2 to 4 begin with a word, not a number: put '#' before each line of text, "
            "and give an ESRI grid's cellsize as surface%pixel");
    REFUSED(heights("\\*File list\r\n\\Version: 7\r\n"),
            "t:1: the head of an instrument's file. If Gwyddion reads it");
    const std::string late = std::string(3000, '\n') + "1 2 3\n" + std::string(3, '\0');
    REFUSED(heights("[DataSet]\n" + std::string(3000, '\n') + late),
            "t:1: the head of an instrument's file. If Gwyddion reads it");
    CHECK(read_heights(write("t", "nan 2 3 4 5\n4 5 6 7 8\n7 8 9 1 2\n"), 1.0, "um", "",
                       Missing::fill)(2, 2) == 9);
    REFUSED(heights("1 2 3 1\n4 5 6 1\n7 8 9 1\n"), "four columns are a list of asperities x y z");
    std::string points;
    for (const int k : indices(9)) points += format("%d %d %d\n", k % 3, k / 3, k);
    CHECK(read_heights(write("t", points), {})(1, 2) == 7);
    REFUSED(read_heights(write("t", points + "1 2 5\n"), {}),
            "t:10: x = 1, y = 2 is already in line 8");
    // The header of Gwyddion's text exports: the unit of the heights.
    const std::string told = write("t",
                                   "# Channel: Height\r\n# Width: 5 mm\r\n# Value units: m\r\n1 2 "
                                   "3 4 5\n1 2 3 4 5\n1 2 3 4 5\n");
    CHECK(read_heights(told, 5.0)(1, 2) == 2000 && read_heights(told, {}, "m")(1, 2) == 2 &&
          read_heights(told, 5.0, "mm", "", Missing::refuse, {"mm", {}})(1, 2) == 2);
    REFUSED(read_heights((folder / "absent"), 1.0), "absent: No such file or directory");
    REFUSED(read_heights(folder.path.string(), 1.0), ": is a folder, not a file");
    REFUSED(read_heights(write("t.nc", "1 2 3\n4 5 x\n"), 1.0),
            "t.nc:2: 'x'");  // by content, not by name
}

// One separator throughout; decimal commas between semicolons.
TEST(separators) {
    const auto second = [](const char* content) {
        return read_heights(write("t", content), 5.0)(1, 2);
    };
    CHECK(second("1 2\t3 4 5\n1 2 3 4 5\n1 2.5  3 4 5\n") == 2.5);
    CHECK(second("1,2, 3 ,4,5\n1,2,3,4,5,\n1,2.5,3,4,5\n") == 2.5);
    CHECK(second("1;2; 3 ;4;5\n1;2;3;4;5;\n1;2.5;3;4;5\n") == 2.5);
    CHECK(second("1;2; 3 ;4;0,5\n1;2;3;4;5;\n1;2,5e0;3;4;5\n") == 2.5);
    const auto row = [](const std::string& one) {
        return read_heights(write("t", one + "\n1;2;3;4;5\n1;2;3;4;5\n"), 5.0);
    };
    REFUSED(row("0,01;2;3;4.5;5"),
            "t:1: '4.5' in column 4: a decimal point, where line 1 has decimal commas");
    REFUSED(row("1;2;3;4.5;0,01"),
            "t:1: '0,01' in column 5: a decimal comma, where line 1 has decimal points");
    REFUSED(row("1.000,5;2;3;4;5"), "'1.000,5' in column 1 is not a number");
    REFUSED(row("1,000,5;2;3;4;5"), "'1,000,5' in column 1 is not a number");
    REFUSED(row("1 2;2;3;4;5"),
            "t:1: blanks before '2' where the rest of the line has semicolons: one separator is "
            "expected throughout");
    REFUSED(row("1 2 3 4 5"), "t:2: semicolons before the end where line 1 has blanks");
    REFUSED(row("1,2,3,4,5"),
            "t:2: semicolons before the end where line 1 has commas: one separator is expected "
            "throughout");
    REFUSED(heights(std::string("1 2 3\n4 5 6\n", 12) + std::string(5000, ' ') +
                    std::string("\n1 \0", 4)),
            "t:4: neither text nor a NetCDF file (there is a zero byte)");
    // Decimal commas between blanks must not be read as separators, which would give twice the
    // columns.
    REFUSED(heights("0,01 0,02 0,03 0,04 0,05\n"),
            "t:1: blanks before '0' where the rest of the line has commas");
    REFUSED(heights("0,01 0,02 0,03 0,04 0,05\n"), "one separator is expected throughout;");
}

std::string asperities_file(std::vector<double> x, std::vector<double> r) {
    return write(folder / "bad", Dimensions{{"asperity", 3}, {"other", 4}},
                 std::vector<Variable>{
                     {"asperity_x", NC_DOUBLE, {"asperity"}, x},
                     {"asperity_y", NC_DOUBLE, {"asperity"}, {0, 0, 1}},
                     {"asperity_z", NC_DOUBLE, {"asperity"}, {0.1, 0.2, 0.3}},
                     {"asperity_radius", NC_DOUBLE, {r.size() == 3 ? "asperity" : "other"}, r}});
}

TEST(asperities) {
    REFUSED(read_asperities(asperities_file({1, 1, 1}, {1, 2, 3})),
            "asperity 1, counted from 0: lies at the same");
    REFUSED(read_asperities(asperities_file({0, 1, 1}, {1, 2, 0})),
            "asperity 2, counted from 0: the radius must");
    REFUSED(read_asperities(asperities_file({0, std::nan(""), 1}, {1, 2, 3})),
            "asperity_x(asperity = 1), counted from 0,");
    REFUSED(read_asperities(asperities_file({0, 1, 1}, {1, 2, 3, 4})),
            "asperity_radius(other = 4): 3 values as of");
    std::vector<Variable> empty;
    for (const char* name : {"asperity_x", "asperity_y", "asperity_z", "asperity_radius"})
        empty.push_back({name, NC_DOUBLE, {"asperity"}});
    REFUSED(read_asperities(write(folder / "empty", Dimensions{{"asperity", 0}}, empty)),
            ": there is no asperity in it");
    REFUSED(read_asperities(write("t", "1 2 3 4\n# remark\n1 2 3\n")),
            "t:3: 3 values where 4 were expected");
    REFUSED(read_asperities(write("t", "1 2 3 4\n2 2 3 -4\n")),
            "t:2: the radius must be positive, not -4");
    REFUSED(read_asperities(write("t", "1 2 3 4\n2 2 3 4\n\n1 2 9 9\n")),
            "t:4: lies at the same point as ");
    REFUSED(read_asperities(write("t", "1 2 nan 4\n")), "t:1: 'nan' in column 3 is not finite");
    REFUSED(read_asperities((folder / "absent")), "No such file");
}

}  // namespace test_inputs
