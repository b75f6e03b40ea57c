// What a case becomes before anything is pressed: levels, places, units, ranges and options, each by hand from the case's own numbers,
// and what is refused just beyond its bound.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "check.hpp"
#include "contact/equivalent.hpp"
#include "error.hpp"
#include "run/job.hpp"
#include "run/prepare.hpp"
#include "run/twins.hpp"
#include "unit/refused.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-13;
const Folder folder;

std::string write(const std::string& name, const std::string& content) { return folder.write(name, content); }

Case synthetic() {
    Case c;
    c.surface.L = 3, c.surface.n = 64, c.surface.L_lambda_l = 3, c.surface.L_lambda_s = 16, c.surface.sigma = 0.02;
    c.surface.hurst = 0.6;
    c.solids.E[1] = 31e3, c.solids.nu[0] = 0.35, c.solids.nu[1] = 0.21, c.solids.R[0] = 4;
    return c;
}

// 30 x 20 points of 0.5 x 0.25 from (x0, y0), as triples of a text.
std::string map_file(const std::string& name, double x0, double y0, double dx = 0.5, double dy = 0.25, double high = 1) {
    std::string text;
    for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 30; ++i) {
            char line[100];
            std::snprintf(
                line, sizeof line, "%.10g %.10g %.17g\n", x0 + dx * i, y0 + dy * j,
                high * 0.01 * (std::sin(1.1 * i + 0.4 * j) + 0.7 * std::cos(0.8 * i - 1.3 * j) + 0.3 * std::sin(2.3 * j + 0.2 * i)));
            text += line;
        }
    return write(name, text);
}

Case of_map(const std::string& file) {
    Case c;
    c.surface.source = Source::heights;
    c.surface.file = file;
    c.output.pdf_levels = {2};
    c.solver.model = Model::asperities;
    return c;
}

void levels() {
    Case c = synthetic();
    auto& keys = c.indentation;
    keys.start = 3.5, keys.stop = 0.5, keys.steps = 7;
    const auto are = [&](const std::vector<double>& wanted, double unit, double rounding = kRounding) {
        Job job = prepare(c);
        CHECK(job.levels.size() == wanted.size());
        CHECK_RELATIVE(job.level_unit, unit, kRounding);
        for (std::size_t k = 0; k < std::min(wanted.size(), job.levels.size()); ++k)
            CHECK_CLOSE(job.levels[k], wanted[k] * unit, rounding * unit * 4);
        return job;
    };
    CHECK(are({3.5, 3, 2.5, 2, 1.5, 1, 0.5}, 0.02).sigma == 0.02);
    keys.unit = LevelUnit::length;
    are({3.5, 3, 2.5, 2, 1.5, 1, 0.5}, 1);
    keys.steps = 1;
    are({3.5}, 1);
    keys.steps = 2;
    are({3.5, 0.5}, 1);
    keys.control = Control::force, keys.spacing = Spacing::log, keys.start = 0.25, keys.stop = 16, keys.steps = 4;
    are({0.25, 1, 4, 16}, 1);
    keys.levels = {0.5, 3, 7};
    are({0.5, 3, 7}, 1);
    keys.control = Control::separation, keys.unit = LevelUnit::sigma;
    are({0.5, 3, 7}, 0.02);
    // Two flats: a pressure times the area, or a share of E* sqrt(2 m2) of the surface made, below which it must stay.
    keys.boundary = Boundary::periodic, keys.control = Control::pressure, keys.unit = LevelUnit::pressure;
    c.solids.R[0] = c.solids.R[1] = HUGE_VAL;
    const Job job = are({0.5, 3, 7}, 9);
    const double E = equivalent_modulus(c.solids.E, c.solids.nu),
                 full = E * std::sqrt(2 * make_surface(c, *job.spectrum, 1, 1).origin.sampled->m2);
    CHECK_RELATIVE(1 / E, (1 - 0.35 * 0.35) / 78e3 + (1 - 0.21 * 0.21) / 31e3, kRounding);
    CHECK(job.indenter.shape->hertz_radius() == HUGE_VAL && job.indenter.period.finite() && job.observe.radial_bins == 0);
    keys.unit = LevelUnit::relative, keys.levels = {0.01, 0.9999};
    are({0.01, 0.9999}, 9 * full);
    keys.levels = {0.01, 1};
    CHECK(!accepted([&] { prepare(c); }));
    keys.unit = LevelUnit::pressure, keys.levels = {1, 0.9999 * full};
    CHECK(accepted([&] { prepare(c); }));
    keys.levels = {1.0001 * full, 1};
    CHECK(!accepted([&] { prepare(c); }));
}

