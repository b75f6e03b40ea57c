// Deflections and fields of contacts with adhesion, and fields of elliptic spots
// (contact/deflection.hpp, observe/fields.hpp).
#include "contact/deflection.hpp"
#include "observe/fields.hpp"
#include "support/adhesive_paths.hpp"
#include "support/height_maps.hpp"

namespace test_adhesive_fields {

using namespace rsc;

// Boussinesq's integral 1/(pi E*) int int p dl dphi over the chords of the disc of radius c through
// a point at the distance d, by the midpoint rule; l = L sin(t) along a half chord L, which removes
// the singularity of the pressure at the edge.
template <class Pressure>
double boussinesq(Pressure&& pressure, double c, double d) {
    constexpr int n = 1000;
    const double widest = d > c ? std::asin(c / d) : pi / 2;
    double sum = 0;
    for (const int j : indices(n)) {
        const double s = (2 * j + 1.0) / n - 1,
                     angle = widest * std::sin(pi / 2 * s);  // dense at the tangents
        const double h = d * std::sin(angle), half = std::sqrt(std::max(c * c - h * h, 0.0));
        double chord = 0;
        for (const int i : indices(n)) {
            const double t = pi / 2 * ((2 * i + 1.0) / n - 1), l = half * std::sin(t);
            chord += pressure(std::sqrt(h * h + l * l)) * half * std::cos(t) * pi / n;
        }
        sum += chord * widest * std::cos(pi / 2 * s) * pi / n;
    }
    return sum / (pi * kE);
}

TEST(test_tension) {
    constexpr double c = 0.02, s0 = 3.0;
    for (const double share : {0.0, 0.5, 0.9, 1.0}) {  // a/c; 1: JKR
        const double a = share * c, e2 = c * c - a * a;
        const auto pressure = [&](double r) {
            if (share == 1) return -s0 / std::sqrt(1 - std::min(r * r / (c * c), 1 - 1e-14));
            return r < a ? -2 * s0 / pi * std::atan(std::sqrt(e2 / (a * a - r * r))) : -s0;
        };
        double force = 0;
        constexpr int n = 200000;
        for (const int k : indices(n)) {
            const double t = pi / 2 * (k + 0.5) / n, r = c * std::sin(t);
            force += 2 * pi * r * pressure(r) * c * std::cos(t) * pi / 2 / n;
        }
        for (const double ratio : {0.0, 0.3, 0.7, 0.95, 1.2, 3.0, 20.0})
            CHECK_RELATIVE(tension_deflection(force, a, c, ratio * c, kE),
                           boussinesq(pressure, c, ratio * c), 1e-4);
        // Continuous at both edges; far away that of a point force.
        for (const double edge : {a, c})
            if (edge > 0)
                CHECK_RELATIVE(tension_deflection(force, a, c, edge * (1 + 1e-12), kE),
                               tension_deflection(force, a, c, edge, kE), 1e-5);
        for (const double d : {1e4 * c, 1e7 * c})
            CHECK_RELATIVE(tension_deflection(force, a, c, d, kE), force / (pi * kE * d), 1e-8);
    }
}

const Asperities kOne = asperities_at({{0.5, 0.5, 0.1, 0.7}});

// The deflected surface of one asperity touches the flat in the contact and is below it around.
// With a range the gap at the edge of the ring is the range. The deflection times half of the
// pressure, less w times the contact area, is the energy.
TEST(test_one) {
    constexpr double w = 0.01, r = 0.7;
    const auto kernel = make_kernel(Interaction::point, Substrate(kE), {});
    for (const double range : {0.0, 0.004, 0.02}) {
        const auto contact = under_flat(kOne, sticky(w, range));
        for (const double u : {-0.5 * range, 0.01, 0.03, 0.0, -0.003}) {
            const Level level = contact->at_separation(0.1 - u);
            if (level.tractions.x.empty()) continue;
            const double a = level.tractions.a[0], c = level.tractions.c[0];
            const auto w_at = [&](double d) {
                return deflection(level, *kernel, 0.5 + 0.6 * d, 0.5 + 0.8 * d);
            };
            const auto gap = [&](double d) { return d * d / (2 * r) - u + w_at(d); };
            for (const double share : {0.1, 0.6, 0.99})
                CHECK_CLOSE(gap(share * a), a > 0 ? 0.0 : gap(0), 1e-10 * c * c / r);
            double before = 0;
            for (const double share : {0.01, 0.1, 0.3, 0.8, 1.0}) {  // it opens throughout the ring
                if (c > a)
                    CHECK(gap(a + share * (c - a)) > before &&
                          gap(a + share * (c - a)) <= range * (1 + 1e-9));
                if (c > a) before = gap(a + share * (c - a));
            }
            if (range > 0) CHECK_RELATIVE(gap(c), range, 1e-9);
            for (const double share : {1.001, 1.1, 2.0, 10.0}) CHECK(gap(share * c) > range);
            CHECK_RELATIVE(w_at(1e5 * c), level.force / (pi * kE * 1e5 * c), 1e-6);
            if (range > 0) continue;
            const double pulled = level.tractions.pulled[0], pressed = level.tractions.pressed[0];
            CHECK_RELATIVE(pulled * pulled, 8 * pi * kE * w * a * a * a,
                           1e-9);  // Griffith: K^2/(2 E*) = w
            double elastic = 0;
            constexpr int n = 2000;
            for (const int k : indices(n)) {
                const double t = pi / 2 * (k + 0.5) / n;
                const double p = 1.5 * pressed / (pi * a * a) * std::cos(t) +
                                 pulled / (2 * pi * a * a) / std::cos(t);
                elastic += 0.5 * p * w_at(a * std::sin(t)) * 2 * pi * a * a * std::sin(t) *
                           std::cos(t) * pi / 2 / n;
            }
            CHECK_CLOSE(elastic - w * pi * a * a, contact->energy(),
                        1e-5 * (elastic + w * pi * a * a));
        }
    }
}

HeightMap map_of(int n, double step, double r) {
    const double half = 0.5 * (n - 1);
    HeightMap map = height_map(n, n, step, step, [=](int i, int j) {
        return 0.1 - 0.5 * (std::pow((i - half) * step, 2) + std::pow((j - half) * step, 2)) / r;
    });
    map.x0 = map.y0 = 0.5 - half * step;
    return map;
}

FieldsAsked everything() {
    FieldsAsked asked;
    asked.pressure = asked.gap = asked.contact = true;
    return asked;
}
const FieldsAsked kAll = everything();

// On oblong pixels: a point that yielded is lower by its residual depth where nothing touches, and
// pressures add up to the force.
TEST(test_oblong) {
    const HeightMap map = height_map(4, 3, 0.5, 2, [](int i, int j) { return 0.1 * i - 0.2 * j; });
    const Indenter tip{kE, kInfinity, 1.0, 2.0};
    Level open, pressed;
    open.separation = 5;
    pressed.add_contact(0, 0.8, 2.1, 1.5, 1.0, 0.1);
    const Fields f = fields_of(map, tip, Interaction::point,
                               {{0, &open, {{0.5}, {4.0}, {0.03}}}, {1, &pressed, {}}}, kAll);
    for (const int k : indices(12))
        CHECK_CLOSE(f.gap[k], 5 - map(k % 4, k / 4) + (k == 9 ? 0.03 : 0), 1e-14);
    CHECK_RELATIVE(std::accumulate(f.pressure.begin() + 12, f.pressure.end(), 0.0) * 0.5 * 2, 1.5,
                   1e-14);
}

// Fields of one asperity: the pressures at the points are those of the closed form and add up to
// the force, the points in contact to the area.
TEST(test_asperity_fields) {
    const Indenter tip{kE, kInfinity, 0.5, 0.5};
    const auto kernel = make_kernel(Interaction::point, Substrate(kE), {});
    for (const double range : {0.0, 0.004}) {
        const Level level =
            make_asperity_contact(kOne, tip, sticky(0.01, range))->at_separation(0.095);
        const double a = level.tractions.a.at(0), c = level.tractions.c.at(0), step = c / 60;
        const HeightMap map = map_of(201, step, 0.7);
        const Fields f = fields_of(map, tip, Interaction::point, {{0, &level, {}}}, kAll);
        double force = 0, area = 0;
        for (const auto k : indices(f.pressure)) {
            const double d = std::hypot(f.x[k % f.x.size()] - 0.5, f.y[k / f.x.size()] - 0.5),
                         p = f.pressure[k];
            force += p * step * step;
            area += f.contact[k] * step * step;
            if (std::abs(d - a) < 1e-9 * a || std::abs(d - c) < 1e-9 * a) continue;
            CHECK((p != 0) == (d < c));
            CHECK((f.contact[k] != 0) == (d < a));
            CHECK(f.gap[k] >= 0);
            if (d < a) CHECK(f.gap[k] == 0);
            if (d < 0.96 * a && range == 0) {
                const double root = std::sqrt(1 - d * d / (a * a));
                const double expected = 1.5 * level.tractions.pressed[0] / (pi * a * a) * root +
                                        level.tractions.pulled[0] / (2 * pi * a * a) / root;
                CHECK_CLOSE(p, expected, 0.01 * 1.5 * level.tractions.pressed[0] / (pi * a * a));
            }
            if (d > a && d < c) CHECK_RELATIVE(p, -0.01 / range, 0.01);
            const double own = d * d / (2 * 0.7) - 0.005 +
                               deflection(level, *kernel, f.x[k % f.x.size()], f.y[k / f.x.size()]);
            if (d > 1.1 * c) CHECK_CLOSE(f.gap[k], own, 0.01 * c * c / 0.7);
        }
        CHECK_RELATIVE(force, level.force, 1e-12);
        CHECK_RELATIVE(area, level.area, 0.01);
    }
}

// Elements: the fields are those of the solution, free and periodic, also where pixels attract
// without contact.
TEST(test_element_fields) {
    constexpr double w = 0.02, range = 0.02, step = 0.008;
    const HeightMap map = map_of(48, step, 0.3);
    for (const bool periodic : {false, true}) {
        Indenter tip{kE, kInfinity, 0.5, 0.5};
        if (periodic) tip.period = {map.Lx(), map.Ly()};
        SolverOptions options = sticky(w, range);
        options.tolerance = 1e-9;
        const auto contact = make_element_contact(map, tip, options);
        const auto kernel = make_kernel(Interaction::point, Substrate(kE), tip.period);
        for (const double Z : {0.11, 0.09, 0.1}) {
            const Level level = contact->at_separation(Z);
            CHECK(level.converged);
            FieldsAsked asked = kAll;
            asked.window = {0, 1, 0, 1};
            const Fields f = fields_of(map, tip, Interaction::point, {{0, &level, {}}}, asked);
            double force = 0, cohesive = 0;
            for (const auto k : indices(f.pressure)) {
                const double p = f.pressure[k], g = f.gap[k], area = step * step;
                force += p * area;
                if (f.contact[k] == 0) cohesive -= p * range / w * area;
                CHECK(p >= -w / range * (1 + 1e-9));
                if (f.contact[k] != 0) CHECK(g == 0);
                if (f.contact[k] == 0 && f.gap[k] > 3 * range) CHECK(p == 0);
                if (f.contact[k] == 0) CHECK(p <= 0);
                if (periodic || k % 97 != 0) continue;
                const double x = f.x[k % f.x.size()], y = f.y[k / f.x.size()];
                const double own = Z - 0.1 +
                                   0.5 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)) / 0.3 +
                                   deflection(level, *kernel, x, y);
                CHECK_CLOSE(g, own, 1e-5 * range);
            }
            CHECK_CLOSE(force, level.force, 1e-10 * w);
            CHECK_CLOSE(cohesive, level.cohesive_area, 1e-10);
        }
    }
}

