// What a level is worth: status, expected errors, grids of elements, borders, filled points.
#include "case/registry.hpp"
#include "contact/make.hpp"
#include "contact/spots.hpp"
#include "elements/pixel_spots.hpp"
#include "observe/map.hpp"
#include "observe/record.hpp"
#include "problem/bodies.hpp"
#include "run/compare.hpp"
#include "support/asperities.hpp"
#include "support/height_maps.hpp"
#include "support/judged.hpp"
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"
#include "trust/judge.hpp"

namespace test_trust {

using namespace rsc;
constexpr double kRounding = 1e-12;

bool has(const LevelValues& level, Cause cause) { return level.doubts & bit(cause); }

// Levels that failed leave maps, radial means and distributions: of two realizations of which one
// failed, they are those of the other.
TEST(observed) {
    ObserveOptions options;
    options.map = make_map_grid(0, 0, 1, 1, 4);
    options.tip_x = options.tip_y = 0.5;
    options.radial_bins = 2;
    options.pdf_levels = {0.0};
    options.pdf = make_pdf_bins(10, 1e3, 1e-2, 10, 1e300);
    const auto record = [&](std::int64_t number, double force, LevelStatus status) {
        Level level;
        level.status = status;
        level.add_contact(0, 0.4, 0.6, force, 0.1, 0.01);
        level.force = force;
        return observe(options, number, {}, {level});
    };
    Accumulators alone(options, 1), both(options, 1);
    alone.add(record(1, 2.0, LevelStatus::overlapping));
    both.add(record(1, 2.0, LevelStatus::overlapping));
    both.add(record(2, 50.0, LevelStatus::not_converged));
    const Observations a = alone.finish(), b = both.finish();
    CHECK(a.map_pressure == b.map_pressure && a.map_area_fraction == b.map_area_fraction &&
          a.radial_pressure == b.radial_pressure);
    CHECK(a.distributions[0].pressure_pdf == b.distributions[0].pressure_pdf &&
          both.converged()[0] == 1);
    CHECK(std::ranges::max(b.map_pressure.value) > 0);
}

// What each spot has for itself adds up to the union; of two in one place one has all.
TEST(own_areas) {
    std::vector<Spot> spots;
    for (const int k : indices(40))
        spots.push_back({std::fmod(0.37 * k, 1.0), std::fmod(0.71 * k, 1.0), 0.12 + 0.002 * k,
                         0.05 + 0.001 * k, 0.3 * k});
    std::vector<double> own;
    const double area = union_area(spots, nullptr, {}, &own);
    double sum = 0, least = 1;
    for (const double a : own) {
        sum += a;
        least = std::min(least, a);
    }
    CHECK(own.size() == spots.size());
    CHECK_RELATIVE(sum, area, 1e-10);
    CHECK(least > -1e-12);
    union_area({{0, 0, 1, 1, 0}, {0, 0, 0.5, 0.5, 0}}, nullptr, {}, &own);
    CHECK_CLOSE(own[0] + own[1], pi,
                1e-9);  // the smaller one, inside, has none or what the larger one does not
    CHECK(own[0] > -1e-12 && own[1] > -1e-12);
}

// A sphere far larger than the map presses every point: the contact ends where the map does, which
// is no border of its own, and says so.
TEST(borders) {
    const HeightMap map = height_map(20, 16, 0.1, 0.1, [](int, int) { return 0.0; });
    SolverOptions options{.surface = {.extent = {0, 0, 2.0, 1.6}}};
    const auto contact = make_element_contact(map, {1e3, 1e4, 1.0, 0.8}, options);
    Level level = contact->at_separation(-0.1);
    Judge(options, {&map}).judge(level, *contact, false);
    CHECK_RELATIVE(level.area, 2.0 * 1.6, kRounding);
    CHECK_RELATIVE(level.area_pixels, 2.0 * 1.6, kRounding);
    CHECK(level.edge_contacts == 1 && has(level, Cause::border));
    CHECK(level.pixels_per_contact == 320);
}

TEST(filled) {
    std::vector<std::uint8_t> missing(16);
    missing[5] = 1;  // the point (1, 1)
    const FilledPoints map{{4, 4, 1, 1, 0, 0}, &missing, false, false};
    Indenter ball{1e3, 1.0, 3, 3};
    constexpr double low = 1e-3;  // heights that reach the ball at its lowest point only
    Level level;
    level.add_contact(0, 1, 1, 1, 1.2, 0);  // over (1, 1) and its four neighbours
    CHECK_RELATIVE(share_on_filled(level, {&map, 1}, ball, low), 0.2, kRounding);
    level = {};
    level.add_contact(0, 3, 3, 1, 0.5, 0);
    CHECK(share_on_filled(level, {&map, 1}, ball, low) == 0);
    level = {};
    ball.x0 = ball.y0 = 1;  // no contact, because the ball is over the hole
    CHECK(share_on_filled(level, {&map, 1}, ball, low) == 1);
    // The same points on body 2, whose middle is above the tip: a cap with a hole at its top.
    const Folder folder;
    Case c =
        case_of_map(folder.write("flat.txt", rows_of_text(32, 32, [](int, int) { return 0.0; })));
    c.surface.pixel = 1.0;
    c.surface.sigma = 1e-3;
    c.surface.missing = Missing::fill;
    c.indenter.file = folder.write("cap.txt", rows_of_text(32, 32, [](int i, int j) {
                                       const double r = std::hypot(i - 15.5, j - 15.5);
                                       return r < 2 ? std::nan("") : -0.5e-3 * r * r;
                                   }));
    set_key(c, "indenter%shape", "'map'");
    c.indentation.unit = LevelUnit::length;
    c.indentation.levels = {-0.01};
    for (const Level& pressed : realize(prepare(c), 1, 1).levels)
        CHECK(pressed.filled_share > 0.1 && has(pressed, Cause::filled_points));
}

// Half of the contact area is that of contacts of at most pixels_per_contact: here of the block of
// nine beside three single ones.
TEST(pixels_of_contacts) {
    const std::vector<Pixel> touching{{6, 0}, {1, 1}, {2, 1}, {3, 1}, {1, 2}, {2, 2},
                                      {3, 2}, {1, 3}, {2, 3}, {3, 3}, {5, 5}, {0, 7}};
    Level level;
    add_pixels(level, flat_map(8, 8, 1, 1), {1.0, 2.0, 0, 0}, kInfinity, touching,
               std::vector<double>(touching.size(), 1.0));
    CHECK(level.contacts == 4 && level.pixels_per_contact == 9);
}

// A ball narrower than a step of the grid may touch between the points, and one pressed as deep as
// its radius is steep; neither is an answer without a doubt. A paraboloid's slope r/R, weighted
// with Hertz's pressure, has the square 2 a^2/(5 R^2).
TEST(narrow_and_steep) {
    const HeightMap map = flat_map(60, 60, 0.1, 0.1);
    const auto judged_at = [&](double R, double x0, double Z0) {
        const Indenter ball{1e3, R, x0, x0};
        const SolverOptions options;
        const auto contact = make_element_contact(map, ball, options);
        return judged(contact->at_separation(Z0), *contact, options, &map);
    };
    CHECK(judged_at(0.04, 3.05, -0.02).doubts == bit(Cause::missed_contact));
    CHECK(judged_at(0.04, 3.05, 0.01).doubts == 0);
    CHECK(has(judged_at(2.0, 2.95, -2.0), Cause::steep_indenter));
    const Level shallow = judged_at(20.0, 2.95, -0.1);
    CHECK(!has(shallow, Cause::steep_indenter));
    CHECK_RELATIVE(shallow.indenter_slope, std::sqrt(0.4 * 0.1 / 20.0), 0.02);  // a^2 = 0.1 R
}

// A map of n x n points with side L, smooth but for an rms height that gives it a spectrum.
Case smooth_map(const Folder& folder, int n, double L) {
    Case c = case_of_map(folder.write(
        "flat.txt", rows_of_text(n, n, [](int i, int j) { return (i + j) % 2 ? 1e-9 : -1e-9; })));
    c.surface.L = L;
    return c;
}

TEST(resolution) {
    const Folder folder;
    Case c = smooth_map(folder, 24, 24.0);
    c.indentation.unit = LevelUnit::length;
    c.indentation.levels = {-0.004, -0.03, -0.2};
    c.solids.R[1] = 200;
    const Job job = prepare(c);
    CHECK_CLOSE(job.indenter.x0, 11.5, kRounding);  // the middle of the points
    const Realization r = realize(job, 1, 1);
    CHECK(r.levels.size() == 3);
    for (const Level& level : r.levels) {
        const double N =
            4.0 / 3 * job.indenter.E_star * std::sqrt(200.0) * std::pow(-level.separation, 1.5);
        const double error = std::abs(level.force / N - 1);
        // Contacts of few pixels may be farther off, with a doubt.
        CHECK(level.force_error_expected >= error || (has(level, Cause::grid) && error > 0.03));
        CHECK((level.status == LevelStatus::out_of_validity) ==
              (level.force_error_expected > 0.03 || level.area_error_expected > 0.1));
    }
    CHECK(r.levels[0].status == LevelStatus::out_of_validity);
    CHECK(r.levels[2].force_error_expected < r.levels[0].force_error_expected);
}

std::vector<Level> pressed(Case c, ModelKind model) {
    c.solver.model = model;
    return realize(prepare(c), 1, 1).levels;
}

// A wave of one direction between flats (Westergaard: A/A0 = (2/pi) asin sqrt s, s = p/p*): up to
// full contact the stated error of A holds on nine of ten levels, and it vanishes with the gap.
TEST(near_full_contact) {
    const Folder folder;
    constexpr double Delta = 1e-3;
    int all = 0, within = 0;
    for (const int n : {16, 33, 64}) {
        Case c = case_of_map(folder.write("wave.txt", rows_of_text(n, n, [n](int i, int) {
                                              return Delta * std::cos(2 * pi * i / n);
                                          })));
        c.surface.L = 1.0;
        c.solids.R[0] = c.solids.R[1] = kInfinity;
        c.indentation.boundary = Boundary::periodic;
        c.indentation.unit = LevelUnit::length;
        const double shares[] = {0.5, 0.8, 0.95, 0.99};
        for (const double s : shares)
            c.indentation.levels.push_back(Delta * (1 - s + s * std::log(s)));
        const std::vector<Level> levels = pressed(c, ModelKind::elements);
        for (const auto k : indices(levels)) {
            const double width = 2 / pi * std::asin(std::sqrt(shares[k])),
                         error = levels[k].area_error_expected;
            ++all;
            within += std::abs(levels[k].area / width - 1) <= error;
            constexpr double kTimes = 2;  // a gap of one pixel is known within its double
            CHECK(levels[k].area * error <= kTimes * (1 - levels[k].area));
        }
    }
    CHECK(all == 12 && 10 * within >= 9 * all);
    // Under a pressure, where errors of N make some of Z0, they add no more than the gap.
    Case c = case_of_map(folder.write("wave.txt", rows_of_text(24, 24, [](int i, int) {
                                          return Delta * std::cos(2 * pi * i / 24);
                                      })));
    c.surface.L = 1.0;
    c.solids.R[0] = c.solids.R[1] = kInfinity;
    c.indentation.boundary = Boundary::periodic;
    c.indentation.control = Control::pressure;
    c.indentation.unit = LevelUnit::pressure;
    c.indentation.levels = {0.999 * pi * prepare(c).indenter.E_star * Delta};
    const Level level = pressed(c, ModelKind::elements).front();
    CHECK(level.area < 1 && level.area * level.area_error_expected <= 3 * (1 - level.area));
}

// Where a contact yields its largest pressure is the hardness, which has no error of the grid.
TEST(largest_pressure_of_yielding) {
    const Folder folder;
    Case c = smooth_map(folder, 24, 24.0);
    c.indentation.unit = LevelUnit::length;
    c.indentation.levels = {-0.2};
    c.solids.R[1] = 200;
    const auto error = [](const Level& level) {
        return find_quantity("pressure_max")->error(level);
    };
    const Level elastic = pressed(c, ModelKind::elements).front();
    CHECK(error(elastic) > 0);
    c.solids.hardness = 0.8 * elastic.pressure_max;
    const Level level = pressed(c, ModelKind::elements).front();
    CHECK_RELATIVE(level.pressure_max, c.solids.hardness, kRounding);
    CHECK(level.plastic_contacts > 0 && error(level) == 0);
}

// Without load a ball that attracts touches over A = pi (6 pi w R^2/K)^(2/3), K = 4 E*/3 (Johnson,
// Kendall and Roberts 1971). Its error is not that of N, which nearly vanishes.
TEST(attraction_without_load) {
    const Folder folder;
    Case c = smooth_map(folder, 64, 1.0);
    c.solids.E[0] = 2;
    c.solids.nu[0] = 0.49;
    c.solids.E[1] = kInfinity;
    c.solids.R[1] = 3;
    c.solids.adhesion = 6e-5;
    c.indentation.control = Control::force;
    c.indentation.levels = {1e-3, 1e-7};
    const Level level = pressed(c, ModelKind::elements).back();
    const double K = 4.0 / 3 * 2 / (1 - 0.49 * 0.49),
                 area = pi * std::pow(6 * pi * 6e-5 * 9 / K, 2.0 / 3);
    CHECK(std::abs(level.area / area - 1) <= level.area_error_expected);
    CHECK(level.area_error_expected < 0.2 && !has(level, Cause::grid));
}

// Errors add up; one that is not known makes their sum unknown. Serious doubts alone raise the
// status, which says the gravest thing.
TEST(doubts_combined_once) {
    Level level;
    level.force = 2;
    level.stiffness = -10;
    const Doubt small{Cause::model_error, 0.03, 0.05, false},
        spikes{Cause::few_points, 0.2, 0.1, true}, border{Cause::border};
    conclude(level, std::array{small}, false);
    CHECK(level.status == LevelStatus::converged && level.doubts == 0);
    conclude(level, std::array{small, spikes}, false);
    CHECK_RELATIVE(level.force_error_expected, 0.23, kRounding);
    CHECK_RELATIVE(level.area_error_expected, 0.15, kRounding);
    CHECK(level.doubts == bit(Cause::few_points) && level.status == LevelStatus::out_of_validity &&
          std::isnan(level.separation_error_expected));
    conclude(level, std::array{small, spikes}, true);  // the same as an error of the separation
    CHECK_RELATIVE(level.separation_error_expected, 0.23 * 2 / 10, kRounding);
    CHECK(std::isnan(level.force_error_expected));
    conclude(level, std::array{small, border}, false);
    CHECK(level.doubts == bit(Cause::border) && std::isnan(level.force_error_expected) &&
          std::isnan(level.area_error_expected));
    level.overlapping_pairs = 1;
    conclude(level, {}, false);
    CHECK(level.status == LevelStatus::overlapping && std::isnan(level.force_error_expected));
    level.unique = false;
    conclude(level, {}, false);
    CHECK(level.status == LevelStatus::not_unique);
    conclude(level, std::array{spikes}, false);
    CHECK(level.status == LevelStatus::out_of_validity);
    level.converged = false;
    conclude(level, std::array{spikes}, false);
    CHECK(level.status == LevelStatus::not_converged && std::isnan(level.force_error_expected));
}

// A contact of asperities that nothing but the model's own error is held against.
struct Sound {
    Asperities asperities = curved(asperities_at({{0.5, 0.5, 0, 1}}), 1, 0, 100);
    SolverOptions options{.law = LawKind::fourth_order,
                          .surface = {.sigma = 1e-3,
                                      .mean_spacing = 0.1,
                                      .points_per_wave = 8,
                                      .grid_step = 0.01,
                                      .gentlest_slope = 0.1,
                                      .extent = {0, 0, 1, 1}}};
    Indenter indenter{1e3, 10, 0.5, 0.5};
    double Z0 = -1e-4;
    Level judged() const {
        const auto contact = make_asperity_contact(asperities, indenter, options);
        Level level = contact->at_separation(Z0);
        Judge(options, {}).judge(level, *contact, false);
        return level;
    }
};

// Each doubt is raised by the smallest case that has it, and not by the same without; where nothing
// was calibrated no error is stated.
TEST(each_doubt) {
    const Level sound = Sound().judged();
    CHECK(sound.doubts == 0 && sound.status == LevelStatus::converged);
    CHECK(sound.force_error_expected > 0 && sound.area_error_expected > 0);
    const auto raises = [](Cause cause, const std::function<void(Sound&)>& change) {
        Sound with;
        change(with);
        const Level level = with.judged();
        return level.doubts == bit(cause) && level.status == LevelStatus::out_of_validity &&
               std::isnan(level.force_error_expected);
    };
    using enum Cause;
    CHECK(raises(border, [](Sound& s) { s.asperities.x[0] = s.indenter.x0 = 0.05; }));
    CHECK(raises(slope_ratio, [](Sound& s) {
        s.indenter.x0 = 0.28;
        s.Z0 = -3e-3;
    }));
    CHECK(!(Sound().judged().slope_ratio > 0));
    CHECK(raises(few_points, [](Sound& s) { s.options.surface.points_per_wave = 2; }));
    CHECK(raises(layer, [](Sound& s) {
        s.indenter.layers.count = 1;
        s.indenter.layers.layer[0] = {0.04, 1e3, 0.3};
        s.indenter.layers.E = 1e3;
        s.indenter.layers.nu = 0.3;
    }));
    CHECK(raises(outside_calibration, [](Sound& s) { s.options.interaction = Interaction::none; }));
    const auto flat = [](Sound& s) {
        s.indenter.shape = Shape(kInfinity);
        s.Z0 = -1e-5;
    };
    CHECK(!raises(outside_calibration, flat));
    CHECK(raises(outside_calibration, [&](Sound& s) {
        flat(s);
        s.options.surface.measured = true;
    }));
    // The tip is beside the summit. A paraboloid of curvature 1 touches the ball at Z0 = -0.1^2/2 *
    // 5/6 = -0.0042, farther from the summit than it is moved.
    CHECK(raises(missed_contact, [](Sound& s) {
        s.indenter.x0 = 0.4;
        s.Z0 = -6e-3;
        s.indenter.shape = Shape(0.2);
    }));
    // A list of asperities is its own surface: no error is stated, and only an indenter as curved
    // as they are is a doubt.
    Sound listed;
    listed.options.surface.gentlest_slope = 0;
    CHECK(listed.judged().status == LevelStatus::converged && listed.judged().force > 0 &&
          std::isnan(listed.judged().force_error_expected));
    listed.indenter.shape = Shape(1.0);
    CHECK(has(listed.judged(), beyond_law));
    Sound above;
    above.Z0 = 1e-3;
    CHECK(above.judged().doubts == 0);
    Sound wide;
    wide.options.surface.mean_spacing = 0.01;
    CHECK(has(wide.judged(), beyond_law) && std::isnan(wide.judged().force_error_expected));
    // Other heights than isotropic Gaussian ones have no smaller error, nor has law 'hertz'.
    Sound measured, hertz;
    measured.options.surface.measured = true;
    hertz.options.law = LawKind::hertz;
    CHECK(measured.judged().force_error_expected >= sound.force_error_expected);
    CHECK(hertz.judged().force_error_expected > sound.force_error_expected);
}

// Points of a measured map that asperities do not represent: on its border, and spikes.
TEST(marks_of_a_map) {
    Sound map;
    auto marks = std::make_shared<MapMarks>();
    marks->reach = 0.01;
    map.options.surface.marks = marks;
    marks->border = {{0, 0.5, 0}};  // the ball is 0.0125 above it
    CHECK(!has(map.judged(), Cause::border));
    marks->border = {{0, 0.5, 0.02}, {0, 0.51, 0.02}, {0, 0.8, 0.05}};
    CHECK(map.judged().edge_contacts == 2 && has(map.judged(), Cause::border));
    marks->border.clear();
    const double without = map.judged().force_error_expected;
    marks->spikes = {{0.5, 0.5}};  // all of the load
    CHECK_RELATIVE(map.judged().force_error_expected, without + 1, kRounding);
    CHECK(map.judged().doubts == bit(Cause::few_points));
}

// Elements: what a level is worth depends on neither the order of the levels nor the number of
// realizations; on odd and on small maps errors are stated as well.
TEST(alike_in_every_order) {
    Case c;
    c.surface.L_lambda_l = 2;
    c.surface.L_lambda_s = 8;
    c.surface.sigma = 1e-3;
    c.surface.n = 64;
    c.solids.R[1] = 10;
    c.indentation.levels = {1.5, 1, 0.5, 0};
    const std::vector<Level> down = pressed(c, ModelKind::elements);
    std::ranges::reverse(c.indentation.levels);
    c.run.realizations = 2;
    const std::vector<Level> up = pressed(c, ModelKind::elements);
    for (std::size_t k = 0; k < 4; ++k) {
        const Level &a = down[k], &b = up[3 - k];
        CHECK(a.status == b.status && a.doubts == b.doubts);
        CHECK(std::isnan(a.force_error_expected) == std::isnan(b.force_error_expected));
        if (a.force_error_expected > 0)
            CHECK_RELATIVE(a.force_error_expected, b.force_error_expected, 1e-3);
    }
    const Folder folder;
    for (const int n : {15, 33})
        for (const bool flats : {false, true}) {
            Case m = case_of_map(folder.write("map.txt", rows_of_text(n, n, [n](int i, int j) {
                                                  return 1e-3 * std::sin(2 * pi * i / n) *
                                                         std::sin(2 * pi * j / n);
                                              })));
            m.surface.L = 1.0;
            if (flats) m.indentation.boundary = Boundary::periodic;
            m.solids.R[1] = flats ? kInfinity : 3;
            m.indentation.unit = LevelUnit::length;
            m.indentation.levels = {flats ? 2e-4 : -2e-3};
            const Level level = pressed(m, ModelKind::elements).front();
            CHECK(level.force > 0 && level.force_error_expected > 0);
        }
}

// Under a prescribed force the separation is uncertain, by the error of N over the stiffness.
TEST(under_a_force) {
    Case c;
    c.surface.L_lambda_l = 2;
    c.surface.L_lambda_s = 8;
    c.surface.sigma = 1e-3;
    c.surface.n = 64;
    c.solids.R[1] = 10;
    c.asperities.law = LawKind::fourth_order;
    c.indentation.levels = {0.5};
    const Level at_separation = pressed(c, ModelKind::asperities).front();
    c.indentation.control = Control::force;
    c.indentation.levels = {at_separation.force};
    const Level level = pressed(c, ModelKind::asperities).front();
    CHECK(level.doubts == at_separation.doubts && std::isnan(level.force_error_expected));
    if (at_separation.force_error_expected > 0)
        CHECK_RELATIVE(level.separation_error_expected,
                       at_separation.force_error_expected * level.force / -level.stiffness, 1e-6);
}

}  // namespace test_trust
