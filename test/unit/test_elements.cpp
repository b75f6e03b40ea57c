// The solver of elements against projected Gauss-Seidel on the full matrix, run until it stands: an independent way to the same minimum.
#include <omp.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "check.hpp"
#include "contact/interaction/love.hpp"
#include "contact/solver/elements.hpp"

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

std::vector<double> gauss_seidel(const Problem& problem, double highest) {
    const std::size_t n = problem.pixels.size();
    std::vector<double> K(n * n), p(n, 0.0);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t l = 0; l < n; ++l)
            K[k * n + l] = love((problem.pixels[k].x - problem.pixels[l].x) * problem.dx,
                                (problem.pixels[k].y - problem.pixels[l].y) * problem.dy, 0.5 * problem.dx, 0.5 * problem.dy) /
                           (std::numbers::pi * kE);
    for (int sweep = 0; sweep < 5000; ++sweep) {
        double moved = 0, largest = 0;
        for (std::size_t k = 0; k < n; ++k) {
            double w = -problem.g0[k];
            for (std::size_t l = 0; l < n; ++l) w += K[k * n + l] * p[l];
            const double next = std::clamp(p[k] - 1.5 * w / K[k * n + k], 0.0, highest);  // over-relaxed: still down the energy
            moved = std::max(moved, std::abs(next - p[k]));
            largest = std::max(largest, next);
            p[k] = next;
        }
        if (moved <= 1e-14 * largest) break;
    }
    return p;
}

std::vector<double> solved(const Problem& problem, double highest, ElementsOutcome& outcome, double& stiffness) {
    const auto products = make_tree_products(kE, problem.dx, problem.dy, 1e-3, 1e-11);
    ElementsSolver solver(*products, highest);
    std::vector<double> p(problem.pixels.size(), 0.0);
    outcome = solver.solve(problem.pixels, problem.g0, 1e-10, 1000, p);
    stiffness = solver.stiffness(1e-10, ElementsSolver::Way::further);
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

void against_dense() {
    const struct {
        int nx, ny;
        double dx, dy, depth;
    } maps[] = {
        {1, 1, 0.1, 0.1, 3.0}, {20, 20, 0.1, 0.1, 0.2}, {24, 18, 0.1, 0.1, -0.1}, {16, 30, 0.2, 0.09, 0.3}, {17, 17, 1e-7, 1e-7, 1.5}};
    for (const auto& map : maps)
        for (unsigned seed = 1; seed <= 2; ++seed) {
            const Problem problem = rough_bump(map.nx, map.ny, map.dx, map.dy, map.depth, seed);
            const auto free = gauss_seidel(problem, kInfinity);
            const double highest_free = *std::max_element(free.begin(), free.end());
            for (const double highest : {kInfinity, 0.4 * highest_free}) {
                const auto expected = std::isinf(highest) ? free : gauss_seidel(problem, highest);
                ElementsOutcome outcome;
                double stiffness = 0, sum = 0, worst = 0;
                const auto p = solved(problem, highest, outcome, stiffness);
                CHECK(outcome.converged);
                long touching = 0, other = 0;
                for (std::size_t k = 0; k < p.size(); ++k) {
                    sum += expected[k];
                    touching += expected[k] > 0;
                    other += (p[k] > 0) != (expected[k] > 0);
                    worst = std::max(worst, std::abs(p[k] - expected[k]));
                }
                CHECK(touching > 0);
                CHECK(other == 0);
                CHECK(worst <= kAgree * sum / static_cast<double>(touching));
                std::printf("%d x %d, %ld of %zu pixels touch: largest difference %.1e of the mean pressure, %ld products\n", map.nx,
                            map.ny, touching, p.size(), worst * static_cast<double>(touching) / sum, outcome.products);
                // The load a little lower and higher, by the slope; only while the same pixels touch is it exact.
                Problem moved = problem;
                const double step = 1e-6 * *std::max_element(problem.g0.begin(), problem.g0.end());
                double change = 0;
                for (const double sign : {1.0, -1.0}) {
                    for (std::size_t k = 0; k < p.size(); ++k) moved.g0[k] = problem.g0[k] + sign * step;
                    double unused;
                    for (double v : solved(moved, highest, outcome, unused)) change += sign * v;
                }
                CHECK_RELATIVE(change / (2 * step), stiffness, 1e-3);
            }
        }
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
    const int before = omp_get_max_threads();
    omp_set_num_threads(before == 1 ? 3 : 1);
    CHECK(solved(problem, kInfinity, outcome, stiffness) == p);
    omp_set_num_threads(before);
    // Too few iterations are told.
    std::vector<double> few(p.size(), 0.0);
    CHECK(!solver.solve(problem.pixels, problem.g0, 1e-10, 3, few).converged);
    // No pixel, no pressure.
    std::vector<double> none;
    CHECK(solver.solve({}, {}, 1e-10, 10, none).converged);
    CHECK(solver.stiffness(1e-10, ElementsSolver::Way::back) == 0);
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

int main() {
    against_dense();
    starts_and_threads();
    connected();
    return check::summary();
}
