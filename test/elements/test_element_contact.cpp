// Elements against what is known: Hertz, and themselves by another way (moved, by force, at other
// tolerances, on pixels of other shapes).

#include "check.hpp"
#include "contact/make.hpp"
#include "physics/indenter/shapes.hpp"
#include "support/height_maps.hpp"
#include "support/judged.hpp"
#include "surface/synthesis.hpp"
#include "trust/grid_error.hpp"

namespace test_element_contact {

using namespace rsc;

constexpr double kE = 94706.168;  // the paper's gold under a rigid sphere

SolverOptions options(double tolerance) { return {.tolerance = tolerance, .max_iterations = 200}; }

HeightMap rough(int n, double L_lambda_s, std::int64_t seed) {
    Spectrum spectrum{.L_lambda_s = L_lambda_s};
    return synthesize(spectrum, n, Normalise::sample, seed, 1);
}

// A smooth sphere: N = 4/3 E* sqrt(R) delta^(3/2), a = sqrt(R delta), dN/dZ0 = -2 E* a, W = 2/5 N
// delta. The sphere is a real one, not a paraboloid: delta/R = 1e-6 makes no difference.
TEST(hertz) {
    double error_before = 0;
    for (const double cells : {10.0, 20.0, 40.0}) {  // pixels a contact radius
        const double R = 2.5, a = 2.5e-3, delta = a * a / R, h = a / cells;
        const int n = int(2.6 * cells);
        const HeightMap map = flat_map(n, n, h, h);
        // Off the symmetry of the pixels, so that no luck helps.
        const auto contact = make_element_contact(
            map, {kE, R, (0.5 * n + 0.31) * h, (0.5 * n - 0.17) * h}, options(1e-8));
        const Level level = contact->at_separation(-delta);
        CHECK(level.converged);
        const double N = 4.0 / 3 * kE * std::sqrt(R * delta) * delta;
        const double error = level.force / N - 1, area = level.area / (pi * a * a) - 1,
                     counted = level.area_pixels / (pi * a * a) - 1;
        CHECK(level.contacts == 1);
        CHECK_CLOSE(level.f[0], level.force, 1e-12 * N);
        // Within 0.5 % at 40 pixels a radius is asked for. The error is of second order: each
        // halving of h divides it by four, within what the staircase of the border lets it.
        CHECK(std::abs(error) < 0.1 / (cells * cells));
        if (error_before != 0) CHECK_CLOSE(std::log2(error_before / error), 2.0, 0.5);
        error_before = error;
        CHECK(std::abs(area) < 0.15 / cells);
        CHECK(counted > 0.15 / cells);  // the bias that the correction takes away
        CHECK_RELATIVE(contact->stiffness(), -2 * kE * a, 0.1 / cells);
        CHECK_RELATIVE(contact->energy(), 0.4 * N * delta, 0.2 / (cells * cells));
        CHECK_CLOSE(contact->first_touch(), 0.0, 0.25 * h * h / R);
        // Pixels twice as long as wide see the same sphere.
        const HeightMap longer = flat_map(n / 2, n, 2 * h, h);
        const auto other = make_element_contact(
            longer, {kE, R, (0.5 * n + 0.31) * h, (0.5 * n - 0.17) * h}, options(1e-8));
        CHECK_RELATIVE(other->at_separation(-delta).force, N, 0.4 / (cells * cells));
        // Pressing with the force finds the depth.
        if (cells > 20) continue;
        const Level pressed = other->at_force(N);
        CHECK_RELATIVE(pressed.force, N, 1e-8);
        CHECK_RELATIVE(pressed.separation, -delta, 0.4 / (cells * cells));
    }
}

// What is touched first and what may touch at all are found as by a search through all pixels: for
// a sphere that is small against the blocks of pixels which are looked at together, anywhere, and
// moved from one place to the other.
TEST(selection) {
    const HeightMap map = rough(96, 32, 5);
    const double R = 0.1;
    const auto moved = make_element_contact(map, {kE, R, 0.5, 0.5}, options(1e-4));
    for (const auto& [x0, y0] :
         {std::pair{0.335, 0.49}, {0.49, 0.335}, {0.66, 0.7}, {0.51, 0.01}}) {
        const Indenter tip{kE, R, x0, y0};
        const auto count = [&](double Z0, double& top) {
            int places = 0;
            top = -1;
            for (const int j : indices(map.ny))
                for (const int i : indices(map.nx)) {
                    const double z = tip.clearance(i * map.dx, j * map.dy, map(i, j));
                    if (z > top) top = z;
                    places += z > Z0;
                }
            return places;
        };
        double top = 0;
        count(0, top);
        const double Z0 = top - 0.02;
        const int places = count(Z0, top);
        const auto fresh = make_element_contact(map, tip, options(1e-4));
        moved->move_tip(x0, y0);
        CHECK(fresh->first_touch() == top && moved->first_touch() == top);
        CHECK(places > 10 && fresh->at_separation(Z0).candidates == places &&
              moved->at_separation(Z0).candidates == places);
    }
}

// Levels keep the tolerance that is asked for: N and A beside those of one a thousand times as
// tight, under a sphere and between flats. A pixel more or less counts in A.
TEST(tolerances) {
    const HeightMap map = rough(256, 32, 2);
    for (const double R : {2.5, kInfinity}) {
        const Indenter tip{kE, R, 0.5, 0.5, std::isinf(R) ? Period{1, 1} : Period{}};
        const auto solved = make_element_contact(map, tip, options(1e-7));
        (void)solved->at_separation(0.01);
        for (int rounds = 1; rounds <= 3;
             ++rounds) {  // the set of pixels grows in the second round, which may be the last one
            const auto contact =
                make_element_contact(map, tip, {.tolerance = 1e-7, .max_iterations = rounds});
            CHECK(!contact->at_separation(0.01).converged);
            CHECK_RELATIVE(contact->energy(), solved->energy(), 0.05);
            CHECK_RELATIVE(contact->stiffness(), solved->stiffness(), 0.3);
        }
        for (const double tolerance : {1e-4, 1e-5}) {
            const auto at = [&](double asked) {
                return make_element_contact(map, tip, options(asked))->at_separation(0.01);
            };
            const Level level = at(tolerance), fine = at(1e-3 * tolerance);
            CHECK_RELATIVE(level.force, fine.force, tolerance);
            CHECK_RELATIVE(level.area, fine.area, 2 * tolerance);
        }
    }
}

// A sphere whose top lies between points, on the surface or above it, and a cone with its tip
// there, touch above the highest point: there N = 0 is in doubt. Above the upper bound of where
// they touch between points it is not.
TEST(between_points) {
    const double R = 10, h = 0.01;
    const int n = 40;
    const double x = (0.5 * n + 0.31) * h, y = (0.5 * n - 0.17) * h;
    const auto touches = [&](const HeightMap& map, const Indenter& tip) {
        SolverOptions o = options(1e-8);
        o.surface.sigma = h * h / R;
        const auto contact = make_element_contact(map, tip, o);
        CHECK(contact->first_touch() < 0);  // the top is at 0
        const double above = touch_between_points(map, tip);
        CHECK(above > 0);
        CHECK(judged(contact->at_separation(above), *contact, o, &map).doubts == 0);
        for (const double deep : {0.1, 0.9}) {
            const Level level =
                judged(contact->at_separation(deep * contact->first_touch()), *contact, o, &map);
            CHECK(level.contacts == 0 && level.doubts == bit(Cause::missed_contact));
        }
        CHECK(contact->at_separation(2 * contact->first_touch()).contacts > 0);
    };
    const HeightMap cap = height_map(n, n, h, h, [&](int i, int j) {
        return -(std::pow(i * h - x, 2) + std::pow(j * h - y, 2)) / (2 * R);
    });
    Indenter flat{kE, kInfinity};
    touches(cap, flat);
    flat.period = {n * h, n * h};
    touches(cap, flat);
    touches(flat_map(n, n, h, h), {kE, R, x, y});
    ShapeKeys cone;
    cone.slope = 0.1;
    touches(flat_map(n, n, h, h), {kE, make_shape(shape_number("cone"), cone), x, y});
}

}  // namespace test_element_contact
