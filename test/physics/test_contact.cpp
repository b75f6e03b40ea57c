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

}  // namespace

TESTS {
    regularisation_leaves_no_trace();
    of_two_the_first_met_carries();
    CHECK_THROWS(AsperityContact(Asperities{}, {-1.0, 2.5, 0, 0}, SolverOptions{}), Error);
    CHECK_THROWS(AsperityContact(Asperities{}, {1.0, 0.0, 0, 0}, SolverOptions{}), Error);
}
