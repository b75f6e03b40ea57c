// Layers on a half-space: the answer to a wave against all of its boundary conditions, its
// transform against quadrature, limits, and a smooth sphere on a layer against the integral
// equation of the axisymmetric problem.
#include "interaction/layers.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>

#include "check.hpp"
#include "contact/equivalent.hpp"
#include "interaction/lattice.hpp"
#include "physics/hardness/hardness.hpp"
#include "support/asperities.hpp"
#include "support/height_maps.hpp"
#include "support/paths.hpp"
#include "truth/elimination.hpp"

namespace test_layers {

using namespace rsc;

LayeredBody body_of(const std::vector<Layer>& layers, double E, double nu) {
    LayeredBody body;
    for (const Layer& layer : layers) body.layer[body.count++] = layer;
    body.E = E;
    body.nu = nu;
    return body;
}

// T by Airy's function f(z) cos kx in each layer, f = (A + B z) exp(-k z) + (C + D z) exp(k (z -
// h)), A + B z in the base, all coefficients from all conditions at once: tractions at the surface,
// tractions and displacements continuous (6 for one layer), in long double.
double by_boundary_conditions(const LayeredBody& body, double wavenumber) {
    using Real = long double;
    const std::size_t layers = body.count;
    const bool rigid = std::isinf(body.E);
    const std::size_t n = 4 * layers + (rigid ? 0 : 2);
    const Real k = wavenumber, unit = body.layer[0].E;  // of stresses
    struct State {
        Real along, down, normal, shear;
    };
    // Of the coefficient `which` of a layer of thickness h at the depth z in it.
    const auto state = [&](const Layer& m, int which, Real z) {
        const Real s = which < 2 ? -k : k,
                   grow = which < 2 ? -k * z : k * (z - static_cast<Real>(m.thickness));
        const Real e = std::exp(grow), a = which % 2 ? 0 : 1, b = which % 2;  // f = (a + b z) e
        const Real f = (a + b * z) * e, f1 = s * f + b * e, f2 = s * s * f + 2 * s * b * e,
                   f3 = s * s * s * f + 3 * s * s * b * e;
        const Real nu = m.nu, two_mu = m.E / (1 + nu) / unit;
        return State{((1 - nu) * f2 + nu * k * k * f) / (two_mu * k),
                     ((1 - nu) * f3 - (2 - nu) * k * k * f1) / (two_mu * k * k), -k * k * f,
                     k * f1};
    };
    std::vector<std::vector<Real>> A(n, std::vector<Real>(n, 0));
    std::vector<Real> b(n, 0);
    const Layer base{0, body.E, body.nu};
    std::size_t row = 2;
    for (std::size_t l = 0; l <= layers; ++l) {
        const Layer& below = l < layers ? body.layer[l] : base;
        if (l == 0) {
            for (const int c : indices(4)) {
                const State s = state(below, c, 0);
                A[0][c] = s.normal;
                A[1][c] = s.shear;
            }
            b[0] = -1;
            continue;
        }
        const Layer& above = body.layer[l - 1];
        const int conditions = l == layers && rigid ? 2 : 4;
        const auto put = [&](std::size_t column, const State& s, Real sign) {
            const Real values[] = {s.along, s.down, s.normal, s.shear};
            for (const int c : indices(conditions)) A[row + c][column] = sign * values[c];
        };
        for (const int c : indices(4)) put(4 * (l - 1) + c, state(above, c, above.thickness), 1);
        if (conditions == 4)
            for (const int c : indices((l < layers ? 4 : 2)))
                put(4 * l + c, state(below, c, 0), -1);
        row += conditions;
    }
    const std::vector<Real> x = solved(A, b);
    Real down = 0;
    for (const int c : indices(4)) down += x[c] * state(body.layer[0], c, 0).down;
    const Real nu = body.layer[0].nu;  // a half-space: 2 (1 - nu^2)/(E k)
    return double(down * k / (2 * (1 - nu * nu)));
}

TEST(answers) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto power = [&](double decades) {
        return std::pow(10.0, decades * (2 * uniform(random) - 1));
    };
    for (const int stack : indices(20)) {
        std::vector<Layer> layers;
        for (int l = 0; l < 1 + stack % 4; ++l)
            layers.push_back({0.1 * power(0.7), 1e5 * power(1.5), 0.499 * uniform(random)});
        const LayeredBody body =
            body_of(layers, stack % 5 == 4 ? kInfinity : 1e5 * power(1.5), 0.499 * uniform(random));
        for (const double kh : {0.03, 0.2, 1.0, 3.0, 9.0}) {
            const double k = kh / layers[0].thickness;
            CHECK_RELATIVE(layered_answer(body, k), by_boundary_conditions(body, k), 1e-8);
        }
        // Long waves feel the base alone, short ones the top.
        const double E_1 = layers[0].E / (1 - layers[0].nu * layers[0].nu),
                     E_base = body.E / (1 - body.nu * body.nu);
        if (std::isfinite(body.E)) CHECK_RELATIVE(layered_answer(body, 1e-9), E_1 / E_base, 1e-5);
        CHECK_RELATIVE(layered_answer(body, 18 / layers[0].thickness), 1, 1e-9);
        CHECK_CLOSE(layered_answer(body, 1e5 / layers[0].thickness), 1, 0);
    }
    // Thin, incompressible, on a rigid base: T -> (2/3) x^3, less 0.8 of x^2 of it, without losing
    // digits.
    for (const double x : {1e-6, 1e-4, 1e-2})
        CHECK_RELATIVE(layered_answer(body_of({{1, 3, 0.5}}, kInfinity, 0.3), x), 2 * x * x * x / 3,
                       2 * x * x + 1e-12);
}

