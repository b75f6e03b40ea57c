// Levels that leave the range of the model say so: contacts near the border of a free surface, more
// contact area than there is surface under the sphere, a sphere below -3 sigma. And only those.
#include "trust/validity.hpp"

#include "asperities/asperity_contact.hpp"
#include "check.hpp"
#include "elements/element_contact.hpp"
#include "run/job.hpp"
#include "run/screen.hpp"
#include "trust/expected_error.hpp"

using namespace rsc;

namespace {

// Just at a bound is within it. Contacts near the border or large beside the spacing are counted
// once more in test_every_value; what is not known is not judged: test_api.
TEST(at_the_bounds) {
    const Indenter indenter{1.0, 2.5, 0.5, 0.5};
    SolverOptions options{.sigma = 0.5, .mean_spacing = 0.125, .surface = {0, 0, 1, 1}};
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
    for (const auto& [share, more] :
         {std::pair{1.0, false}, {1 + 9e-10, false}, {1 + 2e-9, true}}) {
        area.nominal_area = 2, area.area = 2 * share;
        CHECK(exceeds_nominal_area(area) == more);
    }
    area.nominal_area = 0;
    CHECK(!exceeds_nominal_area(area));
}

// A listed asperity under a sphere not much larger: by Hertz with both radii N is smaller by the
// factor sqrt(1 + r/R), and A by 1 + r/R.
TEST(asperity_under_a_small_ball) {
    for (const auto& [r, R, told] : {std::tuple{1.0, 2.0, true}, {0.1, 2.0, false}}) {
        Asperities one;
        one.x = {0.5}, one.y = {0.5}, one.z = {0}, one.radius = {r};
        const double depth = 1e-6, rim = 1e-6, both = r * R / (r + R);
        const Level level = AsperityContact(one, {1.0, R, 0.5, 0.5}, {}).at_separation(-depth);
        CHECK((level.status == LevelStatus::out_of_validity) == told);
        CHECK_RELATIVE(
            level.force,
            (1 + level.force_error_expected) * 4 / 3.0 * std::sqrt(both) * depth * std::sqrt(depth),
            rim);
        CHECK_RELATIVE(level.area,
                       (1 + level.area_error_expected) * std::numbers::pi * both * depth,
                       rim);  // the curvature at the rim is larger by (a/R)^2
    }
}

}  // namespace
