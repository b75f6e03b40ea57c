// Measured maps: the namelist of their twins, and no contact near points that were filled.
#include "base/error.hpp"
#include "case/registry.hpp"
#include "io/inputs.hpp"
#include "support/height_maps.hpp"
#include "support/map_files.hpp"
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"
#include "surface/defects.hpp"
#include "surface/synthesis.hpp"
#include "trust/doubts.hpp"

namespace test_measured_contact {

using namespace rsc;

const Folder folder;

// The namelist of a map's twins: their square is as long as the map's longer side, the tip lies as
// it did from the middle.
TEST(twins_of_an_oblong_map) {
    const Spectrum s{.L = 1, .L_lambda_l = 8, .L_lambda_s = 32, .sigma = 0.005};
    const HeightMap surface = synthesize(s, 128, Normalise::sample, 4, 1);
    map_files::Map map{128, 64, 1e-3 / 128, 1e-3 / 128, {}};
    for (int j = 63; j >= 0; --j)
        for (const int i : indices(128)) map.z.push_back(1e-3 * surface(i, j));
    const std::string file =
        folder.write("oblong.gwy", map_files::gwy_file(map_files::gwy_channel(0, "T", map)));
    Case settings;
    set_key(settings, "run%length_unit", "'um'");  // of 1 mm x 0.5 mm
    set_key(settings, "surface%source", "'heights'");
    set_key(settings, "surface%file", "'" + file + "'");
    set_key(settings, "solids%R(2)", "2500.0");
    set_key(settings, "indentation%centre", "300, 100");
    const Job job = prepare(settings);
    const Case twins = settings_of(twins_text(job, "oblong.nc"));
    CHECK(twins.surface.source == Source::spectrum && twins.surface.file == "oblong.nc" &&
          twins.output.file == "oblong_twins.nc");
    CHECK_RELATIVE(*twins.surface.L, 1e3, 1e-12);
    CHECK_RELATIVE(*twins.surface.sigma, job.measured->parameters.sq, 1e-12);
    CHECK_RELATIVE(*twins.indentation.centre[0], 300, 1e-12);
    CHECK_RELATIVE(*twins.indentation.centre[1], 100 + 250, 1e-12);
    // Rings end at the Nyquist wavenumber, pi/dx: two points more than the longer side has.
    CHECK(twins.surface.n == 130 && twins.run.realizations == 100);
    // A sigma that was given is a length that the levels are in; the twins' own is their rms
    // height.
    set_key(settings, "surface%sigma", "20");
    set_key(settings, "indentation%levels", "3, 1.5");
    const Case scaled = settings_of(twins_text(prepare(settings), "oblong.nc"));
    CHECK(scaled.indentation.unit == LevelUnit::length &&
          (scaled.indentation.levels == std::vector<double>{3 * 20, 1.5 * 20}));
    CHECK(scaled.indentation.start == 4 * 20 && scaled.indentation.stop == 20 &&
          *scaled.surface.sigma == *twins.surface.sigma);
    CHECK(twins.indentation.unit == LevelUnit::sigma && twins.indentation.start == 4 &&
          twins.indentation.stop == 1);
    // Between flats forces are pressures of the map, on the twins' larger area, too.
    for (const char* key : {"solids%R=Infinity,Infinity", "indentation%boundary='periodic'",
                            "indentation%control='force'"})
        set_key(settings, std::string(key, std::strchr(key, '=')), std::strchr(key, '=') + 1);
    const Case flat = settings_of(twins_text(prepare(settings), "oblong.nc"));
    CHECK(flat.indentation.control == Control::pressure &&
          flat.indentation.unit == LevelUnit::pressure);
    CHECK_RELATIVE(flat.indentation.levels.at(0), 3 / (1e3 * 500), 1e-12);
}

// What belongs to body 2 is kept, with its map alone; what is for one realization is not.
TEST(twins_with_a_second_map) {
    const std::string file =
        folder.write("rows.txt", rows_of_text(32, 32, [](int i, int j) {
                         return 1e-3 * std::sin(0.9 * i) * std::cos(0.7 * j) + 1e-4 * (i * j % 7);
                     }));
    const auto twins = [&](std::string keys) {
        const Case one = settings_of("&surface source='heights' file='" + file +
                                     "' pixel=0.03 outliers=8 filter_cutoff=0.1 "
                                     "missing='fill' missing_value=-9999 / "
                                     "&solids R=Infinity,Infinity friction=0.1 / " +
                                     "&output fields='pressure' / " + keys);
        return settings_of(twins_text(prepare(one), "t.nc"));
    };
    const Case two = twins("&indenter shape='map' file='" + file + "' /");
    CHECK(two.surface.pixel == 0.03 && two.surface.outliers == 8 &&
          two.surface.filter_cutoff == 0.1 && two.surface.missing == Missing::fill &&
          two.surface.missing_value == std::vector<double>{-9999});
    CHECK(two.output.fields.empty() && two.solids.friction == 0);
    (void)contacts_kept(two);
    const Case alone = twins("&indenter shape='paraboloid' radii=5.0,5.0 /");
    CHECK(!alone.surface.pixel && alone.surface.missing_value.empty());
}

// A surface of 256 x 256 points as a map, whose point (i, j) `change` may alter.
Case map_case(double L_lambda_s, const std::function<void(int, int, double&)>& change) {
    const HeightMap surface =
        synthesize({.L = 1, .L_lambda_l = 4, .L_lambda_s = L_lambda_s, .sigma = 0.005}, 256,
                   Normalise::sample, 4, 1);
    map_files::Map map{256, 256, 1e-3 / 256, 1e-3 / 256, {}};
    for (int j = 255; j >= 0; --j)
        for (const int i : indices(256)) change(i, j, map.z.emplace_back(1e-3 * surface(i, j)));
    Case settings;
    set_key(settings, "surface%source", "'heights'");
    set_key(settings, "surface%file",
            "'" +
                folder.write("map.gwy", map_files::gwy_file(map_files::gwy_channel(0, "T", map))) +
                "'");
    set_key(settings, "solver%model", "'asperities'");
    set_key(settings, "asperities%law", "'fourth_order'");
    set_key(settings, "indentation%levels", "1, 0, -1");
    return settings;
}

// Levels at which the heights would reach a ball over a hole of the map are out of validity, and
// the hole hides no summit outside it.
// One per cent of single missing points changes the force of every law by less than 1e-4, as the
// filling of single points is of eighth order in the step (here the shortest wave has 10.7).
TEST(holes) {
    constexpr double middle = 128, radius = 20;
    const auto hole = [](int i, int j, double& z) {
        z = std::hypot(i - middle, j - middle) < radius ? std::nan("") : z;
    };
    const auto scattered = [](int i, int j, double& z) {
        z = (37 * i + 101 * j) % 100 == 0 ? std::nan("") : z;
    };
    Case whole = map_case(24, [](int, int, double&) {});
    const Job full = prepare(whole);
    Case holed = map_case(24, hole);
    CHECK_THROWS(prepare(holed), Error);
    set_key(holed, "surface%missing", "'fill'");
    const Job job = prepare(holed);
    CHECK(job.measured->missing > 1200 && job.measured->missing < 1300);
    const auto outside = [&](const Asperities& a) {
        long count = 0;
        for (const auto k : indices(a))
            count += std::hypot(a.x[k] - 0.5, a.y[k] - 0.5) > (radius + 5) / 256;
        return count;
    };
    CHECK(outside(job.given->asperities) == outside(full.given->asperities));
    const auto judged = [](const Job& with, std::int64_t number) {
        for (const Level& level : realize(with, number, 1).levels)
            CHECK(level.filled_share > 0.01 && (level.doubts & bit(Cause::filled_points)));
    };
    judged(job, 1);
    for (const char* name : {"hole_1.gwy", "hole_2.gwy"})
        std::filesystem::copy_file(folder / "map.gwy", folder / name);
    for (const char* model : {"'asperities'", "'elements'"}) {  // one of several maps
        Case several = holed;
        set_key(several, "surface%file", "'" + folder / "hole_*.gwy" + "'");
        set_key(several, "run%realizations", "2");
        set_key(several, "solver%model", model);
        judged(prepare(several), 2);
    }
    for (const char* law : {"'hertz'", "'elliptic'", "'fourth_order'"}) {
        const auto solved = [&](Case c) {
            set_key(c, "surface%missing", "'fill'");
            set_key(c, "asperities%law", law);
            return realize(prepare(c), 1, 1).levels;
        };
        const std::vector<Level> filled = solved(map_case(24, scattered)),
                                 known = solved(map_case(24, [](int, int, double&) {}));
        for (const auto k : indices(known)) {
            CHECK_RELATIVE(filled[k].force, known[k].force, 1e-4);
            CHECK(!(filled[k].filled_share > 0.01));
        }
    }
}

// A missing point beside a step is filled within the heights of the step.
TEST(hole_beside_a_step) {
    for (const int place : {9, 10, 11, 12}) {
        HeightMap map = height_map(20, 20, 1, 1, [&](int i, int j) {
            return i == place && j == 8 ? std::nan("") : i < 11 ? 0.0 : 1.0;
        });
        fill_missing(map);
        CHECK(map(place, 8) >= 0 && map(place, 8) <= 1);
    }
}

// Of a smooth map, 32 points in its shortest wave, level or tilted, on a dome, or rounded to a
// fifth of the rms height, no point is an outlier; of one with ten spikes these ten.
TEST(outliers) {
    const std::function<double(int, int, double)> forms[] = {
        [](int, int, double z) { return z; },
        [](int i, int j, double z) { return z + 2e-6 * i - 1e-6 * j; },
        [](int i, int j, double z) { return z - 2e-9 * (i * i + j * j); },
        [](int, int, double z) { return 1e-6 * std::round(1e6 * z); }};
    for (const auto& form : forms)
        for (const bool spikes : {false, true}) {
            Case c = map_case(8, [&](int i, int j, double& z) {
                z = form(i, j, z) + (spikes && i % 50 == 7 && j % 100 == 60 ? 2e-5 : 0);
            });
            set_key(c, "surface%outliers", "6");
            CHECK(prepare(c).measured->outliers.count == (spikes ? 10 : 0));
        }
}

}  // namespace test_measured_contact