// s(d) by quadrature over k, in steps that J0 does not leave behind.
double transformed(const LayeredBody& body, double d) {
    const double h = body.layer[0].thickness, end = 21 / h,
                 E_1 = body.layer[0].E / (1 - body.layer[0].nu * body.layer[0].nu);
    const double step = std::min(0.25 / h, 3 / d);
    double sum = 0;
    for (double k = 0; k < end; k += step)
        sum += boost::math::quadrature::gauss<double, 20>::integrate(
            [&](double q) {
                return (layered_answer(body, q) - 1) * boost::math::cyl_bessel_j(0, q * d);
            },
            k, std::min(end, k + step));
    return sum / (pi * E_1);
}

TEST(transforms) {
    const LayeredBody bodies[] = {
        body_of({{0.3, 78e3, 0.42}}, 130e3, 0.28), body_of({{0.3, 3, 0.5}}, 210e3, 0.3),
        body_of({{0.3, 500e3, 0.2}}, 30e3, 0.3), body_of({{0.3, 10, 0.3}}, kInfinity, 0.3),
        body_of({{0.3, 78e3, 0.42}, {0.1, 300e3, 0.25}, {2.0, 70e3, 0.17}}, 130e3, 0.28)};
    for (const LayeredBody& body : bodies) {
        const double E_1 = body.layer[0].E / (1 - body.layer[0].nu * body.layer[0].nu);
        const auto smooth = make_layers(body, E_1);
        for (const double ratio : {0.0, 1e-4, 0.01, 0.3, 1.0, 4.0, 30.0, 300.0, 1e4}) {
            if (ratio > 300 && &body != bodies) continue;  // the quadrature takes long
            const double d = 0.3 * ratio,
                         point = 1 / (pi * E_1 * std::max(d, 0.3));  // what G is, about
            CHECK_CLOSE(smooth->at(d), transformed(body, d), 1e-9 * point);
        }
        for (const double k : {1e-3, 0.1, 1.0, 10.0, 100.0})
            CHECK_CLOSE(smooth->share(k), layered_answer(body, k) - 1, 1e-9);
        // A second body that deforms, too, takes its part of E*.
        const auto softer = make_layers(body, E_1 / 3);
        CHECK_RELATIVE(softer->at(0.2), smooth->at(0.2), 1e-12);
        CHECK_RELATIVE(softer->share(0.7), smooth->share(0.7) / 3, 1e-12);
    }
}

