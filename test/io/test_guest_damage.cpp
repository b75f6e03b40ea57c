// Damaged results and unusual files: what is read is what was written, or it is refused.
#include <sys/stat.h>

#include "check.hpp"
#include "io/inputs.hpp"
#include "io/netcdf_writer.hpp"
#include "io/result.hpp"
#include "io/whole_file.hpp"
#include "support/library.hpp"
#include "support/map_files.hpp"
#include "support/refused.hpp"
#include "support/sample_result.hpp"
#include "support/temporary_folder.hpp"

namespace test_guest_damage {

using namespace rsc;

std::vector<double> heights_in(const std::string& path) {
    const HeightMap map = read_heights(path, {}, "mm", "", Missing::refuse);
    std::vector<double> z{map.dx, map.dy, map.x0, map.y0};
    for (const int j : indices(map.ny)) z.insert(z.end(), map.row(j), map.row(j) + map.nx);
    return z;
}

std::vector<double> asperities_in(const std::string& path) {
    const Asperities a = read_asperities(path, "mm");
    std::vector<double> all;
    for (const auto& column : kAsperityColumns)
        all.insert(all.end(), (a.*column.values).begin(), (a.*column.values).end());
    return all;
}

// One damaged byte, at 150 places of the file, and a file that is cut, or whose end is zeros: the
// file is refused every time.
void test_damage(const Folder& folder, Format format) {
    const std::string path = folder / "result.nc", spoilt = folder / "spoilt.nc";
    Result r = sample::result(1);
    r.settings.output.format = format;
    r.settings.output.compression = 0;
    write_result(r, path, "made");
    const std::string whole = bytes(path);
    const auto heights = heights_in(path), asperities = asperities_in(path);
    const std::string text = head_of_result(path)->case_text;
    int read = 0, refused = 0;
    std::vector<std::string> spoiled;
    for (std::size_t k = 1; k <= 150; ++k) {
        spoiled.push_back(whole);
        spoiled.back()[(k * whole.size()) / 151 + k % 7] ^= char(1 << k % 8);
    }
    for (const std::size_t lost : {std::size_t{1}, std::size_t{47}, whole.size() / 2}) {
        spoiled.push_back(whole.substr(0, whole.size() - lost));
        // HDF5 may destroy memory when half of a file is zeros.
        if (format != Format::netcdf4 || lost < 100)
            spoiled.push_back(spoiled.back() + std::string(lost, '\0'));
    }
    for (const std::string& damaged : spoiled) {
        folder.write("spoilt.nc", damaged);
        const auto look = [&](auto&& in, const auto& truth) {
            ++(accepted([&] { CHECK(in(spoilt) == truth); }) ? read : refused);
        };
        look(heights_in, heights);
        look(asperities_in, asperities);
        look(
            [](const std::string& file) {
                return head_of_result(file).value_or(ResultHead{}).case_text;
            },
            text);
    }
    CHECK(read == 0 && refused == 3 * int(spoiled.size()));
}

// A surface data file with 3 x 3 heights.
std::string sdf(double scale) {
    return map_files::sdf_binary({3, 3, 1e-6, 1e-6, {}}, 7, scale,
                                 std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8});
}

TEST(test_inputs) {
    const Folder folder;
    CHECK(
        read_heights(folder.write("good.sdf", sdf(1e-6) + "trailer"), {}, "mm", "", Missing::refuse)
            .nx == 3);
    REFUSED(heights_in(folder.write("down.sdf", sdf(-1e-6))), "Zscale");
    REFUSED(heights_in(folder.write("long.sdf", sdf(1e-6) + std::string(1 << 20, 'x'))), "follow");
    const std::string fifo = folder / "fifo";
    CHECK(mkfifo(fifo.c_str(), 0600) == 0);
    REFUSED(heights_in(fifo), "FIFO");
    REFUSED(heights_in("/dev/zero"), "device");
    for (const char* name :
         {"http://host/a.nc", "file://a#mode=zarr,file", "a.nc#mode=zarr,file"}) {
        CHECK(refusal([&] { check_output(name); }).find("URL") != std::string::npos);
    }
}

// The fill value of netCDF4 is refused as a height.
TEST(test_fill_values) {
    std::vector<double> z(9);
    z[4] = 9.9692099683868690e+36;
    SurfaceHandle surface;
    CHECK(rsc_surface_take(&surface, 3, 3, 1, 1, 0, 0, 0, z.data()) == -9 && !surface);
    z[4] = double(9.9692099683868690e+36f);
    CHECK(rsc_surface_take(&surface, 3, 3, 1, 1, 0, 0, 0, z.data()) == -9 && !surface);
}

TEST(guest_damage) {
    for (const Format format : {Format::netcdf4, Format::classic}) test_damage(Folder(), format);
}

}  // namespace test_guest_damage
