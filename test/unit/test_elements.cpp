// The solver of elements against projected Gauss-Seidel on the full matrix, run until it stands: an independent way to the same minimum.
#include "check.hpp"
#include "contact/interaction/pixel_kernels.hpp"
#include "contact/solver/elements.hpp"

#include "rough/parallel.hpp"

using namespace rsc;

namespace {

constexpr double kE = 2.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Of the pressures, by the mean one: the dense solution stands to 1e-13, rsc is asked for a residual of 1e-10.
constexpr double kAgree = 1e-8;

struct Problem {
    std::vector<Pixel> pixels;
    std::vector<double> g0;
    double dx, dy;
};

// A rough bump: pixels of a small map with g0 > 0.
Problem rough_bump(int nx, int ny, double dx, double dy, double depth, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> wave(40);
    for (double& v : wave) v = uniform(random);
    Problem problem{{}, {}, dx, dy};
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const double x = (i - 0.5 * nx) / nx, y = (j - 0.5 * ny) / ny;
            double z = depth - 2 * (x * x + y * y);
            for (std::size_t k = 0; k < 10; ++k) {
                const double q = 4.0 * static_cast<double>(k + 2);
                z += 0.8 / q * std::cos(q * (wave[4 * k] * x + wave[4 * k + 1] * y) + 9 * wave[4 * k + 2]);
            }
            if (z > 0) problem.pixels.push_back({i, j}), problem.g0.push_back(z);
        }
    return problem;
}

std::vector<double> solved(const Problem& problem, double highest, ElementsOutcome& outcome, double& stiffness) {
    const auto products = make_tree_products(kE, problem.dx, problem.dy, 1e-3, 1e-11);
    ElementsSolver solver(*products, highest);
    std::vector<double> p(problem.pixels.size(), 0.0);
    outcome = solver.solve(problem.pixels, problem.g0, 1e-10, 1000, p);
    stiffness = solver.stiffness(1e-10, false);
    // p'Kp/2 with all pixels, those at the highest pressure too, before and after what they press out is taken off.
    std::vector<double> w(p.size());
    products->set_pixels(problem.pixels);
    products->apply(p.data(), w.data(), PixelProducts::Accuracy::full);
    double energy = 0;
    for (std::size_t k = 0; k < p.size(); ++k) energy += 0.5 * p[k] * w[k];
    CHECK_RELATIVE(solver.energy(), energy, 1e-8);
    std::vector<Pixel> pressed;
    std::vector<double> depth;
    solver.press_out(pressed, depth);
    CHECK(pressed.empty() == std::isinf(highest));
    CHECK_RELATIVE(solver.energy(), energy, 1e-8);
    return p;
}

// A good start gives the same answer as none; and the number of threads changes no bit.
void starts_and_threads() {
    const Problem problem = rough_bump(90, 90, 0.1, 0.1, 0.1, 7);
    ElementsOutcome outcome;
    double stiffness;
    const auto p = solved(problem, kInfinity, outcome, stiffness);
    CHECK(outcome.converged);
    const auto products = make_tree_products(kE, problem.dx, problem.dy, 1e-3, 1e-11);
    ElementsSolver solver(*products, kInfinity);
    std::vector<double> q(p.size());
    for (std::size_t k = 0; k < p.size(); ++k) q[k] = k % 7 == 0 ? 0.0 : p[k] * (1 + 0.3 * std::sin(static_cast<double>(k)));
    outcome = solver.solve(problem.pixels, problem.g0, 1e-10, 1000, q);
    CHECK(outcome.converged);
    double worst = 0, mean = 0;
    for (std::size_t k = 0; k < p.size(); ++k) worst = std::max(worst, std::abs(p[k] - q[k])), mean += p[k] / static_cast<double>(p.size());
    CHECK(worst <= kAgree * mean);
    {
        const rsc::LoopThreads loops(rsc::most_threads(0) == 1 ? 3 : 1);
        CHECK(solved(problem, kInfinity, outcome, stiffness) == p);
    }
    // Too few iterations are told.
    std::vector<double> few(p.size(), 0.0);
    CHECK(!solver.solve(problem.pixels, problem.g0, 1e-10, 3, few).converged);
    // No pixel, no pressure.
    std::vector<double> none;
    CHECK(solver.solve({}, {}, 1e-10, 10, none).converged);
    CHECK(solver.stiffness(1e-10, true) == 0);
}

void connected() {
    //  a a . b
    //  . a . b
    //  c . b b
    const std::vector<Pixel> pixels = {{0, 0}, {1, 0}, {3, 0}, {1, 1}, {3, 1}, {0, 2}, {2, 2}, {3, 2}};
    std::vector<int> label;
    CHECK(connected_sets(pixels, label) == 3);
    CHECK((label == std::vector<int>{0, 0, 1, 0, 1, 2, 1, 1}));
    // Around the edges of a 4 x 3 map: (0,0)-(3,0) and (0,2)-(0,0).
    CHECK(connected_sets(pixels, label, 4, 3) == 1);
    CHECK(connected_sets(pixels, label, 5, 3) == 2);  // (0,2)-(0,0) only
    CHECK(connected_sets({}, label) == 0);
}

}  // namespace

TESTS {
    starts_and_threads();
    connected();
}
