// Stresses below the surface: sums of point forces, Hertz's sphere and line, sliding, equilibrium.
#include "physics/stress/pixel_stress.hpp"
#include "physics/stress/plane_stress.hpp"
#include "physics/stress/spot_stress.hpp"
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"
#include "truth/stress.hpp"

namespace test_stress {

using namespace rsc;

PointGrid square_grid(int n, double step) {
    PointGrid grid;
    grid.nx = grid.ny = n;
    grid.dx = grid.dy = step;
    grid.x0 = grid.y0 = -0.5 * (n - 1) * step;
    return grid;
}

// Pressures p(x, y) where they are positive, at the middles of the pixels.
LevelPixels pressures(const PointGrid& grid, const std::function<double(double, double)>& p) {
    LevelPixels pixels;
    pixels.columns = grid.nx;
    pixels.x0 = grid.x0;
    pixels.y0 = grid.y0;
    pixels.dx = grid.dx;
    pixels.dy = grid.dy;
    for (const int j : indices(grid.ny))
        for (const int i : indices(grid.nx))
            if (const double value = p(grid.x(i), grid.y(j)); value > 0) {
                pixels.index.push_back(int(grid.index(i, j)));
                pixels.pressure.push_back(value);
            }
    return pixels;
}

// Hertz's pressure with p0 = 1 over the circle of radius 1.
LevelPixels hertz(const PointGrid& grid) {
    return pressures(
        grid, [](double x, double y) { return std::sqrt(std::max(0.0, 1 - x * x - y * y)); });
}

Period both(const PointGrid& grid) { return {grid.Lx(), grid.Ly()}; }

GridWindow whole(const PointGrid& grid) { return {0, 0, grid.nx, grid.ny}; }

// Planes of all sizes in turn: what is left in the memory has no effect.
StressMemory memory;

LargestStress largest(const PointGrid& grid, const LevelPixels& pixels, const StressedBody& body,
                      double depth) {
    return stress_below(grid, pixels, body, depth,
                        stressed_window(grid, pixels, body.period, depth), memory);
}

// Largest of a measure over depths about its maximum, and the depth of it.
std::pair<double, double> over_depths(const std::function<double(double)>& at) {
    double most = 0, where = 0;
    for (double z = 0.40; z < 0.86; z += 0.01)
        if (const double value = at(z); value > most) {
            most = value;
            where = z;
        }
    return {most, where};
}

TEST(a_pixel_stresses_the_body_as_point_forces_over_it_do) {
    // The midpoint rule with 600 points errs by about (2a/600)^2/12 of the second derivatives, of
    // order 1/z^2.
    for (const auto [x, y, z] : std::vector<std::array<double, 3>>{
             {0.3, 0.2, 0.7}, {2.1, -1.3, 0.4}, {-1.2, 0.6, 0.2}, {0.1, 3.0, 2.0}}) {
        const double a = 0.5, b = 0.8, nu = 0.3;
        const truth::Tensor t = truth::rectangle(x, y, z, a, b, nu, {0.4, -0.7, 1.0}, 600);
        const StressTensor s = pixel_stress(x, y, z, a, b, nu, {0.4, -0.7});
        const truth::Tensor mine{s.xx, s.yy, s.zz, s.xy, s.xz, s.yz};
        for (std::size_t c = 0; c < 6; ++c) CHECK_CLOSE(mine[c], t[c], 1e-6);
    }
}

TEST(measures_of_stress_are_those_of_principal_stresses) {
    // Principal stresses 5, -1, -4 turned by an angle about z and another about x.
    const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(0.4), e = std::sin(0.4);
    const std::array<std::array<double, 3>, 3> axes{
        {{c, s * d, s * e}, {-s, c * d, c * e}, {0, -e, d}}};
    const std::array<double, 3> principal{5, -1, -4};
    std::array<std::array<double, 3>, 3> t{};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) t[i][j] += principal[k] * axes[k][i] * axes[k][j];
    const StressMeasures m = measures_of({t[0][0], t[1][1], t[2][2], t[0][1], t[0][2], t[1][2]});
    CHECK_CLOSE(m.tension, 5, 1e-12);
    CHECK_CLOSE(m.shear, 4.5, 1e-12);
    CHECK_CLOSE(m.mises, std::sqrt(0.5 * (36 + 9 + 81)), 1e-12);
    CHECK_CLOSE(measures_of({-2, -2, -2, 0, 0, 0}).tension, -2, 0);
}

