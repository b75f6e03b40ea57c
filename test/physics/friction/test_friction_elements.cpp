// Friction by boundary elements: Cattaneo and Mindlin's sphere, a line, rough surfaces against
// asperities, full slip, the loop.
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"

namespace test_friction_elements {

using namespace rsc;

using Values = std::vector<double>;

Values row(const Values& all, std::size_t k, std::size_t n) {
    return {all.begin() + static_cast<std::ptrdiff_t>(k * n),
            all.begin() + static_cast<std::ptrdiff_t>((k + 1) * n)};
}

double loop_area(const Values& x, const Values& Q, std::size_t first) {
    double area = 0;
    for (std::size_t k = first; k + 1 < x.size(); ++k)
        area += 0.5 * (Q[k] + Q[k + 1]) * (x[k + 1] - x[k]);
    return std::abs(area);
}

// Of the fields of a level: the share of the contact that sticks, and Q over mu N. No traction is
// beyond the limit of friction.
struct Slip {
    double sticks, force;
    Slip(const Reader& file, double mu) {
        const auto pressure = file.values("field_pressure"),
                   traction = file.values("field_traction");
        double stuck = 0, touches = 0, sum = 0, pressed = 0;
        for (const auto k : indices(pressure)) {
            CHECK(traction[k] >= -1e-9 * mu * pressure[k] &&
                  traction[k] <= (1 + 1e-9) * mu * pressure[k]);
            touches += pressure[k] > 0;
            stuck += pressure[k] > 0 && traction[k] < mu * pressure[k] * (1 - 1e-9);
            sum += traction[k];
            pressed += pressure[k];
        }
        sticks = stuck / touches;
        force = sum / (mu * pressed);
    }
};

TEST(smooth_sphere_of_cattaneo_and_mindlin) {
    const Folder folder;
    const Reader file =
        run_to(folder / "sphere.nc",
               "&solids E = 200e3, 200e3  nu = 0.3, 0.3  R = Infinity, 10  friction = 0.3 /\n"
               "&surface L = 0.3, L_lambda_l = 2, L_lambda_s = 16, sigma = 1e-9 /\n"
               "&solver model = 'elements' /\n"
               "&indentation control = 'force', levels = 5, 20 /\n"
               "&output fields = 'pressure', 'traction' /\n");
    const double R = 10, mu = 0.3, nu = 0.3, G = 200e3 / 2.6, Gs = G / (2 * (2 - nu)),
                 E = 200e3 / 2 / (1 - nu * nu);
    const auto x = file.values("tangential_displacement"), Q = file.values("tangential_force"),
               stiffness = file.values("tangential_stiffness"), work = file.values("cycle_work");
    const std::size_t points = x.size() / 2, first = 41;
    for (std::size_t k = 0; k < 2; ++k) {
        const double N = k == 0 ? 5 : 20, a = std::cbrt(0.75 * N * R / E),
                     full = 3 * mu * N / (16 * Gs * a);
        const auto slide = row(x, k, points), force = row(Q, k, points);
        // Some 20 and 35 pixels over a: elements are within 0.2 %.
        CHECK_RELATIVE(slide[first - 1], full, 2e-3);
        for (const std::size_t i : indices(first))
            CHECK_CLOSE(force[i], mu * N * (1 - std::pow(std::max(0.0, 1 - slide[i] / full), 1.5)),
                        2e-3 * mu * N);
        CHECK_CLOSE(force[first - 1], mu * N, 1e-6 * mu * N);
        CHECK_RELATIVE(stiffness[k], 8 * Gs * a, 5e-3);
        // Of the cycle between +-0.9 of full slip: 41 points of each branch by the trapezoidal
        // rule.
        CHECK_RELATIVE(loop_area(slide, force, first), work[k], 5e-3);
    }
    // After half of the slide of full slip the radius of stick is a/sqrt(2).
    const Slip slip(file, mu);
    CHECK_CLOSE(std::sqrt(slip.sticks), std::sqrt(0.5), 0.02);
    CHECK_CLOSE(slip.force, 1 - std::pow(0.5, 1.5), 2e-3);
}

TEST(line_of_cattaneo) {
    // Stick over |x| < c with Q = mu P (1 - c^2/b^2) (Johnson 1985, section 7.2).
    const Folder folder;
    const Slip slip(run_to(folder / "line.nc",
                           "&solids E = 200e3, 200e3  nu = 0.3, 0.3  friction = 0.3 /\n"
                           "&indenter shape = 'paraboloid', radii = 10, Infinity /\n"
                           "&surface L = 0.2, L_lambda_l = 2, L_lambda_s = 16, sigma = 1e-9 /\n"
                           "&indentation boundary = 'periodic_y', control = 'force', levels = 4 /\n"
                           "&output fields = 'pressure', 'traction' /\n"),
                    0.3);
    const double c = slip.sticks;
    CHECK(c > 0.5 && c < 0.9);
    CHECK_CLOSE(slip.force, 1 - c * c, 0.03);  // one pixel of 22
}

TEST(rough_surfaces_slide_as_their_asperities_do) {
    // The curve of tangential force over mu N against the slide over that of full slip, by elements
    // and by asperities (law fourth_order), whose loads differ by a few per cent; between flats,
    // too.
    const Folder folder;
    for (const std::string bodies :
         {"&solids E = 80e3, 200e3  nu = 0.35, 0.3  R = Infinity, 20  friction = 0.2 /\n"
          "&indentation levels = 0.8, -0.5 /\n",
          "&solids E = 80e3, 200e3  nu = 0.35, 0.3  R = Infinity, Infinity  friction = 0.2 /\n"
          "&indentation boundary = 'periodic', control = 'pressure', unit = 'pressure', levels = "
          "5, "
          "20 /\n"}) {
        std::array<Values, 2> x, Q, N, S, T, work;
        for (const std::size_t elements : {0, 1}) {
            const Reader file = run_to(
                folder / "rough.nc",
                bodies +
                    "&surface n = 256, L = 1, L_lambda_l = 2, L_lambda_s = 16, sigma = 1e-3 /\n" +
                    (elements
                         ? "&solver model = 'elements' /\n"
                         : "&solver model = 'asperities' / &asperities law = 'fourth_order' /\n"));
            x[elements] = file.values("tangential_displacement");
            Q[elements] = file.values("tangential_force");
            N[elements] = file.values("force");
            S[elements] = file.values("stiffness");
            T[elements] = file.values("tangential_stiffness");
            work[elements] = file.values("cycle_work");
        }
        const std::size_t points = x[0].size() / 2, first = 41;
        for (std::size_t k = 0; k < 2; ++k) {
            const auto a = row(x[1], k, points), q = row(Q[1], k, points), b = row(x[0], k, points),
                       p = row(Q[0], k, points);
            CHECK_RELATIVE(q[first - 1], 0.2 * N[1][k], 1e-6);
            CHECK_CLOSE(T[1][k] / S[1][k], T[0][k] / S[0][k], 1e-9);
            // At the origin the stiffness is that of stick.
            CHECK_RELATIVE(q[1] / a[1], T[1][k], 0.05);
            CHECK_RELATIVE(loop_area(a, q, first), work[1][k], 0.01);
            for (const std::size_t i : indices(first))
                CHECK_CLOSE(q[i] / (0.2 * N[1][k]), p[i] / (0.2 * N[0][k]), 0.03);
            CHECK_RELATIVE(a[first - 1], b[first - 1], 0.1);
        }
    }
}

TEST(loads_between_levels_are_those_of_levels) {
    // One level alone and the last of many: the table of loads has other levels, the loops agree
    // within its error, kCoarse of the load for each end of a piece of the memory.
    const Folder folder;
    const std::string keys =
        "&solids E = 80e3, 200e3  nu = 0.35, 0.3  R = Infinity, 20  friction = 0.2 /\n"
        "&surface L = 1, L_lambda_l = 2, L_lambda_s = 16, sigma = 1e-3 /\n"
        "&solver model = 'elements' /\n";
    const auto force = [&](const char* levels) {
        return run_to(folder / "slid.nc", keys + "&indentation " + levels + " /\n")
            .values("tangential_force");
    };
    const auto one = force("levels = 0.5"), all = force("start = 4, stop = 0.5, steps = 40");
    const auto many = row(all, 39, one.size());
    for (const auto k : indices(one)) CHECK_CLOSE(one[k], many[k], 4e-3 * one[40]);
}

}  // namespace test_friction_elements
