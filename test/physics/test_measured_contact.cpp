// Measured maps: the namelist of their twins, and no contact near points that were filled.
#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "check.hpp"
#include "error.hpp"
#include "read/inputs.hpp"
#include "rough/defects.hpp"
#include "rough/synthesis.hpp"
#include "run/job.hpp"
#include "run/run.hpp"
#include "unit/map_files.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;

namespace {

const Folder folder;

// The namelist of a map's twins: their square is as long as the map's longer side, the tip lies as it did from the middle.
TEST(twins_of_an_oblong_map) {
    const Spectrum s{.L = 1, .L_lambda_l = 8, .L_lambda_s = 32, .sigma = 0.005};
    const HeightMap surface = synthesize(s, 128, Normalise::sample, 4, 1);
    map_files::Map map{128, 64, 1e-3 / 128, 1e-3 / 128, {}};
    for (int j = 63; j >= 0; --j)
        for (int i = 0; i < 128; ++i) map.z.push_back(1e-3 * surface(i, j));
    const std::string file = folder.write("oblong.gwy", map_files::gwy_file(map_files::gwy_channel(0, "T", map)));
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
TEST(filled_points) {
    const Spectrum s{.L = 1, .L_lambda_l = 8, .L_lambda_s = 32, .sigma = 0.005};
    const HeightMap surface = synthesize(s, 256, Normalise::sample, 4, 1);
    map_files::Map map{256, 256, 1e-3 / 256, 1e-3 / 256, {}};
    for (int j = 255; j >= 0; --j)
        for (int i = 0; i < 256; ++i) map.z.push_back(std::hypot(i - 128, j - 128) < 20 ? std::nan("") : 1e-3 * surface(i, j));
    const std::string file = folder.write("hole.gwy", map_files::gwy_file(map_files::gwy_channel(0, "T", map)));
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