TEST(hertz_sphere_of_elements) {
    // Johnson (1985), section 3.4: the shear stress under the centre is largest at 0.48 a, 0.310 p0
    // for nu = 0.3, where von Mises's stress is 0.620 p0; any nu: principal stresses of the axis.
    const PointGrid grid = square_grid(201, 0.02);
    const LevelPixels pixels = hertz(grid);
    for (const double nu : {0.0, 0.3, 0.5}) {
        double most = 0, where = 0;
        for (double z = 0.3; z < 0.7; z += 0.002) {
            const double zz = -1 / (1 + z * z);
            const double rr = -(1 + nu) * (1 - z * std::atan(1 / z)) + 0.5 / (1 + z * z);
            if (const double shear = 0.5 * (rr - zz); shear > most) {
                most = shear;
                where = z;
            }
        }
        const LargestStress there = largest(grid, pixels, {nu, {}, {}}, where);
        // 50 pixels over the radius: 4e-5 of p0
        CHECK_CLOSE(there.shear.value, most, 2e-4);
        CHECK_CLOSE(there.mises.value, 2 * most, 4e-4);
        CHECK_CLOSE(there.shear.x, 0, 1e-12);
        if (nu == 0.3) {
            CHECK_CLOSE(most, 0.310, 5e-4);
            CHECK_CLOSE(where, 0.48, 5e-3);
        }
    }
}

TEST(tension_at_the_rim_of_a_hertz_contact) {
    // (1 - 2 nu) p0/3 at the rim on the surface, and p0 [(1 - 2 nu)/3 + pi mu (4 + nu)/8] behind a
    // sliding sphere (Hamilton and Goodman 1966). The pixels of the rim blur it over their size.
    const double nu = 0.3, mu = 0.3;
    const double still = (1 - 2 * nu) / 3, sliding = still + pi * mu * (4 + nu) / 8;
    std::vector<double> errors;
    for (const int pixels : {20, 80}) {
        const PointGrid grid = square_grid(2 * pixels + 41, 1.0 / pixels);
        const LevelPixels p = hertz(grid);
        const LargestStress at_rest = largest(grid, p, {nu, {}, {}}, 0);
        const LargestStress pushed = largest(grid, p, {nu, {mu, 0}, {}}, 0);
        errors.push_back(std::abs(at_rest.tension.value / still - 1));
        errors.push_back(std::abs(pushed.tension.value / sliding - 1));
        CHECK_CLOSE(pushed.tension.x, -1, 2.0 / pixels);
        const LargestStress across = largest(grid, p, {nu, {0, mu}, {}}, 0);
        CHECK_CLOSE(across.tension.y, -1, 2.0 / pixels);
        CHECK_CLOSE(across.tension.value, pushed.tension.value, 1e-10);
    }
    // about the root of the pixel over the radius
    CHECK(errors[0] < 0.25 && errors[2] < 0.6 * errors[0]);
    CHECK(errors[1] < 0.15 && errors[3] < 0.6 * errors[1]);
}

TEST(hertz_line_between_flats) {
    // A line of half-width 1 along y in a period of 40: shear 0.300 p0 at 0.786 b (Johnson 1985,
    // section 4.2). The mean pressure m presses body and images sideways by nu/(1 - nu) m, where
    // the modes of a line alone would by m.
    const double nu = 0.3, mean = 0.5 * pi / 40, more = 0.5 * (1 - nu / (1 - nu)) * mean;
    PointGrid grid = square_grid(1600, 0.025);
    grid.ny = 8;
    const LevelPixels line =
        pressures(grid, [](double x, double) { return std::sqrt(std::max(0.0, 1 - x * x)); });
    const auto [shear, depth] = over_depths([&](double z) {
        return largest(grid, line, {nu, {}, both(grid)}, z).shear.value;
    });
    CHECK_CLOSE(shear - more, 0.300, 1e-3);
    CHECK_CLOSE(depth, 0.786, 0.02);
    // Sliding: the in-plane shear is mu p0 all over the surface of contact (Johnson, section 7.1).
    const double mu = 0.4;
    StressPlane plane;
    stress_below(grid, line, {0.5, {mu, 0}, both(grid)}, 0, whole(grid), memory, &plane);
    for (const int i : indices(grid.nx))
        if (std::abs(grid.x(i)) < 0.8) CHECK(plane.shear[i] > 0.97 * mu);
    CHECK_CLOSE(plane.shear[800], std::sqrt(mu * mu), 0.02);
}

