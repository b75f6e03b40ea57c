// Contacts of measured maps: what a map's pixels, orientation and spectrum have to do with it, and what not.
#include <unistd.h>

#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "check.hpp"
#include "error.hpp"
#include "read/inputs.hpp"
#include "result_reader.hpp"
#include "rough/defects.hpp"
#include "rough/synthesis.hpp"
#include "run/job.hpp"
#include "run/run.hpp"
#include "unit/map_files.hpp"

using namespace rsc;

namespace {

const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("rsc_test_measured_" + std::to_string(getpid()));
std::string in_folder(const std::string& name) { return (folder / name).string(); }

double mean_of(const std::vector<double>& v) {
    double sum = 0;
    for (double x : v) sum += x;
    return sum / static_cast<double>(v.size());
}

double error_of(const std::vector<double>& v) {
    const double m = mean_of(v);
    double square = 0;
    for (double x : v) square += (x - m) * (x - m);
    return std::sqrt(square / (static_cast<double>(v.size()) * (static_cast<double>(v.size()) - 1)));
}

// Forces of realizations 1 ... count of a case.
std::vector<double> forces(const Case& settings, int count, std::size_t level) {
    const Job job = prepare(settings);
    std::vector<double> all;
    for (int k = 1; k <= count; ++k) all.push_back(realize(job, k, 1).levels[level].force);
    return all;
}

// The circle: surfaces of a known spectrum; one of them as a map in a file, tilted, in micrometres; its twins; and the same force.
void twins() {
    Case original;
    for (const auto& [key, value] :
         {std::pair{"surface%L", "1.0"}, std::pair{"surface%n", "256"}, std::pair{"surface%L_lambda_l", "8.0"},
          std::pair{"surface%L_lambda_s", "48.0"}, std::pair{"surface%sigma", "0.005"}, std::pair{"surface%normalise", "'ensemble'"},
          std::pair{"surface%plateau", ".true."}, std::pair{"indentation%levels", "0.01, 0.005"}, std::pair{"indentation%unit", "'length'"},
          std::pair{"solids%R", "Infinity, 50.0"}})
        set_key(original, key, value);
    constexpr int kSurfaces = 150;
    const Surface surface = make_surface(original, 7, 1);
    map_files::Map map{256, 256, 1e-3 / 256, 1e-3 / 256, {}};
    for (int j = 255; j >= 0; --j)
        for (int i = 0; i < 256; ++i) map.z.push_back(1e-3 * (surface.map(i, j) + 0.002 * i / 256 - 0.1));
    const std::string file = in_folder("map.gwy");
    std::ofstream(file, std::ios::binary) << map_files::gwy_file(map_files::gwy_channel(0, "Topography", map));
    Case measured = original;
    measured.surface = {};
    set_key(measured, "surface%source", "'heights'");
    set_key(measured, "surface%file", "'" + file + "'");
    set_key(measured, "output%file", "'" + in_folder("map.nc") + "'");
    run_case(measured, {});
    Case twin;
    twin = original;
    twin.surface = {};
    set_key(twin, "surface%source", "'spectrum'");
    set_key(twin, "surface%file", "'" + in_folder("map.nc") + "'");
    set_key(twin, "surface%n", "256");
    set_key(twin, "surface%normalise", "'ensemble'");
    // The rms height of the map is one sample's: with the ensemble's, only the spectrum's shape is left to differ.
    set_key(twin, "surface%sigma", "0.005");
    twin.run.seed = 2;
    for (const std::size_t level : {std::size_t{0}, std::size_t{1}}) {
        const std::vector<double> a = forces(original, kSurfaces, level), b = forces(twin, kSurfaces, level);
        const double error = std::hypot(error_of(a), error_of(b));
        std::printf("N of %d surfaces at %zu: %.4g +- %.2g, of twins %.4g +- %.2g\n", kSurfaces, level, mean_of(a), error_of(a), mean_of(b),
                    error_of(b));
        CHECK_CLOSE(mean_of(b), mean_of(a), 2 * error);
        CHECK(error < 0.1 * mean_of(a));  // the comparison says something
    }
}

// The namelist of a map's twins: their square is as long as the map's longer side, the tip lies as it did from the middle.
void twins_of_an_oblong_map() {
    const Spectrum s{.L = 1, .L_lambda_l = 8, .L_lambda_s = 32, .sigma = 0.005};
    const HeightMap surface = synthesize(s, 128, Normalise::sample, 4, 1);
    map_files::Map map{128, 64, 1e-3 / 128, 1e-3 / 128, {}};
    for (int j = 63; j >= 0; --j)
        for (int i = 0; i < 128; ++i) map.z.push_back(1e-3 * surface(i, j));
    const std::string file = in_folder("oblong.gwy");
    std::ofstream(file, std::ios::binary) << map_files::gwy_file(map_files::gwy_channel(0, "T", map));
    Case settings;
    set_key(settings, "surface%source", "'heights'");
    set_key(settings, "surface%file", "'" + file + "'");
    set_key(settings, "indentation%centre", "0.3, 0.1");
    const Job job = prepare(settings);
    const Case twins = read_case_text(twins_text(job, "oblong.nc"), "twins.nml").settings;
    CHECK(twins.surface.source == Source::spectrum && twins.surface.file == "oblong.nc" && twins.output.file == "oblong_twins.nc");
    CHECK_RELATIVE(*twins.surface.L, 1.0, 1e-12);
    CHECK_RELATIVE(*twins.surface.sigma, job.measured->parameters.sq, 1e-12);
    CHECK_RELATIVE(*twins.indentation.centre[0], 0.3, 1e-12);
    CHECK_RELATIVE(*twins.indentation.centre[1], 0.1 + 0.25, 1e-12);
    // Rings end at the Nyquist wavenumber, pi/dx: two points more than the longer side has.
    CHECK(twins.surface.n == 130 && twins.run.realizations == 100);
    // A sigma that was given is a length that the levels are in; the twins' own is their rms height.
    set_key(settings, "surface%sigma", "0.02");
    set_key(settings, "indentation%levels", "3, 1.5");
    const Case scaled = read_case_text(twins_text(prepare(settings), "oblong.nc"), "twins.nml").settings;
    CHECK(scaled.indentation.unit == LevelUnit::length && (scaled.indentation.levels == std::vector<double>{3 * 0.02, 1.5 * 0.02}));
    CHECK(scaled.indentation.start == 4 * 0.02 && scaled.indentation.stop == 0.02 && *scaled.surface.sigma == *twins.surface.sigma);
    CHECK(twins.indentation.unit == LevelUnit::sigma && twins.indentation.start == 4 && twins.indentation.stop == 1);
}

// Filled points make no contact near them.
void filled_points() {
    const Spectrum s{.L = 1, .L_lambda_l = 8, .L_lambda_s = 32, .sigma = 0.005};
    const HeightMap surface = synthesize(s, 256, Normalise::sample, 4, 1);
    map_files::Map map{256, 256, 1e-3 / 256, 1e-3 / 256, {}};
    for (int j = 255; j >= 0; --j)
        for (int i = 0; i < 256; ++i) map.z.push_back(std::hypot(i - 128, j - 128) < 20 ? std::nan("") : 1e-3 * surface(i, j));
    const std::string file = in_folder("hole.gwy");
    std::ofstream(file, std::ios::binary) << map_files::gwy_file(map_files::gwy_channel(0, "T", map));
    Case settings;
    set_key(settings, "surface%source", "'heights'");
    set_key(settings, "surface%file", "'" + file + "'");
    CHECK_THROWS(prepare(settings), Error);
    set_key(settings, "surface%missing", "'fill'");
    set_key(settings, "solver%model", "'asperities'");
    const Job job = prepare(settings);
    CHECK(job.measured && job.measured->missing > 1200 && job.measured->missing < 1300);
    const Asperities& a = job.given->asperities;
    const double wave = job.measured->shortest_wave;
    CHECK_RELATIVE(wave, 1.0 / 32, 0.1);
    double nearest = 1;
    for (std::size_t k = 0; k < a.size(); ++k) nearest = std::fmin(nearest, std::hypot(a.x[k] - 0.5, a.y[k] - 0.5));
    CHECK(nearest > 19.0 / 256 + wave && nearest < 19.0 / 256 + 2.5 * wave);
}

}  // namespace

TESTS {
    std::filesystem::create_directories(folder);
    twins_of_an_oblong_map();
    filled_points();
    twins();
    std::filesystem::remove_all(folder);
}
