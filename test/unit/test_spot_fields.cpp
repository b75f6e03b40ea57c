// The lowering of the surface around the contact spots. Lateral force and moment: physics/test_every_value.
#include "check.hpp"
#include "contact/deflection.hpp"
#include "contact/interaction/lattice.hpp"

using namespace rsc;
using std::numbers::pi;

namespace {

// In and around the spot: test_api, physics/test_adhesive_fields.
TEST(test_one_spot) {
    const double f = 3.0, a = 0.02, E_star = 7e4;
    // No jump at the border of the spot, nor where the series takes over; and no noise from terms that cancel, however far away.
    const double edge = spot_deflection(f, a, a, E_star);
    CHECK_RELATIVE(spot_deflection(f, a, a * (1 + 1e-12), E_star), edge, 1e-11);
    CHECK_RELATIVE(spot_deflection(f, a, 10 * a * (1 - 1e-14), E_star), spot_deflection(f, a, 10 * a * (1 + 1e-14), E_star), 1e-12);
    for (const double ratio : {1e2, 1e4, 1e6, 1e9}) {
        const double d = ratio * a, s2 = 1 / (ratio * ratio);
        CHECK_RELATIVE(spot_deflection(f, a, d, E_star), f / (pi * E_star * d) * (1 + s2 / 10 + 9 * s2 * s2 / 280), 1e-13);
    }
}

// Spots between two flats: the field repeats with the surface. Pixels: physics/test_element_levels.
TEST(test_fields) {
    const double E_star = 7e4;
    Level level;
    level.add_contact(0, 0.3, 0.9, 2.0, 0.02, 1e-3), level.add_contact(1, 1.9, 0.05, 1.0, 0.01, 1e-3);
    const auto free = make_kernel(Interaction::point, E_star, {});
    const auto kernel = make_kernel(Interaction::point, E_star, Period{2, 1});
    const Lattice lattice({2, 1});
    for (const auto& [x, y] : {std::pair{0.3, 0.9}, {0.31, 0.89}, {0.5, 0.2}, {1.8, 0.1}}) {
        // What each spot does, and with images what they do as points: all of them less the nearest.
        const double one = std::hypot(x - 0.3, y - 0.9), other = std::hypot(x - 1.9, y - 0.05);
        const double alone = spot_deflection(2.0, 0.02, one, E_star) + spot_deflection(1.0, 0.01, other, E_star);
        CHECK_RELATIVE(deflection(level, *free, x, y), alone, 1e-14);
        const double xn = std::remainder(x - 0.3, 2.0), yn = std::remainder(y - 0.9, 1.0), xm = std::remainder(x - 1.9, 2.0),
                     ym = std::remainder(y - 0.05, 1.0), near = std::hypot(xn, yn), beside = std::hypot(xm, ym);
        const double images = 2.0 * (near > 0 ? lattice.at(xn, yn) - 1 / near : lattice.self()) + (lattice.at(xm, ym) - 1 / beside);
        CHECK_RELATIVE(deflection(level, *kernel, x, y),
                       spot_deflection(2.0, 0.02, near, E_star) + spot_deflection(1.0, 0.01, beside, E_star) + images / (pi * E_star),
                       1e-10);
    }
    for (const auto& [x, y] : {std::pair{0.3, 0.9}, {0.31, 0.02}, {1.2, 0.5}, {0.1, 0.04}}) {
        const double here = deflection(level, *kernel, x, y);
        for (const auto& [m, n] : {std::pair{1, 0}, {0, 1}, {0, -1}, {-2, 3}})
            CHECK_RELATIVE(deflection(level, *kernel, x + 2 * m, y + n), here, 1e-11);
    }
}

}  // namespace
