// Elements in a run: the surface they stand on, what observations make of them, and &compare beside the asperity model.
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

// Under force control the levels to compare are forces. Where levels depend on those before them, the way begins with the first one.
void which_levels() {
    Case c = small();
    c.indentation.control = Control::force;
    c.indentation.levels = {1.0, 3.0, 10.0};
    c.compare.levels = {8.0};
    const Job job = prepare(c);
    const auto compare = [](const Job& of) {
        return compare_levels(of, 1, 1, observe(of, 1, realize(of, 1, 1)).levels, nullptr, [] { return false; }).levels;
    };
    CHECK(compare(job).size() == 1 && compare(job)[0].step == 2);
    c = small();
    c.solids.hardness = 6000;
    c.indentation.levels = {0.0, 0.5};
    c.compare.levels = {0.5};
    const Job back = prepare(c);
    const std::vector<ComparedLevel> compared = compare(back);
    c.compare.levels.clear();
    c.solver.model = Model::elements;
    const Realization elements = realize(prepare(c), 1, 1);
    CHECK(compared.size() == 1 && compared[0].step == 1);
    CHECK_RELATIVE(compared[0].force, elements.levels[1].force, 1e-5);
    c.indentation.levels = {0.5};
    CHECK(compared[0].force < 0.95 * realize(prepare(c), 1, 1).levels[0].force);
}

}  // namespace

TESTS {
    surface();
    which_levels();
}
