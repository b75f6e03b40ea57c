// Contacts of a few asperities: the paper's regularisation, derivatives, which of several solutions is the answer.
#include "check.hpp"
#include "contact/asperity_contact.hpp"
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
    regularisation_leaves_no_trace();
    stiffness_and_force_control();
    of_two_the_first_met_carries();
    CHECK_THROWS(AsperityContact(Asperities{}, {-1.0, 2.5, 0, 0}, SolverOptions{}), Error);
    CHECK_THROWS(AsperityContact(Asperities{}, {1.0, 0.0, 0, 0}, SolverOptions{}), Error);
}
