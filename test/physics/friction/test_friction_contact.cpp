// Friction, conductance and lateral force of asperities in contact against problems solved on their
// own.
#include "check.hpp"
#include "contact/answers.hpp"
#include "physics/adhesion/adhesive_contact.hpp"
#include "physics/adhesion/sticking.hpp"
#include "physics/friction/contact_curve.hpp"
#include "support/asperities.hpp"
#include "support/paths.hpp"
#include "truth/elimination.hpp"

namespace test_friction_contact {

using namespace rsc;

constexpr double kE = 94.0e3;
const Friction kFriction{0.4, 0.75};
using Real = long double;

SolverOptions tight() { return {.tolerance = 1e-13}; }

struct Slid {
    Path one, other;
    ContactCurve curve{one, other};
    Slid(const Asperities& a, const Indenter& indenter, const SolverOptions& options)
        : one(asperity_path(a, indenter, options)), other(asperity_path(a, indenter, options)) {}
};

// The slip problem of spots solved directly. Pressed by the forces f_i with penetrations u_i, spot
// i slipped in to the penetration u*_i carries q_i = mu (f_i - f_i(u*_i)) and moves by (mu/m)(u_i -
// u*_i) against its surroundings (Mindlin), which all q_j move by q_j/(m pi E* d_ij): the sum is
// the slide xi of the sphere; a spot that would need u*_i < 0 slips as a whole. One scalar equation
// a spot, by bisection, spot after spot until nothing changes.
std::vector<Real> slip_problem(const Asperities& a, const Level& level, Real xi) {
    const std::size_t n = level.asperity.size();
    const Real mu = kFriction.coefficient, m = kFriction.ratio, pi = std::numbers::pi_v<Real>;
    std::vector<Real> q(n, 0);
    for (int sweep = 0; sweep < 400; ++sweep) {
        for (const std::size_t i : indices(n)) {
            const auto at = level.asperity[i];
            Real moved = 0;
            for (const std::size_t j : indices(n)) {
                const auto to = level.asperity[j];
                if (j != i)
                    moved += q[j] / (m * pi * kE *
                                     std::hypot(Real(a.x[at]) - a.x[to], Real(a.y[at]) - a.y[to]));
            }
            const Real rest = std::clamp<Real>(level.u[i] - m / mu * (xi - moved), 0, level.u[i]);
            const Real c = 4 / Real(3) * kE * std::sqrt(Real(a.radius[at]));
            q[i] = mu * (c * level.u[i] * std::sqrt(Real(level.u[i])) - c * rest * std::sqrt(rest));
        }
    }
    return q;
}

TEST(spots_against_slip_problem) {
    const Asperities a = asperities_at({{0.4, 0.5, 0.01, 3e-4},
                                        {0.413, 0.5, 0.009, 5e-4},
                                        {0.407, 0.511, 0.0095, 2e-4},
                                        {0.39, 0.508, 0.0082, 8e-4},
                                        {0.42, 0.49, 0.0101, 4e-4}});
    Slid slid(a, {kE, 2.5, 0.4, 0.5}, tight());
    const double delta = 0.0;
    const Level level = asperity_path(a, {kE, 2.5, 0.4, 0.5}, tight()).at_separation(-delta);
    CHECK(level.asperity.size() == a.size());
    const double full = full_slip(slid.curve, kFriction, delta);
    for (double part : {0.05, 0.3, 0.6, 0.9, 0.99}) {
        const auto q = slip_problem(a, level, part * full);
        FrictionHistory path(kFriction);
        path.go_to(slid.curve, delta, {});
        path.go_to(slid.curve, delta, {0, part * full});
        const auto spots = slip_of_spots(slid.curve, path);
        Real Q = 0;
        CHECK(spots.size() == q.size());
        for (const auto i : indices(q)) {
            Q += q[i];
            CHECK_CLOSE(spots[i].force.y, double(q[i]), 1e-8 * kFriction.coefficient * level.force);
            CHECK(spots[i].force.x == 0 && spots[i].stick_radius < spots[i].radius);
            CHECK(spots[i].asperity == level.asperity[i]);
            CHECK_RELATIVE(spots[i].radius, level.a[i], 1e-10);
            // c = a (1 - q/(mu f))^(1/3), Mindlin's stick radius of a spot of its own.
            const double left = 1 - double(q[i]) / (kFriction.coefficient * level.f[i]);
            CHECK_CLOSE(spots[i].stick_radius, level.a[i] * std::cbrt(std::max(0.0, left)),
                        1e-5 * level.a[i]);
        }
        CHECK_CLOSE(path.tangential_force().y, double(Q),
                    1e-8 * kFriction.coefficient * level.force);
        const auto points = slide_to(slid.curve, kFriction, delta, {part * full});
        CHECK_CLOSE(points[0].force, double(Q), 1e-8 * kFriction.coefficient * level.force);
    }
}

// Constriction (Holm; Greenwood 1966): a spot of radius a at unit potential passes the current 4
// a/(rho_1 + rho_2) and raises the potential at the distance d by I (rho_1 + rho_2)/(2 pi d).
// Solved for all spots by elimination; rho_1 + rho_2 = 1.
double conductance_of_spots(const Asperities& a, const Level& level) {
    const std::size_t n = level.asperity.size();
    std::vector<Real> A(n * n);
    for (const std::size_t i : indices(n))
        for (const std::size_t j : indices(n)) {
            const auto p = level.asperity[i], q = level.asperity[j];
            const Real d = std::hypot(Real(a.x[p]) - a.x[q], Real(a.y[p]) - a.y[q]);
            A[i * n + j] =
                i == j ? 1 / (4 * Real(level.a[i])) : 1 / (2 * std::numbers::pi_v<Real> * d);
        }
    Real sum = 0;
    for (const Real current : solved(A, std::vector<Real>(n, 1))) sum += current;
    return double(sum);
}

TEST(conductance) {
    const Asperities lone = asperities_at({{0.5, 0.5, 0.01, 3e-4}});
    Path holm = asperity_path(lone, {kE, kInfinity, 0.5, 0.5}, tight());
    const Level spot = holm.at_separation(0.004);
    CHECK_RELATIVE(-2 * holm.stiffness() / kE, 4 * spot.a[0], 1e-12);
    const Asperities a = random_asperities(400, 0.02, 0.01, 5e-4, 0.3, 3);
    Path contact = asperity_path(a, {kE, 2.5, 0.5, 0.5}, tight());
    for (double Z0 : {0.005, 0.0, -0.01}) {
        const Level level = contact.at_separation(Z0);
        CHECK(level.asperity.size() > 5);
        CHECK_RELATIVE(-2 * contact.stiffness() / kE, conductance_of_spots(a, level), 1e-10);
    }
    // With adhesion the separation changes the areas, too, and dN/dZ0 is not the conductance: down,
    // and up again to where contacts are stretched. The spots are those of the levels, to the error
    // of products in single precision.
    for (const double range : {0.0, 2e-3}) {
        SolverOptions options = tight();
        options.tolerance = 1e-9;
        options.physics.of<Adhesion>() = {2.0, range};
        const auto sticking = make_asperity_contact(a, {kE, 2.5, 0.5, 0.5}, options);
        for (double Z0 : {0.012, 0.006, 0.003, 0.008, 0.011}) {
            const Level level = sticking->at_separation(Z0);
            CHECK(level.asperity.size() > 1);
            CHECK_RELATIVE(conductance_length(*sticking, sticking->stiffness()),
                           conductance_of_spots(a, level), 1e-6);
        }
    }
}

}  // namespace test_friction_contact
