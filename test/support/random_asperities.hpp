// Sets of asperities for tests: reproducible, with heights and radii of a rough surface or worse.
#pragma once

#include "surface/asperities.hpp"

// n asperities on the unit square, at least `spacing` apart, Gaussian heights of rms sigma,
// lognormal radii about `radius`.
inline rsc::Asperities random_asperities(int n, double spacing, double sigma, double radius,
                                         double radius_spread, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal(0, 1);
    rsc::Asperities a;
    for (int tries = 0; static_cast<int>(a.size()) < n && tries < 100 * n; ++tries) {
        const double x = uniform(random), y = uniform(random);
        bool free = true;
        for (std::size_t k = 0; k < a.size() && free; ++k)
            free = std::hypot(a.x[k] - x, a.y[k] - y) >= spacing;
        if (!free) continue;
        a.x.push_back(x);
        a.y.push_back(y);
        a.z.push_back(sigma * normal(random));
        a.radius.push_back(radius * std::exp(radius_spread * normal(random)));
    }
    return a;
}
