// A level gives the same answer alone as in a series, also where the energy has several minima; which method 'auto' takes. That all methods give one
// answer: test_independent, test_edges.
#include "check.hpp"
#include "contact/asperity_contact.hpp"
#include "physics/random_asperities.hpp"

using namespace rsc;

namespace {

constexpr double kE = 1.0;
constexpr double kTolerance = 1e-8;  // of the loads; each level is asked for a residual of 1e-11

SolverOptions options(Method method) {
    SolverOptions o;
    o.method = method;
    o.tolerance = 1e-11;
    o.sigma = 0.01;
    return o;
}

// Where the energy has several minima too: asperities in clusters, alone and within a series of levels, forwards and backwards.
void levels_do_not_remember() {
    for (unsigned seed = 0; seed < 4; ++seed) {
        const Asperities a = random_asperities(200, seed % 2 ? 0.0005 : 0.01, 0.01, seed % 2 ? 0.3 : 5e-4, 0.7, 200 + seed);
        const Indenter indenter{kE, 2.5, 0.5, 0.5};
        constexpr int levels = 30;
        const auto separation = [](int k) { return 0.03 - 0.001 * k; };
        AsperityContact down(a, indenter, options(Method::direct)), up(a, indenter, options(Method::direct));
        std::vector<double> forward(levels), backward(levels);
        for (int k = 0; k < levels; ++k) forward[static_cast<std::size_t>(k)] = down.at_separation(separation(k)).force;
        for (int k = levels - 1; k >= 0; --k) backward[static_cast<std::size_t>(k)] = up.at_separation(separation(k)).force;
        for (int k = 0; k < levels; ++k) {
            const double alone = AsperityContact(a, indenter, options(Method::direct)).at_separation(separation(k)).force;
            CHECK_CLOSE(forward[static_cast<std::size_t>(k)], alone, kTolerance * alone);
            CHECK_CLOSE(backward[static_cast<std::size_t>(k)], alone, kTolerance * alone);
        }
    }
}

// Pressed with one force after another, trials on the way go on from each other, where the energy has several minima into others than
// the answer; the level found is the answer at its separation.
void pressed_levels_do_not_remember() {
    for (unsigned seed = 200; seed < 204; ++seed) {
        const Asperities a = random_asperities(400, 0.003, 0.01, 0.1, 0.7, seed);
        const Indenter indenter{kE, 1e4, 0.5, 0.5};
        const auto fresh = [&](double Z0) { return AsperityContact(a, indenter, options(Method::direct)).at_separation(Z0); };
        const double first = fresh(0.02).force;
        AsperityContact pressed(a, indenter, options(Method::direct));
        for (int k = 0; k < 12 && first > 0; ++k) {
            const double N = first * std::pow(1.5, k);
            const Level level = pressed.at_force(N), alone = fresh(level.separation);
            CHECK(level.asperity == alone.asperity);
            CHECK_CLOSE(level.force, alone.force, kTolerance * alone.force);
            if (level.status != LevelStatus::not_converged) CHECK_CLOSE(level.force, N, kTolerance * N);
        }
    }
}

// 'auto': direct sums of few asperities, a mesh of many, of fewer where every pair is a sum over images; none where nothing interacts. What was
// asked for by name is done. One summit carries all, the others are candidates only.
void auto_chooses() {
    const auto method_of = [](int n, Method method, Interaction interaction, Period period) {
        Asperities a;
        const int side = static_cast<int>(std::sqrt(n));
        for (int i = 0; i < side * side; ++i) {
            a.x.push_back((i % side + 0.5) / side), a.y.push_back((i / side + 0.5) / side);
            a.z.push_back(i == 0 ? 1e-2 : 1e-9), a.radius.push_back(1e-3);
        }
        SolverOptions o = options(method);
        o.tolerance = 1e-4, o.interaction = interaction;
        const Level level = AsperityContact(a, {kE, HUGE_VAL, 0.5, 0.5, period}, o).at_separation(0);
        CHECK(level.candidates == side * side && level.status == LevelStatus::converged);
        CHECK(level.fallback == (method == Method::mesh && level.method != method ? Fallback::no_interaction : Fallback::none));
        return level.method;
    };
    CHECK(method_of(900, Method::automatic, Interaction::point, {}) == Method::direct);
    CHECK(method_of(40000, Method::automatic, Interaction::point, {}) == Method::mesh);
    CHECK(method_of(900, Method::automatic, Interaction::point, {1, 1}) == Method::mesh);
    CHECK(method_of(40000, Method::automatic, Interaction::none, {}) == Method::direct);
    CHECK(method_of(900, Method::mesh, Interaction::point, {}) == Method::mesh);
    CHECK(method_of(900, Method::direct, Interaction::point, {1, 1}) == Method::direct);
    CHECK(method_of(900, Method::mesh, Interaction::none, {1, 1}) == Method::direct);
}

}  // namespace

TESTS {
    auto_chooses();
    levels_do_not_remember();
    pressed_levels_do_not_remember();
}