void places() {
    // A synthetic square; the tip in its middle, or where the case says, and not beyond.
    Case c = synthetic();
    Job job = prepare(c);
    CHECK(job.site.domain.x0 == 0 && job.site.domain.y0 == 0 && job.site.domain.Lx == 3 && job.site.domain.Ly == 3 && !job.site.guessed);
    CHECK(job.site.sigma == 0.02 && job.indenter.x0 == 1.5 && job.indenter.y0 == 1.5 && !job.indenter.period.finite());
    CHECK_RELATIVE(job.indenter.shape->hertz_radius(), 4 * 2.5 / 6.5, kRounding);
    CHECK_RELATIVE(job.site.mean_spacing, theoretical_moments(*job.spectrum).mean_spacing(), kRounding);
    CHECK(job.observe.tip_x == 1.5 && job.observe.tip_y == 1.5 && job.observe.radial_bins == 50);
    c.indentation.centre[1] = 0.75, c.output.radial_bins = 13, c.output.pdf_levels = {2.5, 1}, c.output.pdf_bins = 17,
    c.output.map_cells = 9;
    job = prepare(c);
    CHECK(job.indenter.x0 == 1.5 && job.indenter.y0 == 0.75 && job.observe.tip_x == 1.5 && job.observe.tip_y == 0.75);
    CHECK(job.observe.radial_bins == 13 && job.observe.pdf.bins == 17 && job.observe.map.nx == 9 && job.observe.map.ny == 9);
    CHECK_RELATIVE(job.observe.pdf_levels[0], 0.05, kRounding);
    CHECK_RELATIVE(job.observe.pdf_levels[1], 0.02, kRounding);
    c.indentation.centre[0] = 0.5, c.indentation.centre[1] = {};
    job = prepare(c);
    CHECK(job.indenter.x0 == 0.5 && job.indenter.y0 == 1.5);
    for (const int axis : {0, 1})
        for (const auto& [at, allowed] : {std::pair{-1e-9, false}, {0.0, true}, {3.0, true}, {3 + 1e-9, false}}) {
            c.indentation.centre[0] = c.indentation.centre[1] = 1;
            c.indentation.centre[axis] = at;
            CHECK(accepted([&] { prepare(c); }) == allowed);
        }
    // A rectangle that does not begin at 0, in a domain of unlike sides.
    Site site;
    site.domain = {-2, 5, 4, 1};
    for (const double R : {0.5, HUGE_VAL})
        for (const bool guessed : {false, true}) {
            site.guessed = guessed;
            const double beyond = guessed ? R : 0;
            for (const auto& [x, y] : {std::pair{-2 - beyond, 5.5}, {2 + beyond, 5.5}, {0.0, 5 - beyond}, {0.0, 6 + beyond}})
                if (std::isfinite(x) && std::isfinite(y)) CHECK(accepted([&] { require_tip_above(site, R, x, y); }));
            if (std::isfinite(beyond))
                for (const auto& [x, y] :
                     {std::pair{-2.001 - beyond, 5.5}, {2.001 + beyond, 5.5}, {0.0, 4.999 - beyond}, {0.0, 6.001 + beyond}})
                    CHECK(!accepted([&] { require_tip_above(site, R, x, y); }));
            CHECK(!accepted([&] { require_tip_above(site, R, 1e60, 5.5); }) &&
                  !accepted([&] { require_tip_above(site, R, 0, std::nan("")); }));
        }
    c.indentation.boundary = Boundary::periodic;
    CHECK(period_of(c, site).x == 4 && period_of(c, site).y == 1);
    // Asperities: the square [0, L]^2 if it holds them, otherwise one of side L about their middle, without L the smallest one.
    const auto list = [](std::vector<double> x, std::vector<double> y, std::vector<double> z) {
        Asperities a;
        a.x = std::move(x), a.y = std::move(y), a.z = std::move(z), a.radius.assign(a.x.size(), 0.1);
        return a;
    };
    const auto is = [](const Site& s, double x0, double y0, double side, bool made_up, double spacing) {
        CHECK_CLOSE(s.domain.x0, x0, kRounding * 10);
        CHECK_CLOSE(s.domain.y0, y0, kRounding * 10);
        CHECK_CLOSE(s.domain.Lx, side, kRounding * 10);
        CHECK_CLOSE(s.domain.Ly, side, kRounding * 10);
        CHECK(s.guessed == made_up);
        CHECK_CLOSE(s.mean_spacing, spacing, kRounding * 10);
    };
    const Asperities three = list({1, 4, 2}, {0.5, 2, 2.5}, {1, 2, 6});
    is(list_site(three, 4.0, "them"), 0, 0, 4, false, 4 / std::sqrt(3.0));
    is(list_site(three, 3.5, "them"), 0.75, -0.25, 3.5, false, 3.5 / std::sqrt(3.0));
    is(list_site(three, 3.0, "them"), 1, 0, 3, false, std::sqrt(3.0));
    is(list_site(three, {}, "them"), 1, 0, 3, true, std::sqrt(3.0));
    CHECK(!accepted([&] { list_site(three, 2.999, "them"); }));
    CHECK_RELATIVE(list_site(three, {}, "them").sigma, std::sqrt(14.0 / 3), kRounding);
    is(list_site(list({0, 2}, {-3, 2}, {0, 0}), 6.0, "them"), -2, -3.5, 6, false, 6 / std::sqrt(2.0));
    is(list_site(list({7}, {9}, {1}), {}, "it"), 6.5, 8.5, 1, true, 0);
    is(list_site(list({7}, {9}, {1}), 10.0, "it"), 0, 0, 10, false, 10);
}

