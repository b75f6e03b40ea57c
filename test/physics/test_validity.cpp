// Levels that leave the range of the model say so: contacts near the border of a free surface, more contact area than there is surface
// under the sphere, a sphere below -3 sigma. And only those.
#include "contact/validity.hpp"

#include "check.hpp"
#include "contact/asperity_contact.hpp"
#include "contact/element_contact.hpp"
#include "contact/expected_error.hpp"
#include "error.hpp"
#include "run/job.hpp"
#include "run/screen.hpp"

using namespace rsc;

namespace {

// Just at a bound is within it, of asperities and of elements; what is not known is not judged.
void at_the_bounds() {
    const Indenter indenter{1.0, 2.5, 0.5, 0.5};
    SolverOptions options;
    options.mean_spacing = 0.125, options.sigma = 0.5, options.surface = {0, 0, 1, 1};
    for (const bool pixels : {false, true})
        for (const auto& [x, y, a, large, edge] : {std::tuple{0.5, 0.5, 0.03125, 0, 0},
                                                   {0.5, 0.5, 0.031251, 1, 0},
                                                   {0.125, 0.5, 0.01, 0, 0},
                                                   {0.124999, 0.5, 0.01, 0, 1},
                                                   {0.875, 0.875, 0.01, 0, 0},
                                                   {0.5, 0.875001, 0.01, 0, 1},
                                                   {0.75, 0.5, 0.3, 1, 2}}) {
            Level level;
            level.add_contact(0, x, y, 1.0, a, 0.001);
            (pixels ? judge_edges : judge_range)(level, indenter, options);
            const int at_border = edge > 0;  // also a contact that itself reaches so far
            CHECK(level.large_contacts == large && level.edge_contacts == at_border);
            CHECK((level.status == LevelStatus::out_of_validity) == (at_border > 0 || (large > 0 && !pixels)));
            SolverOptions unknown;
            Level other;
            other.add_contact(0, x, y, 1.0, a, 0.001);
            other.separation = -1e9;
            (pixels ? judge_edges : judge_range)(other, indenter, unknown);
            CHECK(other.large_contacts == 0 && other.edge_contacts == 0 && other.status == LevelStatus::converged);
            unknown.surface = options.surface;  // no mean distance: those that reach the border
            (pixels ? judge_edges : judge_range)(other, indenter, unknown);
            CHECK(other.large_contacts == 0 && other.edge_contacts == (edge == 2));
        }
    for (const auto& [Z0, deep] : {std::pair{-1.5, false}, {-1.5000001, true}}) {
        Level level;
        level.separation = Z0;
        judge_range(level, indenter, options);
        CHECK((level.status == LevelStatus::out_of_validity) == deep && level.nominal_area == 0);
    }
    Level beyond;
    beyond.beyond_law = 1;
    judge_range(beyond, indenter, options);
    CHECK(beyond.status == LevelStatus::out_of_validity);
    LevelValues area;
    for (const auto& [share, more] : {std::pair{1.0, false}, {1 + 9e-10, false}, {1 + 2e-9, true}}) {
        area.nominal_area = 2, area.area = 2 * share;
        CHECK(exceeds_nominal_area(area) == more);
    }
    area.nominal_area = 0;
    CHECK(!exceeds_nominal_area(area));
}

// Elements: contacts near the border count, their size and depth do not.
void elements() {
    HeightMap map;
    map.allocate(40, 40, 40);
    map.dx = map.dy = 0.025;
    SolverOptions options;
    options.sigma = 0.01;
    options.mean_spacing = 0.1;
    options.surface = {0, 0, 1, 1};
    for (const auto& [x, edge] : {std::pair(0.5, 0), std::pair(0.05, 1)}) {
        for (int j = 0; j < 40; ++j)
            for (int i = 0; i < 40; ++i) map.row(j)[i] = -0.5 * (std::pow(i * 0.025 - x, 2) + std::pow(j * 0.025 - 0.5, 2));
        const Level level = make_element_contact(map, {1.0, 1e6, 0.5, 0.5}, options)->at_separation(-0.0005);
        CHECK(level.contacts == 1 && level.edge_contacts == edge);
        CHECK(level.status == (edge > 0 ? LevelStatus::out_of_validity : LevelStatus::converged));
        // The disc about the tip that holds all pixels: the one at x and its four neighbours.
        CHECK(level.pixels.index.size() == 5);
        const double side = 0.025, beside = std::hypot(0.5 - x + 1.5 * side, 0.5 * side);
        CHECK_RELATIVE(level.nominal_area, std::min(1.0, std::numbers::pi * beside * beside), 1e-12);
    }
    // Deep, the one contact is larger than a quarter of <d>: it counts, and nothing is said against it. Pressures by pixel: Hertz's are
    // above p of their largest value p0 on the share 1 - (p/p0)^2 of the area.
    for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i) map.row(j)[i] = -0.5 * (std::pow(i * 0.025 - 0.51, 2) + std::pow(j * 0.025 - 0.49, 2));
    const double a = 0.25, p0 = 2 * a / std::numbers::pi;
    const Level level = make_element_contact(map, {1.0, 1e6, 0.51, 0.49}, options)->at_separation(-a * a);
    CHECK(level.contacts == 1 && level.large_contacts == 1 && level.status == LevelStatus::converged);
    CHECK(level.area <= level.nominal_area && level.nominal_area < 1.4 * level.area);
    CHECK_CLOSE(level.extreme_area_fraction, 1 - std::pow(kExtreme / p0, 2), 0.03);  // a tenth of a is a pixel
}

}  // namespace

TESTS {
    at_the_bounds();
    elements();
}
