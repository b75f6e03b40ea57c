// Elements in a run: the surface they stand on, what observations make of them, and &compare beside the asperity model.
#include <cmath>
#include <sstream>

#include "case/registry.hpp"
#include "check.hpp"
#include "error.hpp"
#include "run/compare.hpp"
#include "run/job.hpp"

using namespace rsc;

namespace {

Case small() {
    Case c;
    c.surface.n = 64;
    c.surface.L_lambda_l = 4;
    c.surface.L_lambda_s = 24;
    c.indentation.levels = {2.0, 1.0, -0.5};
    return c;
}

// The grid of elements has points_per_wave points in the shortest wave, and holds the surface of the asperities' grid.
void surface() {
    Case c = small();
    CHECK(element_points(c, spectrum_of(c)) == 192);
    c.elements.points_per_wave = 8.1;
    CHECK(element_points(c, spectrum_of(c)) == 196);  // the next even number without prime factors above 7
    c.elements.points_per_wave = 16;
    CHECK(element_points(c, spectrum_of(c)) == 384);
    const Surface fine = make_element_surface(c, 3, 1), coarse = make_surface(small(), 3, 1);
    double worst = 0;
    // sigma is exact over the points of each grid (normalise = 'sample'): the two differ by a factor next to 1.
    const double factor = coarse.map(5, 7) / fine.map(30, 42);
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i) worst = std::max(worst, std::abs(coarse.map(i, j) - factor * fine.map(6 * i, 6 * j)));
    CHECK(worst <= 1e-12);
    CHECK_CLOSE(factor, 1.0, 1e-2);
}

void comparison() {
    Case c = small();
    c.asperities.law = LawKind::fourth_order;
    c.compare.levels = {0.9, 2.2};  // the nearest levels are the second and the first
    const Job job = prepare(c);
    const RealizationRecord record = observe(job, 1, realize(job, 1, 1));
    std::ostringstream screen;
    const ComparedLevels compared = compare_levels(job, 1, 1, record.levels, &screen, [] { return false; });
    CHECK((compared.step == std::vector<std::int32_t>{1, 0}));
    CHECK(compared.failed == 0);
    Case truth = small();
    truth.solver.model = Model::elements;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto s = static_cast<std::size_t>(compared.step[k]);
        // The grid is refined until N changes by less than 1 %: the answer is that of a run on the grid it tells.
        CHECK(compared.columns[k] == compared.rows[k] && compared.columns[k] >= 192);
        CHECK(compared.force_error_expected[k] <= 0.01);
        truth.elements.points_per_wave = compared.columns[k] / truth.surface.L_lambda_s;
        const Realization elements = realize(prepare(truth), 1, 1);
        CHECK_RELATIVE(compared.force[k], elements.levels[s].force, 1e-5);
        CHECK(compared.contacts[k] == elements.levels[s].contacts);
        CHECK_RELATIVE(compared.area[k], elements.levels[s].area, 1e-3);  // a pixel more or less
        CHECK_RELATIVE(compared.area_pixels[k], elements.levels[s].area_pixels, 1e-3);
        CHECK(compared.area_pixels[k] > 1.01 * compared.area[k]);
        CHECK_RELATIVE(compared.force_error[k], record.levels[s].force / compared.force[k] - 1, 1e-12);
        CHECK_RELATIVE(compared.area_error[k], record.levels[s].area / compared.area[k] - 1, 1e-12);
        CHECK_RELATIVE(compared.contacts_error[k], static_cast<double>(record.levels[s].contacts) / compared.contacts[k] - 1, 1e-12);
        CHECK(std::abs(compared.force_error[k]) < 0.2);  // it is the same surface
    }
    double N = 0;
    for (double p : compared.pixels.pressure) N += p * compared.pixels.dx * compared.pixels.dy;
    CHECK_RELATIVE(N, compared.force[1], 1e-12);  // pixels are those of the last one
    CHECK(screen.str().find("itself +- ") != std::string::npos);
    CHECK(compares(job, false) && !compares(prepare(small()), false) && compares(prepare(small()), true));
    Case none = small();
    none.compare.what = CompareWhat::none;
    CHECK(!compares(prepare(none), true));
}

