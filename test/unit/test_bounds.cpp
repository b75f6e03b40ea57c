// What asperities tell of their errors, one test for each cause that the fit of the bounds did not
// contain, against elements on the same surface with 8 points in the shortest wave, whose own
// errors are below 1 %.
#include "base/format.hpp"
#include "case/registry.hpp"
#include "check.hpp"
#include "run/job.hpp"
#include "run/prepare.hpp"
#include "trust/expected_error.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;

namespace {

constexpr double kFlat = std::numeric_limits<double>::infinity(), kElements = 0.01;

std::vector<Level> pressed(Case c, Model model) {
    c.solver.model = model;
    return realize(prepare(c), 1, 1).levels;
}

struct Error {
    double N = 0, A = 0;
};
// Relative differences from elements; none of them is larger than what the level tells, and none of
// status 0 larger than 10 %.
std::vector<Error> told_errors(Case c, LawKind law) {
    c.asperities.law = law;
    const std::vector<Level> levels = pressed(c, Model::asperities),
                             truth = pressed(c, Model::elements);
    std::vector<Error> errors;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const Level& level = levels[k];
        errors.push_back({level.force / truth[k].force - 1, level.area / truth[k].area - 1});
        CHECK(std::abs(errors[k].N) <= level.force_error_expected + kElements);
        CHECK(level.status != LevelStatus::converged || std::abs(errors[k].N) < kMuchError);
    }
    return errors;
}

Case surface(std::int64_t seed, double hurst, double longest, double shortest, double sigma,
             int n) {
    Case c;
    c.run.seed = seed;
    c.surface.hurst = hurst, c.surface.L_lambda_l = longest, c.surface.L_lambda_s = shortest,
    c.surface.sigma = sigma, c.surface.n = n;
    c.solids.E[0] = 1.0, c.solids.nu[0] = 0.3;
    return c;
}

void under_a_cone(Case& c, double slope, double x, double y) {
    set_key(c, "indenter%shape", "'cone'");
    c.indenter.slope = slope, c.solids.R[1] = kFlat;
    c.indentation.centre[0] = x, c.indentation.centre[1] = y;
}

// However gentle a cone is, its corner touches flanks beside which no summit of the surface is near
// (N was -40 % of 'fourth_order').
TEST(gentle_cone) {
    Case c = surface(5285837, 0.44, 2.135, 19, 3e-5, 256);
    c.surface.aspect = 8.2, c.surface.direction = 43;
    under_a_cone(c, 3.4e-4, 0.55, 0.554);
    c.indentation.levels = {0.3, -0.4};
    for (const Error& e : told_errors(c, LawKind::fourth_order)) CHECK(std::abs(e.N) < 0.03);
    for (const Error& e : told_errors(c, LawKind::elliptic)) CHECK(std::abs(e.N) < 0.06);
}

// The corner within a contact: a paraboloid is no description of it ('elliptic' -22 %, told 10 %
// and valid), the most loaded ellipse is, also on a coated body.
TEST(corner_within_a_contact) {
    Case c = surface(2536159, 0.5, 1.3, 26, 1.5e-3, 256);
    c.surface.aspect = 5, c.surface.direction = 106;
    c.solids.layer_thickness = {0.1}, c.solids.layer_E = {1.2}, c.solids.layer_nu = {0.34};
    under_a_cone(c, 0.042, 0.39, 0.382);
    c.indentation.levels = {-1.4, -2.05};
    for (const Error& e : told_errors(c, LawKind::fourth_order))
        CHECK(std::abs(e.N) < 0.05 && std::abs(e.A) < 0.06);
    CHECK(std::abs(told_errors(c, LawKind::elliptic).front().N) > 0.15);
}

// Two summits of one ridge are one contact: law 'elliptic' carries 18 % too much (told 6 %, valid).
TEST(summits_of_a_ridge) {
    Case c = surface(5250501, 0.857, 4.22, 13, 5e-3, 256);
    c.surface.aspect = 5.55, c.surface.direction = 70, c.surface.plateau = true,
    c.solids.R[1] = 3.79;
    c.indentation.centre[0] = 0.635, c.indentation.centre[1] = 0.363,
    c.indentation.levels = {2.4, 2.2};
    CHECK(told_errors(c, LawKind::elliptic).front().N > 0.1);
}

