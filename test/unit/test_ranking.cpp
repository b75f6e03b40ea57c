// Asperities ranked under a sphere that moves: at every place the very ranking that a sphere put there has.
#include "check.hpp"
#include "contact/ranking.hpp"
#include "physics/random_asperities.hpp"

using namespace rsc;

namespace {

// Along a walk of n steps of the given length, with a level of random depth at most places. `reach`: how far below the highest.
void walk(const Asperities& asperities, double R, double step, int n, double reach, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Indenter tip{1.0, R, 0.5, 0.5};
    Ranking moved;
    moved.assign(asperities, tip);
    int differences = 0;
    for (int k = 0; k < n; ++k) {
        Ranking fresh;
        fresh.assign(asperities, tip);
        if (moved.highest() != fresh.highest()) ++differences;
        if (k % 3 != 0) {
            const double Z0 = fresh.highest() - reach * std::abs(uniform(random));
            std::vector<int> seen;
            const std::size_t count = fresh.above(Z0, seen);
            if (moved.above(Z0, seen) != count) {
                ++differences;
            } else {
                for (std::size_t r = 0; r < count; ++r)
                    differences += moved[r].height != fresh[r].height || moved[r].asperity != fresh[r].asperity;
            }
        }
        tip.x0 += step * uniform(random);
        tip.y0 += step * uniform(random);
        moved.move(tip.x0, tip.y0);
    }
    CHECK(differences == 0);
}

}  // namespace

TEST(all_ranking) {
    const Asperities rough = random_asperities(2000, 0.005, 0.01, 1e-3, 0.3, 1);
    constexpr double flat = std::numeric_limits<double>::infinity();
    for (const double R : {0.05, 0.3, 2.5, 1e3, flat}) {  // the first two leave most of the asperities outside of the sphere
        for (const double step : {1e-5, 1e-3, 0.03, 0.3}) walk(rough, R, step, 200, 0.03, 2);
        walk(rough, R, 1e-3, 200, 1e-4, 3);  // shallow
        walk(rough, R, 1e-2, 100, 10, 4);    // all of them
    }
    // The sphere ends at its rim, which belongs to it.
    for (const auto& [x, y] : {std::pair{1.0, -2.0}, {0.5, -1.5}, {0.0, -2.0}, {0.5, -2.5}}) {
        const Indenter small{1.0, 0.5, 0.5, -2.0};
        CHECK(small.clearance(x, y, 2.0) == 1.5);
        CHECK(small.clearance(0.5 + (x - 0.5) * (1 + 1e-15), -2 + (y + 2) * (1 + 1e-15), 2.0) == -flat);
    }
    // A high one far out: it comes up while the sphere is on its way.
    Asperities peak = rough;
    peak.z[17] = 1;
    for (const double R : {0.3, 2.5}) walk(peak, R, 0.02, 300, 0.05, 5);
}
