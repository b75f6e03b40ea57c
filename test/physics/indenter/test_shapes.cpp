// Indenters of every shape: smooth ones by elements against closed forms, each with its order in
// the pixel; lateral forces against the energy.
#include "check.hpp"
#include "contact/answers.hpp"
#include "physics/friction/contact_curve.hpp"
#include "physics/friction/friction.hpp"
#include "physics/indenter/shapes.hpp"
#include "support/asperities.hpp"
#include "support/height_maps.hpp"
#include "support/paths.hpp"

namespace test_shapes {

using namespace rsc;

constexpr double kE = 100;

// The origin between points, or on one.
HeightMap flat_map(int nx, int ny, double h) {
    HeightMap map = ::flat_map(nx, ny, h, h);
    map.x0 = -0.5 * h * (nx - 1);
    map.y0 = -0.5 * h * (ny - 1);
    return map;
}

SolverOptions elements(double tolerance = 1e-8) {
    return {.tolerance = tolerance, .max_iterations = 500};
}

Shape shape(const char* name, const ShapeKeys& keys) {
    return make_shape(shape_number(name), keys);
}

// Force and area at a depth on n x n points over `side`, against the closed form. The error falls
// at least as h^order.
void closed_form(const char* name, const ShapeKeys& keys, double depth, double side, int n,
                 double force_error, double area_error, double order) {
    const Shape s = shape(name, keys);
    const auto truth = s->smooth(kE);
    CHECK(truth.has_value());
    double errors[2];
    for (const int k : indices(2)) {
        const int points = k == 0 ? n : 4 * n;
        const HeightMap map = flat_map(points, points, side / points);
        const auto contact = make_element_contact(map, {kE, s, 0, 0}, elements());
        const Level level = contact->at_separation(-depth);
        errors[k] = std::abs(level.force / truth->force(depth) - 1);
        if (k == 1) {
            CHECK_RELATIVE(level.force, truth->force(depth), force_error);
            CHECK_RELATIVE(level.area, truth->area_under(truth->force(depth)), area_error);
        }
    }
    if (order > 0)
        CHECK(errors[1] <= std::max(errors[0] * std::pow(0.25, order), 0.2 * force_error));
}

// F = -dW/d(x0, y0) by central differences.
template <class Make>
void lateral(const char* name, const ShapeKeys& keys, double depth, double step, double tolerance,
             Make make) {
    Indenter tip{kE, shape(name, keys), 0.013, -0.021};
    const auto at = [&](double dx, double dy, Level& level) {
        Indenter there = tip;
        there.x0 += dx;
        there.y0 += dy;
        const std::unique_ptr<Path> contact = make(there);
        level = contact->at_separation(-depth);
        return contact->energy();
    };
    Level level, other;
    at(0, 0, level);
    const Vec2 force = lateral_force(tip, level);
    const double fx = -(at(step, 0, other) - at(-step, 0, other)) / (2 * step),
                 fy = -(at(0, step, other) - at(0, -step, other)) / (2 * step);
    CHECK(level.contacts > 0);
    const double size = std::hypot(force.x, force.y);
    CHECK(std::hypot(force.x - fx, force.y - fy) <= tolerance * size);
}

// Smooth bodies with friction: N grows as the approach to some power p, so Q = mu N [1 - (1 -
// xi/xi_full)^p] (Cattaneo and Mindlin's for p = 3/2; a punch sticks all over until it slides).
void friction(const char* name, const ShapeKeys& keys, double depth, double side) {
    const Shape s = shape(name, keys);
    const HeightMap map = flat_map(49, 49, side / 49);  // a point under the tip
    const auto one = make_element_contact(map, {kE, s, 0, 0}, elements()),
               other = make_element_contact(map, {kE, s, 0, 0}, elements());
    ContactCurve curve(*one, *other);
    const Friction mu{0.3, 0.8};
    const double full = full_slip(curve, mu, depth), N = curve.load(depth).force,
                 p = s->smooth(kE)->force_power;
    CHECK_RELATIVE(full, 0.3 / 0.8 * depth, 1e-9);
    for (const auto& point : slide_to(curve, mu, depth, {0.3 * full, 0.7 * full, full})) {
        constexpr double kCoarse = 0.01;  // of elements on so few points
        CHECK_CLOSE(point.force / (0.3 * N), 1 - std::pow(1 - point.displacement / full, p),
                    kCoarse);
    }
}

// Two spheres, and a ball in a socket (R < 0), at contacts too wide for paraboloids: forces and
// depths of the axisymmetric contact are linear in the gap, so each is the sum of Segedin's for one
// sphere (Sneddon 1965, eq. 6.15).
TEST(two_spheres) {
    for (const double R_rough : {kInfinity, 1.0, -2.0}) {
        ShapeKeys keys;
        keys.R = 1;
        keys.R_rough = R_rough;
        const double a = 0.4;
        double depth = 0, force = 0;
        for (const double R : {1.0, R_rough}) {
            if (std::isinf(R)) continue;
            const double log = std::log((R + a) / (R - a));
            depth += 0.5 * a * log;
            force += kE * (0.5 * (a * a + R * R) * log - a * R);
        }
        constexpr int n = 96;
        const HeightMap map = flat_map(n, n, 2.5 * a / n);
        const auto contact =
            make_element_contact(map, {kE, shape("sphere", keys), 0, 0}, elements());
        const Level level = contact->at_separation(-depth);
        CHECK_RELATIVE(level.force, force, 1e-3);  // of 38 points in a; paraboloids: 2 or 3 %
        CHECK_RELATIVE(level.area, pi * a * a, 1e-2);
    }
}

// Two maps that repeat: heights add, so a flat on their sum carries the same at the same distance
// of mean planes.
TEST(two_maps) {
    constexpr int n = 32;
    const double q = 2 * pi / n;
    const auto one_of = [&](auto height) {
        HeightMap map = height_map(n, n, 1.0 / n, 1.0 / n, height);
        map.x0 = map.y0 = -0.5 * (n - 1) / n;
        map.periodic = true;
        return map;
    };
    const auto z = [q](int i, int j) { return 3e-3 * std::cos(2 * q * i) * std::cos(3 * q * j); };
    const auto w = [q](int i, int j) { return 2e-3 * std::sin(4 * q * i + q * j); };
    const HeightMap first = one_of(z),
                    sum = one_of([&](int i, int j) { return z(i, j) + w(i, j); });
    auto second = std::make_shared<HeightMap>(one_of(w));
    ShapeKeys keys;
    keys.map = second;
    const Indenter body{kE, shape("map", keys), 0, 0, {1, 1}},
        flat{kE, Shape(kInfinity), 0, 0, {1, 1}};
    const auto two = make_element_contact(first, body, elements()),
               one = make_element_contact(sum, flat, elements());
    for (const double Z0 : {3e-3, 1e-3}) {
        const double N = two->at_separation(Z0).force;
        CHECK(N > 0);
        CHECK_RELATIVE(N, one->at_separation(Z0).force, 1e-6);
    }
}

TEST(all_shapes) {
    ShapeKeys keys;
    keys.R = 1;
    keys.slope = 0.1;
    keys.radius = 0.05;
    // Hertz's ellipse (Johnson 1985, section 4.2). Turned along the diagonal it is the same
    // contact.
    for (const double ratio : {3.0, 10.0}) {
        keys.radii[0] = 1;
        keys.radii[1] = ratio;
        closed_form("paraboloid", keys, 1e-3, ratio > 3 ? 0.24 : 0.16, 24, 1e-3, 1.5e-2, 0.5);
    }
    keys.angle = 0.25 * pi;
    keys.radii[1] = 3;
    closed_form("paraboloid", keys, 1e-3, 0.16, 24, 1e-3, 1.5e-2, 0.5);
    closed_form("cone", keys, 5e-3, 0.1, 24, 1e-3, 1.5e-2, 0.5);
    closed_form("punch", keys, 1e-3, 0.12, 24, 1e-2, 2e-2, 0.5);

    for (const char* name : {"paraboloid", "cone", "punch"})
        friction(name, keys, name[0] == 'c' ? 5e-3 : 1e-3, 0.14);

    // Lateral forces of every shape, on asperities and on the points of a surface.
    keys.rim_radius = 0.5;
    keys.angle = 0.4;
    keys.radii[0] = 0.5;
    keys.radii[1] = 2;
    HeightMap rough = flat_map(48, 48, 1.0 / 48);
    const double q = 2 * pi / 48;
    keys.map =
        std::make_shared<HeightMap>(height_map(96, 96, 1.0 / 48, 1.0 / 48, [q](int i, int j) {
            return 4e-3 * std::sin(2 * q * i + 1) * std::cos(3 * q * j);
        }));
    for (const int j : indices(48))
        for (const int i : indices(48))
            rough.row(j)[i] = 3e-3 * std::cos(4 * q * i) * std::cos(3 * q * j + 0.3 * i * q);
    Asperities asperities = random_asperities(300, 0.005, 0.01, 1e-3, 0.02, 5);
    for (double& x : asperities.x) x -= 0.5;
    for (double& y : asperities.y) y -= 0.5;
    for (const ShapeRow& row : kShapes) {
        SolverOptions precise{.tolerance = 1e-12};
        lateral(row.name, keys, -0.002, 1e-6, 1e-6, [&](const Indenter& tip) {
            return make_asperity_contact(asperities, tip, precise);
        });
        lateral(row.name, keys, 4e-3, 1e-6, 1e-6, [&](const Indenter& tip) {
            return make_element_contact(rough, tip, elements(1e-11));
        });
    }
}

}  // namespace test_shapes