TEST(the_period_is_forgotten_as_it_grows) {
    // Under a contact that is small beside the period the stresses are those of a free surface.
    // What the images and the mean pressure add falls with the area of the period; what is left is
    // the difference between uniform and band-limited pressures, of second order in the pixel.
    const double step = 0.25;
    std::vector<StressPlane> planes;
    const SlidingTraction sliding{0.3, -0.2};
    for (const int n : {32, 64, 128, 256, 0}) {  // 0: a free surface
        const int points = n == 0 ? 64 : n;
        const PointGrid grid = square_grid(points, step);
        const LevelPixels p = pressures(grid, [](double x, double y) {
            const double r2 = (x - 0.4) * (x - 0.4) + y * y;
            return std::exp(-r2) * (r2 < 9);
        });
        planes.emplace_back();
        stress_below(grid, p, {0.3, sliding, n > 0 ? both(grid) : Period{}}, 0.7,
                     {points / 2 - 8, points / 2 - 8, 16, 16}, memory, &planes.back());
    }
    const auto apart = [](const StressPlane& a, const StressPlane& b) {
        double most = 0;
        for (const auto k : indices(a.mises))
            most = std::max({most, std::abs(a.mises[k] - b.mises[k]),
                             std::abs(a.shear[k] - b.shear[k]),
                             std::abs(a.tension[k] - b.tension[k])});
        return most;
    };
    const double first = apart(planes[0], planes[1]), second = apart(planes[1], planes[2]),
                 third = apart(planes[2], planes[3]);
    CHECK(first > 3 * second && second > 3 * third);
    CHECK(apart(planes[3], planes[4]) < third + step * step / 8);
}

TEST(hertz_line_that_repeats_along_its_axis) {
    // On a free surface 8 wide: shear 0.300 p0 at 0.786 b, and 2 mu p0 tension behind a sliding
    // line on the surface (Johnson 1985, sections 4.2 and 7.1), along y and along x, for several
    // periods.
    const double nu = 0.3, mu = 0.3;
    for (const int n : {16, 61}) {
        PointGrid grid = square_grid(161, 0.05);
        grid.ny = n;
        const auto root = [](double t) { return std::sqrt(std::max(0.0, 1 - t * t)); };
        const LevelPixels line = pressures(grid, [&](double x, double) { return root(x); });
        const StressedBody body{nu, {}, {kInfinity, grid.Ly()}};
        const auto [shear, depth] =
            over_depths([&](double z) { return largest(grid, line, body, z).shear.value; });
        CHECK_CLOSE(shear, 0.300, 1e-3);
        CHECK_CLOSE(depth, 0.786, 0.02);
        const LargestStress pushed = largest(grid, line, {nu, {mu, 0}, {kInfinity, grid.Ly()}}, 0);
        CHECK_CLOSE(pushed.tension.value, 2 * mu, 0.15 * 2 * mu);  // blurred by pixels
        CHECK_CLOSE(pushed.tension.x, -1, 0.1);
        PointGrid turned = grid;
        std::swap(turned.nx, turned.ny);
        std::swap(turned.x0, turned.y0);
        const LevelPixels across = pressures(turned, [&](double, double y) { return root(y); });
        const LargestStress other =
            largest(turned, across, {nu, {0, mu}, {turned.Lx(), kInfinity}}, 0.3);
        const LargestStress one = largest(grid, line, {nu, {mu, 0}, {kInfinity, grid.Ly()}}, 0.3);
        CHECK_RELATIVE(other.mises.value, one.mises.value, 1e-9);
        CHECK_RELATIVE(other.tension.value, one.tension.value, 1e-9);
    }
    // A spot in each period: that in the middle of a free strip of n periods, but for those beyond
    // it, which add about 1/n.
    const PointGrid one = square_grid(64, 0.1);
    const double L = one.Ly();
    const auto spot = [L](double x, double y) {
        y = std::remainder(y - 0.7, L);
        return std::sqrt(std::max(0.0, 1 - x * x - y * y));
    };
    const SlidingTraction sliding{0.1, 0.2};
    StressPlane repeated;
    stress_below(one, pressures(one, spot), {nu, sliding, {kInfinity, L}}, 0.4, whole(one), memory,
                 &repeated);
    std::vector<double> apart;
    for (const int n : {3, 7, 15}) {
        PointGrid strip = one;
        strip.ny = n * one.ny;
        strip.y0 = one.y0 - (n - 1) / 2 * L;
        StressPlane plane;
        stress_below(strip, pressures(strip, spot), {nu, sliding, {}}, 0.4,
                     {0, (n - 1) / 2 * one.ny, one.nx, one.ny}, memory, &plane);
        apart.push_back(0);
        for (const std::size_t k : indices(one.points()))
            apart.back() = std::max(apart.back(), std::abs(repeated.mises[k] - plane.mises[k]));
    }
    CHECK(apart[1] < 0.55 * apart[0] && apart[2] < 0.55 * apart[1] &&
          apart[2] < 2e-3);  // of p0 = 1
}

