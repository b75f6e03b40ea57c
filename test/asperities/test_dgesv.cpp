// The paper's method on its own, without the solver that takes over where it fails: it converges by
// itself where the paper used it, its matrix is the derivative of its residual, and a level says
// what it was solved with.
#include "asperities/dgesv.hpp"

#include "check.hpp"
#include "support/asperities.hpp"
#include "support/paths.hpp"

namespace test_dgesv {

using namespace rsc;

constexpr int kMostSolves = 15;     // the paper: 7 to 12 a step
constexpr double kResidual = 1e-8;  // of the unregularised equation

WorkingSet candidates(const Asperities& a, const Indenter& indenter, double Z0) {
    WorkingSet set;
    for (const auto i : indices(a)) {
        const double g0 = indenter.clearance(a.x[i], a.y[i], a.z[i]) - Z0;
        if (!(g0 > 0)) continue;
        set.asperity.push_back(int(i));
        set.x.push_back(a.x[i]);
        set.y.push_back(a.y[i]);
        set.g0.push_back(g0);
    }
    return set;
}

// K against central differences of R, at forces where some points are within delta of touching,
// some far inside, some far outside.
TEST(matrix) {
    const Asperities a = random_asperities(150, 0.02, 0.01, 5e-4, 0.5, 7);
    const Indenter indenter{1.0, 2.5, 0.5, 0.5};
    const WorkingSet set = candidates(a, indenter, -0.01);
    const auto law = make_law(LawKind::hertz, a, 1.0);
    law->prepare(set.asperity);
    const auto kernel = make_kernel(Interaction::point, 1.0);
    const std::size_t n = set.g0.size();
    CHECK(n > 20);
    const double delta = 0.005;
    std::vector<double> force(n), K(n * n), unused(n * n), above, below, R;
    for (const std::size_t i : indices(n)) force[i] = 2e-5 * (1 + std::sin(3.0 * double(i)));
    const auto penetrations = [&](const std::vector<double>& F) {
        std::vector<double> v = set.g0;
        for (const std::size_t i : indices(n))
            for (const std::size_t j : indices(n))
                if (j != i)
                    v[i] -= F[j] / (pi * std::hypot(set.x[i] - set.x[j], set.y[i] - set.y[j]));
        return v;
    };
    const std::vector<double> v = penetrations(force);
    int near = 0, inside = 0, outside = 0;
    for (const double x : v) ++(x < 0 ? outside : x < delta ? near : inside);
    CHECK(near > 2 && inside > 2 && outside > 2);
    paper_equations(*law, *kernel, set, delta, force, v, R, K.data());
    double largest = 0, worst = 0;
    for (const std::size_t j : indices(n)) {
        // of forces near 1e-5: truncation and rounding of the difference are both below 1e-5 of K
        const double h = 1e-9;
        std::vector<double> F = force;
        F[j] = force[j] + h;
        paper_equations(*law, *kernel, set, delta, F, penetrations(F), above, unused.data());
        F[j] = force[j] - h;
        paper_equations(*law, *kernel, set, delta, F, penetrations(F), below, unused.data());
        for (const std::size_t i : indices(n)) {
            worst = std::max(worst, std::abs((above[i] - below[i]) / (2 * h) - K[j * n + i]));
            if (i != j) largest = std::max(largest, std::abs(K[j * n + i]));
        }
    }
    CHECK(worst <= 1e-5 * largest);
}

// The slopes of the solution are df/dv of every asperity, from which the proof takes what other
// solutions there may be.
TEST(slopes) {
    constexpr double kShare = 1e-6,
                     // of the penetration; of the slope, by central differences and rounding
        kDifference = 1e-7;
    const Asperities a = random_asperities(150, 0.02, 0.01, 5e-4, 0.5, 7);
    const WorkingSet set = candidates(a, {1.0, 2.5, 0.5, 0.5}, -0.01);
    const auto law = make_law(LawKind::hertz, a, 1.0);
    law->prepare(set.asperity);
    std::vector<double> v, force, slope;
    CHECK(solve_by_dgesv(*law, *make_kernel(Interaction::point, 1.0), set, {1e-4, 5, kResidual, 30},
                         v, force, slope)
              .converged);
    int touching = 0;
    for (const auto i : indices(v)) {
        const double h = kShare * std::abs(v[i]), rise = law->force(set.asperity[i], v[i] + h) -
                                                         law->force(set.asperity[i], v[i] - h);
        CHECK_RELATIVE(slope[i], rise / (2 * h), kDifference);
        touching += slope[i] > 0;
    }
    CHECK(touching > 10);
}

// What a level was really solved with, and why not otherwise.
TEST(says_what_it_did) {
    const Asperities a = random_asperities(300, 0.02, 0.01, 5e-4, 0.5, 300);
    const Indenter indenter{1.0, 2.5, 0.5, 0.5};
    SolverOptions options{
        .method = Method::dgesv,
        .tolerance = kResidual,
        .surface = {.sigma = 0.01},
    };
    const Level paper = asperity_path(a, indenter, options).at_separation(0.0);
    CHECK(paper.method == Method::dgesv && paper.fallback == Fallback::none);
    CHECK(paper.iterations <= kMostSolves && paper.products == paper.iterations);
    // Delta never cut: the iteration cannot converge on the unregularised equation, and the level
    // says so.
    options.delta_cut = 1;
    options.delta0 = 1;
    options.max_iterations = 30;
    const Level uncut = asperity_path(a, indenter, options).at_separation(0.0);
    CHECK(uncut.method == Method::direct && uncut.fallback == Fallback::dgesv_not_converged);
    CHECK_CLOSE(uncut.force, paper.force, 1e-6 * paper.force);
    // Its counts are those of both: the solves in vain, and what the direct method took, with a
    // product more: of what dgesv left.
    SolverOptions direct = options;
    direct.method = Method::direct;
    const Level plain = asperity_path(a, indenter, direct).at_separation(0.0);
    CHECK(plain.iterations > 0 && uncut.iterations == 30 + plain.iterations &&
          uncut.products == plain.products + 1);
    // Two asperities so close that the solution the iteration finds is a saddle of the energy.
    const Asperities pair = asperities_at({{0.499, 0.5, 0.01, 1e-2}, {0.501, 0.5, 0.01, 1e-2}});
    options.delta_cut = 5;
    options.delta0 = 0.01;
    const Level saddle = asperity_path(pair, {1.0, 1e9, 0.5, 0.5}, options).at_separation(0.0);
    CHECK(saddle.method == Method::direct && saddle.fallback == Fallback::not_unique);
    options.interaction = Interaction::none;
    options.method = Method::mesh;
    const Level alone = asperity_path(a, indenter, options).at_separation(0.0);
    CHECK(alone.method == Method::direct && alone.fallback == Fallback::no_interaction);
}

// The answer does not depend on where the regularisation begins, nor on how it is cut.
TEST(regularisation_leaves_no_trace) {
    const Asperities a = random_asperities(300, 0.012, 0.01, 5e-4, 0.5, 3);
    const auto force = [&](double delta0, double cut, double tolerance) {
        SolverOptions options{
            .method = Method::dgesv,
            .tolerance = tolerance,
            .surface = {.sigma = 0.01},
        };
        options.delta0 = delta0;
        options.delta_cut = cut;
        return asperity_path(a, {1.0, 2.5, 0.5, 0.5}, options).at_separation(0.005).force;
    };
    const double reference = force(0.01, 5, 1e-11);
    for (const double delta0 : {0.1, 0.01, 0.001})
        for (const double cut : {2.0, 5.0, 10.0})
            CHECK_RELATIVE(force(delta0, cut, 1e-10), reference, 1e-9);
}

}  // namespace test_dgesv
