// Friction by boundary elements: Cattaneo and Mindlin's sphere, rollers and ellipses, rough bodies
// without Poisson's effect, turning slides, full slip, loops, and a slow solver of small cases.
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"

#include "contact/equivalent.hpp"
#include "interaction/cerruti.hpp"
#include "physics/friction/sliding_elements.hpp"

namespace test_friction_elements {

using namespace rsc;

using Values = std::vector<double>;

constexpr std::size_t kFirst = 21, kPoints = 62;  // of first loading, and with one cycle

// The component of a curve of two at a level.
Values component(const Values& all, std::size_t level, std::size_t which) {
    Values one;
    for (const auto k : indices(kPoints)) one.push_back(all[2 * (level * kPoints + k) + which]);
    return one;
}

double loop_area(const Values& x, const Values& Q) {
    double area = 0;
    for (std::size_t k = kFirst; k + 1 < x.size(); ++k)
        area += 0.5 * (Q[k] + Q[k + 1]) * (x[k + 1] - x[k]);
    return area;
}

// Two equal spheres of Poisson ratio nu: first loading and the cycle of Mindlin and Deresiewicz, of
// which Johnson (1985, section 7.4) gives the work. With nu > 0 the slip is not quite along the
// slide, which Mindlin neglects: the difference of Q is below 0.5 % of mu N.
TEST(sphere_of_cattaneo_mindlin_and_deresiewicz) {
    const Folder folder;
    for (const double nu : {0.0, 0.3}) {
        const std::string n = std::to_string(nu);
        const Reader file =
            run_to(folder / "sphere.nc",
                   "&solids E = 200e3, 200e3  nu = " + n + ", " + n +
                       "  R = Infinity, 10  friction = 0.3 /\n"
                       "&surface L = 0.3, L_lambda_l = 2, L_lambda_s = 16, sigma = 1e-9 /\n"
                       "&solver model = 'elements' /\n"
                       "&indentation control = 'force', levels = 5 /\n"
                       "&output fields = 'pressure', 'traction', 'traction_x', 'traction_y', "
                       "'slip_x' /\n");
        const double R = 10, mu = 0.3, G = 100e3 / (1 + nu), Gs = G / (2 * (2 - nu)),
                     E = 200e3 / 2 / (1 - nu * nu);
        const double allowed = nu > 0 ? 5e-3 : 2e-3;
        const auto xi = file.values("tangential_displacement"), Q = file.values("tangential_force"),
                   stiffness = file.values("tangential_stiffness"),
                   work = file.values("cycle_work"), slips = file.values("full_slip"),
                   stuck = file.values("stick_area"), lost = file.values("friction_work"),
                   area = file.values("contact_area");
        const double N = 5, a = std::cbrt(0.75 * N * R / E), full = 3 * mu * N / (16 * Gs * a);
        const auto x = component(xi, 0, 0), q = component(Q, 0, 0), y = component(Q, 0, 1);
        // Some 40 pixels over a: elements are within 0.2 %.
        CHECK_RELATIVE(slips[0], full, 2e-3);
        CHECK_RELATIVE(stiffness[0], 8 * Gs * a, 5e-3);
        const auto mindlin = [&](double slide) {
            return mu * N * (1 - std::pow(std::max(0.0, 1 - slide / full), 1.5));
        };
        const double A = 0.9 * slips[0];
        for (const auto i : indices(kPoints)) {
            const std::size_t back = i - kFirst;
            const double expected = i < kFirst   ? mindlin(x[i])
                                    : back <= 20 ? mindlin(A) - 2 * mindlin(0.5 * (A - x[i]))
                                                 : 2 * mindlin(0.5 * (A + x[i])) - mindlin(A);
            CHECK_CLOSE(q[i], expected, allowed * mu * N);
            CHECK_CLOSE(y[i], 0, 1e-5 * mu * N);
        }
        const double s = mindlin(A) / (mu * N);
        CHECK_RELATIVE(
            work[0],
            9 * mu * mu * N * N / (10 * a * Gs) *
                (1 - std::pow(1 - s, 5.0 / 3) - 5 * s / 6 * (1 + std::pow(1 - s, 2.0 / 3))),
            0.02);
        CHECK_RELATIVE(loop_area(x, q), work[0], 0.01);
        // Along first loading: Q dx = change of the elastic energy + work; in full stick none.
        CHECK(lost[0] == 0 && lost[20] > 0);
        // After half of the slide of full slip the radius of stick is a/sqrt(2).
        CHECK_CLOSE(stuck[10] / area[0], 0.5, 0.03);
        const auto p = file.values("field_pressure"), t = file.values("field_traction"),
                   tx = file.values("field_traction_x"), ty = file.values("field_traction_y"),
                   slip = file.values("field_slip_x");
        for (const auto k : indices(p)) {
            CHECK_CLOSE(t[k], std::hypot(tx[k], ty[k]), 1e-12 * mu * p[k]);
            CHECK(t[k] <= mu * p[k] * (1 + 1e-9));
            CHECK(slip[k] >= 0 && (slip[k] == 0 || t[k] >= mu * p[k] * (1 - 1e-9)));
        }
    }
}

// The stiffness of stick of a roller is that of pressing across its axis (plane strain) and 1 - nu
// of it along the axis (antiplane).
TEST(roller_across_and_along_its_axis) {
    const Folder folder;
    for (const bool along_x : {false, true}) {
        const Reader file = run_to(
            folder / "roller.nc",
            std::string("&solids E = 200e3, 200e3  nu = 0.3, 0.3  friction = 0.3 /\n"
                        "&indenter shape = 'paraboloid', radii = ") +
                (along_x ? "Infinity, 10" : "10, Infinity") +
                " /\n&surface L = 0.2, L_lambda_l = 2, L_lambda_s = 16, sigma = 1e-9 /\n"
                "&indentation boundary = '" +
                (along_x ? "periodic_x" : "periodic_y") + "', control = 'force', levels = 4 /\n");
        const double S = -file.values("stiffness")[0],
                     x = file.values("tangential_stiffness_xx")[0],
                     y = file.values("tangential_stiffness_yy")[0];
        CHECK_RELATIVE(along_x ? y : x, S, 5e-3);
        CHECK_RELATIVE(along_x ? x : y, 0.7 * S, 5e-3);
        // Cattaneo: Q = mu P (1 - c^2/b^2) with the half width c of stick.
        const auto stuck = file.values("stick_area"), Q = file.values("tangential_force");
        const double c = stuck[10] / file.values("contact_area")[0];
        CHECK_CLOSE(Q[20] / (0.3 * file.values("force")[0]), 1 - c * c, 0.03);  // a pixel of 22
    }
}

// An ellipse in stick: the tractions are those of a flat punch, and the displacement of its middle
// is an integral over directions (Vermeulen and Johnson 1964).
TEST(ellipse_along_its_axes) {
    constexpr double nu = 0.3, c = nu / (1 - nu), ratio = 4;
    double normal = 0, along = 0, across = 0;
    constexpr int parts = 2000;
    for (const int k : indices(parts)) {
        const double f = std::numbers::pi * (k + 0.5) / parts;
        const double w = 1 / std::hypot(std::cos(f) / ratio, std::sin(f));
        normal += w;
        along += w * (1 + c * std::cos(f) * std::cos(f));
        across += w * (1 + c * std::sin(f) * std::sin(f));
    }
    PointGrid grid{200, 60, 0.01, 0.01, 0, 0};
    LevelPixels contact;
    contact.columns = grid.nx;
    for (const int j : indices(grid.ny))
        for (const int i : indices(grid.nx)) {
            const double x = grid.x(i) - 0.995, y = grid.y(j) - 0.295, r = x * x / 16 + y * y;
            if (r >= 0.0484) continue;
            contact.index.push_back(std::int32_t(grid.index(i, j)));
            contact.pressure.push_back(std::sqrt(0.0484 - r));
        }
    const auto stiffness = [&](double shear) {
        SlidingElements bodies({.E_star = 1e3, .shape = Shape(kInfinity)},
                               {0.3, 1 / (1 + 0.5 * shear)}, grid, 1e-6);
        CHECK(bodies.slide(contact, {}));
        return bodies.stiffness();
    };
    const auto with = stiffness(c), without = stiffness(0);
    CHECK_RELATIVE(with[0] / without[0], normal / along, 3e-3);   // 0.780
    CHECK_RELATIVE(with[2] / without[2], normal / across, 3e-3);  // 0.873
    CHECK_CLOSE(with[1], 0, 1e-6 * with[0]);
}

// Without Poisson's effect the tangential problem of any contact is the normal one twice: Q is mu
// times the difference of the loads at two separations (Ciavarella, Jaeger).
TEST(rough_bodies_without_poissons_effect_superpose) {
    const Folder folder;
    for (const std::string body : {"&indentation ", "&indentation boundary = 'periodic' ",
                                   "&indenter shape = 'paraboloid', radii = 20, Infinity /\n"
                                   "&indentation boundary = 'periodic_y' "}) {
        const bool flat = body.find("periodic'") != std::string::npos,
                   ball = body == "&indentation ";
        const auto run = [&](const std::string& friction, const std::string& levels) {
            return run_to(folder / "rough.nc",
                          "&solids E = 80e3, 80e3  nu = 0, 0  friction = " + friction +
                              (ball ? " R = Infinity, 20" : " R = Infinity, Infinity") + " /\n" +
                              body + "unit = 'length', levels = " + levels +
                              " /\n&surface n = 64, L = 1, L_lambda_l = 2, L_lambda_s = 8, sigma = "
                              "1e-3 /\n&solver model = 'elements' tolerance = 1e-10 /\n");
        };
        const double Z0 = flat ? 5e-4 : -5e-4;
        const Reader slid = run("0.2", std::to_string(Z0));
        const Values x = component(slid.values("tangential_displacement"), 0, 0),
                     q = component(slid.values("tangential_force"), 0, 0);
        const double N = slid.values("force")[0];
        CHECK_CLOSE(q[kFirst - 1], 0.2 * N, 1e-6 * N);
        std::string levels;
        for (const std::size_t k : {15, 10, 5})
            levels += (levels.empty() ? "" : ", ") + format("%.17g", Z0 + x[k] / 0.2);
        const auto inner = run("0", levels).values("force");
        for (const std::size_t k : indices(3))
            CHECK_CLOSE(q[15 - 5 * k], 0.2 * (N - inner[k]), 1e-6 * 0.2 * N);
    }
}

// Pressures of Hertz on a grid.
LevelPixels hertz(const PointGrid& grid, double a) {
    LevelPixels contact;
    contact.columns = grid.nx;
    for (const int j : indices(grid.ny))
        for (const int i : indices(grid.nx)) {
            const double r = std::hypot(grid.x(i), grid.y(j)) / a;
            if (r >= 1) continue;
            contact.index.push_back(std::int32_t(grid.index(i, j)));
            contact.pressure.push_back(std::sqrt(1 - r * r));
        }
    return contact;
}

// A slide that turns at constant size: its force and work converge with the length of the steps.
TEST(a_slide_that_turns) {
    const PointGrid grid{14, 14, 0.16, 0.16, -1.04, -1.04};
    const auto contact = hertz(grid, 1.0);
    const auto turned = [&](int steps) {
        SlidingElements bodies({.E_star = 10, .shape = Shape(kInfinity)}, {0.3, 0.8235}, grid,
                               1e-7);
        CHECK(bodies.slide(contact, {}));
        const double size = 0.6 * bodies.full_slip({1, 0});
        Slide last{size, 0};
        CHECK(bodies.slide(contact, last));
        for (int k = 1; k <= steps; ++k) {
            const double angle = 1.5 * std::numbers::pi * k / steps;
            const Slide to{size * std::cos(angle), size * std::sin(angle)};
            CHECK(bodies.slide(contact, {to.x - last.x, to.y - last.y}));
            last = to;
        }
        const Slide Q = bodies.force();
        return std::array{Q.x, Q.y, bodies.work_lost()};
    };
    const auto fine = turned(3000), middle = turned(300), coarse = turned(30);
    const double Q = std::hypot(fine[0], fine[1]);
    for (const std::size_t k : {0, 1}) {
        CHECK_CLOSE(coarse[k], fine[k], 0.03 * Q);
        CHECK_CLOSE(middle[k], fine[k], 0.003 * Q);
    }
    CHECK_RELATIVE(coarse[2], fine[2], 0.1);
    CHECK_RELATIVE((coarse[2] - fine[2]) / (middle[2] - fine[2]), 11, 0.2);
    CHECK(fine[0] > 0 && fine[1] < 0);  // at (0, -size) slips are along x
}

// The least of q'Tq/2 - b'q over discs by accelerated projected gradients, restarted where they
// rise.
Values slowly(const std::vector<Values>& T, const Values& limit, const Values& b, Values q) {
    const std::size_t n = limit.size();
    double norm = 0;
    for (const Values& row : T)
        norm = std::max(norm, std::accumulate(row.begin(), row.end(), 0.0,
                                              [](double s, double t) { return s + std::abs(t); }));
    const auto project = [&](Values& v) {
        for (const auto k : indices(n)) {
            const double size = std::hypot(v[k], v[n + k]),
                         factor = size > limit[k] ? limit[k] / size : 1;
            v[k] *= factor;
            v[n + k] *= factor;
        }
    };
    project(q);
    Values y = q;
    double t = 1;
    for (const int step : indices(20000)) {
        Values z = y;
        for (const auto i : indices(2 * n))
            z[i] += (b[i] - std::inner_product(y.begin(), y.end(), T[i].begin(), 0.0)) / norm;
        project(z);
        double rise = 0, change = 0;
        for (const auto i : indices(2 * n)) {
            rise += (y[i] - z[i]) * (z[i] - q[i]);
            change = std::max(change, std::abs(z[i] - q[i]));
        }
        if (rise > 0) t = 1;
        const double next = 0.5 * (1 + std::sqrt(1 + 4 * t * t));
        for (const auto i : indices(2 * n)) y[i] = z[i] + (t - 1) / next * (z[i] - q[i]);
        t = next;
        q = std::move(z);
        if (change < 1e-13 && step > 20) break;
    }
    return q;
}

// Fifty random small contacts along random slides, whose pressures and pixels change on the way, on
// free, line and periodic surfaces.
TEST(small_contacts_against_a_slow_solver) {
    std::mt19937 random(7);
    const auto uniform = [&] { return std::uniform_real_distribution<>(-1, 1)(random); };
    for (const int number : indices(50)) {
        PointGrid grid{3 + number % 3, 3 + number % 2, 0.25, 0.25, 0, 0};
        const double nu = 0.5 * std::abs(uniform());
        const int kind = number % 3;
        const Indenter indenter{
            .E_star = 1,
            .shape = Shape(kInfinity),
            .period = {kind == 2 ? grid.Lx() : kInfinity, kind > 0 ? grid.Ly() : kInfinity}};
        const Friction friction{0.4, 2 * (1 - nu) / (2 - nu)};
        SlidingElements bodies(indenter, friction, grid, 1e-9);
        TractionProducts products(substrate_of(indenter), 2 / friction.ratio - 2, indenter.period,
                                  grid);
        std::vector<Pixel> all;
        for (const int j : indices(grid.ny))
            for (const int i : indices(grid.nx)) all.push_back({i, j});
        products.set_pixels(all);
        const std::size_t n = all.size();
        std::vector<Values> T;  // symmetric: its rows are the products with unit tractions
        for (const auto k : indices(2 * n)) {
            Values unit(2 * n, 0.0), u(2 * n);
            unit[k] = 1;
            products.apply(unit.data(), u.data(), true);
            T.push_back(u);
        }
        Values q(2 * n, 0.0);
        for (const int step : indices(4)) {
            LevelPixels contact;
            contact.columns = grid.nx;
            Values limit(n, 0.0);
            for (const auto k : indices(n)) {
                const double p = uniform() + 0.4 + 0.1 * step;
                if (!(p > 0) || (kind == 2 && k % 2 == 0)) continue;
                contact.index.push_back(std::int32_t(k));
                contact.pressure.push_back(p);
                limit[k] = friction.coefficient * p;
            }
            const Slide by{0.15 * uniform(), 0.15 * uniform()};
            CHECK(bodies.slide(contact, by));
            Values b(2 * n);
            for (const auto i : indices(2 * n))
                b[i] = std::inner_product(q.begin(), q.end(), T[i].begin(), i < n ? by.x : by.y);
            q = slowly(T, limit, b, q);
            const auto& found = bodies.state();
            for (const auto k : indices(contact.index))
                for (const std::size_t part : {0, 1})
                    CHECK_CLOSE(found.q[part * contact.index.size() + k],
                                q[part * n + at(contact.index[k])], 1e-6);
        }
    }
}

// Integrals of Cerruti's kernels over a rectangle by the midpoint rule, and their images.
TEST(kernels_of_cerruti) {
    constexpr double a = 0.5, b = 0.7;
    for (const auto& [x, y] : {std::pair{3.0, 1.0}, {0.2, 2.0}, {4.0, -3.0}}) {
        constexpr int n = 400;
        double xx = 0, xy = 0;
        for (const int i : indices(n))
            for (const int j : indices(n)) {
                const double X = x + a - 2 * a * (i + 0.5) / n, Y = y + b - 2 * b * (j + 0.5) / n,
                             r = std::hypot(X, Y);
                const double part = 4 * a * b / n / n / (r * r * r);
                xx += X * X * part;
                xy += X * Y * part;
            }
        CHECK_RELATIVE(cerruti_xx(x, y, a, b), xx, 1e-5);
        CHECK_RELATIVE(cerruti_xy(x, y, a, b), xy, 1e-5);
    }
    const LineCerruti line{3.0};
    double xx = -2 * 0.02 / 3, xy = 0;
    for (int n = -200000; n <= 200000; ++n) {
        xx += cerruti_xx(0.7, 0.2 + 3 * n, 0.05, 0.1);
        xy += cerruti_xy(0.7, 0.2 + 3 * n, 0.05, 0.1);
    }
    CHECK_CLOSE(line.xx(0.7, 0.2, 0.05, 0.1), xx, 1e-7);
    CHECK_CLOSE(line.xy(0.7, 0.2, 0.05, 0.1), xy, 1e-7);
}

// Yielded bodies: the tractions are those of the pressures of the level, at most mu H.
TEST(pressures_of_yielded_levels) {
    const Folder folder;
    const Reader file = run_to(
        folder / "yielded.nc",
        "&solids E = 200e3, 200e3  nu = 0.3, 0.3  R = Infinity, 10  friction = 0.3  hardness "
        "= 600 /\n"
        "&surface L = 0.3, L_lambda_l = 2, L_lambda_s = 16, sigma = 1e-9 /\n"
        "&solver model = 'elements' /\n"
        "&indentation control = 'force', levels = 20, amplitude = 1.2 /\n"
        "&output fields = 'pressure', 'traction' /\n");
    const auto p = file.values("field_pressure"), Q = file.values("tangential_force");
    CHECK_RELATIVE(std::ranges::max(p), 600, 1e-9);
    CHECK_CLOSE(component(Q, 0, 0)[kFirst], 0.3 * 20, 1e-2 * 0.3 * 20);
}

}  // namespace test_friction_elements