// One spot, p0 = 1 over a = 1. Huber's solution (nu = 0.3): von Mises's stress is largest at the
// depth 0.48, tensions at small depths beyond the rim. Two flats have the same stresses wherever
// the period begins, and the mean pressure.
TEST(spots_of_asperities) {
    Level level;
    level.add_contact(0, 0.3, -0.2, 2 * pi / 3, 1, 0);
    const auto largest_at = [&](double z, const StressedBody& body, const Rectangle& cell) {
        const SpotPressures spots = pressures_of_spots(level, body.period, cell, z);
        return largest(spots.grid, spots.pixels, body, z);
    };
    const StressedBody free{0.3};
    CHECK_CLOSE(largest_at(0.48, free, {}).mises.value, 0.620, 0.006);
    CHECK_CLOSE(largest_at(0.48, free, {}).shear.value, 0.310, 0.003);
    for (const auto& [depth, tension] :
         {std::pair{0.1, 0.0169}, std::pair{0.25, 0.0072}, std::pair{0.5, 0.0067}})
        CHECK_RELATIVE(largest_at(depth, free, {}).tension.value, tension, 0.05);
    const StressedBody flats{0.3, {}, {16, 16}};
    for (const double z : {0.5, 4.0, 12.0}) {
        const Rectangle cell{-8, -8, 16, 16}, rolled{0, -8, 16, 16};
        const LargestStress one = largest_at(z, flats, cell), other = largest_at(z, flats, rolled);
        CHECK_RELATIVE(one.mises.value, other.mises.value, 1e-9);
        CHECK_CLOSE(one.tension.value, other.tension.value, 1e-9 * one.mises.value);
    }
    // Far below, zz = -p and xx = yy = -nu/(1 - nu) p.
    const double p = 2 * pi / 3 / 256;
    CHECK_RELATIVE(largest_at(40, flats, {-8, -8, 16, 16}).tension.value, -0.3 / 0.7 * p, 1e-5);
}

std::vector<double> values_of(const std::string& text, const std::string& path,
                              const std::vector<std::string>& names) {
    const Reader file = run_to(path, text);
    std::vector<double> all;
    for (const std::string& name : names)
        for (const double value : file.values(name)) all.push_back(value);
    return all;
}

TEST(a_file_holds_the_stresses_of_its_pressures) {
    const Folder folder;
    const Reader file =
        run_to(folder / "stress.nc",
               "&solids E = 200, 200  nu = 0.25, 0.3  R = Infinity, 50  friction = 0.2 /\n"
               "&surface L = 1, L_lambda_l = 2, L_lambda_s = 8, sigma = 1e-3 /\n"
               "&indentation control = 'force', levels = 0.02, 0.1 /\n"
               "&solver model = 'elements' /\n"
               "&output stress_depths = 0.02, 0.1, sliding_direction = 120,"
               " fields = 'pressure', 'mises', 'shear', 'tension' /\n");
    const auto x = file.values("field_x"), y = file.values("field_y"),
               pressure = file.values("field_pressure");
    const double half = 0.5 * (x[1] - x[0]), qx = 0.2 * std::cos(2 * pi / 3),
                 qy = 0.2 * std::sin(2 * pi / 3);
    const std::array<const char*, 3> names{"mises", "shear", "tension"};
    const std::size_t points = x.size() * y.size();
    for (std::size_t q = 0; q < 3; ++q) {
        const auto most = file.values(names[q] + std::string("_max")),
                   at_x = file.values(names[q] + std::string("_max_x")),
                   at_y = file.values(names[q] + std::string("_max_y")),
                   field = file.values(std::string("field_") + names[q]);
        CHECK(most.size() == 4 && field.size() == 2 * points);
        for (std::size_t d = 0; d < 2; ++d) {
            const double z = d == 0 ? 0.02 : 0.1;
            truth::Tensor sum{};
            for (const std::size_t k : indices(points)) {
                if (!(pressure[k] > 0)) continue;
                const double dx = at_x[2 + d] - x[k % x.size()], dy = at_y[2 + d] - y[k / x.size()];
                const int n = std::hypot(dx, dy) < 4 * half ? 40 : 8;
                const truth::Tensor t =
                    truth::rectangle(dx, dy, z, half, half, 0.25, {qx, qy, 1}, n);
                for (std::size_t c = 0; c < 6; ++c) sum[c] += pressure[k] * t[c];
            }
            const StressMeasures m = measures_of({sum[0], sum[1], sum[2], sum[3], sum[4], sum[5]});
            const std::array<double, 3> there{m.mises, m.shear, m.tension};
            CHECK_CLOSE(most[2 + d], there[q], 2e-4 * m.mises);
            const auto plane = field.begin() + static_cast<std::ptrdiff_t>(d * points);
            CHECK_CLOSE(*std::max_element(plane, plane + static_cast<std::ptrdiff_t>(points)),
                        most[2 + d], 1e-9 * m.mises);
        }
    }
}

