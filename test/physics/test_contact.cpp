// The contact of a few asperities against closed forms, and the symmetries every answer must have.
#include <algorithm>
#include <numbers>

#include "check.hpp"
#include "contact/asperity_contact.hpp"
#include "contact/ranking.hpp"
#include "contact/solver/newton.hpp"
#include "error.hpp"
#include "random_asperities.hpp"

using namespace rsc;

namespace {

constexpr double kE = 94.0e3;
constexpr double kFlat = __builtin_huge_val();
const Method kMethods[] = {Method::dgesv, Method::direct};

SolverOptions options(Method method, double tolerance) {
    SolverOptions o;
    o.method = method;
    o.tolerance = tolerance;
    o.sigma = 0.01;
    return o;
}

Level press(const Asperities& a, double Z0, const SolverOptions& o, double R = 2.5, double x0 = 0.5, double y0 = 0.5) {
    return AsperityContact(a, {kE, R, x0, y0}, o).at_separation(Z0);
}

// One asperity under the tip is Hertz contact, to rounding.
void one_asperity_is_hertz() {
    Asperities a;
    a.x = {0.5}, a.y = {0.5}, a.z = {0.02}, a.radius = {2e-4};
    for (Method method : kMethods) {
        const Level level = press(a, 0.013, options(method, 1e-13));
        const double u = 0.007;
        CHECK_RELATIVE(level.force, 4.0 / 3.0 * kE * std::sqrt(2e-4) * std::pow(u, 1.5), 1e-12);
        CHECK_RELATIVE(level.area, std::numbers::pi * 2e-4 * u, 1e-12);
        CHECK(level.status == LevelStatus::converged);
    }
    // Away from the tip the sphere is higher by R - sqrt(R^2 - rho^2).
    a.x = {0.8}, a.y = {0.1};
    const Level level = press(a, 0.0, options(Method::direct, 1e-13), 0.75, 0.5, 0.5);
    CHECK(level.candidates == 0);  // rho = 0.5: the sphere is 0.191 higher there
    a.z = {0.2};
    const double u = 0.2 + std::sqrt(0.75 * 0.75 - 0.25) - 0.75;
    CHECK_RELATIVE(press(a, 0.0, options(Method::direct, 1e-13), 0.75).force, 4.0 / 3.0 * kE * std::sqrt(2e-4) * std::pow(u, 1.5), 1e-12);
}

// Two equal asperities: f = c (g - f/(pi E* d))^(3/2), solved here by bisection.
void two_equal_asperities() {
    const double g = 0.01, r = 3e-4, d = 0.01, c = 4.0 / 3.0 * kE * std::sqrt(r);
    double low = 0, high = c * std::pow(g, 1.5);
    for (int i = 0; i < 200; ++i) {
        const double f = 0.5 * (low + high), left = g - f / (std::numbers::pi * kE * d);
        (left > 0 && c * std::pow(left, 1.5) > f ? low : high) = f;
    }
    Asperities a;
    a.x = {0.4, 0.4 + d}, a.y = {0.5, 0.5}, a.z = {g, g}, a.radius = {r, r};
    for (Method method : kMethods) {
        const Level level = press(a, 0.0, options(method, 1e-13), kFlat);
        CHECK_RELATIVE(level.force, 2 * low, 1e-12);
        CHECK(level.asperity.size() == 2);
    }
}

// Translation, rotation by 90 degrees and renumbering change loads by rounding only.
void symmetries() {
    const Asperities a = random_asperities(400, 0.012, 0.01, 5e-4, 0.5, 1);
    constexpr double tolerance = 1e-9;  // of the loads, as the solver is asked for 1e-12
    for (Method method : kMethods) {
        const SolverOptions o = options(method, 1e-12);
        const Level level = press(a, -0.005, o);
        CHECK(level.asperity.size() > 30);
        Asperities moved = a, turned = a, renumbered = a;
        for (std::size_t k = 0; k < a.size(); ++k) {
            moved.x[k] += 3.7;
            moved.y[k] -= 11.3;
            turned.x[k] = 1 - a.y[k];
            turned.y[k] = a.x[k];
        }
        for (auto* v : {&renumbered.x, &renumbered.y, &renumbered.z, &renumbered.radius}) std::reverse(v->begin(), v->end());
        CHECK_RELATIVE(press(moved, -0.005, o, 2.5, 0.5 + 3.7, 0.5 - 11.3).force, level.force, tolerance);
        CHECK_RELATIVE(press(turned, -0.005, o).force, level.force, tolerance);
        const Level other = press(renumbered, -0.005, o);
        CHECK_RELATIVE(other.force, level.force, tolerance);
        for (std::size_t k = 0; k < level.f.size() && other.f.size() == level.f.size(); ++k) {
            CHECK_CLOSE(other.f[level.f.size() - 1 - k], level.f[k], tolerance * level.force);
        }
    }
}

// All lengths by s: forces by s^2, areas by s^2. The modulus by t: forces by t. Exact but for rounding and the tolerance.
void scaling() {
    const Asperities a = random_asperities(300, 0.012, 0.01, 5e-4, 0.5, 2);
    for (Method method : kMethods) {
        SolverOptions o = options(method, 1e-12);
        const Level level = press(a, 0.005, o);
        Asperities large = a;
        const double s = 1024.0;
        for (auto* v : {&large.x, &large.y, &large.z, &large.radius}) {
            for (double& value : *v) value *= s;
        }
        o.sigma *= s;
        const Level scaled = AsperityContact(large, {kE, 2.5 * s, 0.5 * s, 0.5 * s}, o).at_separation(0.005 * s);
        CHECK_RELATIVE(scaled.force, s * s * level.force, 1e-10);
        CHECK_RELATIVE(scaled.area, s * s * level.area, 1e-10);
        o.sigma /= s;
        CHECK_RELATIVE(AsperityContact(a, {3 * kE, 2.5, 0.5, 0.5}, o).at_separation(0.005).force, 3 * level.force, 1e-10);
    }
}

// The paper's method: neither the first regularisation nor how fast it is cut matters to the answer.
void regularisation_leaves_no_trace() {
    const Asperities a = random_asperities(300, 0.012, 0.01, 5e-4, 0.5, 3);
    const double reference = press(a, 0.005, options(Method::dgesv, 1e-11)).force;
    for (double delta0 : {0.1, 0.01, 0.001}) {
        for (double cut : {2.0, 5.0, 10.0}) {
            SolverOptions o = options(Method::dgesv, 1e-10);
            o.delta0 = delta0;
            o.delta_cut = cut;
            CHECK_RELATIVE(press(a, 0.005, o).force, reference, 1e-9);
        }
    }
}

// B F only lowers the surface: asperities with g0 <= 0 never touch, so leaving them out loses nothing. Here nothing is left out:
// every asperity enters a plain fixed-point residual of the whole surface.
void overlap_selection_loses_nothing() {
    const Asperities a = random_asperities(500, 0.01, 0.01, 5e-4, 0.5, 4);
    const double Z0 = -0.01;
    const Level level = press(a, Z0, options(Method::direct, 1e-12));
    CHECK(level.candidates < 500);
    std::vector<double> F(a.size(), 0.0);
    for (std::size_t k = 0; k < level.asperity.size(); ++k) F[static_cast<std::size_t>(level.asperity[k])] = level.f[k];
    for (std::size_t i = 0; i < a.size(); ++i) {
        double g = height_under_sphere({kE, 2.5, 0.5, 0.5}, a.x[i], a.y[i], a.z[i]) - Z0;
        for (std::size_t j = 0; j < a.size(); ++j) {
            if (i != j) g -= F[j] / (std::numbers::pi * kE * std::hypot(a.x[i] - a.x[j], a.y[i] - a.y[j]));
        }
        const double f = g > 0 ? 4.0 / 3.0 * kE * std::sqrt(a.radius[i]) * std::pow(g, 1.5) : 0.0;
        CHECK_CLOSE(F[i], f, 1e-10 * level.force);
    }
    // The paper's selection keeps asperities within 1.5 sqrt(2 (4 sigma - Z0) R) of the tip.
    SolverOptions o = options(Method::direct, 1e-12);
    o.selection = Selection::paper;
    CHECK(press(a, 4 * o.sigma, o).candidates == 0);
    o.selection_factor = 0.3;
    const Level few = press(a, Z0, o);
    const double r0 = 0.3 * std::sqrt(2 * (4 * o.sigma - Z0) * 2.5);
    CHECK(few.candidates > 0 && few.candidates < level.candidates);
    for (int i : few.asperity) CHECK(std::hypot(a.x[static_cast<std::size_t>(i)] - 0.5, a.y[static_cast<std::size_t>(i)] - 0.5) <= r0);
}

// No interaction: a sum of Hertz contacts.
void without_interaction() {
    const Asperities a = random_asperities(300, 0.005, 0.01, 5e-4, 0.5, 5);
    SolverOptions o = options(Method::direct, 1e-12);
    o.interaction = Interaction::none;
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double g = height_under_sphere({kE, 2.5, 0.5, 0.5}, a.x[i], a.y[i], a.z[i]) - 0.002;
        if (g > 0) sum += 4.0 / 3.0 * kE * std::sqrt(a.radius[i]) * std::pow(g, 1.5);
    }
    CHECK_RELATIVE(press(a, 0.002, o).force, sum, 1e-12);
    o.method = Method::dgesv;
    CHECK_RELATIVE(press(a, 0.002, o).force, sum, 1e-12);
}

