// Force control of elements: the first level, levels far apart, and a map all of whose points carry
// load. A level under a force equals the level at its separation, costs about as many products, and
// does not depend on the number of threads.
#include <cmath>

#include "base/parallel.hpp"
#include "check.hpp"
#include "contact/make.hpp"
#include "surface/synthesis.hpp"

namespace test_element_force {

using namespace rsc;

struct Run {
    std::vector<Level> levels;
    long products = 0;
};

template <class At>
Run run(const HeightMap& map, const Indenter& tip, const std::vector<double>& values, At at) {
    const auto contact = make_element_contact(map, tip, {.tolerance = 1e-8, .max_iterations = 200});
    Run all;
    for (const double value : values) {
        all.levels.push_back(at(*contact, value));
        all.products += all.levels.back().products;
    }
    return all;
}

void compare(double R, const std::vector<double>& forces) {
    Spectrum s{.L = 1, .L_lambda_l = 4, .L_lambda_s = 16, .sigma = 1e-3};
    const HeightMap map = synthesize(s, 128, Normalise::sample, 1, 1);
    const Indenter tip{1e5, R, 0.5, 0.5};
    const auto under_force = [](Path& contact, double N) { return contact.at_force(N); };
    const Run by_force = run(map, tip, forces, under_force);
    std::vector<double> separations;
    for (const Level& level : by_force.levels) separations.push_back(level.separation);
    const Run by_separation = run(
        map, tip, separations, [](Path& contact, double Z0) { return contact.at_separation(Z0); });
    for (const auto k : indices(forces)) {
        CHECK(by_force.levels[k].converged);
        CHECK_RELATIVE(by_force.levels[k].force, forces[k], 1e-6);
        CHECK_RELATIVE(by_separation.levels[k].force, forces[k], 1e-6);
        CHECK_RELATIVE(by_force.levels[k].area, by_separation.levels[k].area, 1e-3);
    }
    CHECK(double(by_force.products) <= 1.3 * double(by_separation.products));
    {
        const LoopThreads loops(3);
        const Run again = run(map, tip, forces, under_force);
        for (const auto k : indices(forces))
            CHECK(again.levels[k].separation == by_force.levels[k].separation);
    }
}

// The first level of a contact deep in a roughness, where the force rises by high powers of the
// depth: the search for its depth comes to an end, at less than the cost of a second level.
void first_levels() {
    constexpr double sigma = 0.01;
    Spectrum s{.L = 1, .L_lambda_l = 24, .L_lambda_s = 64, .sigma = sigma};
    const HeightMap map = synthesize(s, 320, Normalise::sample, 1, 1);
    const Indenter tip{1e5, 2.5, 0.5, 0.5};
    for (const double Z0 : {2 * sigma, 1.73 * sigma, 1.5 * sigma, sigma, 0.0}) {
        const Level level = make_element_contact(map, tip, {})->at_separation(Z0),
                    under = make_element_contact(map, tip, {})->at_force(level.force);
        CHECK(std::abs(under.separation - Z0) <
              1e-5 * sigma);  // ten tolerances of the force, which rises with a power of the depth
        CHECK(under.products <= 2 * level.products);
    }
}

// A ball deep in a roughness of many points: the sets of points under pressure settle. Without
// releases before additions they repeat until the energy ends the cycle, from the fifth force on.
void settled_sets() {
    Spectrum s{.L = 0.45, .L_lambda_l = 8, .L_lambda_s = 128, .sigma = 2e-4};
    const HeightMap map = synthesize(s, 512, Normalise::sample, 1, 1);
    const Indenter tip{1.1538e5, 5, 0.225, 0.225};
    constexpr int most_rounds = 15;  // half of those after which cycles are excluded by the energy
    const auto contact = make_element_contact(map, tip, {.tolerance = 1e-8, .max_iterations = 200});
    for (const double N : {1.0, 2.2, 4.6, 10.0, 22.0, 46.0, 100.0}) {
        const Level level = contact->at_force(N);
        CHECK(level.converged);
        CHECK(level.iterations <= most_rounds);
    }
}

TEST(element_force) {
    settled_sets();
    first_levels();
    const double flat = kInfinity;
    compare(5.0, {0.1, 1.0, 30.0, 1000.0});
    compare(flat, {500.0, 1000.0, 3000.0, 10000.0});  // the last ones in full contact
}

}  // namespace test_element_force
