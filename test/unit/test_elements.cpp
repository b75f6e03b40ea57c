// Sets of pixels that are connected, and levels with too few rounds. The solver itself: physics/test_element_levels.
#include "check.hpp"
#include "contact/element_contact.hpp"
#include "contact/solver/elements.hpp"
#include "height_maps.hpp"

using namespace rsc;

namespace {

void connected() {
    //  a a . b
    //  . a . b
    //  c . b b
    const std::vector<Pixel> pixels = {{0, 0}, {1, 0}, {3, 0}, {1, 1}, {3, 1}, {0, 2}, {2, 2}, {3, 2}};
    std::vector<int> label;
    CHECK(connected_sets(pixels, label) == 3);
    CHECK((label == std::vector<int>{0, 0, 1, 0, 1, 2, 1, 1}));
    // Around the edges of a 4 x 3 map: (0,0)-(3,0) and (0,2)-(0,0).
    CHECK(connected_sets(pixels, label, 4, 3) == 1);
    CHECK(connected_sets(pixels, label, 5, 3) == 2);  // (0,2)-(0,0) only
    CHECK(connected_sets({}, label) == 0);
}

// A level that had too few rounds says so.
void rounds() {
    const HeightMap map =
        height_map(32, 32, 0.03, 0.03, [](int i, int j) { return 0.02 * std::cos(0.9 * i + 0.3 * j) * std::sin(0.7 * j); });
    for (const auto& [most, status] : {std::pair{1, LevelStatus::not_converged}, {200, LevelStatus::converged}}) {
        SolverOptions options;
        options.max_iterations = most, options.tolerance = 1e-10;
        CHECK(make_element_contact(map, {2.0, 50.0, 0.5, 0.5}, options)->at_separation(0.0).status == status);
    }
}

}  // namespace

TESTS {
    connected();
    rounds();
}