// A window holds the points within it, whatever the steps.
TEST(test_window) {
    const HeightMap map = height_map(40, 60, 0.02, 0.01, [](int, int) { return 0.0; });
    Level level;
    level.separation = 1;
    FieldsAsked asked = kAll;
    asked.window = {0.095, 0.505, 0.195, 0.305};
    const Fields f =
        fields_of(map, {kE, kInfinity, 0.5, 0.5}, Interaction::point, {{0, &level, {}}}, asked);
    CHECK(f.x.size() == 21 && f.y.size() == 11);
    CHECK_CLOSE(f.x.front() + f.x.back(), 0.6, 1e-12);
    CHECK_CLOSE(f.y.front() + f.y.back(), 0.5, 1e-12);
}

// Fields of an elliptic spot beside its summit: its points touch, and its pressure is Hertz's, with
// the second moments a^2/5 and b^2/5.
TEST(test_elliptic_spot) {
    constexpr double a = 0.2, b = 0.05, angle = 0.7, f = 3.0;
    Level level;
    level.add_contact(0, 0.5, 0.5, f, std::sqrt(a * b), 1e-3);
    level.spots = {{0.53, 0.46, a, b, angle}};
    const double step = 0.002;
    const Fields fields = fields_of(map_of(501, step, 0.7), {kE, kInfinity, 0.5, 0.5},
                                    Interaction::point, {{0, &level, {}}}, kAll);
    double force = 0, area = 0, x = 0, y = 0, along = 0, across = 0;
    for (const auto k : indices(fields.pressure)) {
        const double dx = fields.x[k % fields.x.size()] - 0.53,
                     dy = fields.y[k / fields.x.size()] - 0.46,
                     p = fields.pressure[k] * step * step;
        const double s = dx * std::cos(angle) + dy * std::sin(angle),
                     t = dy * std::cos(angle) - dx * std::sin(angle);
        CHECK((fields.contact[k] != 0) == (s * s / (a * a) + t * t / (b * b) < 1));
        force += p;
        area += fields.contact[k] * step * step;
        x += p * dx;
        y += p * dy;
        along += p * s * s;
        across += p * t * t;
    }
    CHECK_RELATIVE(force, f, 1e-12);
    CHECK_RELATIVE(area, pi * a * b, 5e-3);
    CHECK(std::hypot(x, y) < 1e-3 * f * b);
    CHECK_RELATIVE(along / f, a * a / 5, 5e-3);
    CHECK_RELATIVE(across / f, b * b / 5, 5e-3);
}

}  // namespace test_adhesive_fields