// A sphere on the body by the integral equation of the axisymmetric problem: with the Hankel
// transform of the pressure written as int_0^a psi(t) cos(k t) dt there is none outside of a, and
//     psi(t) + (2/pi) int_0^a psi(s) int_0^inf (T - 1) cos(k t) cos(k s) dk ds = (E*/pi)(depth -
//     t^2/R),  psi(a) = 0.
struct Pressed {
    double depth, force;
};
Pressed axisymmetric(const LayeredBody& body, double R, double a) {
    constexpr std::size_t n = 40;
    using Gauss = boost::math::quadrature::gauss<double, n>;
    const double h = body.layer[0].thickness,
                 E = body.layer[0].E / (1 - body.layer[0].nu * body.layer[0].nu);
    std::vector<double> t, weight;
    for (const std::size_t i : indices(n / 2))
        for (const int side : {-1, 1}) {
            t.push_back(0.5 * a * (1 + side * Gauss::abscissa()[i]));
            weight.push_back(0.5 * a * Gauss::weights()[i]);
        }
    t.push_back(a);
    weight.push_back(0);
    std::vector<double> k, rest;  // nodes over k, and (T - 1) times their weights
    const double step = std::min(0.25 / h, 2 / a);
    for (double from = 0; from < 20 / h; from += step)
        for (const std::size_t i : indices(n / 2))
            for (const int side : {-1, 1}) {
                k.push_back(from + 0.5 * step * (1 + side * Gauss::abscissa()[i]));
                rest.push_back(0.5 * step * Gauss::weights()[i] *
                               (layered_answer(body, k.back()) - 1));
            }
    std::vector<std::vector<double>> A(n + 1, std::vector<double>(n + 1, 0.0)),
        wave(n + 1, std::vector<double>(k.size()));
    for (std::size_t i = 0; i <= n; ++i)
        for (const auto q : indices(k)) wave[i][q] = std::cos(k[q] * t[i]);
    for (std::size_t i = 0; i <= n; ++i)
        for (std::size_t j = 0; j <= n; ++j) {
            double sum = 0;
            for (const auto q : indices(k)) sum += rest[q] * wave[i][q] * wave[j][q];
            A[i][j] = (i == j ? 1.0 : 0.0) + 2 / pi * weight[j] * sum;
        }
    std::vector<double> flat(n + 1, E / pi), curved;
    for (double x : t) curved.push_back(E / pi * x * x / R);
    flat = solved(A, flat);
    curved = solved(A, curved);
    const double depth = curved[n] / flat[n];
    double force = 0;
    for (const std::size_t i : indices(n))
        force += 2 * pi * weight[i] * (depth * flat[i] - curved[i]);
    return {depth, force};
}

TEST(sphere_on_a_layer) {
    const double R = 50, a = 1;
    const int n = 64;
    const double pixel = 2.6 * a / n;
    HeightMap map = flat_map(n, n, pixel, pixel);
    map.x0 = map.y0 = 0.5 * pixel;
    for (const double ratio : {10.0, 1.0, 0.1})  // of the layer's modulus to the base's
        for (const double h : {0.2, 1.0, 5.0}) {
            const LayeredBody body = body_of({{h * a, 100 * ratio, 0.4}}, 100, 0.3);
            const Pressed truth = axisymmetric(body, R, a);
            Indenter sphere{100 * ratio / (1 - 0.16), R, 0.5 * n * pixel, 0.5 * n * pixel, {}};
            sphere.layers = body;
            const auto contact = make_element_contact(map, sphere, {.tolerance = 1e-5});
            const Level level = contact->at_separation(-truth.depth);
            CHECK_RELATIVE(level.force, truth.force, 0.005);
            CHECK_RELATIVE(level.area, pi * a * a, 0.02);
        }
}

