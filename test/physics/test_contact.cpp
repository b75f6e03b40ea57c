// The contact of a few asperities against closed forms, and the symmetries every answer must have.
#include "check.hpp"
#include "contact/asperity_contact.hpp"
#include "contact/expected_error.hpp"
#include "contact/ranking.hpp"
#include "contact/solver/newton.hpp"
#include "contact/start.hpp"
#include "error.hpp"
#include "physics/random_asperities.hpp"

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
        double g = Indenter{kE, 2.5, 0.5, 0.5}.clearance(a.x[i], a.y[i], a.z[i]) - Z0;
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

// The rule that defines the answer of a level starts from the mean field: F = f(<g0 - s>) with s the mean of B F over F, to a
// hundredth of the largest g0; F'BF - s sum F falls as s grows.
void start_is_the_mean_field() {
    for (unsigned seed = 20; seed < 26; ++seed) {
        const Asperities a = random_asperities(100, 0.01, 0.01, 1e-3, 0.5, seed);
        WorkingSet set;
        double highest = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            if (!(a.z[i] + 0.02 > 0)) continue;
            set.asperity.push_back(static_cast<int>(i)), set.x.push_back(a.x[i]), set.y.push_back(a.y[i]), set.g0.push_back(a.z[i] + 0.02);
            highest = std::max(highest, set.g0.back());
        }
        const auto law = make_law(LawKind::hertz, a, kE);
        law->prepare(set.asperity);
        const auto products = make_direct_products(make_kernel(Interaction::point, kE));
        const std::vector<double> start = cold_start(*law, *products, set);
        const double s = set.g0[0] - start[0];
        CHECK(s > 0.1 * highest && s < highest);
        const auto excess = [&](double t) {  // of the mean field over t, times the load
            double sum = 0;
            std::vector<double> F;
            for (std::size_t i = 0; i < start.size(); ++i) F.push_back(law->force(set.asperity[i], set.g0[i] - t));
            for (std::size_t i = 0; i < F.size(); ++i) {
                sum -= t * F[i];
                for (std::size_t j = 0; j < F.size(); ++j)
                    if (i != j) sum += F[i] * F[j] / (std::numbers::pi * kE * std::hypot(set.x[i] - set.x[j], set.y[i] - set.y[j]));
            }
            return sum;
        };
        CHECK(excess(s - 0.01 * highest) > 0 && excess(s + 0.02 * highest) < 0);
        for (std::size_t i = 0; i < start.size(); ++i) CHECK_CLOSE(start[i], set.g0[i] - s, 1e-15);
    }
}

// Two asperities so close that only one can carry: the one that the descending sphere meets first keeps the other out, whichever
// would carry more. So it is from the first touch on, and so it is for a level alone.
void of_two_the_first_met_carries() {
    for (double lower : {0.7, 0.8, 0.9}) {
        for (double larger : {0.3, 1.0, 4.0}) {
            const double r = 1e-2, g = 0.01;
            Asperities a;
            a.x = {0.5, 0.5005}, a.y = {0.5, 0.5}, a.z = {lower * g, g}, a.radius = {larger * r, r};
            for (Method method : {Method::direct, Method::dgesv, Method::mesh}) {
                const Level level = press(a, 0.0, options(method, 1e-10), kFlat);
                CHECK(level.status == LevelStatus::not_unique);
                CHECK(level.asperity == std::vector<int>{1});
                CHECK_RELATIVE(level.force, 4.0 / 3.0 * kE * std::sqrt(r) * std::pow(g, 1.5), 1e-9);
            }
        }
    }
}

// Asperities that nearly coincide are not told apart in single precision: nothing is proved of them. A little further apart it is: the one
// that hardly reaches up has no solution of its own.
void asperities_that_nearly_coincide() {
    for (const auto& [apart, along_y, status] : {std::tuple{0.9e-6, false, LevelStatus::not_unique},
                                                 {0.9e-6, true, LevelStatus::not_unique},
                                                 {1.1e-6, false, LevelStatus::converged},
                                                 {1.1e-6, true, LevelStatus::converged}}) {
        Asperities a;
        a.x = {0.2, 0.5, 0.5 + apart, 1.2}, a.y = {0.5, 0.4, 0.4, 0.45}, a.z = {1e-3, 1e-2, 1e-11, 1e-3},
        a.radius = {1e-3, 1e-3, 1e-3, 1e-3};
        if (along_y) std::swap(a.x, a.y);
        const Level level = press(a, 0.0, options(Method::direct, 1e-10), kFlat);
        CHECK(level.status == status && level.contacts == 3 && level.candidates == 4);
    }
}

// N = 1 - Z0 with a step from 0.7 to 5.7 at Z0 = 0.3.
class Step final : public Contact {
public:
    double stiffness() override { return touching_ ? -1.0 : 0.0; }
    double energy() const override { return 0; }
    void move_tip(double, double) override {}
    void recall(const std::vector<double>&, const Level*) override {}
    double first_touch() const override { return 1; }
    const Indenter& indenter() const override { return indenter_; }

protected:
    void forget_levels() override {}
    Level solve(double Z0) override {
        Level level;
        level.separation = Z0;
        level.force = Z0 >= 1 ? 0 : Z0 > 0.3 ? 1 - Z0 : 6 - Z0;
        touching_ = level.force > 0;
        return level;
    }
    double tolerance() const override { return 1e-10; }
    double force_at_most(double depth) override { return depth; }
    std::optional<double> likely_separation() const override { return {}; }
    std::size_t levels_since_move() const override { return 2; }

private:
    Indenter indenter_{1, 1, 0, 0};
    bool touching_ = false;
};

// A force that no separation carries is told; those on both sides of the step are found.
void a_force_over_which_N_jumps() {
    Step contact;
    for (const double N : {0.5, 0.699, 5.701, 8.0}) {
        const Level level = contact.at_force(N);
        CHECK(level.status == LevelStatus::converged);
        CHECK_RELATIVE(level.force, N, 1e-10);
    }
    for (const double N : {0.71, 3.0, 5.69}) {
        const Level level = contact.at_force(N);
        CHECK(level.status == LevelStatus::not_converged && level.fallback == Fallback::jump);
        CHECK_CLOSE(level.separation, 0.3, 1e-12);
    }
}

}  // namespace

TESTS {
    a_force_over_which_N_jumps();
    one_asperity_is_hertz();
    two_equal_asperities();
    regularisation_leaves_no_trace();
    overlap_selection_loses_nothing();
    stiffness_and_force_control();
    start_is_the_mean_field();
    of_two_the_first_met_carries();
    asperities_that_nearly_coincide();
    CHECK_THROWS(AsperityContact(Asperities{}, {-1.0, 2.5, 0, 0}, SolverOptions{}), Error);
    CHECK_THROWS(AsperityContact(Asperities{}, {1.0, 0.0, 0, 0}, SolverOptions{}), Error);
}
