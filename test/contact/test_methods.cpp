// A level gives the same answer alone as in a series, also where the energy has several minima;
// which of these is the answer; which method 'auto' takes. That all methods give one answer:
// test_independent, test_edges.
#include "check.hpp"
#include "support/asperities.hpp"
#include "support/paths.hpp"

namespace test_methods {

using namespace rsc;

constexpr double kE = 1.0;
constexpr double kTolerance = 1e-8;  // of the loads; each level is asked for a residual of 1e-11

SolverOptions options(Method method) {
    return {.method = method, .tolerance = 1e-11, .surface = {.sigma = 0.01}};
}

Path path(const Asperities& a, const Indenter& indenter) {
    return asperity_path(a, indenter, options(Method::direct));
}

// Where the energy has several minima too: asperities in clusters, alone and within a series of
// levels, forwards and backwards.
TEST(levels_do_not_remember) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        const Asperities a = random_asperities(200, seed % 2 ? 0.0005 : 0.01, 0.01,
                                               seed % 2 ? 0.3 : 5e-4, 0.7, 200 + seed);
        const Indenter indenter{kE, 2.5, 0.5, 0.5};
        constexpr int levels = 30;
        const auto separation = [](int k) { return 0.03 - 0.001 * k; };
        Path down = path(a, indenter), up = path(a, indenter);
        std::vector<double> forward(levels), backward(levels);
        for (const int k : indices(levels)) forward[k] = down.at_separation(separation(k)).force;
        for (int k = levels - 1; k >= 0; --k) backward[k] = up.at_separation(separation(k)).force;
        for (const int k : indices(levels)) {
            const double alone = path(a, indenter).at_separation(separation(k)).force;
            CHECK_CLOSE(forward[k], alone, kTolerance * alone);
            CHECK_CLOSE(backward[k], alone, kTolerance * alone);
        }
    }
}

// Pressed with one force after another, trials on the way go on from each other, where the energy
// has several minima into others than the answer; the level found is the answer at its separation.
TEST(pressed_levels_do_not_remember) {
    for (unsigned seed = 200; seed < 204; ++seed) {
        const Asperities a = random_asperities(400, 0.003, 0.01, 0.1, 0.7, seed);
        const Indenter indenter{kE, 1e4, 0.5, 0.5};
        const auto fresh = [&](double Z0) { return path(a, indenter).at_separation(Z0); };
        const double first = fresh(0.02).force;
        Path pressed = path(a, indenter);
        for (int k = 0; k < 12 && first > 0; ++k) {
            const double N = first * std::pow(1.5, k);
            const Level level = pressed.at_force(N), alone = fresh(level.separation);
            CHECK(level.asperity == alone.asperity);
            CHECK_CLOSE(level.force, alone.force, kTolerance * alone.force);
            if (level.converged) CHECK_CLOSE(level.force, N, kTolerance * N);
        }
    }
}

// Two asperities so close that only one can carry: the one that the descending sphere meets first
// keeps the other out, whichever would carry more. So it is from the first touch on, and so it is
// for a level alone.
TEST(of_two_the_first_met_carries) {
    for (double lower : {0.7, 0.8, 0.9}) {
        for (double larger : {0.3, 1.0, 4.0}) {
            const double r = 1e-2, g = 0.01;
            const Asperities a =
                asperities_at({{0.5, 0.5, lower * g, larger * r}, {0.5005, 0.5, g, r}});
            for (Method method : {Method::direct, Method::dgesv, Method::mesh}) {
                const Level level =
                    asperity_path(a, {kE, kInfinity, 0.5, 0.5}, options(method)).at_separation(0);
                CHECK(!level.unique);
                CHECK(level.asperity == std::vector<int>{1});
                CHECK_RELATIVE(level.force, 4.0 / 3.0 * kE * std::sqrt(r) * std::pow(g, 1.5), 1e-9);
            }
        }
    }
}

// 'auto': direct sums of few asperities, a mesh of many, of fewer where every pair is a sum over
// images; none where nothing interacts. What was asked for by name is done. One summit carries all,
// the others are candidates only.
TEST(auto_chooses) {
    const auto method_of = [](int n, Method method, Interaction interaction, Period period) {
        std::vector<std::array<double, 4>> a;
        const int side = int(std::sqrt(n));
        for (const int i : indices(side * side))
            a.push_back(
                {(i % side + 0.5) / side, (i / side + 0.5) / side, i == 0 ? 1e-2 : 1e-9, 1e-3});
        SolverOptions o = options(method);
        o.tolerance = 1e-4;
        o.interaction = interaction;
        const Level level =
            asperity_path(asperities_at(a), {kE, kInfinity, 0.5, 0.5, period}, o).at_separation(0);
        CHECK(level.candidates == side * side && level.converged);
        CHECK(level.fallback == (method == Method::mesh && level.method != method
                                     ? Fallback::no_interaction
                                     : Fallback::none));
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

}  // namespace test_methods