// Numbers of a level that two bodies which are the same must share.
void same(Path& one, const Level& a, Path& other, const Level& b, double tolerance) {
    CHECK(a.status == b.status && a.contacts == b.contacts && a.force > 0);
    CHECK_RELATIVE(a.force, b.force, tolerance);
    CHECK_RELATIVE(a.area, b.area, tolerance);
    CHECK_RELATIVE(one.stiffness(), other.stiffness(), tolerance);
    CHECK_RELATIVE(one.energy(), other.energy(), tolerance);
}

HeightMap rough_map(int n, double h) {
    HeightMap map = height_map(n, n, h, h, [n](int i, int j) {
        return 0.01 * (std::cos(0.9 * i + 0.3 * j) + std::cos(0.5 * i - 0.8 * j + 1) +
                       0.7 * std::sin(0.31 * i * i / n + 0.7 * j));
    });
    map.x0 = map.y0 = 0.5 * h;
    return map;
}

Indenter layered(const LayeredBody& body, double R, double x, double y) {
    const Layer& top = body.count > 0 ? body.layer[0] : Layer{1, body.E, body.nu};
    Indenter tip{top.E / (1 - top.nu * top.nu), R, x, y, {}};
    tip.layers = body;
    return tip;
}

// Equal materials and a thick layer are half-spaces; for elements a layer far thinner than a pixel
// is not there. dW/dZ0 = -N, dN/dZ0 = -S.
TEST(limits) {
    const Asperities asperities = random_asperities(150, 0.02, 0.01, 5e-3, 0.5, 3);
    const HeightMap map = rough_map(40, 0.025);
    const LayeredBody base = body_of({}, 3, 0.3), thick = body_of({{1e7, 3, 0.3}}, 50, 0.1),
                      alike = body_of({{0.2, 3, 0.3}}, 3, 0.3),
                      thin = body_of({{1e-9, 50, 0.1}}, 3, 0.3),
                      bulging = body_of({{0.2, 3, 0.5}}, kInfinity, 0.3);
    SolverOptions options{.law = LawKind::hertz, .tolerance = 1e-9};
    // Shifted by its bulge, a soft layer's kernel is negative nowhere.
    const auto kernel = make_kernel(Interaction::point, substrate_of(layered(bulging, 3, 0, 0)));
    for (double d = 1e-3; d < 1e3; d *= 1.1) CHECK(kernel->at(d, 0) >= 0);
    const auto contact = [&](const LayeredBody& body, int model) -> std::unique_ptr<Path> {
        Indenter tip = layered(body, model == 2 ? kInfinity : 3.0, 0.5, 0.5);
        if (model == 2) tip.period = {map.Lx(), map.Ly()};
        if (model == 0) return make_asperity_contact(asperities, tip, options);
        return make_element_contact(map, tip, options);
    };
    for (const int model : indices(3)) {
        const double Z0 = model == 0 ? 0.0 : 0.012;
        const auto plain = contact(base, model);
        const Level truth = plain->at_separation(Z0);
        for (const LayeredBody* body : {&thick, &alike, &thin}) {
            if (model == 0 && body == &thin)
                continue;  // of the first order in a/h: no limit of asperities
            const auto coated = contact(*body, model);
            const Level level = coated->at_separation(Z0);
            same(*coated, level, *plain, truth, 1e-6);
        }
        const auto soft = contact(bulging, model);
        const double step = model == 0 ? 1e-5 : 1e-6;
        const double up = soft->at_separation(Z0 + step).force, energy_up = soft->energy();
        const double down = soft->at_separation(Z0 - step).force, energy_down = soft->energy();
        const Level level = soft->at_separation(Z0);
        CHECK(level.force > 0 && level.converged);
        CHECK_RELATIVE((energy_up - energy_down) / (2 * step), -level.force, 1e-3);
        CHECK_RELATIVE((up - down) / (2 * step), soft->stiffness(), 3e-2);
    }
}

