// Files of instruments: .gwy and .sdf, what is read and what is refused with which words; where
// Gwyddion is installed, what it makes of them itself.
#include <unistd.h>
#include <zlib.h>

#include "check.hpp"
#include "io/formats.hpp"
#include "io/inputs.hpp"
#include "support/map_files.hpp"
#include "support/netcdf_file.hpp"
#include "support/refused.hpp"
#include "support/temporary_folder.hpp"

namespace test_maps {

using namespace rsc;
using namespace map_files;

const Folder folder;

std::string write(const std::string& name, const std::string& content) {
    return folder.write(name, content);
}

// 6 x 4 points of 2 x 3 micrometres; height 100 row + column nanometres, rows from the top.
Map sample() {
    Map map{6, 4, 2e-6, 3e-6, {}};
    for (const int j : indices(4))
        for (const int i : indices(6)) map.z.push_back(1e-9 * (100 * j + i));
    return map;
}

// The same with rows from below, as .sdf has them.
Map upwards() {
    Map map = sample();
    for (const int j : indices(4))
        for (const int i : indices(6)) map.z[std::size_t(6 * j + i)] = 1e-9 * (100 * (3 - j) + i);
    return map;
}
constexpr std::size_t kHole = 2 * 6 + 4;  // the point of check_sample() among these

// The sample in micrometres, y upwards; `missing` is the column of a missing point in the second
// row from the top, or -1.
void check_sample(const HeightMap& m, int missing) {
    CHECK(m.nx == 6 && m.ny == 4 && !m.periodic && m.x0 == 0 && m.y0 == 0);
    CHECK_RELATIVE(m.dx, 2.0, 1e-12);
    CHECK_RELATIVE(m.dy, 3.0, 1e-12);
    for (const int j : indices(4))
        for (const int i : indices(6))
            if (i == missing && j == 2)
                CHECK(std::isnan(m(i, j)));
            else
                CHECK_CLOSE(m(i, j), 1e-3 * (100 * (3 - j) + i), 1e-12);
}

HeightMap in_micrometres(const std::string& path, const std::string& channel = "",
                         Missing missing = Missing::refuse) {
    return read_heights(path, std::nullopt, "um", channel, missing);
}

HeightMap of_gwy(const Map& map) {
    return in_micrometres(write("w.gwy", gwy_file(gwy_channel(0, "T", map))));
}
HeightMap of_sdf(const std::string& content, Missing missing = Missing::refuse) {
    return in_micrometres(write("t.sdf", content), "", missing);
}

TEST(gwy) {
    const Map map = sample();
    Map in_own_units = map;
    in_own_units.dx *= 1e3;
    in_own_units.dy *= 1e3;
    for (double& z : in_own_units.z) z *= 1e9;
    check_sample(in_micrometres(write("one.gwy", gwy_file(gwy_channel(0, "Topography", map)))), -1);
    CHECK_RELATIVE(read_heights(write("one.gwy", gwy_file(gwy_channel(0, "T", map))), std::nullopt,
                                "mm")(1, 3),
                   1e-6, 1e-12);
    check_sample(
        in_micrometres(write("own.gwy", gwy_file(gwy_channel(0, "T", in_own_units, "nm", "mm")))),
        -1);
    CHECK_RELATIVE(read_heights(folder / "one.gwy", 12e-3).Lx(), 12e-3,
                   1e-12);  // L may be given, if it is the same
    REFUSED(read_heights(folder / "one.gwy", 11e-3),
            "one.gwy: its coordinate x spans 6 steps of 0.002 = 0.012, but L = 0.011 was given");
    // The first channel of heights, or the one that is named; other things lie between.
    Map other = map;
    for (double& z : other.z) z += 1e-6;
    std::string between;
    gwy_component(between, "/filename", 's', std::string("x.gwy") + '\0');
    gwy_component(between, "/0/base/range-type", 'i', bytes(std::int32_t{1}));
    gwy_component(between, "/flag", 'b', "\1");
    gwy_component(between, "/letters", 'C', bytes(std::uint32_t{3}) + "abc");
    gwy_component(between, "/words", 'S', bytes(std::uint32_t{2}) + std::string("a\0bc\0", 5));
    gwy_component(between, "/objects", 'O', bytes(std::uint32_t{1}) + gwy_object("GwySIUnit", ""));
    gwy_component(between, "/meta", 'o', gwy_object("GwyContainer", ""));
    gwy_component(between, "/long", 'q', bytes(std::int64_t{5}));
    const std::string three =
        gwy_file(gwy_channel(2, "Height", other) + between + gwy_channel(0, "Amplitude", map, "V") +
                 gwy_channel(1, "Topography", map));
    check_sample(in_micrometres(write("three.gwy", three)), -1);
    CHECK_RELATIVE(in_micrometres(write("three.gwy", three), "Height")(0, 3), 1.0, 1e-12);
    CHECK_RELATIVE(in_micrometres(folder / "three.gwy", "2")(0, 3), 1.0, 1e-12);
    REFUSED(in_micrometres(folder / "three.gwy", "3"),
            "there is no channel '3'; there are 'Amplitude' (0) in 'V', 'Topography' (1) in 'm',");
    REFUSED(in_micrometres(write("three.gwy", three), "Amplitude"),
            "channel 'Amplitude': its values are in 'V',");
    for (const std::string name : {"Phase", "Topo"})  // also the beginning of a title
        REFUSED(in_micrometres(write("three.gwy", three), name),
                "there is no channel '" + name + "'; there are");
    REFUSED(in_micrometres(write("volt.gwy", gwy_file(gwy_channel(0, "A", map, "V")))),
            "no channel contains heights; there are 'A' (0) in");
    REFUSED(in_micrometres(write("number.gwy",
                                 gwy_file(gwy_channel(0, "A", map, "")))),  // a number is no length
            "there are 'A' (0) in ''; surface%height_unit is the unit of a channel that has none");
    REFUSED(in_micrometres(write("none.gwy", gwy_file(between))),
            "none.gwy: contains no channel (image)");
    REFUSED(in_micrometres(write("xy.gwy", gwy_file(gwy_channel(0, "A", map, "m", "s")))),
            "channel 'A': its sides are in 's', which is");
    // Missing points: NaN, or under the mask.
    Map hole = map;
    hole.z[6 + 4] = std::nan("");
    const std::string with_hole = write("hole.gwy", gwy_file(gwy_channel(0, "T", hole)));
    check_sample(in_micrometres(with_hole, "", Missing::fill), 4);
    REFUSED(in_micrometres(with_hole), "1 of 24 points are missing or masked, the");
    Map mask = map;
    for (double& z : mask.z) z = 0;
    mask.z[6 + 4] = 0.25;
    mask.z[0] = -1;  // above 0 is masked
    std::string masked = gwy_channel(0, "T", map);
    gwy_component(masked, "/0/mask", 'o', gwy_field(mask, "m", ""));
    check_sample(in_micrometres(write("mask.gwy", gwy_file(masked)), "", Missing::fill), 4);
    REFUSED(in_micrometres(write("mask.gwy", gwy_file(masked))), "missing or masked");

    std::string untitled;
    gwy_component(untitled, "/3/data", 'o', gwy_field(map, "m", "V"));
    REFUSED(in_micrometres(write("one.gwy", gwy_file(untitled))),
            "one.gwy: no channel contains heights; there are 'channel 3' (3) in 'V'");
    // Sides that are not given are 1.
    for (const bool x : {true, false}) {
        std::string field = gwy_field(map, "m", "m");
        const std::string name = x ? "yreal" : "xreal", part = name + std::string("\0d", 2);
        field.erase(field.find(part), part.size() + 8);
        field.replace(
            13, 4,
            bytes(static_cast<std::uint32_t>(field.size() - 17)));  // behind the name: what is left
        std::string c;
        gwy_component(c, "/0/data", 'o', field);
        const HeightMap m = in_micrometres(write("one.gwy", gwy_file(c)));
        CHECK_RELATIVE(m.dx, x ? 2.0 : 1e6 / 6, 1e-12);
        CHECK_RELATIVE(m.dy, x ? 1e6 / 4 : 3.0, 1e-12);
    }

    // A file that is cut anywhere is refused, with the place.
    const std::string whole = gwy_file(gwy_channel(0, "T", map));
    for (std::size_t size = 5; size < whole.size(); ++size)
        REFUSED(in_micrometres(write("cut.gwy", whole.substr(0, size))), "at byte ");
    Map wrong = map;
    wrong.nx = 7;
    REFUSED(of_gwy(wrong), "w.gwy: channel 'T': 24 values for 7 x 4 points");
    wrong.nx = 2000000000;
    wrong.ny = 2000000000;
    REFUSED(of_gwy(wrong), "GB; this machine has");
    wrong = map;
    wrong.ny = -4;
    REFUSED(of_gwy(wrong), ": /0/data yres = -4: must be positive");
    Map small = map;
    small.ny = 3;
    small.z.resize(18);
    std::string badly = gwy_channel(0, "T", map);
    gwy_component(badly, "/0/mask", 'o', gwy_field(small, "m", ""));
    REFUSED(in_micrometres(write("w.gwy", gwy_file(badly))),
            "w.gwy: channel 'T': its mask and the channel differ in size");
    std::string strange;
    gwy_component(strange, "/x", 'x', "");
    REFUSED(in_micrometres(write("w.gwy", gwy_file(strange))), "/x has an unknown type, 'x'");
    REFUSED(in_micrometres(write("w.gwy", "GWYO" + whole.substr(4))),
            "a file of another version of Gwyddion (it");
    REFUSED(in_micrometres(write("w.gwy", "GWYP" + gwy_object("GwyBrick", ""))),
            "an object GwyContainer was expected, not 'GwyBrick'");
}

template <class T>
std::vector<T> values_of(const Map& map, double scale, T missing, bool hole) {
    std::vector<T> values;
    for (const double z : map.z) values.push_back(static_cast<T>(std::round(z / scale)));
    if (hole) values[kHole] = missing;
    return values;
}

template <class T>
void sdf_type(int type, T missing) {
    const Map map = upwards();
    for (const bool hole : {false, true}) {
        if (sizeof(T) == 1) {  // too few numbers for the sample: the type alone
            std::vector<T> values(24, T{3});
            if (hole) values[kHole] = missing;
            const HeightMap m = of_sdf(sdf_binary(map, type, 1e-9, values), Missing::fill);
            CHECK_RELATIVE(m(0, 0), 3e-3, 1e-12);
            CHECK(std::isnan(m(4, 2)) == hole);
            continue;
        }
        const std::string path =
            write("t.sdf", sdf_binary(map, type, 1e-9, values_of<T>(map, 1e-9, missing, hole)));
        check_sample(in_micrometres(path, "", Missing::fill), hole ? 4 : -1);
        if (hole) REFUSED(in_micrometres(path), "points are missing");
    }
}

TEST(sdf) {
    const Map map = upwards();
    sdf_type<std::uint8_t>(0, 255);
    sdf_type<std::uint16_t>(1, 65535);
    sdf_type<std::uint32_t>(2, 4294967295u);
    sdf_type<float>(3, std::nanf(""));
    sdf_type<float>(3, std::numeric_limits<float>::lowest());
    sdf_type<std::int8_t>(4, -128);
    sdf_type<std::int16_t>(5, -32768);
    sdf_type<std::int32_t>(6, std::numeric_limits<std::int32_t>::min());
    sdf_type<double>(7, std::nan(""));
    sdf_type<double>(7, std::numeric_limits<double>::lowest());
    const auto i16 = values_of<std::int16_t>(map, 1e-9, 0, false);
    check_sample(of_sdf(sdf_binary(map, 5, 1e-9, i16, "bISO-2.0")), -1);
    check_sample(of_sdf(sdf_binary(map, 5, 1e-9, i16, "bBCR-1.0") + "a trailer"), -1);
    // BCR also marks a missing point by the largest value; in ISO this is a height.
    for (const std::int16_t mark : {std::int16_t{-32768}, std::int16_t{32767}})
        for (const char* const version : {"bBCR-1.0", "bISO-1.0"}) {
            const auto values = values_of<std::int16_t>(map, 1e-9, mark, true);
            const std::string path = write("t.sdf", sdf_binary(map, 5, 1e-9, values, version));
            const bool missing = mark < 0 || version[1] == 'B';
            CHECK(std::isnan(in_micrometres(path, "", Missing::fill)(4, 2)) == missing);
        }
    // A mark that the format does not know, in the unit of the case (um).
    const auto marked = values_of<std::int16_t>(map, 1e-9, 9999, true);
    const std::string path = write("t.sdf", sdf_binary(map, 5, 1e-9, marked));
    const MapKeys text{"", {}, {9.999}};
    check_sample(read_heights(path, {}, "um", "", Missing::fill, text), 4);
    // Olympus: eight bytes more in the header.
    std::string olympus = sdf_binary(map, 5, 1e-9, i16);
    olympus.insert(81, bytes(std::uint32_t{5}) + bytes(std::uint32_t{1}));
    check_sample(of_sdf(olympus), -1);

    std::vector<std::string> words;
    for (const double z : map.z) words.push_back(std::to_string(std::lround(z * 1e9)));
    check_sample(of_sdf(sdf_text(map, 1e-9, words)), -1);
    words[kHole] = "BAD";
    check_sample(of_sdf(sdf_text(map, 1e-9, words), Missing::fill), 4);
    words[kHole] = "-32768";
    check_sample(of_sdf(sdf_text(map, 1e-9, words, 5), Missing::fill), 4);
    REFUSED(of_sdf(sdf_text(map, 1e-9, words, 5)), "1 of 24 points are missing");
    words[kHole] = "-2147483648";
    check_sample(of_sdf(sdf_text(map, 1e-9, words, 6), Missing::fill), 4);
    CHECK_RELATIVE(of_sdf(sdf_text(map, 1e-9, words, 7))(4, 2), -2147483.648,
                   1e-12);  // a number like others
    words[kHole] = "NaN";
    check_sample(of_sdf(sdf_text(map, 1e-9, words, 6), Missing::fill), 4);
    for (const std::string word : {"1O4", "10-4"}) {
        words[kHole] = word;
        REFUSED(of_sdf(sdf_text(map, 1e-9, words)), "t.sdf:18: '" + word + "' is not a number");
    }
    words.pop_back();
    words[kHole] = "104";
    REFUSED(of_sdf(sdf_text(map, 1e-9, words)),
            ": 23 heights where 6 x 4 were expected; is the file complete?");
    words.resize(25, "0");
    REFUSED(of_sdf(sdf_text(map, 1e-9, words)), "'0' after the last of 6 x 4 heights");
    words.resize(24);
    for (const auto& [from, to, place] :
         {std::tuple{"NumPoints = 6", "NumPoints = -6", "t.sdf:6: NumPoints"},
          {"\r\nYscale", " mm\r\nYscale", "t.sdf:8: Xscale"}}) {
        std::string odd = sdf_text(map, 1e-9, words);
        REFUSED(of_sdf(odd.replace(odd.find(from), std::strlen(from), to)), place);
    }
    // Cut anywhere, and absurd headers.
    const std::string binary = sdf_binary(map, 5, 1e-9, i16);
    for (std::size_t size = 8; size < binary.size(); ++size)
        REFUSED(of_sdf(binary.substr(0, size)), "at byte ");
    Map wrong = map;
    wrong.nx = wrong.ny = 65535;
    REFUSED(of_sdf(sdf_binary(wrong, 5, 1e-9, i16)), "65535 x 65535 heights of 2 bytes each, but");
    std::string packed = binary;
    packed[78] = 1;
    REFUSED(of_sdf(packed), "t.sdf: Compression = 1: only 0 (none) is known");
    packed = binary;
    packed[80] = 2;
    REFUSED(of_sdf(packed), "t.sdf: CheckType = 2: only 0 (none) is known");
    REFUSED(read_sdf(write("t.sdf", "cISO-1.0"), "", "mm", {}, nullptr),
            "t.sdf: is no surface data file (ISO 25178-71)");
    REFUSED(in_micrometres(write("t.sdf", binary), "Height"), "has no channel 'Height'; only");
    // A file of an unknown format.
    REFUSED(in_micrometres(write("t.plu", std::string("PLU\0\1\2", 6))),
            "neither NetCDF, .gwy, .sdf nor text.");
}

// The example of input/README: both files are one map.
TEST(example) {
    const std::string input = RSC_TEST_DATA "/../../input/map/";
    const HeightMap sdf = read_heights(input + "map.sdf", std::nullopt, "um", "", Missing::fill);
    const HeightMap gwy = read_heights(input + "map.gwy", std::nullopt, "um", "", Missing::fill);
    CHECK(sdf.nx == 160 && sdf.ny == 128 && gwy.nx == 160 && gwy.ny == 128);
    CHECK_RELATIVE(sdf.dx, 2.5, 1e-12);
    CHECK_RELATIVE(gwy.dy, 3.125, 1e-12);
    long different = 0;
    for (const int j : indices(128))
        for (const int i : indices(160))
            different += std::isnan(sdf(i, j)) != std::isnan(gwy(i, j)) ||
                         std::abs(sdf(i, j) - gwy(i, j)) > 1e-9;
    CHECK(different == 0);
}

std::string packed(const std::string& path) {
    const std::string content = ::bytes(path), name = path + ".gz";
    const gzFile file = gzopen(name.c_str(), "wb");
    CHECK(gzwrite(file, content.data(), unsigned(content.size())) == int(content.size()));
    gzclose(file);
    return name;
}

// The lines of heights in nanometres, the first with the given y.
std::string lines(const std::string& separator, bool from_top, const std::string& end = "\n") {
    std::string text;
    for (const int j : indices(4))
        for (const int i : indices(6))
            text += std::to_string(100 * (from_top ? j : 3 - j) + i) + (i < 5 ? separator : end);
    return text;
}

// One map in every format is one map: rows lie where the format has them, whatever the order in the
// file.
TEST(one_map_in_every_format) {
    const MapKeys none, nm{"nm", {}, {}, "um"};
    const auto check = [](const std::string& path, const MapKeys& keys) {
        check_sample(read_heights(path, {}, "um", "", Missing::refuse, keys), -1);
    };
    check(write("w.gwy", gwy_file(gwy_channel(0, "T", sample()))), none);
    check(write("w.gwy", gwy_file(gwy_channel(0, "T", sample(), "m", ""))), {"", {}, {}, "m"});
    Map numbers = sample();
    for (double& z : numbers.z) z *= 1e9;
    check(write("w.gwy", gwy_file(gwy_channel(0, "T", numbers, ""))), {"nm", {}});
    const std::string head =
        "aBCR-1.0 ; first\nNumPoints = 6\nNumProfiles = 4\nXscale = 2e-6\nYscale = 3E-006\n"
        "Zscale=1E-9\nCompression  = NULL ; or 0\nDataType = INTEGER\nCheckType = NULL\n"
        "*  ; EOF header\n   ; data\n";
    for (const char* const end : {"\n", "\r\n", "\r"}) {
        std::string text = head + lines(" ", false) + "*\n";
        for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;)
            text.replace(at, 1, end), at += std::strlen(end);
        check(write("t.sdf", text), none);
        check(packed(folder / "t.sdf"), none);
    }
    check(write("t.sdf", sdf_binary(upwards(), 7, 1, upwards().z, "bISO-2.0")), none);
    const std::string heading = "# Channel: T\n# Width: 12 \xb5m\n# Height: 12 \xc2\xb5m\n";
    check(write("g.txt", heading + "# Value units: nm\n" + lines("\t", true)), none);
    check(packed(folder / "g.txt"), none);
    std::string triples;
    for (const int k : {5, 2, 0, 1, 3, 4})  // columns in any order, rows from the top
        for (const int j : indices(4))
            triples += joined(2 * k, " ", 9 - 3 * j, " ", 100 * j + k, "\n");
    check(write("t.txt", triples), nm);
    check(write("t.txt", "# x [um] y [um]\n" + triples), {"nm", {}});
    check(packed(folder / "t.txt"), {"nm", {}});
    for (const bool down : {false, true})
        for (const bool turned : {false, true}) {
            std::vector<double> z, y;
            for (const int j : indices(4)) y.push_back(3e-6 * (down ? 3 - j : j));
            for (const int k : indices(24)) {
                const int j = turned ? k % 4 : k / 6, i = turned ? k / 4 : k % 6;
                z.push_back(1e-9 * (100 * (down ? j : 3 - j) + i));
            }
            using Names = std::vector<std::string>;
            const std::vector<std::pair<std::string, std::string>> metres = {{"units", "m"}};
            const std::vector<netcdf_file::Variable> all = {
                {"x", NC_DOUBLE, {"x"}, netcdf_file::counted(6, 0, 2e-6), metres},
                {"y", NC_DOUBLE, {"y"}, y, metres},
                {"height", NC_DOUBLE, turned ? Names{"x", "y"} : Names{"y", "x"}, z, metres}};
            for (const int format : {NC_NETCDF4, 0, NC_64BIT_DATA})
                check(netcdf_file::write(folder / "m.nc", {{"x", 6}, {"y", 4}}, all, format), none);
        }
    // Square points of a matrix.
    for (const char* const separator : {" ", ",", ";"}) {
        const HeightMap map = read_heights(write("m.txt", lines(separator, false)), {}, "um", "",
                                           Missing::refuse, {"nm", 2.0});
        CHECK(map(1, 0) == 0.301 && map(1, 3) == 0.001 && map.dx == 2);
    }
}

// What is packed otherwise, or no map at all, and the command that helps.
TEST(other_files) {
    const auto expect = [](const std::string& content, const std::string& words) {
        REFUSED(in_micrometres(write("a'b.dat", content)), words);
    };
    expect(std::string("\xfd"
                       "7zXZ\0\1",
                       7),
           "packed by xz; this unpacks it: xz -dc '");
    expect("BZh91AY", "bzip2 -dc '" + (folder / "a'\\''b.dat") + "' > '");
    expect("PK\3\4" + std::string(22, '\0') + std::string("\5\0\0\0m.txt", 9), "unzip '");
    expect("PK\3\4" + std::string(22, '\0') + std::string("\10\0\0\0main.xml", 12), "Gwyddion");
    expect("solid a\n facet normal 0 0 1\n", "is a mesh of triangles (STL)");
    expect(std::string(80, ' ') + bytes(std::uint32_t{2}) + std::string(100, '\0'), "(STL)");
    const std::string gzip = ::bytes(packed(write("p", lines(" ", true))));
    expect(gzip.substr(0, gzip.size() - 9), "cut or damaged");
    expect("name a\nname b\n", "lines 1 to 2 begin with a word, not a number, and the rest is no");
}

}  // namespace test_maps
