// The edges of the problem: whatever is asked, the answer is finite and right, or its status says
// what is wrong with it, or it is refused with a reason.
#include "asperities/newton.hpp"
#include "asperities/ranking.hpp"
#include "base/error.hpp"
#include "check.hpp"
#include "support/asperities.hpp"
#include "support/paths.hpp"
#include "support/refused.hpp"

namespace test_edges {

using namespace rsc;

constexpr double kE = 94.0e3;
const Method kMethods[] = {Method::direct, Method::dgesv, Method::mesh, Method::automatic};

SolverOptions options(Method method, double tolerance = 1e-10) {
    return {.method = method, .tolerance = tolerance, .surface = {.sigma = 0.01}};
}

Path path(const Asperities& a, double R, Method method = Method::direct, double tolerance = 1e-10) {
    return asperity_path(a, {kE, R, 0.5, 0.5}, options(method, tolerance));
}

// Everything in the level is finite, contacts are contacts, and sums are sums.
void sane(const Level& level, const char* what) {
    bool ok = std::isfinite(level.force) && std::isfinite(level.area) &&
              std::isfinite(level.residual) && level.force >= 0;
    double sum = 0;
    for (const auto k : indices(level.f)) {
        ok = ok && level.f[k] > 0 && std::isfinite(level.f[k]) && level.a[k] > 0 &&
             std::isfinite(level.a[k]) && level.u[k] > 0;
        ok = ok && (k == 0 || level.asperity[k] > level.asperity[k - 1]);
        sum += level.f[k];
    }
    ok = ok && std::abs(sum - level.force) <= 1e-12 * level.force;
    if (!ok) std::printf("%s\n", what);
    CHECK(ok);
}

// The residual of every asperity of the surface, written out in long double; the answer must hold
// whatever the solver left out.
double residual(const Asperities& a, const Indenter& indenter, double Z0, const Level& level) {
    std::vector<long double> F(a.size(), 0);
    for (const auto k : indices(level.f)) F[level.asperity[k]] = level.f[k];
    long double error2 = 0, force2 = 0;
    for (const auto i : indices(a)) {
        const long double dx = a.x[i] - indenter.x0, dy = a.y[i] - indenter.y0,
                          rho2 = dx * dx + dy * dy;
        const long double R = indenter.shape->hertz_radius();
        if (!std::isinf(indenter.shape->hertz_radius()) && rho2 > R * R) continue;
        long double g =
            a.z[i] - static_cast<long double>(Z0) -
            (std::isinf(indenter.shape->hertz_radius()) ? 0 : rho2 / (R + std::sqrt(R * R - rho2)));
        for (const auto j : indices(a)) {
            if (j != i)
                g -= F[j] / (std::numbers::pi_v<long double> * indenter.E_star *
                             std::hypot(static_cast<long double>(a.x[i]) - a.x[j],
                                        static_cast<long double>(a.y[i]) - a.y[j]));
        }
        const long double f = g > 0 ? 4 / 3.0L * indenter.E_star *
                                          std::sqrt(static_cast<long double>(a.radius[i])) * g *
                                          std::sqrt(g)
                                    : 0;
        error2 += (f - F[i]) * (f - F[i]);
        force2 += F[i] * F[i];
    }
    return force2 > 0 ? double(std::sqrt(error2 / force2)) : double(std::sqrt(error2));
}

void check_answer(const Asperities& a, const Indenter& indenter, double Z0, Method method,
                  const char* what, double tolerance = 1e-10) {
    const Level level = asperity_path(a, indenter, options(method, tolerance)).at_separation(Z0);
    sane(level, what);
    const double left = residual(a, indenter, Z0, level);
    const bool told = !level.converged, right = left <= 2 * tolerance;
    if (told || !right)
        std::printf("%s, method %d: status %d, residual %.1e, true residual %.1e\n", what,
                    int(method), int(level.status), level.residual, left);
    CHECK(!told);
    CHECK(right);
    CHECK_CLOSE(
        level.residual, left,
        method == Method::mesh ? tolerance : 0.01 * tolerance);  // the mesh: to its products
}

// Two asperities at one point have an infinite interaction. They are refused where asperities come
// from outside; the solver itself is never given them, and must not answer with NaN all the same.
TEST(coincident) {
    const auto three = [](double gap) {
        return asperities_at(
            {{0.5, 0.5, 0.01, 1e-3}, {0.5 + gap, 0.5, 0.012, 1e-3}, {0.6, 0.5, 0.01, 1e-3}});
    };
    const Asperities a = three(0);
    CHECK_THROWS(validate(a, [](std::size_t i) { return "asperity " + std::to_string(i); }), Error);
    for (Method method : kMethods)
        refusal([&] { sane(path(a, 2.5, method).at_separation(0.0), "coincident"); });
    // Nearly so: only one of the two can carry, whichever, and the level says that the other might
    // have. Nearer than the coordinates of the inner products resolve (2^-31 of the surface's
    // extent), the level may be said not to have converged instead.
    for (double gap : {1.2e-16, 1e-14, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4}) {
        const Asperities near = three(gap);
        for (Method method : kMethods) {
            const Level level = path(near, 2.5, method).at_separation(0.0);
            sane(level, "nearly coincident");
            if (gap < 1e-9) {
                CHECK((!level.unique || !level.converged));
                CHECK(!level.converged || residual(near, {kE, 2.5, 0.5, 0.5}, 0.0, level) <= 2e-10);
                continue;
            }
            CHECK(!level.unique);
            CHECK(level.f.size() == 2);
            CHECK(residual(near, {kE, 2.5, 0.5, 0.5}, 0.0, level) <= 2e-10);
        }
    }
}

// Spots that overlap: a local minimum of the energy, or close to one in the same sense, and
// flagged. Between two equal ones the threshold is d = (2/pi) a.
TEST(overlapping) {
    const double r = 1e-2, g = 0.01;
    for (double d : {0.03, 0.015, 0.008, 0.004, 0.001, 1e-4}) {
        const Asperities a = asperities_at({{0.5 - d / 2, 0.5, g, r}, {0.5 + d / 2, 0.5, g, r}});
        for (Method method : kMethods) {
            const Level level = path(a, kInfinity, method).at_separation(0.0);
            sane(level, "overlapping");
            CHECK(residual(a, {kE, kInfinity, 0.5, 0.5}, 0.0, level) <= 2e-10);
            bool overlap = level.f.size() == 2 && d < level.a[0] + level.a[1];
            CHECK(level.overlapping_pairs == overlap);
            // Beyond (2/pi) a of the radius each would have alone, the largest any solution can
            // have, there is one solution only; far within it there are others, and this is told.
            const double unique_from = 2 / pi * std::sqrt(r * g);
            if (d > 1.2 * unique_from) CHECK(level.unique && level.converged);
            if (d < 0.5 * unique_from) CHECK(!level.unique);
            if (level.f.size() == 2)
                CHECK(d >= 2 / pi * std::sqrt(level.a[0] * level.a[1]) * (1 - 1e-6));
            else
                CHECK(!level.unique);
        }
    }
}

// From far above to far below the surface; the deepest has every asperity in contact or pushed out
// by its neighbours.
TEST(depths) {
    const Asperities a = random_asperities(200, 0.03, 0.01, 1e-3, 0.5, 12);
    for (double R : {2.5, 1e6, kInfinity}) {
        double last = 0;
        for (double Z0 : {1e6, 1.0, 0.04, 0.02, 0.0, -0.05, -0.5, -10.0, -1e3, -1e6}) {
            for (Method method : kMethods)
                check_answer(a, {kE, R, 0.5, 0.5}, Z0, method,
                             ("depth " + std::to_string(Z0)).c_str());
            for (const double loose : {1e-6, 1e-7})
                check_answer(a, {kE, R, 0.5, 0.5}, Z0, Method::direct, "loose", loose);
            const double N = path(a, R).at_separation(Z0).force;
            CHECK(N >= last);
            if (Z0 > 0.5) CHECK(N == 0);
            last = N;
        }
        CHECK(last > 0);
    }
    // The flat gives what a very large sphere gives.
    const double flat = path(a, kInfinity, Method::direct, 1e-12).at_separation(0.0).force;
    CHECK_RELATIVE(path(a, 1e12, Method::direct, 1e-12).at_separation(0.0).force, flat, 1e-9);
}

// Loads from that of a touch to far beyond.
TEST(forces) {
    const Asperities a = random_asperities(200, 0.03, 0.01, 1e-3, 0.5, 15);
    for (double N : {1e-9, 1e-3, 1.0, 1e3, 1e6, 1e9}) {
        Path contact = path(a, 2.5);
        const Level level = contact.at_force(N);
        sane(level, "force");
        // Z0 has neighbours only so near, and the force with it: the last term is what one summit
        // of radius 5e-3 or less takes.
        const double ulp =
            std::nextafter(std::abs(level.separation), kInfinity) - std::abs(level.separation);
        CHECK(level.converged);
        CHECK_CLOSE(level.force, N,
                    1e-10 * N + 4 * ulp * std::abs(contact.stiffness()) +
                        kE * 0.1 * std::pow(4 * ulp, 1.5));
    }
    Path contact = path(a, 2.5);
    for (double N : {0.0, -1.0, 1e-20, std::nan(""), kInfinity})
        CHECK_THROWS(contact.at_force(N), Error);
    for (double Z0 : {std::nan(""), kInfinity, -kInfinity})
        CHECK_THROWS(contact.at_separation(Z0), Error);
    for (double E : {0.0, -1.0, std::nan(""), kInfinity})
        CHECK_THROWS(asperity_path(a, {E, 2.5, 0.5, 0.5}, options(Method::direct)), Error);
    for (double R : {0.0, -1.0, std::nan("")}) CHECK_THROWS(path(a, R), Error);
}

// Residuals of numbers whose squares are none.
TEST(beyond_squares) {
    for (double size : {1e-200, 1.0, 1e200})
        CHECK_RELATIVE(relative_residual({3 * size, 4 * size}, {50 * size, 0}), 0.1, 1e-15);
    CHECK(relative_residual({0, 0}, {0, 0}) == 0);
    CHECK(relative_residual({1e-300, 0}, {0, 0}) == 1);
    CHECK(relative_residual({1, 0}, {kInfinity, 0}) == 1);
    const Asperities a =
        asperities_at({{0, 0, 0, 0.5e-3}, {1e-3, 0, 0, 0.5e-3}, {0, 1e-3, 0, 0.5e-3}});
    for (Method method : {Method::direct, Method::dgesv}) {
        const Level level = asperity_path(a, {kE, kInfinity, 0, 0}, options(method))
                                .at_separation(-1e170);  // forces of some 1e258
        CHECK(std::isfinite(level.residual));
        CHECK(level.residual < 1
                  ? std::isfinite(level.force)
                  : std::isnan(level.force) && level.contacts == 0);  // no state, no numbers
        CHECK(!level.converged || level.residual < 1e-6);
    }
}

}  // namespace test_edges
