// Maps as instruments and other programs write them: units in comments and attributes, masks, codes
// for missing points, empty cells, coordinates; and what is done with wrong points in holes.
#include "base/format.hpp"
#include "io/inputs.hpp"
#include "support/height_maps.hpp"
#include "support/netcdf_file.hpp"
#include "support/refused.hpp"
#include "support/temporary_folder.hpp"
#include "surface/defects.hpp"
#include "surface/measured.hpp"

namespace test_dialects {

using namespace rsc;
using netcdf_file::Variable;

const Folder folder;
constexpr const char* kRows = "1 2 3 4 5\n2 3 4 5 6\n3 4 5 6 8\n";

HeightMap text_map(const std::string& text, const MapKeys& keys = {"", 0.5},
                   Missing missing = Missing::refuse, MapOrigin* origin = nullptr) {
    return read_heights(folder.write("t", text), {}, "um", "", missing, keys, origin);
}

// A comment states the unit of the heights, or asks for it; never is it passed over.
TEST(test_units_in_comments) {
    CHECK(text_map(std::string("# Exported image units: nm\n") + kRows)(4, 2) == 0.008);
    CHECK(text_map(std::string("# Value units: m\n") + kRows)(0, 0) == 1e6);
    CHECK(text_map(std::string("# Z units = mm, by hand\n") + kRows)(0, 0) == 1e3);
    for (const char* const comment :
         {"# heights [nm]", "# scan size 10 mm", "# z in nanometers", "# step: 5nm", "# z (m)"}) {
        const std::string text = std::string(comment) + "\n" + kRows;
        REFUSED(text_map(text), "surface%height_unit, the unit of the heights, must be given");
        CHECK(text_map(text, {"um", 0.5})(0, 0) == 1);
    }
    // Words that look like units, and the unit of the case.
    for (const char* const comment : {"# made in 2020 at a place m", "# United Instruments: x",
                                      "# z [um]", "# 12 scans in 3 h"})
        CHECK(text_map(std::string(comment) + "\n" + kRows)(0, 0) == 1);
    // Of points the coordinates, too, have a unit.
    std::string points;
    for (const int k : indices(9))
        points += std::to_string(k % 3) + " " + std::to_string(k / 3) + " 1\n";
    CHECK_RELATIVE(text_map("# x [nm] y [nm] z [nm]\n" + points, {"nm", {}}).dx, 1e-3, 1e-12);
    CHECK(text_map("# x [um] y [um] z [nm]\n" + points, {"nm", {}})(0, 0) == 0.001);
    CHECK(text_map(points, {"nm", {}, {}, "mm"}).dx == 1000 && text_map(points, {}).dx == 1);
    for (const char* const comment : {"# scan of 10 mm\n", "# x [um] y [nm]\n"})
        REFUSED(text_map(comment + points, {"nm", {}}), "surface%");
    REFUSED(text_map(points, {"nm", {}}), "surface%coordinate_unit must be given");
    REFUSED(text_map("# z units: nm\n" + points, {}), "surface%coordinate_unit must be given");
    REFUSED(text_map(kRows, {"", 0.5, {}, "um"}), "a matrix has no coordinates");
}

// The sides of the header of Gwyddion's exports; with it, three or four columns are a matrix.
TEST(test_sides_in_comments) {
    const std::string header = "# Width: 6 nm\n# H\xc3\xb6he: 6 nm\n# Value units: nm\n";
    const HeightMap map = text_map(header + "1 2 3 4\n2 3 4 5\n3 4 5 6\n", {});
    CHECK_RELATIVE(map.dx, 0.0015, 1e-12);
    CHECK_RELATIVE(map.dy, 0.002, 1e-12);
    CHECK(text_map(header + "1 2 3\n2 3 4\n3 4 5\n", {}).nx == 3);
    REFUSED(text_map(header + kRows, {"", 0.5}), "a comment says that the map is 0.006 um wide");
}

// Gwyddion writes its header in the language of its user. The unit of the heights (m) is another
// than that of the sides (um), which is the unit of the case.
TEST(test_headers_in_other_languages) {
    const std::array<std::array<const char*, 3>, 5> languages = {{
        {"Breite:", "H\xc3\xb6he:", "Einheiten:"},
        {"Largeur :", "Hauteur :", "Unit\xc3\xa9s :"},
        {"Larghezza:", "Altezza:", "unit\xc3\xa0 valore:"},
        {"\xe5\xb9\x85:", "\xe9\xab\x98\xe3\x81\x95\xef\xbc\x9a",
         "\xe5\x80\xa4\xe3\x81\xae\xe5\x8d\x98\xe4\xbd\x8d:"},
        {"\xd0\xa8\xd0\xb8\xd1\x80\xd0\xb8\xd0\xbd\xd0\xb0:",
         "\xd0\x92\xd1\x8b\xd1\x81\xd0\xbe\xd1\x82\xd0\xb0:",
         "\xd0\x95\xd0\xb4\xd0\xb8\xd0\xbd\xd0\xb8\xd1\x86\xd1\x8b:"},
    }};
    for (const auto& [width, height, unit] : languages) {
        const auto header = [&](const char* value) {
            return std::string("# Kanal: Topography\n# ") + width + " 10.00 \xc2\xb5m\n# " +
                   height + " 6.00 \xc2\xb5m\n# " + unit + value + "\n" + kRows;
        };
        const HeightMap map = text_map(header(" m"), {});
        CHECK(map(0, 2) == 1e6);  // the first line is the top
        CHECK_RELATIVE(map.dx, 2, 1e-12);
        CHECK_RELATIVE(map.dy, 2, 1e-12);
        for (const char* const other : {" V", ""})
            REFUSED(text_map(header(other), {}), "is no unit of length");
    }
    // A unit alone after a colon is not passed over either, whatever stands before.
    const std::string alone = std::string("# Einheit: m\n") + kRows;
    REFUSED(text_map(alone), "surface%height_unit, the unit of the heights, must be given");
    CHECK(text_map(alone, {"um", 0.5})(0, 0) == 1);
    // The height of the map counts also where its width is given, and contradicts square points.
    const std::string high = "# Width: 5 um\n# Height: 6 um\n# Value units: um\n";
    const HeightMap map = read_heights(folder.write("t", high + kRows), 5.0, "um", "",
                                       Missing::refuse, MapKeys{}, nullptr);
    CHECK_RELATIVE(map.dx, 1, 1e-12);
    CHECK_RELATIVE(map.dy, 2, 1e-12);
    REFUSED(text_map(high + kRows, {"", 1.0}), "a comment says that the map is 6 um high");
}

TEST(test_empty_cells) {
    const auto missing = [](const std::string& text) {
        const HeightMap map = text_map(text, {"", 0.5}, Missing::fill);
        std::string places;
        for (const int j : indices(map.ny))
            for (const int i : indices(map.nx))
                if (std::isnan(map(i, j))) places += std::to_string(i) + std::to_string(j) + " ";
        return std::to_string(map.nx) + ": " + places;
    };
    CHECK(missing(",2,3,4,5\n1,2,,,5\n1,2,3,4,\n") == "5: 00 21 31 42 ");
    CHECK(missing("1;2,5;3;4;\n1;2;3;4;5\n;;;;\n") == "5: 40 02 12 22 32 42 ");
    CHECK(missing("1,2,3,4,5,\n1,2,3,4,5,\n1,2,3,4,5,\n") == "5: ");  // a separator ends each line
    REFUSED(text_map("1,2,3,4,5\n1,2,,4,5\n1,2,3,4,5\n"),
            "empty cells of a map are missing points");
}

// A table with its coordinates in the first line and column, as spreadsheets write it; a map that
// only lacks its corner is read.
TEST(test_coordinates_are_no_heights) {
    const std::string rows = "2.5,7,9,1,4\n5,3,8,2,7\n7.5,1,2,9,5\n10,4,4,3,8\n";
    REFUSED(text_map(",0,0.33,0.67,1\n" + rows, {"", 0.5}, Missing::fill),
            "t:1: the corner is empty, the first line and the first column are uniform");
    CHECK(text_map(",0,0.33,0.77,1\n" + rows, {"", 0.5}, Missing::fill).nx == 5);
    CHECK(text_map("1,0,0.33,0.67,1\n" + rows).nx == 5);
}

TEST(test_missing_values) {
    const std::string text = "-9999 1 2 1 2\n2 1 -9999 2 1\n1 2 1 2 -32768\n";
    MapOrigin origin;
    const HeightMap map = text_map(text, {"nm", 0.5, {-9999, -32768}}, Missing::fill, &origin);
    CHECK(count_missing(map) == 3 && std::isnan(map(4, 2)) && !origin.code);
    REFUSED(text_map(text, {"nm", 0.5, {-9999}}), "2 of 15 points are missing");
    // Told as likely: twice the same far below the others; a single one is an outlier.
    text_map("-9999 1 2 1 2\n2 1 -9999 2 1\n1 2 1 2 3\n", {"", 0.5}, Missing::refuse, &origin);
    CHECK(origin.code == -9999.0 && origin.coded == 2);
    text_map("-9999 1 2 1 2\n2 1 1 2 1\n1 2 1 2 3\n", {"", 0.5}, Missing::refuse, &origin);
    CHECK(!origin.code);
    // The lowest height is met more often than the next, however near it is; a tail that thins out,
    // two levels and a plateau that is most of the map are no codes.
    long repeated = 0;
    const auto with_lowest = [](int times, double lowest) {
        return height_map(40, 40, 1, 1, [=](int i, int j) {
            return 40 * i + j < times ? lowest : std::fmod(0.618 * (40 * i + j), 1);
        });
    };
    CHECK(likely_code(with_lowest(60, -1e-3), repeated) == -1e-3 && repeated == 60);
    CHECK(!likely_code(with_lowest(10, -1e-3), repeated));
    CHECK(!likely_code(with_lowest(900, -1e-3), repeated));
    const HeightMap two = height_map(40, 40, 1, 1, [](int i, int j) { return (i + j) % 2; });
    CHECK(!likely_code(two, repeated));
    const HeightMap rounded = height_map(40, 40, 1, 1, [](int i, int j) {
        return std::round(4 * std::sin(0.7 * i) + 4 * std::sin(0.9 * j));
    });
    CHECK(!likely_code(rounded, repeated));
    // Zeros in a block among heights about 0, but not a plateau among plateaus.
    long points = 0;
    const auto with_block = [&](double elsewhere) {
        return height_map(16, 16, 1, 1, [=](int i, int j) {
            if (i < 5 && j < 5) return 0.0;
            return i > 10 && j > 10 ? elsewhere + 0.1 * (i * j % 3) * (elsewhere == 0)
                                    : std::sin(1.7 * i + 2.9 * j);
        });
    };
    CHECK(likely_code(with_block(0), points) == 0.0 && points >= 25);
    CHECK(!likely_code(with_block(0.5), points));
}

// SurfaceTopography's layout: attribute unit, y fastest, a mask; its 0 is a point that is there.
TEST(test_netcdf_layouts) {
    std::vector<double> heights, mask;
    for (const int i : indices(4))
        for (const int j : indices(3)) {
            heights.push_back(10 * i + j);
            mask.push_back(i == 2 && j == 1);
        }
    const std::vector<std::pair<std::string, std::string>> nm = {{"unit", "nm"}};
    const std::vector<Variable> all = {{"x", NC_DOUBLE, {"x"}, {0, 2, 4, 6}, nm},
                                       {"y", NC_DOUBLE, {"y"}, {0, 3, 6}, nm},
                                       {"heights", NC_DOUBLE, {"x", "y"}, heights, nm},
                                       {"mask", NC_INT, {"x", "y"}, mask}};
    const std::string path = netcdf_file::write(folder / "t.nc", {{"x", 4}, {"y", 3}}, all);
    MapOrigin origin;
    const HeightMap map = read_heights(path, {}, "um", "", Missing::fill, {}, &origin);
    CHECK(map.nx == 4 && map.ny == 3 && origin.channel == "heights");
    CHECK_RELATIVE(map.dx, 0.002, 1e-12);
    CHECK_RELATIVE(map.dy, 0.003, 1e-12);
    CHECK_RELATIVE(map(3, 2), 0.032, 1e-12);
    CHECK(std::isnan(map(2, 1)) && count_missing(map) == 1);
    REFUSED(read_heights(path, {}, "um"), "1 of 12 points are missing");
}

// Points x y z of a grid of which whole columns are missing, and coordinates with too few digits.
TEST(test_points) {
    std::string dropped, rounded;
    for (const int j : indices(5))
        for (const int i : indices(7)) {
            if (i != 2 && i != 3) dropped += format("%.4f %.4f %d\n", i / 3.0, j / 3.0, i + j);
            rounded += format("%.1f %.4f %d\n", i / 3.0, j / 3.0, i + j);
        }
    const HeightMap map = text_map(dropped, {}, Missing::fill);
    CHECK(map.nx == 7 && map.ny == 5 && count_missing(map) == 10 && map(6, 4) == 10);
    REFUSED(text_map(dropped, {}), "surface%missing = 'fill' fills such points");
    REFUSED(text_map(rounded, {}), "x has too few digits: it is rounded to 0.1");
}

// A wrong point in the middle of a hole, a right one beside it, and outliers on whole ground.
TEST(test_islands) {
    const auto z = [](int i, int j) { return std::sin(0.5 * i) * std::cos(0.4 * j); };
    HeightMap map = height_map(40, 40, 1, 1, [&](int i, int j) {
        const bool hole = i > 10 && i < 30 && j > 10 && j < 30;
        if (i == 20 && j == 20) return -300.0;
        if (i == 35 && j == 5) return 50.0;
        return hole && !(i == 11 && j == 13) ? std::nan("") : z(i, j);
    });
    const Outliers found = remove_outliers(map, 6);
    CHECK(found.count == 2 && found.islands == 1);
    CHECK(std::isnan(map(20, 20)) && std::isnan(map(35, 5)) && map(11, 13) == z(11, 13));
}

TEST(test_flat_maps) {
    HeightMap map = flat_map(16, 16, 1, 1);
    const Measured m = measure(map, {});
    CHECK(std::isnan(m.parameters.ssk) && m.gaussian());
    for (const std::string& line : report(m, "mm")) CHECK(line.find("nan") == std::string::npos);
}

// One wave: the lay lies along its crests, whatever its direction.
TEST(test_lay) {
    for (const auto& [kx, ky] : {std::pair{4, 0}, {0, 3}, {3, 3}, {5, -2}}) {
        HeightMap map = height_map(64, 64, 1, 1, [kx = kx, ky = ky](int i, int j) {
            return std::cos(2 * pi * (kx * i + ky * j) / 64);
        });
        const double crest = 180 / pi * std::atan2(ky, kx) + 90;
        const double off = measure_spectrum(map, 1, 0).lay - crest;
        CHECK_CLOSE(std::remainder(off, 180), 0, 0.5);
    }
}

}  // namespace test_dialects
