// Two flats that repeat: asperities and their images against scalar equations, a large period
// against none, methods against each other, conservation and symmetry.
#include "check.hpp"
#include "support/asperities.hpp"
#include "support/paths.hpp"

namespace test_periodic {

using namespace rsc;

constexpr double kE = 3.0;
constexpr double kSelf = -3.900264920001955886982;  // of the square lattice (test_lattice.cpp)

SolverOptions options(Method method, double tolerance = 1e-11, LawKind law = LawKind::hertz) {
    return {.method = method, .law = law, .tolerance = tolerance, .surface = {.sigma = 0.01}};
}

Indenter flats(double L) { return {kE, kInfinity, 0, 0, {L, L}}; }

Asperities on_square(int n, unsigned seed, double spacing = 0.02, double radius = 1e-3) {
    return random_asperities(n, spacing, 0.01, radius, 0.4, seed);
}

// u + lowering f(u) = depth, by bisection.
double pressed(double lowering, double depth, double radius) {
    double low = 0, high = depth * 10;
    for (int k = 0; k < 200; ++k) {
        const double u = 0.5 * (low + high);
        (u + lowering * 4.0 / 3 * kE * std::sqrt(radius) * u * std::sqrt(u) > depth ? high : low) =
            u;
    }
    return low;
}

// One asperity and its images, and two half a period apart (a lattice turned by 45 degrees): Z0 is
// the true one, of the mean planes.
TEST(asperities_and_images) {
    constexpr double kScalar = 1e-12;
    const double radius = 2e-3, L = 0.8;
    for (double Z0 : {0.0099, 0.005, -0.02}) {
        const double depth = 0.01 - Z0;
        const Asperities one = asperities_at({{0.1, 0.2, 0.01, radius}});
        const Asperities two = asperities_at({{0.1, 0.2, 0.01, radius}, {0.5, 0.6, 0.01, radius}});
        for (Method method : {Method::direct, Method::dgesv}) {
            Path single = asperity_path(one, flats(L), options(method, 1e-14));
            const double u = pressed(kSelf / (pi * kE * L), depth, radius);
            const Level level = single.at_separation(Z0);
            CHECK_RELATIVE(level.force, 4.0 / 3 * kE * std::sqrt(radius) * u * std::sqrt(u),
                           kScalar);
            CHECK_RELATIVE(level.u[0], u, kScalar);
            CHECK_RELATIVE(level.pressure_max, 2 * kE / pi * std::sqrt(u / radius), kScalar);
            Path both = asperity_path(two, flats(L), options(method, 1e-14));
            const double v = pressed(kSelf * std::sqrt(2.0) / (pi * kE * L), depth, radius);
            CHECK_RELATIVE(both.at_separation(Z0).force,
                           2 * 4.0 / 3 * kE * std::sqrt(radius) * v * std::sqrt(v), kScalar);
        }
    }
}

// Force control is the inverse of separation control; stiffness and force are the derivatives of
// force and energy.
TEST(controls_and_derivatives) {
    constexpr double kInverse = 1e-9, kDifference = 1e-6;
    const Asperities a = on_square(400, 31);
    Path contact = asperity_path(a, flats(1), options(Method::direct, 1e-12));
    for (double Z0 : {0.02, 0.01, 0.0}) {
        const Level level = contact.at_separation(Z0);
        CHECK(level.separation == Z0 && level.contacts > 2);
        Path other = asperity_path(a, flats(1), options(Method::direct, 1e-12));
        const Level pressed = other.at_force(level.force);
        CHECK_CLOSE(pressed.separation, Z0, kInverse * 0.01);
        CHECK_RELATIVE(pressed.force, level.force, 1e-11);
        const double S = contact.stiffness(), h = 1e-6;
        CHECK_RELATIVE(other.stiffness(), S, 1e-7);
        const Level up = contact.at_separation(Z0 + h);
        const double W_up = contact.energy();
        const Level down = contact.at_separation(Z0 - h);
        const double W_down = contact.energy();
        CHECK(up.asperity == down.asperity);
        CHECK_RELATIVE((up.force - down.force) / (2 * h), S, kDifference);
        CHECK_RELATIVE((W_down - W_up) / (2 * h), level.force, kDifference);
    }
    const Level touch = contact.at_separation(1.0);
    CHECK(touch.force == 0 && touch.contacts == 0 && contact.stiffness() == 0 &&
          contact.energy() == 0);
}

}  // namespace test_periodic