// dN/dZ0 against central differences; pressing with a force finds the separation again.
void stiffness_and_force_control() {
    const Asperities a = random_asperities(400, 0.012, 0.01, 5e-4, 0.5, 6);
    AsperityContact contact(a, {kE, 2.5, 0.5, 0.5}, options(Method::direct, 1e-12));
    const double h = 1e-6;
    const double plus = contact.at_separation(0.006 + h).force, minus = contact.at_separation(0.006 - h).force;
    const double N = contact.at_separation(0.006).force, K = contact.stiffness();
    CHECK_RELATIVE(K, (plus - minus) / (2 * h),
                   1e-6);  // second-order differences: (h/sigma)^2 = 1e-8, and kinks as contacts form
    CHECK(K < 0);
    const Level again = contact.at_force(N);
    CHECK_RELATIVE(again.force, N, 1e-11);
    CHECK_RELATIVE(again.separation, 0.006, 1e-9);
    for (double force : {1e-6 * N, 1e-3 * N, 30 * N}) {
        AsperityContact fresh(a, {kE, 2.5, 0.5, 0.5}, options(Method::direct, 1e-10));
        const Level level = fresh.at_force(force);
        CHECK_RELATIVE(level.force, force, 1e-9);
        CHECK(level.status != LevelStatus::not_converged);
    }
}

}  // namespace

int main() {
    one_asperity_is_hertz();
    two_equal_asperities();
    symmetries();
    scaling();
    regularisation_leaves_no_trace();
    overlap_selection_loses_nothing();
    without_interaction();
    stiffness_and_force_control();
    CHECK_THROWS(AsperityContact(Asperities{}, {-1.0, 2.5, 0, 0}, SolverOptions{}), Error);
    CHECK_THROWS(AsperityContact(Asperities{}, {1.0, 0.0, 0, 0}, SolverOptions{}), Error);
    return check::summary();
}