TEST(stresses_of_threads_and_campaigns_are_the_same_bits) {
    const Folder folder;
    const std::vector<std::string> names{"mises_max", "mises_max_x", "shear_max", "tension_max",
                                         "tension_max_y"};
    for (const std::string model :
         {"&solids R = Infinity, 50 / &solver model = 'elements' / &indentation levels = 1, 0 /\n",
          "&solids R = Infinity, Infinity / &solver model = 'elements' /\n"
          "&indentation boundary = 'periodic', control = 'pressure', unit = 'pressure', levels = "
          "50, 100 /\n",
          "&solids R = Infinity, 50 / &solver model = 'asperities' / &indentation levels = 1, 0 "
          "/\n"}) {
        const std::string text =
            "&surface n = 64, L = 1, L_lambda_l = 2, L_lambda_s = 8, sigma = "
            "1e-3 / &output stress_depths = 0, 0.1 /\n" +
            model;
        const auto run = [&](const std::string& keys) {
            return values_of("&run " + keys + " /\n" + text, folder / "one.nc", names);
        };
        const auto one = run("threads = 1"), three = run("threads = 3"),
                   second = run("first_realization = 2");
        CHECK(one == three);
        const auto both = run("realizations = 2");
        CHECK(both.size() == 2 * one.size());
        const std::size_t each = one.size() / names.size();
        bool same = true;
        for (const auto v : indices(names))
            for (const std::size_t k : indices(each))
                same = same && both[2 * v * each + k] == one[v * each + k] &&
                       both[(2 * v + 1) * each + k] == second[v * each + k];
        CHECK(same);
    }
}

TEST(one_summit_by_asperities_and_by_elements) {
    // A list with one asperity, and the same sphere as a smooth surface of elements under a ball of
    // its radius: within 2 %.
    const Folder folder;
    std::ofstream(folder / "one.txt") << "0.5 0.5 0 20\n";
    const std::string keys =
        "&solids E = 200, 200  nu = 0.3, 0.3  R = Infinity, Infinity /\n"
        "&indentation control = 'force', levels = 0.02 /\n"
        "&output stress_depths = 0.01, 0.05, 0.1 /\n";
    const std::vector<std::string> names{"mises_max", "shear_max"};
    const auto spot = values_of(keys + "&surface source = 'asperities', file = '" +
                                    (folder / "one.txt") + "', L = 1, sigma = 1e-3 /\n",
                                folder / "a.nc", names);
    const auto elements = values_of(
        "&solids E = 200, 200  nu = 0.3, 0.3  R = Infinity, 20 /\n"
        "&indentation control = 'force', levels = 0.02 /\n"
        "&output stress_depths = 0.01, 0.05, 0.1 /\n"
        "&surface L = 1, L_lambda_l = 2, L_lambda_s = 12, sigma = 1e-9 /\n"
        "&solver model = 'elements' /\n",
        folder / "e.nc", names);
    CHECK(spot.size() == 6 && elements.size() == 6);
    for (std::size_t k = 0; k < 6; ++k) CHECK_CLOSE(elements[k] / spot[k], 1, 0.02);
}

}  // namespace test_stress
