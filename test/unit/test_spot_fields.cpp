// What the contact spots do beside N: the lowering of the surface around them, and the lateral force on the sphere.
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "../physics/random_asperities.hpp"
#include "check.hpp"
#include "contact/asperity_contact.hpp"
#include "contact/deflection.hpp"
#include "contact/lateral.hpp"

using namespace rsc;
using std::numbers::pi;

namespace {

// Boussinesq's integral of the Hertz pressure: along a chord at distance h from the centre the pressure adds up to
// p0 pi (a^2 - h^2)/(2a), and all chords through the point at distance d make w = 1/(pi E*) int p dl dphi. Midpoint rule, exact but
// for the ends of the range outside the spot, where it is of order n^-2.
double boussinesq(double f, double a, double d, double E_star) {
    const double p0 = 1.5 * f / (pi * a * a), half = d > a ? std::asin(a / d) : pi / 2;
    const int n = 200000;
    double sum = 0;
    for (int k = 0; k < n; ++k) {
        const double h = d * std::sin(half * ((2 * k + 1.0) / n - 1));
        sum += a * a - h * h;
    }
    return p0 / (2 * a * E_star) * sum * 2 * half / n;
}

void test_one_spot() {
    const double f = 3.0, a = 0.02, E_star = 7e4;
    for (const double ratio : {0.0, 0.3, 0.9, 0.999, 1.0, 1.001, 1.1, 2.0, 5.0, 9.9, 10.1, 30.0}) {
        CHECK_RELATIVE(spot_deflection(f, a, ratio * a, E_star), boussinesq(f, a, ratio * a, E_star), 1e-9);
    }
    // No jump at the border of the spot, nor where the series takes over; and no noise from terms that cancel, however far away.
    const double edge = spot_deflection(f, a, a, E_star);
    CHECK_RELATIVE(spot_deflection(f, a, a * (1 + 1e-12), E_star), edge, 1e-11);
    CHECK_RELATIVE(spot_deflection(f, a, 10 * a * (1 - 1e-14), E_star), spot_deflection(f, a, 10 * a * (1 + 1e-14), E_star), 1e-12);
    for (const double ratio : {1e2, 1e4, 1e6, 1e9}) {
        const double d = ratio * a, s2 = 1 / (ratio * ratio);
        CHECK_RELATIVE(spot_deflection(f, a, d, E_star), f / (pi * E_star * d) * (1 + s2 / 10 + 9 * s2 * s2 / 280), 1e-13);
    }
}

// F = -dW/d(x0, y0) by central differences of the energy, far from a place of symmetry.
void test_lateral() {
    const Asperities asperities = random_asperities(2000, 0.01, 0.01, 3e-3, 0.3, 11);
    SolverOptions options;
    options.tolerance = 1e-11;
    for (const double R : {0.7, 5.0}) {
        const Indenter tip{9e4, R, 0.43, 0.58};
        const double Z0 = -0.01, h = 1e-6;
        const auto energy = [&](double x0, double y0) {
            AsperityContact contact(asperities, {tip.E_star, R, x0, y0}, options);
            contact.at_separation(Z0);
            return contact.energy();
        };
        AsperityContact contact(asperities, tip, options);
        const Level level = contact.at_separation(Z0);
        const Vec2 force = lateral_force(tip, level);
        CHECK(level.asperity.size() > 20 && std::abs(force.x) > 1e-4 * level.force && std::abs(force.y) > 1e-4 * level.force);
        // Differences err by h^2 of the third derivative, some 1e-5 of the force; another formula would by its order.
        const double tolerance = 1e-4 * std::hypot(force.x, force.y);
        CHECK_CLOSE(force.x, -(energy(tip.x0 + h, tip.y0) - energy(tip.x0 - h, tip.y0)) / (2 * h), tolerance);
        CHECK_CLOSE(force.y, -(energy(tip.x0, tip.y0 + h) - energy(tip.x0, tip.y0 - h)) / (2 * h), tolerance);
        const Vec2 flat = lateral_force({tip.E_star, std::numeric_limits<double>::infinity(), 0.43, 0.58}, level);
        CHECK(flat.x == 0 && flat.y == 0);
    }
}

}  // namespace

int main() {
    test_one_spot();
    test_lateral();
    return check::summary();
}