void options() {
    Case c = synthetic();
    c.solver.method = Method::dgesv, c.solver.tolerance = 3e-5, c.solver.max_iterations = 33, c.solver.delta0 = 0.034;
    c.solver.interaction = Interaction::none, c.indentation.selection = Selection::paper, c.indentation.selection_factor = 1.7;
    c.solids.hardness = 321, c.solids.size_effect = 0.45;
    Site site;
    site.domain = {-2, 5, 4, 1}, site.sigma = 0.03, site.mean_spacing = 0.27;
    c.surface.sigma = 0.07;
    CHECK(sigma_of(c, site) == 0.07);
    SolverOptions o = solver_of(c, site);
    CHECK(o.sigma == 0.07 && o.method == Method::dgesv && o.tolerance == 3e-5 && o.max_iterations == 33 && o.delta0 == 0.034);
    CHECK(o.interaction == Interaction::none && o.selection == Selection::paper && o.selection_factor == 1.7 && o.mean_spacing == 0.27);
    CHECK(o.hardness.H0 == 321 && o.hardness.length == 0.45 && o.law == LawKind::hertz);
    CHECK(o.surface.x0 == -2 && o.surface.y0 == 5 && o.surface.Lx == 4 && o.surface.Ly == 1);
    c.surface.sigma = {}, c.asperities.law = LawKind::fourth_order;
    o = solver_of(c, site);
    CHECK(o.sigma == 0.03 && o.law == LawKind::fourth_order && sigma_of(c, site) == 0.03);
    // Where the surface ends is known of free surfaces that are no guess.
    site.guessed = true;
    CHECK(!solver_of(c, site).surface.known());
    site.guessed = false, c.indentation.boundary = Boundary::periodic;
    CHECK(!solver_of(c, site).surface.known());
    // Without an rms height neither dgesv nor the paper's selection can be.
    site.sigma = 0;
    for (const Method method : {Method::automatic, Method::dgesv})
        for (const Selection selection : {Selection::overlap, Selection::paper}) {
            c.solver.method = method, c.indentation.selection = selection;
            CHECK(accepted([&] { solver_of(c, site); }) == (method == Method::automatic && selection == Selection::overlap));
        }
    // The grid of elements: the next even number of factors 2, 3, 5 and 7 alone.
    Case e = synthetic();
    for (int most = 4; most <= 400; ++most) {
        e.elements.points_per_wave = most / 16.0;
        int n = most + most % 2;
        for (;; n += 2) {
            int rest = n;
            for (const int p : {2, 3, 5, 7})
                while (rest % p == 0) rest /= p;
            if (rest == 1) break;
        }
        CHECK(element_points(e, spectrum_of(e)) == n);
    }
    e.elements.points_per_wave = 2048.01;
    CHECK(!accepted([&] { require_element_memory(e, spectrum_of(e)); }));
    // The spectrum of the keys, and of none.
    Case bare;
    const Spectrum s = spectrum_of(bare), t = spectrum_of(synthetic());
    CHECK(s.L == 1 && s.sigma == 0.01 && s.hurst == 0.8 && s.L_lambda_l == 24 && s.L_lambda_s == 512 && !s.plateau && !s.table);
    CHECK(t.L == 3 && t.sigma == 0.02 && t.hurst == 0.6 && t.L_lambda_l == 3 && t.L_lambda_s == 16);
    // From a table: the square of its longest wave, its own rms height, unless the case has others.
    Case tabulated;
    tabulated.surface.source = Source::spectrum, tabulated.surface.file = write("table.txt", "2 7e-4\n6 1e-5\n30 1e-7\n");
    const Spectrum own = spectrum_of(tabulated);
    CHECK_RELATIVE(own.L, kPi, kRounding);
    CHECK_RELATIVE(own.sigma, own.table->sigma(), kRounding);
    tabulated.surface.L = 5, tabulated.surface.sigma = 0.4;
    CHECK(spectrum_of(tabulated).L == 5 && spectrum_of(tabulated).sigma == 0.4);
    CHECK(has_spectrum(tabulated) && has_spectrum(bare) && !has_spectrum(of_map("a.txt")));
    CHECK(differs_by_realization(tabulated) && differs_by_realization(bare) && !differs_by_realization(of_map("a.txt")) &&
          differs_by_realization(of_map("a*.txt")));
    // What a surface's statistics are of.
    for (const Normalise how : {Normalise::sample, Normalise::ensemble}) {
        Case n = synthetic();
        n.surface.normalise = how;
        const Surface surface = make_surface(n, 3, 1);
        const Moments grid = grid_moments(surface.map);
        const Ground ground = make_ground(n, 3, 1), bare_ground = make_bare_ground(surface), found = make_ground(surface, n, 1);
        for (const Ground* g : {&ground, &bare_ground, &found}) {
            CHECK_RELATIVE(g->statistics.sigma, std::sqrt(surface.origin.sampled->m0), kRounding);
            CHECK_RELATIVE(g->statistics.m2, surface.origin.sampled->m2, kRounding);
            CHECK_RELATIVE(g->statistics.m4, surface.origin.sampled->m4, kRounding);
            CHECK_RELATIVE(g->statistics.m2_grid, grid.m2, 1e-10);
            CHECK_RELATIVE(g->statistics.m4_grid, grid.m4, 1e-10);
            CHECK(g->site.sigma == 0.02 && g->site.domain.Lx == 3 && g->site.domain.Ly == 3);
            CHECK_RELATIVE(g->site.mean_spacing, theoretical_moments(spectrum_of(n)).mean_spacing(), kRounding);
        }
        CHECK((std::abs(ground.statistics.sigma - 0.02) < 1e-12) == (how == Normalise::sample));
        CHECK(ground.statistics.summits == static_cast<std::int64_t>(ground.asperities.size()) && ground.statistics.summits > 20);
        CHECK(surface.origin.points_per_wave == 4 && ground.asperities.x == found.asperities.x);
    }
}

