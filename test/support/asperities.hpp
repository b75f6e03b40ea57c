// Sets of asperities for tests: given, or random and reproducible, with heights and radii of a
// rough surface or worse.
#pragma once

#include <random>

#include "surface/asperities.hpp"

// Each by its x, y, z and radius.
inline rsc::Asperities asperities_at(const std::vector<std::array<double, 4>>& list) {
    rsc::Asperities a;
    for (const auto& [x, y, z, radius] : list) {
        a.x.push_back(x);
        a.y.push_back(y);
        a.z.push_back(z);
        a.radius.push_back(radius);
    }
    return a;
}

// The same with the curvatures ratio/radius and 1/(ratio radius).
inline rsc::Asperities curved(rsc::Asperities a, double ratio, double angle = 0,
                              double biharmonic = 0) {
    a.kappa1.clear();
    a.kappa2.clear();
    for (const double radius : a.radius) {
        a.kappa1.push_back(ratio / radius);
        a.kappa2.push_back(1 / (ratio * radius));
    }
    a.angle.assign(a.size(), angle);
    a.biharmonic.assign(a.size(), biharmonic);
    return a;
}

// n asperities on the unit square, at least `spacing` apart, Gaussian heights of rms sigma,
// lognormal radii about `radius`.
inline rsc::Asperities random_asperities(int n, double spacing, double sigma, double radius,
                                         double radius_spread, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal(0, 1);
    rsc::Asperities a;
    for (int tries = 0; int(a.size()) < n && tries < 100 * n; ++tries) {
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
