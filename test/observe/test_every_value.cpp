// The numbers of the result files: a matrix of cases is run, and each value of each file is
// computed here once more from the contacts (or the pixels under pressure) of its levels, from the
// heights, and from the case.
//
// The levels themselves are the library's; that they are right is what the tests of the contact
// show.
#include <netcdf.h>

#include "case/read_case.hpp"
#include "check.hpp"
#include "run/run.hpp"
#include "support/netcdf_file.hpp"
#include "support/temporary_folder.hpp"
#include "truth/values/checked_file.hpp"
#include "truth/values/distributions.hpp"
#include "truth/values/levels.hpp"
#include "truth/values/observed.hpp"
#include "truth/values/single.hpp"

namespace test_every_value {

using namespace rsc;
using namespace values;

struct Scene {
    std::string name, text;
    std::vector<Vector> compare_path = {};
    const HeightMap* as_read = nullptr;
};

Case settings_of(const std::string& text, const std::string& output) {
    const ReadCase read = read_case_text(text, "case.nml");
    Case c = read.settings;
    c.output.file = output;
    return c;
}

void check_file(const Scene& scene, const std::string& path, const Case& settings) {
    const int before = check::failures;
    const Truth t(settings);
    CheckedFile f(scene.name, path);
    header(f, t);
    levels(f, t);
    separations(f, t);
    surfaces(f, t);
    regimes(f, t);
    maps(f, t);
    if (!settings.output.pdf_levels.empty())
        distributions(f, t);
    else
        CHECK(!f.has("pdf_level") && !f.has("bin"));
    asperities(f, t);
    contacts(f, t);
    contact_mask(f, t);
    heights(f, t);
    friction(f, t);
    measured(f, t, scene.as_read);
    compared(f, t, scene.compare_path);
    f.finish();
    if (check::failures > before)
        std::printf("%s: %d failures\n", scene.name.c_str(), check::failures - before);
}

const RunOptions kOptions{.command = "rsc the_case.nml", .inputs = {}, .report = {}};

void run_and_check(const Scene& scene, const Folder& folder) {
    const std::string path = folder / (scene.name + ".nc");
    const Case settings = settings_of(scene.text, path);
    CHECK(run_case(settings, kOptions) == 0);
    check_file(scene, path, settings);
    int format = 0;
    nc_inq_format(Reader(path).id(), &format);
    const std::map<Format, int> formats{{Format::netcdf4, NC_FORMAT_NETCDF4_CLASSIC},
                                        {Format::cdf5, NC_FORMAT_CDF5},
                                        {Format::classic, NC_FORMAT_CLASSIC}};
    CHECK(format == formats.at(settings.output.format));
}

// A map of other steps along x than along y, tilted, bent, away from the origin; some points
// missing.
HeightMap measured_map() {
    HeightMap map;
    map.allocate(60, 42, 60);
    map.dx = 0.1;
    map.dy = 0.07;
    map.x0 = 2;
    map.y0 = -1;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) {
            const double x = map.dx * i, y = map.dy * j;
            double z = 0.0005 * x * x - 0.001 * y * y + 0.0008 * x * y + 0.002 * x - 0.003 * y + 7;
            for (int k = 1; k < 12; ++k)  // waves of all directions, shorter and lower
                z += 0.01 / (k + 1) *
                     std::sin(1.9 * (k + 1) *
                                  (x * std::cos(2.4 * k * k) + 1.2 * y * std::sin(2.4 * k * k)) +
                              1.7 * k * k);
            const bool missing = (i == 20 && j > 10 && j < 14) || (i == 50 && j == 30);
            map.row(j)[i] = missing ? kNone : z;
        }
    return map;
}