// Under force control the levels to compare are forces. Where levels depend on those before them, the way begins with the first one.
void which_levels() {
    Case c = small();
    c.indentation.control = Control::force;
    c.indentation.levels = {1.0, 3.0, 10.0};
    c.compare.levels = {8.0};
    const Job job = prepare(c);
    CHECK(compare_levels(job, 1, 1, observe(job, 1, realize(job, 1, 1)).levels, nullptr, [] { return false; }).step ==
          std::vector<std::int32_t>{2});
    c = small();
    c.solids.hardness = 6000;
    c.indentation.levels = {0.0, 0.5};
    c.compare.levels = {0.5};
    const Job back = prepare(c);
    const ComparedLevels compared = compare_levels(back, 1, 1, observe(back, 1, realize(back, 1, 1)).levels, nullptr, [] { return false; });
    c.compare.levels.clear();
    c.solver.model = Model::elements;
    const Realization elements = realize(prepare(c), 1, 1);
    CHECK(compared.step == std::vector<std::int32_t>{1});
    CHECK_RELATIVE(compared.force[0], elements.levels[1].force, 1e-5);
    c.indentation.levels = {0.5};
    CHECK(compared.force[0] < 0.95 * realize(prepare(c), 1, 1).levels[0].force);
}

// With hardness: both models along their own paths, a way back and a second way down included, the comparison as a run of its own would have it.
void yielding() {
    Case c = small();
    c.solids.hardness = 15000;
    c.indentation.levels = {2.0, 0.5, 0.0, 0.5, 1.0, 0.5, -1.0};
    c.asperities.law = LawKind::fourth_order;
    c.compare.levels = {0.5, -1.0, 0.5};  // loading and the way back, and the end
    const Job job = prepare(c);
    const Realization r = realize(job, 1, 1);
    CHECK(r.residual_profile.depth.empty() && r.residual_depth.size() == r.asperities.size());
    const RealizationRecord record = observe(job, 1, r);
    const ComparedLevels compared = compare_levels(job, 1, 1, record.levels, nullptr, [] { return false; });
    CHECK((compared.step == std::vector<std::int32_t>{1, 3, 6}));
    Case truth = c;
    truth.compare.levels.clear();
    truth.solver.model = Model::elements;
    const Job elements_job = prepare(truth);
    const Realization elements = realize(elements_job, 1, 1);
    CHECK(elements.residual_depth.empty() && !elements.residual_profile.depth.empty());
    for (std::size_t k = 0; k < 3; ++k) {
        const Level& level = elements.levels[static_cast<std::size_t>(compared.step[k])];
        CHECK_RELATIVE(compared.force[k], level.force, 1e-5);
        const LevelValues& asperities = record.levels[static_cast<std::size_t>(compared.step[k])];
        CHECK_RELATIVE(compared.force_error[k], asperities.force / compared.force[k] - 1, 1e-12);
    }
    CHECK(compared.force[1] < 0.9 * compared.force[0]);  // the same separation on the way back
    double volume = 0;
    for (double d : elements.residual_profile.depth) volume += d * elements.residual_profile.dx * elements.residual_profile.dy;
    CHECK_RELATIVE(elements.levels.back().plastic_work, 15000 * volume, 1e-12);
    for (const Level& level : elements.levels) {
        CHECK(level.yields.size() == level.f.size());
        for (double p : level.pixels.pressure) CHECK(p <= 15000);
    }
    CHECK(elements.levels[2].plastic_contacts > 0 && elements.levels[3].plastic_contacts == 0 && elements.levels[6].plastic_contacts > 0);
    const Realization again = realize(elements_job, 1, 2);
    for (std::size_t s = 0; s < again.levels.size(); ++s)
        CHECK(again.levels[s].force == elements.levels[s].force && again.levels[s].pixels.pressure == elements.levels[s].pixels.pressure);
    CHECK(again.residual_profile.depth == elements.residual_profile.depth);
}

}  // namespace

TESTS {
    surface();
    comparison();
    which_levels();
    yielding();
}
