// Line contact: surfaces that repeat along one axis. Hertz's line, Lekner's sum, a long free strip.
#include "base/error.hpp"
#include "check.hpp"
#include "contact/make.hpp"
#include "interaction/line_kernel.hpp"
#include "physics/indenter/shapes.hpp"

namespace test_line_contact {

using namespace rsc;

HeightMap map_of(int nx, int ny, double step, const std::function<double(double, double)>& z) {
    HeightMap map;
    map.allocate(nx, ny, nx);
    map.dx = map.dy = step;
    map.x0 = -0.5 * (nx - 1) * step;
    map.y0 = -0.5 * (ny - 1) * step;
    for (const int j : indices(ny))
        for (const int i : indices(nx)) map.row(j)[i] = z(map.x(i), map.y(j));
    return map;
}

// A cylinder of radius R whose axis lies along x or y, on a surface that repeats along its axis if
// the period is finite.
Indenter roller(double R, double E_star, double period, bool along_x = false) {
    ShapeKeys keys;
    keys.radii[0] = along_x ? kInfinity : R;
    keys.radii[1] = along_x ? R : kInfinity;
    Indenter indenter{E_star, make_shape(shape_number("paraboloid"), keys), 0, 0};
    if (std::isfinite(period)) indenter.period = {kInfinity, period};
    if (along_x) std::swap(indenter.period.x, indenter.period.y);
    return indenter;
}

SolverOptions exact() {
    SolverOptions options;
    options.tolerance = 1e-8;
    return options;
}

double flat(double, double) { return 0; }

// Waves along and across the axis, with the period 1 along y.
double rough(double x, double y) {
    return 1e-3 * (std::cos(2 * pi * (3 * y + 0.7)) * std::cos(9 * x) +
                   std::cos(2 * pi * 2 * y + 14 * x) + 0.5 * std::cos(2 * pi * 5 * y - 7 * x));
}

TEST(images_along_a_line) {
    // The plain sum of the first 20 000 images on either side; those beyond give
    // (2 along^2 - across^2)/(2 n^2 L^3) in leading order.
    const double L = 2, D = 3, constant = 2 / L * (std::log(D / (2 * L)) + std::numbers::egamma);
    const LineKernel kernel(L, D);
    constexpr int n = 20000;
    for (const double across : {0.0, 0.1, 0.7, 0.999, 1.001, 1.5, 5.0})
        for (const double along : {0.0, 0.3, -0.7, 0.9}) {
            long double sum = 0;
            for (int k = n; k >= 1; --k)
                sum += 1 / std::hypot((long double)across, along + k * (long double)L) +
                       1 / std::hypot((long double)across, along - k * (long double)L) -
                       2 / (k * (long double)L);
            sum += (2 * along * along - across * across) / (2.0L * n * n * L * L * L);
            CHECK_CLOSE(kernel.images(across, along), double(sum) + constant, 2e-12);
        }
}

TEST(hertz_line) {
    // b = 2 sqrt(P R/(pi E*)), p0 = 2 P/(pi b); a surface as wide as D = 6 b, the reference. The
    // centre is lowered by (2 P/(pi E*)) [ln(2 D/b) + 1/2], the line load's -(2/(pi E*)) ln(x/D)
    // averaged over the pressure; the stiffness per length is pi E*/(2 ln(2 D/b)).
    const double R = 12, E = 1.1e5, P = 50;
    const double b = 2 * std::sqrt(P * R / (pi * E)), p0 = 2 * P / (pi * b);
    const double Z0 = -2 * P / (pi * E) * (std::log(12.0) + 0.5);
    std::vector<double> errors;
    for (const int across : {36, 72, 144}) {  // 6, 12 and 24 pixels over b
        const double step = 6 * b / across;
        const int along = 24;
        const HeightMap map = map_of(across, along, step, flat);
        const double period = along * step;
        const Indenter indenter = roller(R, E, period);
        const auto contact = make_element_contact(map, indenter, exact());
        const Level level = contact->at_force(P * period);
        CHECK(level.converged);
        CHECK_RELATIVE(level.force_per_length, P, 1e-7);
        const double most = *std::ranges::max_element(level.pixels.pressure);
        errors.push_back(std::abs(most / p0 - 1));
        // Equal along the axis.
        const std::size_t each = level.pixels.index.size() / along;
        CHECK(each * along == level.pixels.index.size());
        for (std::size_t k = each; k < level.pixels.pressure.size(); ++k)
            CHECK_CLOSE(level.pixels.pressure[k], level.pixels.pressure[k % each], 3e-6 * p0);
        CHECK_CLOSE(level.area / period, 2 * b, 1.5 * step);
        CHECK_CLOSE(level.separation, Z0, 0.02 * step / b * std::abs(Z0));
        CHECK_RELATIVE(-contact->stiffness() / period, pi * E / (2 * std::log(12.0)),
                       0.2 * step / b);
        // The same at this separation.
        const Level again = contact->at_separation(level.separation);
        CHECK_RELATIVE(again.force, level.force, 1e-6);
    }
    // of second order in the step: 0.36, 0.089 and 0.022 %
    CHECK(errors[0] < 0.005 && errors[0] > 3 * errors[1] && errors[1] > 3 * errors[2]);
}

TEST(tiling_a_roller_along_its_axis_changes_nothing) {
    // A half-width of 0.3 on a side of 2 across, with periods of 0.08, 0.16 and 0.32: contacts
    // wider than the period, too, have one force at each separation, and values per length that do
    // not depend on the period.
    const double E = 1e5, R = 10, step = 0.01;
    SolverOptions options;
    options.tolerance = 1e-11;
    std::array<std::vector<double>, 3> values;
    for (const int tiles : {1, 2, 4}) {
        const int along = 8 * tiles;
        const double period = along * step;
        const HeightMap map = map_of(200, along, step, flat);
        const auto contact = make_element_contact(map, roller(R, E, period), options);
        auto& of = values[std::size_t(tiles / 2)];
        for (const double P : {60.0, 250.0, 775.0}) {
            const Level level = contact->at_force(P * period);
            const double stiffness = contact->stiffness();
            CHECK(level.converged && stiffness < 0);
            for (const double value :
                 {level.separation, stiffness / period, level.energy / period, level.area / period})
                of.push_back(value);
            CHECK_RELATIVE(contact->at_separation(level.separation).force, P * period, 1e-6);
        }
    }
    for (const auto k : indices(values[0]))
        for (const auto& other : values) CHECK_RELATIVE(other[k], values[0][k], 1e-9);
}

TEST(one_row_is_a_surface_constant_along_the_axis) {
    // The same roller on 8 rows of square pixels, and on one row of pixels 300 times as long.
    const double R = 12, E = 1.1e5, P = 50, step = 0.01;
    const auto wavy = [](double x, double) { return 1e-4 * std::cos(40 * x); };
    const HeightMap rows = map_of(120, 8, step, wavy);
    HeightMap row = map_of(120, 1, step, wavy);
    row.dy = 300 * step;
    SolverOptions options;
    options.tolerance = 1e-11;
    const auto many = make_element_contact(rows, roller(R, E, 8 * step), options);
    const auto one = make_element_contact(row, roller(R, E, row.dy), options);
    const Level a = many->at_force(P * 8 * step), b = one->at_force(P * row.dy);
    CHECK(a.converged && b.converged);
    CHECK_RELATIVE(b.separation, a.separation, 1e-9);
    CHECK_RELATIVE(b.area / row.dy, a.area / (8 * step), 1e-9);
    CHECK_RELATIVE(b.energy / row.dy, a.energy / (8 * step), 1e-9);
    CHECK_RELATIVE(one->stiffness() / row.dy, many->stiffness() / (8 * step), 1e-9);
    CHECK(b.contacts == a.contacts);
}

TEST(westergaard_wave) {
    // z = Delta cos(2 pi x/lambda) on a flat, with the mean pressure p: A/A0 = (2/pi) asin
    // sqrt(p/p*) and the largest pressure 2 sqrt(p p*), p* = pi E* Delta/lambda (Johnson 1985,
    // section 13.2). An edge is known to half a pixel, the pressure to second order in the pixels.
    const double E = 100, lambda = 1, Delta = 1e-3, full = pi * E * Delta / lambda;
    for (const int n : {512, 1024, 2048, 16384}) {
        HeightMap row = map_of(n, 1, lambda / n, [&](double x, double) {
            return Delta * std::cos(2 * pi * x / lambda + 0.1234);
        });
        row.dy = 1;
        ShapeKeys keys;
        Indenter flat{E, make_shape(shape_number("sphere"), keys), 0, 0};
        flat.period = {lambda, row.dy};
        const auto contact = make_element_contact(row, flat, exact());
        for (const double share : {0.01, 0.1, 0.3, 0.6, 0.9}) {
            const Level level = contact->at_force(share * full);
            CHECK_CLOSE(level.area, 2 / pi * std::asin(std::sqrt(share)), std::max(1e-4, 1.25 / n));
            CHECK_RELATIVE(level.pressure_max, 2 * full * std::sqrt(share),
                           3 / (share * n * n) + 2e-6);
        }
    }
}

TEST(a_wavy_roller_against_a_dense_solution) {
    // Strips of uniform pressure: w_i = -(2/(pi E*)) sum p_j int ln(|x_i - s|/D) ds, integrated by
    // Gauss's rule of two points on 32 parts of a strip, and in closed form on its own; p >= 0 by
    // Gauss and Seidel.
    const int n = 96;
    const double step = 0.01, E = 1e5, D = n * step, R = 20;
    HeightMap row =
        map_of(n, 1, step, [](double x, double) { return 2e-4 * std::cos(37 * x + 1); });
    row.dy = 3;
    const Indenter body = roller(R, E, row.dy);
    const auto contact = make_element_contact(row, body, exact());
    const double Z0 = contact->first_touch() - 2e-3;
    const Level level = contact->at_separation(Z0);
    std::vector<double> kernel(n), p(n, 0.0), w(n, 0.0);
    for (const int d : indices(n)) {
        double sum = d == 0 ? step * (std::log(0.5 * step / D) - 1) : 0;
        for (int k = 0; d > 0 && k < 64; ++k) {
            const double s = (k / 2 + 0.5 + (k % 2 == 0 ? -0.5 : 0.5) / std::sqrt(3.0)) / 32 - 0.5;
            sum += step / 64 * std::log((d + s) * step / D);
        }
        kernel[std::size_t(d)] = -2 / (pi * E) * sum;
    }
    for (int sweep = 0; sweep < 20000; ++sweep)
        for (const int i : indices(n)) {
            const auto at = std::size_t(i);
            const double over = body.clearance(row.x(i), row.y(0), row(i, 0)) - Z0;
            const double next = std::max(0.0, p[at] + (over - w[at]) / kernel[0]),
                         change = next - p[at];
            p[at] = next;
            for (int j = 0; change != 0 && j < n; ++j)
                w[std::size_t(j)] += change * kernel[std::size_t(std::abs(i - j))];
        }
    double force = 0;
    std::size_t pressed = 0;
    for (const double value : p) {
        force += value * step;
        pressed += value > 0;
    }
    CHECK(level.contacts > 1 && level.pixels.index.size() == pressed);
    CHECK_RELATIVE(level.force / row.dy, force, 1e-7);
    CHECK_RELATIVE(level.pressure_max, std::ranges::max(p), 1e-6);
}

TEST(energy_and_stiffness_of_a_line) {
    const double step = 1.0 / 48, E = 100;
    const HeightMap map = map_of(40, 48, step, rough);
    const auto contact = make_element_contact(map, roller(3, E, 1), exact());
    const double Z = contact->first_touch() - 4e-3, d = 1e-6;
    const Level low = contact->at_separation(Z - d), high = contact->at_separation(Z + d),
                middle = contact->at_separation(Z);
    CHECK_RELATIVE((high.energy - low.energy) / (2 * d), -middle.force, 1e-4);
    CHECK_RELATIVE((high.force - low.force) / (2 * d), contact->stiffness(), 1e-3);
}

TEST(a_line_along_x_is_one_along_y_turned) {
    const double step = 1.0 / 48, E = 100;
    const HeightMap map = map_of(40, 48, step, rough);
    const auto one = make_element_contact(map, roller(3, E, 1), exact());
    const HeightMap turned = map_of(48, 40, step, [](double x, double y) { return rough(y, x); });
    const auto other = make_element_contact(turned, roller(3, E, 1, true), exact());
    for (const double N : {0.02, 0.2, 1.0}) {
        const Level a = one->at_force(N), b = other->at_force(N);
        CHECK(a.contacts == b.contacts);
        CHECK_RELATIVE(b.separation, a.separation, 1e-6);
        CHECK_RELATIVE(b.area, a.area, 1e-9);
        const Level c = one->at_separation(a.separation);
        CHECK_RELATIVE(c.force, N, 1e-5);
    }
}

TEST(a_shift_along_the_axis_changes_nothing) {
    const double step = 1.0 / 48, E = 100;
    const HeightMap map = map_of(40, 48, step, rough);
    const auto one = make_element_contact(map, roller(3, E, 1), exact());
    const HeightMap moved =
        map_of(40, 48, step, [&](double x, double y) { return rough(x, y + 17 * step); });
    const auto other = make_element_contact(moved, roller(3, E, 1), exact());
    for (const double N : {0.05, 0.5}) {
        const Level a = one->at_force(N), b = other->at_force(N);
        CHECK(a.contacts == b.contacts);  // those across the border are one
        CHECK_RELATIVE(b.separation, a.separation, 1e-6);
        CHECK_RELATIVE(b.area, a.area, 1e-9);
    }
}

TEST(the_middle_of_a_long_free_strip) {
    // The same surface free and three times as long: where its middle third carries the force of a
    // period, it has its area within 2 %.
    const int n = 48;
    const double step = 1.0 / n, E = 100, N = 0.5;
    const HeightMap map = map_of(40, n, step, rough);
    const auto line = make_element_contact(map, roller(3, E, 1), exact());
    const Level period = line->at_force(N);
    // The middle of the middle third is that of the period.
    const HeightMap strip = map_of(40, 3 * n, step, [](double x, double y) { return rough(x, y); });
    const auto free = make_element_contact(strip, roller(3, E, kInfinity), exact());
    double total = 3 * N, force = 0, area = 0;
    for (int i = 0; i < 20 && std::abs(force / N - 1) > 1e-3; ++i) {
        const Level level = free->at_force(total);
        force = area = 0;
        for (const auto k : indices(level.pixels.index))
            if (std::abs(level.pixels.y(k)) < 0.5) {
                force += level.pixels.pressure[k] * step * step;
                area += step * step;
            }
        total *= N / force;
    }
    CHECK_RELATIVE(force, N, 1e-3);
    CHECK_RELATIVE(area, period.area_pixels, 0.02);
}

TEST(what_does_not_repeat_is_refused) {
    const HeightMap map = map_of(16, 16, 0.1, flat);
    Indenter across = roller(3, 100, 1.6);
    std::swap(across.period.x, across.period.y);
    CHECK_THROWS(make_element_contact(map, across, exact()), Error);
}

}  // namespace test_line_contact