// Several maps: each realization its own, brought to the place of the first; sizes that differ are refused.
void maps() {
    map_file("p1.txt", -3, 7), map_file("p2.txt", 11, -5, 0.5, 0.25, 1.5), map_file("p3.txt", 0, 0, 0.5, 0.25, 0.5);
    Case c = of_map(folder / "p?.txt");
    c.run.realizations = 3;
    c.indentation.levels = {1.0};
    const Job job = prepare(c);
    CHECK(job.site.domain.x0 == -3 && job.site.domain.y0 == 7 && std::abs(job.site.domain.Lx - 15) < 1e-9 &&
          std::abs(job.site.domain.Ly - 5) < 1e-9);
    CHECK_CLOSE(job.indenter.x0, 4.25, 1e-9);  // the middle of the points
    CHECK_CLOSE(job.indenter.y0, 9.375, 1e-9);
    CHECK(!job.given && job.measured && job.measured->nx == 30);
    const Realization one = realize(job, 1, 1), two = realize(job, 2, 1), three = realize(job, 3, 1);
    CHECK(one.asperities.size() > 10 && two.asperities.size() == one.asperities.size() && three.asperities.size() == one.asperities.size());
    for (std::size_t k = 0; k < std::min(one.asperities.size(), two.asperities.size()); ++k) {
        for (const Realization* r : {&two, &three}) {
            CHECK_CLOSE(r->asperities.x[k], one.asperities.x[k], 1e-9);
            CHECK_CLOSE(r->asperities.y[k], one.asperities.y[k], 1e-9);
        }
        CHECK_RELATIVE(two.asperities.z[k], 1.5 * one.asperities.z[k], 1e-9);
        CHECK_RELATIVE(three.asperities.radius[k], 2 * one.asperities.radius[k], 1e-9);
        CHECK(one.asperities.x[k] > -3 && one.asperities.x[k] < 12 && one.asperities.y[k] > 7 && one.asperities.y[k] < 12);
    }
    CHECK_RELATIVE(two.statistics.sigma, 1.5 * one.statistics.sigma, 1e-9);
    CHECK_RELATIVE(one.statistics.m2, one.statistics.m2_grid, 0);
    CHECK_RELATIVE(job.site.mean_spacing, std::sqrt(75 / static_cast<double>(one.asperities.size())), 1e-9);
    // As many files as realizations are asked for.
    c.run.first_realization = 2;
    CHECK(!accepted([&] { prepare(c); }));
    c.run.realizations = 2;
    CHECK(accepted([&] { prepare(c); }));
    CHECK_CLOSE(prepare(c).site.domain.x0, 11, 1e-9);
    CHECK(!accepted([&] { make_surface(c, 0, 1); }) && !accepted([&] { make_surface(c, 4, 1); }) &&
          accepted([&] { make_surface(c, 3, 1); }));
    c.run.realizations = 1, c.run.first_realization = 3;
    CHECK(prepare(c).given.has_value());
    // Sides that differ by more than a millionth, along x or y.
    c.run.realizations = 2, c.run.first_realization = 1;
    for (const auto& [dx, dy, allowed] :
         {std::tuple{0.5000004, 0.25, true}, {0.5, 0.2500002, true}, {0.500001, 0.25, false}, {0.5, 0.250001, false}}) {
        map_file("p2.txt", 11, -5, dx, dy);
        const Job other = prepare(c);
        CHECK(accepted([&] { realize(other, 2, 1); }) == allowed);
        c.solver.model = Model::elements;
        const Job elements = prepare(c);
        c.solver.model = Model::asperities;
        CHECK(accepted([&] { realize(elements, 2, 1); }) == allowed);
    }
    // Elements stand on the points themselves: as read, copied, or made on a grid of their own.
    map_file("p4.txt", 4, -9);
    Case elements = of_map(folder / "p4.txt");
    elements.solver.model = Model::elements;
    const Surface read = make_surface(elements, 1, 1);
    const Ground copied = make_ground(read, elements, 1), direct = make_ground(elements, 1, 1);
    for (const Ground* g : {&copied, &direct}) {
        CHECK(g->points && g->asperities.size() == 0);
        if (!g->points) continue;
        const HeightMap& m = *g->points;
        CHECK(m.nx == 30 && m.ny == 20 && m.dx == read.map.dx && m.dy == read.map.dy && m.x0 == read.map.x0 && m.y0 == read.map.y0);
        CHECK(m.dx > 0.49 && m.dy < 0.26 && m.periodic == read.map.periodic && g->site.domain.Lx == m.Lx() && g->site.domain.Ly == m.Ly());
        long same = 0;
        for (int j = 0; j < 20; ++j)
            for (int i = 0; i < 30; ++i) same += m(i, j) == read.map(i, j);
        CHECK(same == 600);
    }
    Case made = synthetic();
    made.solver.model = Model::elements, made.elements.points_per_wave = 6.1;
    CHECK(make_ground(made, 1, 1).points->nx == 98 && make_ground(made, 1, 1).points->ny == 98);
    // Of two sizes the message names both.
    try {
        map_file("p2.txt", 11, -5, 0.75, 0.125);
        realize(prepare(c), 2, 1);
        CHECK(!"refused");
    } catch (const Error& e) {
        CHECK(std::string(e.what()) ==
              "the map of realization 2 is 22.500000 x 2.500000, the first is 15.000000 x 5.000000; maps of one size are expected");
    }
    // A flat list has no sigma: the levels need one.
    Case list;
    list.surface.source = Source::asperities, list.surface.file = write("list.txt", "1 1 2 0.5\n3 1 2 0.25\n");
    CHECK(!accepted([&] { prepare(list); }));
    list.surface.sigma = 0.5;
    const Job of_list = prepare(list);
    CHECK(of_list.sigma == 0.5 && of_list.levels.front() == 2 && of_list.site.guessed && of_list.given && of_list.given->list);
    CHECK(of_list.given->statistics.summits == 2 && of_list.given->statistics.sigma == 0 && std::isnan(of_list.given->statistics.m2));
}

}  // namespace

TESTS {
    levels();
    places();
    options();
    maps();
}
