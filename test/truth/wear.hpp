// A ball that wears the half-space under it, by rings: slow, and nothing of it is shared with src.
#pragma once

#include "truth/elimination.hpp"

namespace truth {

// Deflection at the radius r under a unit pressure on a disc of radius a, E* = 1 (Johnson 1985,
// equation 3.29).
inline double under_disc(double r, double a) {
    if (a == 0) return 0;
    if (r <= a) return 4 * a / pi * std::comp_ellint_2(r / a);
    const double k = a / r;
    return 4 * r / pi * (std::comp_ellint_2(k) - (1 - k * k) * std::comp_ellint_1(k));
}

struct WornBall {
    double separation = 0, area = 0, largest_pressure = 0, depth = 0, volume = 0;
};

// A rigid ball of radius R under the force N after sliding the distance s, which wears k p ds:
// rings of equal width up to the radius `most`, and implicit steps that grow from the beginning on.
inline WornBall worn_ball(double E_star, double R, double N, double k, double s, double most,
                          int rings, int steps) {
    const std::size_t n = rings;
    const double width = most / rings;
    std::vector<double> r(n), area(n), K(n * n), worn(n, 0.0), p(n, 0.0);
    for (const std::size_t i : indices(n)) {
        r[i] = (double(i) + 0.5) * width;
        area[i] = 2 * pi * r[i] * width;
        for (const std::size_t j : indices(n)) {
            const double inner = double(j) * width;
            K[i * n + j] = (under_disc(r[i], inner + width) - under_disc(r[i], inner)) / E_star;
        }
    }
    WornBall ball;
    std::size_t touching = n / 4;  // the contact is a disc
    for (int step = 0; step <= steps; ++step) {
        const double part = double(step) / steps, before = part - 1.0 / steps;
        const double rate = step > 0 ? k * s * (part * part - before * before) : 0;
        const auto gap0 = [&](std::size_t i) { return -r[i] * r[i] / (2 * R) - worn[i]; };
        for (bool settled = false; !settled;) {
            const std::size_t m = touching + 1;
            std::vector<double> A(m * m, 0.0), b(m, N);
            for (const std::size_t i : indices(touching)) {
                for (const std::size_t j : indices(touching)) A[i * m + j] = K[i * n + j];
                A[i * m + i] += rate;
                A[i * m + touching] = 1;
                A[touching * m + i] = area[i];
                b[i] = gap0(i);
            }
            const std::vector<double> x = solved(A, b);
            ball.separation = x[touching];
            std::ranges::fill(p, 0.0);
            std::copy(x.begin(), x.end() - 1, p.begin());
            double next = ball.separation - gap0(touching);
            for (const std::size_t j : indices(touching)) next += K[touching * n + j] * p[j];
            settled = p[touching - 1] >= 0 && next >= 0;
            if (!settled) touching += next < 0 ? 1 : -1;
        }
        for (const std::size_t i : indices(n)) worn[i] += rate * p[i];
    }
    ball.depth = worn[0];
    ball.largest_pressure = *std::ranges::max_element(p);
    for (const std::size_t i : indices(n)) ball.volume += worn[i] * area[i];
    // its edge lies in the last ring
    ball.area = pi * std::pow(width * (double(touching) - 0.5), 2);
    return ball;
}

}  // namespace truth
