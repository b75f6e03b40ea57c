// What the contact spots do beside N: the lowering of the surface around them, and the lateral
// force on the sphere.
#include "check.hpp"
#include "contact/answers.hpp"
#include "contact/deflection.hpp"
#include "interaction/lattice.hpp"

namespace test_spot_fields {

using namespace rsc;

// Boussinesq's integral of the Hertz pressure: along a chord at distance h from the centre the
// pressure adds up to p0 pi (a^2 - h^2)/(2a), and all chords through the point at distance d make w
// = 1/(pi E*) int p dl dphi. Midpoint rule, exact but for the ends of the range outside the spot,
// where it is of order n^-2.
double boussinesq(double f, double a, double d, double E_star) {
    const double p0 = 1.5 * f / (pi * a * a), half = d > a ? std::asin(a / d) : pi / 2;
    const int n = 200000;
    double sum = 0;
    for (const int k : indices(n)) {
        const double h = d * std::sin(half * ((2 * k + 1.0) / n - 1));
        sum += a * a - h * h;
    }
    return p0 / (2 * a * E_star) * sum * 2 * half / n;
}

TEST(test_one_spot) {
    const double f = 3.0, a = 0.02, E_star = 7e4;
    for (const double ratio : {0.0, 0.3, 0.9, 0.999, 1.0, 1.001, 1.1, 2.0, 5.0, 9.9, 10.1, 30.0}) {
        CHECK_RELATIVE(spot_deflection(f, a, ratio * a, E_star),
                       boussinesq(f, a, ratio * a, E_star), 1e-9);
    }
    // No jump at the border of the spot, nor where the series takes over; and no noise from terms
    // that cancel, however far away.
    const double edge = spot_deflection(f, a, a, E_star);
    CHECK_RELATIVE(spot_deflection(f, a, a * (1 + 1e-12), E_star), edge, 1e-11);
    CHECK_RELATIVE(spot_deflection(f, a, 10 * a * (1 - 1e-14), E_star),
                   spot_deflection(f, a, 10 * a * (1 + 1e-14), E_star), 1e-12);
    for (const double ratio : {1e2, 1e4, 1e6, 1e9}) {
        const double d = ratio * a, s2 = 1 / (ratio * ratio);
        CHECK_RELATIVE(spot_deflection(f, a, d, E_star),
                       f / (pi * E_star * d) * (1 + s2 / 10 + 9 * s2 * s2 / 280), 1e-13);
    }
}

// Spots between two flats: the field repeats with the surface. Pixels: test_element_levels.
TEST(test_fields) {
    const double E_star = 7e4;
    Level level;
    level.add_contact(0, 0.3, 0.9, 2.0, 0.02, 1e-3);
    level.add_contact(1, 1.9, 0.05, 1.0, 0.01, 1e-3);
    const auto free = make_kernel(Interaction::point, E_star, {});
    const auto kernel = make_kernel(Interaction::point, E_star, Period{2, 1});
    const Lattice lattice({2, 1});
    for (const auto& [x, y] : {std::pair{0.3, 0.9}, {0.31, 0.89}, {0.5, 0.2}, {1.8, 0.1}}) {
        // What each spot does, and with images what they do as points: all of them less the
        // nearest.
        const double one = std::hypot(x - 0.3, y - 0.9), other = std::hypot(x - 1.9, y - 0.05);
        const double alone =
            spot_deflection(2.0, 0.02, one, E_star) + spot_deflection(1.0, 0.01, other, E_star);
        CHECK_RELATIVE(deflection(level, *free, x, y), alone, 1e-14);
        const double xn = std::remainder(x - 0.3, 2.0), yn = std::remainder(y - 0.9, 1.0),
                     xm = std::remainder(x - 1.9, 2.0), ym = std::remainder(y - 0.05, 1.0),
                     near = std::hypot(xn, yn);
        const double beside = std::hypot(xm, ym);
        const double images = 2.0 * (near > 0 ? lattice.at(xn, yn) - 1 / near : lattice.self()) +
                              (lattice.at(xm, ym) - 1 / beside);
        CHECK_RELATIVE(deflection(level, *kernel, x, y),
                       spot_deflection(2.0, 0.02, near, E_star) +
                           spot_deflection(1.0, 0.01, beside, E_star) + images / (pi * E_star),
                       1e-10);
    }
    for (const auto& [x, y] : {std::pair{0.3, 0.9}, {0.31, 0.02}, {1.2, 0.5}, {0.1, 0.04}}) {
        const double here = deflection(level, *kernel, x, y);
        for (const auto& [m, n] : {std::pair{1, 0}, {0, 1}, {0, -1}, {-2, 3}})
            CHECK_RELATIVE(deflection(level, *kernel, x + 2 * m, y + n), here, 1e-11);
    }
}

// The moment about the tip: a force beside it turns the flat about the other axis; a flat is a
// sphere without end.
TEST(test_moment) {
    Level level;
    level.add_contact(0, 0.6, 0.2, 3.0, 0.01, 1e-3);
    const Indenter flat{7e4, kInfinity, 0.5, 0.5},
        beside{7e4, flat.shape->hertz_radius(), 0.6, 0.5}, large{7e4, 1e7, 0.5, 0.5};
    const Vec2 both = tip_moment(flat, level), one = tip_moment(beside, level),
               sphere = tip_moment(large, level);
    CHECK_RELATIVE(both.x, 3.0 * (0.2 - 0.5), 1e-14);
    CHECK_RELATIVE(both.y, -3.0 * (0.6 - 0.5), 1e-14);
    CHECK(one.y == 0 && one.x == both.x);
    CHECK_RELATIVE(sphere.x, both.x, 1e-12);
    CHECK_RELATIVE(sphere.y, both.y, 1e-12);
}

}  // namespace test_spot_fields