void write_map(const HeightMap& map, const std::string& path) {
    using namespace netcdf_file;
    const auto mm = [](const char* name, std::vector<std::string> over, Vector v) {
        return Variable{name, NC_DOUBLE, over, v, {{"units", "mm"}}};
    };
    const std::size_t nx = map.nx, ny = map.ny;
    write(path, {{"y", ny}, {"x", nx}},
          {mm("y", {"y"}, counted(ny, map.y0, map.dy)), mm("x", {"x"}, counted(nx, map.x0, map.dx)),
           mm("height", {"y", "x"}, {map.data.get(), map.data.get() + map.nx * map.ny})});
}

std::vector<Scene> scenes(const Folder& folder, const HeightMap& map) {
    const std::string micro = "&run length_unit = 'um', force_unit = 'mN', seed = 2147483647 /\n";
    const std::string bodies =
        "&solids E = 80, 200  nu = 0.35, 0.3  R = 900, 2500  resistivity = 2.0e-5, 3.0e-5";
    // no steep contact
    const std::string round =
        "&solids E = 80, 200  nu = 0.35, 0.3  R = 3000, 8000  resistivity = 2.0e-5, 3.0e-5";
    const std::string flats =
        "&solids E = 80, 200  nu = 0.35, 0.3  R = Infinity, Infinity  resistivity = 2.0e-5, 3.0e-5";
    const std::string surface =
        "&surface n = 128, L = 100, L_lambda_l = 2, L_lambda_s = 16, hurst = 0.7, sigma = 0.5";
    const std::string rough =
        "&surface n = 128, L = 100, L_lambda_l = 2, L_lambda_s = 16, hurst = 0.6, plateau = "
        ".true., sigma = 1.5";
    const std::string out =
        "&output map_cells = 9, radial_bins = 7, pdf_levels = 0.9, 0.25, pdf_bins = 31";
    const std::string asperities = "&solver model = 'asperities' /\n&asperities law = 'hertz' /\n";
    const std::string of_map =
        "&surface source = 'heights', file = '" + folder / "input_map.nc" + "', missing = 'fill', ";

    std::vector<Scene> all;
    all.push_back({"sphere",
                   "&run length_unit = 'um', force_unit = 'mN', seed = 12345678901, title = 'Of "
                   "its own' /\n" +
                       bodies + ", friction = 0.3 /\n" + surface +
                       " /\n&asperities law = 'hertz' /\n&indentation levels = 9.0, 1.5, 0.8, 0.2, "
                       "centre = 57, 38 /\n" +
                       out + ", heights = .true. /\n&compare levels = 8.5, 0.3, 1.2 /\n"});
    all.push_back(
        {"rough", micro + bodies + " /\n" + rough +
                      " /\n&asperities law = 'hertz' /\n&solver model = 'asperities' /\n" +
                      "&indentation start = 2.5, stop = -3.2, steps = 5, centre = 44, 52 /\n" +
                      "&output map_cells = 8, radial_bins = 5, pdf_levels = -0.5, pdf_bins = 40, "
                      "contacts = 'last' /\n"});
    all.push_back(
        {"paper",
         micro + bodies + " /\n" + surface +
             ", normalise = 'ensemble' /\n&asperities curvature = 'algebraic', law = 'hertz' /\n" +
             "&indentation start = 2.5, stop = 0.3, steps = 4, spacing = 'log', selection "
             "= 'paper', selection_factor = 0.4 /\n" +
             "&solver method = 'dgesv', tolerance = 1e-8 /\n&output format = 'cdf5', "
             "contacts = 'none', map_cells = 5 /\n"});
    all.push_back({"ellipses", micro + bodies + " /\n" + rough +
                                   " /\n&asperities law = 'elliptic' /\n" +
                                   "&indentation levels = 2, 1, centre = 60, 41 /\n&solver method "
                                   "= 'mesh', interaction = 'none' /\n" +
                                   out + " /\n"});
    all.push_back(
        {"fourth_order", round + " /\n" + rough +
                             " /\n&asperities law = 'fourth_order' /\n&solver method = 'mesh' /\n" +
                             "&indentation levels = 1.8, 0.5, -1.2 /\n" + out +
                             ", format = 'classic' /\n"});
    all.push_back(
        {"force", "&run seed = -5 /\n" + bodies + " /\n" + surface +
                      " /\n&indentation control = 'force', levels = 200, 900, centre = 57, 38 /\n" +
                      out + " /\n&compare levels = 1000, 300 /\n"});
    all.push_back({"elements", micro + bodies + " /\n" + surface +
                                   " /\n&solver model = 'elements' /\n" +
                                   "&indentation levels = 9.0, 1.5, 0.8, 0.2, centre = 57, 38 /\n" +
                                   out + ", heights = .true. /\n"});
    all.push_back(
        {"flats",
         micro + flats + " /\n" + surface +
             " /\n&indentation boundary = 'periodic', control = 'pressure', unit = 'relative', " +
             "levels = 0.003, 0.01 /\n&output map_cells = 6, pdf_levels = 1.9, 2.2, pdf_bins = 20 "
             "/\n"});
    all.push_back(
        {"flats_apart",
         micro + flats + " /\n" + surface +
             " /\n&indentation boundary = 'periodic', levels = 9, 2.2, 1.7 /\n" +
             "&output map_cells = 6, pdf_levels = 1.9, pdf_bins = 20 /\n&compare levels = 2 /\n"});
    all.push_back(
        {"flats_elements", micro + flats + " /\n" + surface + " /\n&solver model = 'elements' /\n" +
                               "&indentation boundary = 'periodic', control = 'pressure', unit = "
                               "'pressure', levels = 0.1, 0.4 /\n" +
                               "&output map_cells = 6, pdf_levels = 2.0, pdf_bins = 20 /\n"});
    all.push_back(
        {"yielding", micro + bodies + ", hardness = 1.5, size_effect = 6 /\n" + surface + " /\n" +
                         "&indentation levels = 1.5, 0.6, 0.2, 0.5, 0.1, centre = 57, 38 /\n" +
                         out + " /\n"});
    // Elements that yield go through the turning points: the deepest level, then up.
    all.push_back({"yielding_compared",
                   micro + bodies + ", hardness = 2 /\n" + surface +
                       " /\n&asperities law = 'elliptic' /\n" +
                       "&indentation levels = 1.5, 0.6, 0.2, 0.6, centre = 57, 38 /\n" + out +
                       " /\n&compare levels = 0.6, 0.6 /\n",
                   {{1}, {0.2, 3}}});
    all.push_back({"unloading_compared",
                   micro + bodies + ", hardness = 2 /\n" + surface +
                       " /\n&asperities law = 'elliptic' /\n" +
                       "&indentation levels = 0.2, 0.6, centre = 57, 38 /\n" + out +
                       " /\n&compare levels = 0.6 /\n",
                   {{0.2, 1}}});
    all.push_back(
        {"yielding_elements",
         micro + bodies + ", hardness = 2 /\n" + surface + " /\n&solver model = 'elements' /\n" +
             "&indentation levels = 1.5, 0.6, 0.2, 0.5, centre = 57, 38 /\n" + out + " /\n"});
    const std::string on_map =
        "/\n&output map_cells = 11, radial_bins = 6, heights = .true., pdf_levels = 0.3, pdf_bins "
        "= 25 /\n";
    all.push_back({"map",
                   of_map + "detrend = 'quadratic' /\n&solids E = 3000, 9000  R(2) = 80 /\n" +
                       "&asperities law = 'hertz' /\n&compare "
                       "levels = 0.2 /\n" +
                       "&indentation levels = 0.8, 0.2, centre = 5.3, 1.6 " + on_map,
                   {},
                   &map});
    // Near the border, on pixels that are no squares.
    all.push_back(
        {"map_elements",
         of_map +
             "detrend = 'sphere', filter_cutoff = 0.5 /\n&solids E = 3000, 9000  R(2) = 80  "
             "hardness = 30 /\n" +
             "&solver model = 'elements' /\n&indentation levels = 0.8, 0.2, centre = 5.3, 1.88 " +
             on_map,
         {},
         &map});
    all.push_back({"map_flats",
                   of_map + "detrend = 'plane' /\n" + flats + " /\n" +
                       "&indentation boundary = 'periodic', control = 'pressure', unit = "
                       "'relative', levels = 0.005 " +
                       on_map,
                   {},
                   &map});
    // A short length for sigma makes short ranges: values beyond the last bin, and in it.
    all.push_back(
        {"list",
         micro + bodies + " /\n&surface source = 'asperities', file = '" + folder / "list.txt" +
             "', L = 90, sigma = 0.03 /\n&asperities law = 'hertz' /\n" +
             "&indentation levels = 0.25, -0.2, unit = 'length', centre = 41, 55 /\n" +
             "&output map_cells = 9, radial_bins = 7, pdf_levels = 8, -7, pdf_bins = 3 /\n"});
    all.push_back({"spectrum", micro + bodies + " /\n&surface source = 'spectrum', file = '" +
                                   folder / "psd.txt" + "', n = 128, L = 100 /\n" + asperities +
                                   "&indentation levels = 0.5, -0.4, centre = 41, 55 /\n" + out +
                                   " /\n"});
    // Campaigns.
    all.push_back(
        {"campaign",
         "&run length_unit = 'um', force_unit = 'mN', realizations = 4, first_realization = 3 /\n" +
             bodies + " /\n" + surface + " /\n" + asperities +
             "&indentation levels = 9.0, 1.2, 0.3, centre = 57, 38 /\n" + out +
             " /\n&compare levels = 0.3 /\n"});
    all.push_back({"campaign_force", "&run realizations = 4 /\n" + bodies + " /\n" + surface +
                                         " /\n" + asperities +
                                         "&indentation control = 'force', levels = 200, 900 /\n" +
                                         out + ", format = 'classic' /\n"});
    all.push_back(
        {"campaign_flats",
         "&run realizations = 4 /\n" + flats + " /\n" + surface + " /\n" + asperities +
             "&indentation boundary = 'periodic', control = 'pressure', unit = 'pressure', "
             "levels = 0.1 /\n" +
             "&output map_cells = 6, pdf_levels = 2.0, pdf_bins = 20, format = 'classic' /\n"});
    all.push_back({"campaign_elements",
                   "&run realizations = 4 /\n" + bodies + " /\n" + surface +
                       " /\n&solver model = 'elements' /\n&indentation levels = 0.5 /\n" + out +
                       ", format = 'classic' /\n"});
    return all;
}

