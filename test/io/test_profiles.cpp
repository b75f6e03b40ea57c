// Profiles in files: texts of styluses, .sdf with one profile, .smd, NetCDF; what is refused.
#include "check.hpp"
#include "io/inputs.hpp"
#include "support/netcdf_file.hpp"
#include "support/refused.hpp"
#include "support/temporary_folder.hpp"

namespace test_profiles {

using namespace rsc;

const Folder folder;

// 20 points 0.5 um apart, of the height 10 i nm.
constexpr int kPoints = 20;

HeightMap read(const std::string& text, const MapKeys& keys = {},
               Missing missing = Missing::refuse) {
    return read_profile(folder.write("profile", text), {}, "um", "", missing, keys, 1);
}

void check(const HeightMap& m) {
    CHECK(m.nx == kPoints && m.ny == 1);
    CHECK_RELATIVE(m.dx, 0.5, 1e-9);
    for (const int i : indices(m.nx)) CHECK_CLOSE(m(i, 0), 0.01 * i, 1e-9);
}

std::string rows(const std::function<std::string(int)>& row) {
    std::string text;
    for (const int i : indices(kPoints)) text += row(i) + "\r\n";
    return text;
}
std::string number(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

TEST(texts_of_styluses) {
    const auto pairs = [](const char* between, double x, double z) {
        return rows([=](int i) { return number(0.5 * x * i) + between + number(0.01 * z * i); });
    };
    // Units in the line above the columns, after lines of text with numbers among them.
    check(read("Stylus Force,3\r\nScan Length,2000\r\nLateral (um),Total Profile (nm)\r\n" +
               pairs(",", 1, 1e3)));
    // Empty columns, and x rounded to less than the step.
    check(read("Lateral um,Raw Micrometer,\n" + rows([](int i) {
                   return number(0.5 * i + (i % 3 == 2 ? 0.1 : 0.0)) + "," + number(0.01 * i) +
                          ",,";
               })));
    check(read("Messdaten\n[um]\t[mm]\n" + pairs("\t", 1, 1e-3)));
    check(read("# x [mm], z [um]\n" + pairs(" ", 1e-3, 1), {.coordinate_unit = "mm"}));
    check(read(pairs(";", 1, 1)));
    // Heights alone, with the step from the file or the case.
    const std::string heights = rows([](int i) { return number(0.01 * i); });
    check(
        read("SigmaSurf_Data 1.0\r\nSPACING_UM: 0.50000\r\nNUMBER_OF_POINTS: 20\r\n"
             "PROFILE_UM:\r\n" +
             heights));
    check(read(heights, {.pixel = 0.5}));
    REFUSED(read(heights), "surface%pixel");
    // A damaged line must not cut the profile short.
    std::string damaged = heights;
    damaged.replace(damaged.find("0.1\r"), 3, "O.1");
    REFUSED(read(damaged, {.pixel = 0.5}), "in two places");
    // Several columns: the number of that with the heights.
    const std::string three =
        rows([](int i) { return number(0.5 * i) + " 7 " + number(0.01 * i); });
    check(read_profile(folder.write("three", "N\tRaw\tZ\n" + three), {}, "um", "3", Missing::refuse,
                       {}, 1));
    REFUSED(read(three), "surface%channel");
    // Missing points: words, and places without a line.
    std::string holes = pairs(" ", 1, 1);
    holes.erase(holes.find("3.5 "), std::string("3.5 0.07\r\n").size());
    const HeightMap filled = read(holes, {}, Missing::fill);
    CHECK(filled.nx == kPoints && std::isnan(filled(7, 0)) && !std::isnan(filled(8, 0)));
    REFUSED(read(holes), "1 of 20 points are missing");
}

TEST(standard_files_of_one_profile) {
    const std::string micrometres = rows([](int i) { return number(0.01 * i); });
    const std::string sdf =
        "ManufacID = X\r\nCreateDate = 0\r\nModDate = 0\r\nNumPoints = 20\r\n"
        "NumProfiles = 1\r\nXscale = 5E-07\r\nYscale = 0\r\nZscale = 1E-06\r\n"
        "Zresolution = -1\r\nCompression = 0\r\nDataType = 7\r\n"
        "CheckType = 0\r\n*\r\n" +
        micrometres + "*\r\n*\r\n";
    check(read("aISO-1.0\r\n" + sdf));
    check(read("aNPL-V1.0\r\n" + sdf));
    const std::string smd =
        "ISO 5436-2:2012 a\r\nPRF 1 ISO5436\r\n"
        "CX I 20 mm 1.0e0 D 5.0e-4\r\nCZ A 20 um 1.0e0 D\r\n\3\r\n"
        "DATE 1\r\n\3\r\n" +
        micrometres + "\3\r\n123\r\n\3\r\n\32";
    check(read(smd));
    std::string shorter = smd;
    shorter.erase(shorter.find("0.05\r\n"), 6);
    REFUSED(read(shorter), "19 heights where 20 were expected");
}

}  // namespace test_profiles
