// Kernel values kept over levels: sums over changing sources and targets equal plain sums, also after all values are forgotten.
#include <random>

#include "check.hpp"
#include "contact/interaction/pair_matrix.hpp"

using namespace rsc;

TESTS {
    constexpr double kE = 3.0, kDepth = 0.1, kSingle = 1e-6;  // the promise of sums in single precision
    const double near = 1 / (std::numbers::pi * kE);
    const auto smooth = std::make_shared<const SmoothPart>([=](double d) { return near / std::hypot(d, kDepth); },
                                                           [](double k) { return std::exp(-k * kDepth); }, kDepth);
    const auto kernel = make_kernel(Interaction::point, Substrate(kE, smooth));
    PairMatrix matrix(*kernel);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    constexpr int points = 200;
    std::vector<double> x(points), y(points);
    for (int k = 0; k < points; ++k) x[k] = uniform(random), y[k] = uniform(random);
    for (int round = 0; round < 12; ++round) {
        if (round == 6) matrix.forget();
        std::vector<int> active, others;
        for (int k = 0; k < points; ++k) (uniform(random) < 0.1 + 0.05 * (round % 5) ? active : others).push_back(k);
        std::vector<double> f, among(active.size()), onto(others.size());
        std::vector<std::uint32_t> sources, targets;
        for (const int k : active) sources.push_back(matrix.find(x[k], y[k])), f.push_back(uniform(random) - 0.2);
        for (const int k : others) targets.push_back(matrix.find(x[k], y[k]));
        const auto plain = [&](int to) {
            double sum = 0;
            for (std::size_t k = 0; k < active.size(); ++k) {
                const double dx = x[active[k]] - x[to], dy = y[active[k]] - y[to];
                sum += f[k] * (active[k] == to ? kernel->self() : kernel->at(dx, dy));
            }
            return sum;
        };
        matrix.set_active(sources);
        for (const bool single : {false, true}) {
            const double accuracy = single ? 20 * kSingle : 1e-10;  // of the largest of sums with both signs
            matrix.among(single, f.data(), among.data());
            matrix.onto(single, f.data(), targets, onto.data());
            const double scale = std::abs(*std::max_element(among.begin(), among.end()));
            for (std::size_t k = 0; k < active.size(); ++k) CHECK_CLOSE(among[k], plain(active[k]), accuracy * scale);
            for (std::size_t k = 0; k < others.size(); ++k) CHECK_CLOSE(onto[k], plain(others[k]), accuracy * scale);
        }
    }
}