// The hardness is that of what lies on top: no contact bears more.
TEST(hardness_of_the_top) {
    const Asperities asperities = random_asperities(1200, 0.005, 0.01, 2e-3, 0.5, 3);
    const Indenter tip = layered(body_of({{0.1, 3, 0.4}, {0.1, 9, 0.2}}, 1, 0.3), 100.0, 0.5, 0.5);
    SolverOptions options{.method = Method::direct, .tolerance = 1e-9, .surface = {.sigma = 0.01}};
    const Level elastic = asperity_path(asperities, tip, options).at_separation(0.012);
    options.physics.of<Hardness>().H0 = 1e-2 * elastic.force / elastic.area;
    const Level yields = asperity_path(asperities, tip, options).at_separation(0.012);
    CHECK(yields.force > 0 && yields.force < elastic.force &&
          yields.force <= options.physics.of<Hardness>().H0 * yields.area * (1 + 1e-9));
    // The same table for the same body, as long as it is in use.
    const auto table = layers_of(tip.layers, tip.E_star);
    CHECK(layers_of(tip.layers, tip.E_star) == table);
    // Its share is in proportion to E*.
    CHECK_RELATIVE(2 * layers_of(tip.layers, 0.5 * tip.E_star)->share(3), table->share(3), 1e-12);
}

// Between flats: the sum over images against the sum over modes, and all methods against each
// other; a layer like its base is none.
TEST(repeating) {
    const LayeredBody body = body_of({{0.1, 3, 0.5}, {0.1, 9, 0.2}}, 1, 0.3);
    const double E_1 = 3 / (1 - 0.25), Lx = 2, Ly = 1.5;
    const auto smooth = make_layers(body, E_1);
    const Lattice lattice({Lx, Ly}, smooth.get(), 1 / (pi * E_1)), plain({Lx, Ly});
    for (const auto& [x, y] : {std::pair{0.1, 0.2}, {0.9, 0.7}, {0.37, 0.05}, {1.9, -3.3}}) {
        double sum = 0;
        for (int m = -80; m <= 80; ++m)
            for (int n = -60; n <= 60; ++n) {
                const double kx = 2 * pi * m / Lx, ky = 2 * pi * n / Ly, k = std::hypot(kx, ky);
                if (k > 0)
                    sum += 2 * pi / (Lx * Ly * k) * (layered_answer(body, k) - 1) *
                           std::cos(kx * x + ky * y);
            }
        CHECK_CLOSE(lattice.at(x, y), plain.at(x, y) + sum, 1e-8 * (1 + std::abs(sum)));
        CHECK(lattice.at(x, y) >= lattice.least());
        CHECK_RELATIVE(lattice.nearest_smooth(x + 3 * Lx, y - 2 * Ly), lattice.nearest_smooth(x, y),
                       1e-9);
    }
    const Asperities asperities = random_asperities(800, 0.005, 0.01, 2e-3, 0.5, 3);
    SolverOptions options{.tolerance = 1e-9, .surface = {.sigma = 0.01}};
    const auto between_flats = [&](const LayeredBody& of, Method method) {
        Indenter tip = layered(of, kInfinity, 0.5, 0.5);
        tip.period = {1, 1};
        options.method = method;
        return make_asperity_contact(asperities, tip, options);
    };
    const auto direct = between_flats(body, Method::direct);
    const Level truth = direct->at_separation(0.012);
    CHECK(truth.contacts > 50);
    for (const Method method : {Method::mesh, Method::dgesv}) {
        const auto contact = between_flats(body, method);
        same(*contact, contact->at_separation(0.012), *direct, truth, 1e-8);
    }
    const auto alike = between_flats(body_of({{0.2, 3, 0.3}}, 3, 0.3), Method::direct),
               none = between_flats(body_of({}, 3, 0.3), Method::direct);
    same(*alike, alike->at_separation(0.012), *none, none->at_separation(0.012), 1e-6);
}

}  // namespace test_layers
