// Several asperities that attract within a range: the path against a slow minimiser of the energy,
// and the work of cycles.
#include "support/adhesive_paths.hpp"

namespace test_dugdale_paths {

using namespace rsc;

// A paraboloid with the traction s0 out to the radius c, by the transform chi(t) = u - t^2/r in the
// contact, -(2 s0/E*) sqrt(c^2 - t^2) around it: f = 2 E* int_0^c chi dt, deflection at c = (2/pi)
// int_0^(pi/2) chi(c sin) d angle; the contact ends where both are equal.
struct DugdaleEdge {
    const Asperities& a;
    double w, z0;
    double s0() const { return w / z0; }
    double contact(std::size_t i, double c, double u) const {
        double low = 0, high = c;
        for (int k = 0; k < 100; ++k) {
            const double middle = 0.5 * (low + high);
            (middle * middle / a.radius[i] - 2 * s0() / kE * std::sqrt(c * c - middle * middle) < u
                 ? low
                 : high) = middle;
        }
        return u > -2 * s0() / kE * c ? low : 0.0;
    }
    double force(std::size_t i, double c, double u, double& slope) const {
        const double x = contact(i, c, u), t = std::asin(std::min(x / c, 1.0));
        slope = 2 * kE * x;
        return slope * (u - x * x / (3 * a.radius[i])) -
               4 * s0() * c * c * (0.25 * pi - 0.5 * t - 0.25 * std::sin(2 * t));
    }
    // The zone grows while the gap at its edge is below z0.
    double growth(std::size_t i, double c, double u) const {
        const double r = a.radius[i], t = std::asin(std::min(contact(i, c, u) / c, 1.0));
        const double sunk = 2 / pi *
                            (u * t - c * c / r * (0.5 * t - 0.25 * std::sin(2 * t)) -
                             2 * s0() / kE * c * (1 - std::sin(t)));
        return z0 - (c * c / (2 * r) - u + sunk);
    }
    double touches() const { return -z0; }
    double start(std::size_t i, double) const { return seed(i); }
    double seed(std::size_t i) const { return 0.4 * s0() * a.radius[i] / (pi * kE); }
};

// The range for Maugis's parameter of asperities of the mean radius.
double range_of(double w, double lambda) {
    return 2 * w / (lambda * std::cbrt(16 * pi * w * kE * kE / (9 * 0.25)));
}

// 21 levels down and 21 up: the same asperities attract at every level, and the forces agree to the
// accuracy of the minimiser's radii. Seed 102 has close neighbours whose zones overlap, and jumps
// far from equilibrium.
TEST(test_minimiser) {
    const struct {
        unsigned seed;
        int n;
        double apart, lambda;
    } cases[] = {{1, 3, 0.2, 0.1}, {2, 4, 0.2, 1}, {7, 2, 0.2, 3}, {102, 6, 0.08, 0.3}};
    for (const auto& [seed, n, apart, lambda] : cases) {
        const RandomAsperities system = random_asperities(n, seed, apart);
        const double range = range_of(system.w, lambda), length = reach(system.w);
        PathMinimiser slow(system.asperities, kE, DugdaleEdge{system.asperities, system.w, range});
        const auto contact = under_flat(system.asperities, sticky(system.w, range));
        const double top = 0.02 + range, bottom = 0;
        slow.Z = top;
        for (int k = 0; k <= 40; ++k) {
            const double Z = k <= 20 ? top + (bottom - top) * k / 20
                                     : bottom + (top + 2 * length - bottom) * (k - 20) / 20;
            slow.go_to(Z, 0.1 * length);
            const Level level = contact->at_separation(Z);
            CHECK(level.converged);
            CHECK((level.cohesive_area > 0) == (slow.attached() > 0));
            double rings = 0;  // of radii a to c, which attract without touching
            const LevelTractions& t = level.tractions;
            for (const auto i : indices(t.a)) rings += pi * (t.c[i] * t.c[i] - t.a[i] * t.a[i]);
            CHECK_CLOSE(level.cohesive_area, rings, 1e-12);
            CHECK_CLOSE(level.force, slow.force(),
                        1e-8 * std::max(std::abs(level.force), system.w));
        }
    }
}

TEST(test_work) {
    for (double lambda : {0.3, 2.0}) {
        const RandomAsperities system = random_asperities(5, 31, 0.2);
        const double range = range_of(system.w, lambda);
        const auto contact = under_flat(system.asperities, sticky(system.w, range));
        check_work_of_cycle(*contact, 0.05 + range, -0.005);
    }
}

// Weak attraction over a long range: an asperity lets go where it attaches, within rounding, and
// the way up is the way down. The tolerance of touching, 1e-8 of the range, leaves less than 1e-6 w
// in N.
TEST(test_reversible) {
    constexpr double w = 1e-8, range = 0.05;
    constexpr std::size_t steps = 9;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const RandomAsperities system = random_asperities(12, seed, 0.1);
        const auto contact = under_flat(system.asperities, sticky(w, range));
        std::vector<double> down;
        for (const std::size_t k : indices(2 * steps)) {
            const std::size_t place = std::min(k, 2 * steps - 1 - k);
            const Level level = contact->at_separation(0.075 - 0.01 * double(place));
            CHECK(level.converged);
            if (k < steps) down.push_back(level.force);
            CHECK_CLOSE(level.force, down[place], 1e-9 * std::abs(level.force) + 1e-6 * w);
        }
    }
}

}  // namespace test_dugdale_paths