// Law 'hertz' takes contacts on the summits of the surface, where a ball touches their flanks
// later: almost all of N is missing.
TEST(summits_instead_of_flanks) {
    constexpr double kMissing = 0.05;  // N -91, -75, -60 %; told were 64, 49, 58 %
    Case c = surface(4060462, 0.877, 3.26, 16, 1.17e-3, 128);
    c.surface.plateau = true, c.solids.R[1] = 4.74;
    c.indentation.centre[0] = 0.62, c.indentation.centre[1] = 0.679,
    c.indentation.levels = {0.57, 0.26, -0.05};
    const std::vector<Level> hertz = pressed(c, Model::asperities),
                             truth = pressed(c, Model::elements);
    for (std::size_t k = 0; k < truth.size(); ++k)
        CHECK(std::abs(hertz[k].force / truth[k].force - 1) <
              hertz[k].force_error_expected + kMissing);
}

// Two flats of which a seventh to two thirds touch: asperities grow into each other, N of
// 'fourth_order' is 76 % too large on the first surface and, with most contacts beyond the law, 47
// % too small on the second (told 27 and 19 %).
TEST(flats_nearly_closed) {
    Case few = surface(1, 0.8, 2, 8, 1e-3, 64), many = surface(3, 1, 1, 16, 1e-3, 128);
    few.indentation.levels = {0.6, 0.3, 0.1}, many.indentation.levels = {0.8, 0.4, 0.2};
    for (Case* c : {&few, &many})
        c->solids.R[1] = kFlat, c->indentation.boundary = Boundary::periodic;
    for (const LawKind law : {LawKind::hertz, LawKind::elliptic, LawKind::fourth_order})
        told_errors(few, law);
    told_errors(many, LawKind::fourth_order);
}

// Yielding contacts: what is told is near the truth, not thirty times as much.
TEST(yielding) {
    // of 'fourth_order'; the true errors are 2, 4, 7 %, told were 170 to 390 %; 'elliptic' at first
    // 18 %
    constexpr double kTold = 0.3;
    Case c = surface(3221843, 0.99, 3, 12, 1.73e-5, 128);
    c.surface.aspect = 3.8, c.surface.direction = 103, c.solids.R[1] = 27.3,
    c.solids.hardness = 6e-5;
    c.indentation.centre[0] = 0.4056, c.indentation.centre[1] = 0.661,
    c.indentation.levels = {0, -0.7, -1.05};
    told_errors(c, LawKind::fourth_order), told_errors(c, LawKind::elliptic);
    c.asperities.law = LawKind::fourth_order;
    for (const Level& level : pressed(c, Model::asperities))
        CHECK(level.plastic_contacts > 0 && level.force_error_expected < kTold);
}

// Law 'hertz' between two rough bodies: without contact it is valid only above the sum of their
// highest points.
TEST(two_rough_bodies_apart) {
    const Folder folder;
    const std::string second = folder / "second.txt";  // three columns
    std::ofstream file(second);
    constexpr int points = 64;
    constexpr double turn = 2 * std::numbers::pi / points;
    for (int j = 0; j < points; ++j)
        for (int i = 0; i < points; ++i)
            file << format("%.6g %.6g %.12g\n", 1.0 * i / points, 1.0 * j / points,
                           1e-3 * std::cos(turn * 9 * i) * std::cos(turn * 7 * j));
    file.close();
    Case c = surface(7, 0.8, 2, 8, 1e-3, 64);
    c.solids.R[1] = kFlat, c.indentation.boundary = Boundary::periodic,
    c.surface.detrend = Detrend::none, c.indenter.file = second;
    set_key(c, "indenter%shape", "'map'");
    c.indentation.levels = {6, 3.4, 3.3};
    const std::vector<Level> hertz = pressed(c, Model::asperities),
                             truth = pressed(c, Model::elements);
    CHECK(hertz[0].contacts == 0 && hertz[0].status == LevelStatus::converged);
    for (const std::size_t k : {1, 2})
        CHECK(truth[k].force > 0 && hertz[k].force == 0 &&
              hertz[k].status == LevelStatus::out_of_validity);
}

}  // namespace