// Levels that did not converge say so, and are compared with nothing.
void unconverged(const Folder& folder) {
    const std::string path = folder / "unconverged.nc";
    const Case c = settings_of(
        "&surface n = 128, L_lambda_l = 2, L_lambda_s = 16 /\n&solver max_iterations = 1 /\n"
        "&indentation levels = 0.5, 0.0 /\n&compare levels = 0.5 /\n",
        path);
    CHECK(run_case(c, kOptions) == 3);
    const Reader file(path);
    CHECK(file.values("status") == (Vector{4, 4}) &&
          file.values("compare_residual")[0] > c.solver.tolerance);
    for (const char* name : {"force_error", "area_error", "contacts_error"})
        CHECK(file.values(name) == Vector{NC_FILL_DOUBLE});
    CHECK(file.values("compare_force")[0] > 0);
}

TEST(every_value) {
    ::setenv("SOURCE_DATE_EPOCH", "86400", 1);
    const Folder folder;
    const HeightMap map = measured_map();
    write_map(map, folder / "input_map.nc");
    std::ofstream(folder / "list.txt")
        << "10 20 0.2 30\n44 51 1.1 12\n47 58 0.9 22\n40 60 0.4 17\n70 75 1.4 25\n38.5 52 1.0 19\n";
    std::ofstream(folder / "psd.txt") << "0.15 0.9\n0.4 0.3\n0.9 0.01\n";
    for (const Scene& scene : scenes(folder, map)) {
        run_and_check(scene, folder);
    }
    unconverged(folder);
}

}  // namespace test_every_value
