// What a case becomes before anything is pressed: levels, places, units, ranges and options, each
// by hand from the case's own numbers, and what is refused just beyond its bound.
#include "base/format.hpp"
#include "case/registry.hpp"
#include "contact/equivalent.hpp"
#include "physics/indenter/shapes.hpp"
#include "problem/bodies.hpp"
#include "support/height_maps.hpp"
#include "support/refused.hpp"
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"
#include "trust/doubts.hpp"

namespace test_jobs {

using namespace rsc;
constexpr double kRounding = 1e-13;
const Folder folder;

std::string write(const std::string& name, const std::string& content) {
    return folder.write(name, content);
}

Case synthetic() {
    Case c;
    c.surface.L = 3;
    c.surface.n = 64;
    c.surface.L_lambda_l = 3;
    c.surface.L_lambda_s = 16;
    c.surface.sigma = 0.02;
    c.surface.hurst = 0.6;
    c.solids.E[1] = 31e3;
    c.solids.nu[0] = 0.35;
    c.solids.nu[1] = 0.21;
    c.solids.R[0] = 4;
    return c;
}

// 30 x 20 points of 0.5 x 0.25 from (x0, y0), as triples of a text.
std::string map_file(const std::string& name, double x0, double y0, double dx = 0.5,
                     double dy = 0.25, double high = 1) {
    std::string text;
    for (const int j : indices(20))
        for (const int i : indices(30)) {
            char line[100];
            std::snprintf(line, sizeof line, "%.10g %.10g %.17g\n", x0 + dx * i, y0 + dy * j,
                          high * 0.01 *
                              (std::sin(1.1 * i + 0.4 * j) + 0.7 * std::cos(0.8 * i - 1.3 * j) +
                               0.3 * std::sin(2.3 * j + 0.2 * i)));
            text += line;
        }
    return write(name, text);
}

// A duration is spread evenly over the levels, both ends included.
TEST(times) {
    Case c = synthetic();
    c.indentation.levels = {3, 2, 1, 0};
    c.indentation.duration = 6;
    CHECK((prepare(c).times == std::vector<double>{0, 2, 4, 6}));
}

// The gap between curved bodies: curvatures add, in line contact across the axis alone.
TEST(gap_of_two_bodies) {
    Case c = synthetic();
    c.solids.R[0] = -10;
    c.indenter.shape = shape_number("paraboloid");
    c.indenter.radii[0] = 6;
    c.indenter.radii[1] = 4;
    const auto gap = [&](double x, double y) { return shape_of(c)->height(x, y); };
    CHECK_RELATIVE(gap(0.2, 0.3), 0.02 * (1 / 6.0 - 0.1) + 0.045 * (0.25 - 0.1), kRounding);
    c.indenter.radii[1] = kInfinity;
    CHECK(!accepted([&] { shape_of(c); }));  // straight on a concave body
    c.indentation.boundary = Boundary::periodic_y;
    CHECK_RELATIVE(gap(0.2, 0.3), 0.02 * (1 / 6.0 - 0.1), kRounding);
    c.indenter.radii[0] = kInfinity;
    c.solids.R[0] = 10;
    CHECK_RELATIVE(gap(0.2, 0.3), 0.02 * 0.1, kRounding);
    c.indentation.boundary = Boundary::periodic_x;
    CHECK_RELATIVE(gap(0.2, 0.3), 0.045 * 0.1, kRounding);
}

TEST(places) {
    Case c = synthetic();
    // A rectangle that does not begin at 0, in a domain of unlike sides.
    SurfaceDomain domain;
    static_cast<Domain&>(domain) = {-2, 5, 4, 1};
    for (const double R : {0.5, kInfinity})
        for (const bool guessed : {false, true}) {
            domain.guessed = guessed;
            const double beyond = guessed ? R : 0;
            for (const auto& [x, y] : {std::pair{-2 - beyond, 5.5},
                                       {2 + beyond, 5.5},
                                       {0.0, 5 - beyond},
                                       {0.0, 6 + beyond}})
                if (std::isfinite(x) && std::isfinite(y))
                    CHECK(accepted([&] { require_tip_above(domain, R, x, y); }));
            if (std::isfinite(beyond))
                for (const auto& [x, y] : {std::pair{-2.001 - beyond, 5.5},
                                           {2.001 + beyond, 5.5},
                                           {0.0, 4.999 - beyond},
                                           {0.0, 6.001 + beyond}})
                    CHECK(!accepted([&] { require_tip_above(domain, R, x, y); }));
            CHECK(!accepted([&] { require_tip_above(domain, R, 1e60, 5.5); }) &&
                  !accepted([&] { require_tip_above(domain, R, 0, std::nan("")); }));
        }
    c.indentation.boundary = Boundary::periodic;
    CHECK(period_of(c, domain).x == 4 && period_of(c, domain).y == 1);
    // Asperities: the square [0, L]^2 if it holds them, otherwise one of side L about their middle,
    // without L the smallest one.
    const auto list = [](std::vector<double> x, std::vector<double> y, std::vector<double> z) {
        Asperities a;
        a.x = std::move(x);
        a.y = std::move(y);
        a.z = std::move(z);
        a.radius.assign(a.x.size(), 0.1);
        return a;
    };
    const auto is = [](const SurfaceDomain& s, double x0, double y0, double side, bool made_up,
                       double spacing) {
        CHECK_CLOSE(s.x0, x0, kRounding * 10);
        CHECK_CLOSE(s.y0, y0, kRounding * 10);
        CHECK_CLOSE(s.Lx, side, kRounding * 10);
        CHECK_CLOSE(s.Ly, side, kRounding * 10);
        CHECK(s.guessed == made_up);
        CHECK_CLOSE(s.mean_spacing, spacing, kRounding * 10);
    };
    const Asperities three = list({1, 4, 2}, {0.5, 2, 2.5}, {1, 2, 6});
    is(list_domain(three, 4.0, "them"), 0, 0, 4, false, 4 / std::sqrt(3.0));
    is(list_domain(three, 3.5, "them"), 0.75, -0.25, 3.5, false, 3.5 / std::sqrt(3.0));
    is(list_domain(three, 3.0, "them"), 1, 0, 3, false, std::sqrt(3.0));
    is(list_domain(three, {}, "them"), 1, 0, 3, true, std::sqrt(3.0));
    CHECK(!accepted([&] { list_domain(three, 2.999, "them"); }));
    CHECK_RELATIVE(list_domain(three, {}, "them").sigma, std::sqrt(14.0 / 3), kRounding);
    is(list_domain(list({0, 2}, {-3, 2}, {0, 0}), 6.0, "them"), -2, -3.5, 6, false,
       6 / std::sqrt(2.0));
    is(list_domain(list({7}, {9}, {1}), {}, "it"), 6.5, 8.5, 1, true, 0);
    is(list_domain(list({7}, {9}, {1}), 10.0, "it"), 0, 0, 10, false, 10);
}

// Several maps: each realization its own, brought to the place of the first; sizes that differ are
// refused.
TEST(maps) {
    map_file("p1.txt", -3, 7);
    map_file("p2.txt", 11, -5, 0.5, 0.25, 1.5);
    map_file("p3.txt", 0, 0, 0.5, 0.25, 0.5);
    Case c = case_of_map(folder / "p?.txt");
    c.solver.model = ModelKind::asperities;
    c.asperities.law = LawKind::hertz;
    c.run.realizations = 3;
    c.indentation.levels = {1.0};
    const Job job = prepare(c);
    CHECK(job.domain.x0 == -3 && job.domain.y0 == 7 && std::abs(job.domain.Lx - 15) < 1e-9 &&
          std::abs(job.domain.Ly - 5) < 1e-9);
    const Rectangle& extent = job.solver.surface.extent;
    CHECK(extent.x0 == -3 && extent.y0 == 7 && extent.Lx == job.domain.Lx &&
          extent.Ly == job.domain.Ly);
    CHECK_CLOSE(job.indenter.x0, 4.25, 1e-9);  // the middle of the points
    CHECK_CLOSE(job.indenter.y0, 9.375, 1e-9);
    CHECK(!job.given && job.measured && job.measured->nx == 30);
    const Realization one = realize(job, 1, 1), two = realize(job, 2, 1),
                      three = realize(job, 3, 1);
    CHECK(one.asperities.size() > 10 && two.asperities.size() == one.asperities.size() &&
          three.asperities.size() == one.asperities.size());
    for (std::size_t k = 0; k < std::min(one.asperities.size(), two.asperities.size()); ++k) {
        for (const Realization* r : {&two, &three}) {
            CHECK_CLOSE(r->asperities.x[k], one.asperities.x[k], 1e-9);
            CHECK_CLOSE(r->asperities.y[k], one.asperities.y[k], 1e-9);
        }
        CHECK_RELATIVE(two.asperities.z[k], 1.5 * one.asperities.z[k], 1e-9);
        CHECK_RELATIVE(three.asperities.radius[k], 2 * one.asperities.radius[k], 1e-9);
        CHECK(one.asperities.x[k] > -3 && one.asperities.x[k] < 12 && one.asperities.y[k] > 7 &&
              one.asperities.y[k] < 12);
    }
    CHECK_RELATIVE(two.statistics.sigma, 1.5 * one.statistics.sigma, 1e-9);
    CHECK_RELATIVE(one.statistics.m2, one.statistics.m2_grid, 0);
    CHECK_RELATIVE(job.domain.mean_spacing, std::sqrt(75 / double(one.asperities.size())), 1e-9);
    // As many files as realizations are asked for.
    c.run.first_realization = 2;
    CHECK(!accepted([&] { prepare(c); }));
    c.run.realizations = 2;
    CHECK(accepted([&] { prepare(c); }));
    CHECK_CLOSE(prepare(c).domain.x0, 11, 1e-9);
    CHECK(!accepted([&] { make_surface(c, 0, 1); }) && !accepted([&] { make_surface(c, 4, 1); }) &&
          accepted([&] { make_surface(c, 3, 1); }));
    c.run.realizations = 1;
    c.run.first_realization = 3;
    CHECK(prepare(c).given.has_value());
    // Sides that differ by more than a millionth, along x or y.
    c.run.realizations = 2;
    c.run.first_realization = 1;
    for (const auto& [dx, dy, allowed] : {std::tuple{0.5000004, 0.25, true},
                                          {0.5, 0.2500002, true},
                                          {0.500001, 0.25, false},
                                          {0.5, 0.250001, false}}) {
        map_file("p2.txt", 11, -5, dx, dy);
        for (const ModelKind model : {ModelKind::elements, ModelKind::asperities}) {
            c.solver.model = model;
            CHECK(accepted([&] { realize(prepare(c), 2, 1); }) == allowed);
        }
    }
    // Elements stand on the points themselves: as read, copied, or made on a grid of their own.
    map_file("p4.txt", 4, -9);
    Case elements = case_of_map(folder / "p4.txt");
    elements.solver.model = ModelKind::elements;
    const Surface read = make_surface(elements, 1, 1);
    const SurfaceModel copied = make_surface_model(read, elements, 1),
                       direct = make_surface_model(elements, 1, 1);
    for (const SurfaceModel* g : {&copied, &direct}) {
        CHECK(g->points && g->asperities.size() == 0);
        if (!g->points) continue;
        const HeightMap& m = *g->points;
        CHECK(m.nx == 30 && m.ny == 20 && m.dx == read.map.dx && m.dy == read.map.dy &&
              m.x0 == read.map.x0 && m.y0 == read.map.y0);
        CHECK(m.dx > 0.49 && m.dy < 0.26 && m.periodic == read.map.periodic &&
              g->domain.Lx == m.Lx() && g->domain.Ly == m.Ly());
        long same = 0;
        for (const int j : indices(20))
            for (const int i : indices(30)) same += m(i, j) == read.map(i, j);
        CHECK(same == 600);
    }
    Case made = synthetic();
    made.solver.model = ModelKind::elements;
    made.elements.points_per_wave = 6.1;
    CHECK(make_surface_model(made, 1, 1).points->nx == 98 &&
          make_surface_model(made, 1, 1).points->ny == 98);
    // Of two sizes the message names both.
    map_file("p2.txt", 11, -5, 0.75, 0.125);
    REFUSED(prepare(c), "22.5 x 2.5");
    REFUSED(prepare(c), "15 x 5");
    // A flat list has no sigma: the levels need one.
    Case list;
    list.surface.source = Source::asperities;
    list.surface.file = write("list.txt", "1 1 2 0.5\n3 1 2 0.25\n");
    CHECK(!accepted([&] { prepare(list); }));
    list.surface.sigma = 0.5;
    const Job of_list = prepare(list);
    CHECK(of_list.sigma == 0.5 && of_list.levels.front() == 2 && of_list.domain.guessed &&
          of_list.given && of_list.given->list);
    CHECK(of_list.given->statistics.summits == 2 && of_list.given->statistics.sigma == 0 &&
          std::isnan(of_list.given->statistics.m2));
}

// A relative pressure is p/(E* sqrt(2 m2)) with the m2 of the surface's modes, whatever the
// direction of its lay.
TEST(pressures) {
    for (const double direction : {0.0, 90.0, 25.0}) {
        Case c = synthetic();
        c.surface.n = 128;
        c.surface.aspect = 4;
        c.surface.direction = direction;
        c.solids.R[0] = kInfinity;
        c.indentation.boundary = Boundary::periodic;
        c.indentation.control = Control::pressure;
        c.indentation.unit = LevelUnit::relative;
        c.indentation.levels = {0.01};
        const Job job = prepare(c);
        const double m2 = make_surface(c, 1, 1).sampled->m2;
        CHECK_RELATIVE(job.levels[0], 0.01 * job.indenter.E_star * std::sqrt(2 * m2) * 3 * 3,
                       kRounding);
        // Body 2 is a wave a cos(2 pi x/3), whose m2 is (2 pi a/3)^2/4.
        constexpr int points = 64;
        constexpr double a = 0.05, of_differences = 2e-3;
        std::string wave;
        for (const int k : indices(points * points))
            wave +=
                format("%.12g %.12g %.12g\n", 3.0 * (k % points) / points,
                       3.0 * (k / points) / points, a * std::cos(2 * pi * (k % points) / points));
        c.indenter.file = write("wave.txt", wave);
        set_key(c, "indenter%shape", "'map'");
        const double both = m2 + std::pow(2 * pi * a / 3, 2) / 4;
        const Job two = prepare(c);
        CHECK_RELATIVE(two.levels[0], 0.01 * two.indenter.E_star * std::sqrt(2 * both) * 3 * 3,
                       of_differences);
    }
}

// The lay of a spectrum from a file turns with its direction. Without L the surface is as long as
// the longest wave.
TEST(lay_of_a_spectrum) {
    Case c = synthetic();
    c.surface.source = Source::spectrum;
    c.surface.file = write("psd.txt", "10 1\n40 0.01\n");
    c.surface.L.reset();
    CHECK_RELATIVE(spectrum_of(c).L, 2 * pi / 10, kRounding);
    c.surface.L = 1.0;
    c.surface.aspect = 4;
    c.surface.direction = 25;
    const MomentTensor one = theoretical_moments(spectrum_of(c)).tensor;
    c.surface.direction = 115;
    const MomentTensor other = theoretical_moments(spectrum_of(c)).tensor;
    CHECK(one.m20 < 0.5 * one.m02);
    CHECK_RELATIVE(one.m20, other.m02, 1e-12);
    CHECK_RELATIVE(one.m11, -other.m11, 1e-12);
}

// Two elastic flats by elements are closed where their mean planes meet: that is known before they
// are solved.
TEST(closed_flats) {
    Case c = synthetic();
    c.solids.R[0] = c.solids.R[1] = kInfinity;
    c.solver.model = ModelKind::elements;
    c.indentation.boundary = Boundary::periodic;
    c.indentation.levels = {2, 1, 0.1};
    CHECK(accepted([&] { prepare(c); }));
    c.indentation.levels = {2, 1, 0};
    REFUSED(prepare(c), "that of full contact, 0 ");
    Case hard = c;
    hard.indentation.control = Control::pressure;
    hard.indentation.unit = LevelUnit::pressure;
    hard.solids.hardness = 100;
    hard.indentation.levels = {99.9};
    (void)prepare(hard);
    hard.indentation.levels = {100};
    REFUSED(prepare(hard), "hardness");
    c.solids.hardness = 5e3;  // pixels that yield have levels below
    CHECK(accepted([&] { prepare(c); }));
}

// A sharp punch on a plane by elements: N = 2 a E* d. The edge lies between the points of the grid,
// in another way at each place: nine of ten levels are within their expected error.
TEST(punch_on_plane) {
    constexpr int kPlaces = 10, kOutside = 1;
    Case c = case_of_map(write("plane.txt", rows_of_text(64, 64, [](int i, int j) {
                                   return (i * 7 + j * 3) % 5 == 0 ? 1e-12 : 0;
                               })));
    c.surface.L = 0.4;
    c.solver.model = ModelKind::elements;
    c.indenter.shape = shape_number("punch");
    c.indentation.control = Control::force;
    c.indentation.levels = {1};
    for (const double a : {0.05, 0.1}) {
        int outside = 0;
        for (const int k : indices(kPlaces)) {
            c.indenter.radius = a;
            c.indentation.centre[0] = 0.2 + 0.0007 * k;
            c.indentation.centre[1] = 0.2 - 0.0011 * k;
            const Job job = prepare(c);
            const Level level = realize(job, 1, 1).levels[0];
            outside +=
                !(std::abs(level.force / (-2 * a * job.indenter.E_star * level.separation) - 1) <=
                  level.separation_error_expected / std::abs(level.separation));
        }
        CHECK(outside <= kOutside);
    }
}

// Adhesion is refused for asperities where it flattens the roughness: the energy of a flat surface,
// E* q/4 times the mean square of each wave, is summed over the modes.
TEST(adhesion_that_flattens) {
    Case c = synthetic();
    c.solver.model = ModelKind::asperities;
    c.surface.L_lambda_l = 12;
    double energy = 0, squares = 0;
    for (int i = -16; i <= 16; ++i)
        for (int j = -16; j <= 16; ++j) {
            const double wave = std::hypot(i, j);
            if (wave < 12 || wave > 16) continue;
            const double square = std::pow(wave, -2 * (1 + c.surface.hurst));
            squares += square;
            energy += 2 * pi * wave / *c.surface.L * square;
        }
    energy *= 0.25 * equivalent_modulus(c.solids.E, c.solids.nu) * std::pow(*c.surface.sigma, 2) /
              squares;
    c.solids.adhesion = 0.9 * energy;
    CHECK(accepted([&] { prepare(c); }));
    c.solids.adhesion = 1.1 * energy;
    REFUSED(prepare(c), "solids%adhesion");
    // A soft layer that is thin compared with the waves takes hardly less energy than the body
    // below: the bound does not apply to layers.
    c.solids.adhesion = 0.9 * energy;
    c.solids.layer_nu = {c.solids.nu[0]};
    c.solids.layer_thickness = {1e-4};
    c.solids.layer_E = {0.01 * c.solids.E[0]};
    CHECK(accepted([&] { prepare(c); }));
}

// A smooth map and a rough one between flats: by elements it is the same contact whichever is body
// 2. The summits of the smooth one are not those of the contact, so that asperities are no model of
// it, and say so.
TEST(exchanged_maps) {
    constexpr int n = 96, kWaves = 12;
    const double q = 2 * pi / n;
    const auto smooth = [q](int i, int j) {
        return 1e-3 * (std::cos(q * i + 1) + std::cos(q * j + 2) + std::cos(2 * q * i - q * j));
    };
    const auto rough = [q](int i, int j) {
        return 2e-4 * (std::cos(kWaves * q * i + 0.3) + std::cos(kWaves * q * j) +
                       std::cos(9 * q * i - 7 * q * j + 2));
    };
    const std::string files[] = {write("smooth.txt", rows_of_text(n, n, smooth)),
                                 write("rough.txt", rows_of_text(n, n, rough))};
    for (const ModelKind model : {ModelKind::elements, ModelKind::asperities}) {
        Level level[2];
        for (const int first : {0, 1}) {
            Case c = case_of_map(files[first]);
            c.surface.pixel = 1.0 / n;
            c.solver.model = model;
            c.solver.tolerance = 1e-10;
            c.solids.R[0] = c.solids.R[1] = kInfinity;
            c.indenter.file = files[1 - first];
            set_key(c, "indenter%shape", "'map'");
            c.indentation.boundary = Boundary::periodic;
            c.indentation.control = Control::pressure;
            c.indentation.unit = LevelUnit::relative;
            c.indentation.levels = {0.005};
            level[first] = realize(prepare(c), 1, 1).levels[0];
        }
        if (model == ModelKind::elements) {
            CHECK_RELATIVE(level[0].area, level[1].area, 1e-9);
            CHECK_RELATIVE(level[0].separation, level[1].separation, 1e-8);
        } else {
            for (const Level& one : level) CHECK(one.doubts & bit(Cause::outside_calibration));
        }
    }
}

// Levels of elements solved in groups side by side: each equals the level solved alone, to the
// tolerance, they are handed on in their order, and the number of threads changes no bit.
TEST(groups_of_levels) {
    Case c = synthetic();
    c.solver.model = ModelKind::elements;
    c.solver.tolerance = 1e-9;
    c.compare.levels = {};
    for (const int k : indices(37)) c.indentation.levels.push_back(2.5 - 0.05 * k);
    const Job job = prepare(c);
    std::vector<std::size_t> order;
    const auto note = [&](std::size_t k, const Level&) { order.push_back(k); };
    const std::vector<Level> one = realize(job, 1, 1, note).levels,
                             three = realize(job, 1, 3).levels;
    CHECK(order.size() == one.size() && std::ranges::is_sorted(order));
    for (const auto k : indices(one)) {
        CHECK(one[k].force == three[k].force && one[k].area == three[k].area);
        CHECK(one[k].stiffness == three[k].stiffness && one[k].doubts == three[k].doubts);
        CHECK(one[k].separation_error_expected == three[k].separation_error_expected ||
              std::isnan(three[k].separation_error_expected));
    }
    for (const std::size_t k : {std::size_t{9}, one.size() - 1}) {
        Case alone = c;
        alone.indentation.levels = {c.indentation.levels[k]};
        const Level level = realize(prepare(alone), 1, 1).levels[0];
        CHECK_RELATIVE(one[k].force, level.force, 1e-7);
        if (!std::isnan(level.force_error_expected))
            CHECK_RELATIVE(one[k].force_error_expected, level.force_error_expected, 1e-3);
    }
}

}  // namespace test_jobs
