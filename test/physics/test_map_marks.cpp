// Points of a measured map that asperities do not represent: those of its border, and spikes one
// point wide.
#include "check.hpp"
#include "height_maps.hpp"

#include "asperities/asperity_contact.hpp"
#include "elements/element_contact.hpp"
#include "run/prepare.hpp"
#include "surface/defects.hpp"
#include "surface/detection.hpp"
#include "trust/expected_error.hpp"

using namespace rsc;

namespace {

constexpr int kPoints = 64;
const Indenter kTip{1e5, std::numeric_limits<double>::infinity(), 0.5, 0.5};

HeightMap hills(double at_border, double spike, double x_of_it = 20, double y_of_it = -2) {
    HeightMap map = height_map(kPoints, kPoints, 1.0 / kPoints, 1.0 / kPoints, [=](int i, int j) {
        const auto hill = [&](double x, double y) {
            return std::exp(-(std::pow(i - x, 2) + std::pow(j - y, 2)) / 50);
        };
        return 1e-3 * (hill(30, 34) + at_border * hill(x_of_it, y_of_it) +
                       1e-2 * std::sin(0.5 * i) * std::sin(0.4 * j));
    });
    map.row(50)[50] += spike;
    return map;
}

Level press(const HeightMap& map, double separation) {
    const Breaks breaks = find_breaks(map, 0);
    SummitCount count;
    const Asperities a =
        find_asperities(map, Curvature::geometric, &count, 1, Detail::subgrid, 0, &breaks);
    SolverOptions options{.law = LawKind::fourth_order,
                          .sigma = 2e-4,
                          .mean_spacing = 0.1,
                          .rms_slope = 0.01,
                          .surface = {0, 0, 1, 1},
                          .marks = marks_of(map, breaks)};
    const auto contact = make_asperity_contact(a, kTip, options);
    return contact->at_separation(separation);
}

TEST(border) {
    CHECK(press(hills(0, 0), 5e-4).edge_contacts == 0);
    // the hill behind the border stands higher than the one inside
    const Level cut = press(hills(1.5, 0), 5e-4);
    CHECK(cut.edge_contacts == 1 && cut.status == LevelStatus::out_of_validity);
    for (const auto& [x, y] : {std::pair{20, 65}, {-2, 20}, {65, 20}})
        CHECK(press(hills(1.5, 0, x, y), 5e-4).edge_contacts == 1);
    // The expected error contains what elements carry there.
    for (const double at_border : {1.1, 1.5, 4.0}) {
        const HeightMap map = hills(at_border, 0);
        const Level told = press(map, 5e-4),
                    truth = make_element_contact(map, kTip, {.sigma = 2e-4})->at_separation(5e-4);
        CHECK(std::abs(truth.force / told.force - 1) > 0.1);
        CHECK(std::abs(truth.force - told.force) < told.force_error_expected * told.force);
        CHECK(told.error_cause == kBorderCause);
    }
    CHECK(press(hills(0.3, 0), 5e-4).edge_contacts == 0);    // too low to touch
    CHECK(press(hills(1.5, 0), 1.2e-3).edge_contacts == 1);  // nothing else touches
}

TEST(spikes) {
    const HeightMap map = hills(0, 2e-3);
    CHECK(find_breaks(map, 0).spikes.size() == 1);
    const Level on_spike = press(map, 5e-4), without = press(hills(0, 0), 5e-4);
    CHECK(on_spike.status == LevelStatus::out_of_validity);
    CHECK(on_spike.force_error_expected > without.force_error_expected + 0.2);
}

}  // namespace
