// Pressing with a force: one unknown, Z0, and one equation, N(Z0) = N, more than a level at a separation.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/contact.hpp"
#include "error.hpp"

namespace rsc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

Level Contact::at_separation(double Z0) {
    if (!std::isfinite(Z0)) throw Error(Failure::bad_input, "the separation must be finite");
    Level level = solve(Z0);
    if (level.status != LevelStatus::not_converged) accept();
    return level;
}

// Newton on ln N(Z0), whose slope the stiffness gives, kept inside a bracket that shrinks at every level.
Level Contact::at_force(double N) {
    if (!(N > 0) || !std::isfinite(N)) throw Error(Failure::bad_input, "the force must be positive and finite");
    double above = first_touch();  // separations that carry less
    if (!std::isfinite(above)) throw Error(Failure::bad_input, "no asperity lies under the sphere: no force can be carried");
    double below = -kInfinity;  // separations that carry more
    // A first depth: what the place touched first would need alone.
    double depth = std::numeric_limits<double>::epsilon() * std::max(std::abs(above), std::numeric_limits<double>::min());
    while (first_place_force(depth) < N) depth *= 2;
    double Z0 = likely_separation().value_or(above - 0.25 * depth);
    Level level;
    int iterations = 0;
    long products = 0;
    constexpr int most = 200;
    for (int i = 0; i < most; ++i) {
        level = solve(Z0);
        iterations += level.iterations;
        products += level.products;
        const double miss = level.force / N - 1;
        if (std::abs(miss) <= tolerance() || level.status == LevelStatus::not_converged) break;
        (miss < 0 ? above : below) = Z0;
        double next = level.force > 0 ? Z0 - std::log1p(miss) * level.force / stiffness() : -kInfinity;
        if (std::isinf(below)) {
            const double furthest = above - std::max(2 * (levels_since_move() > 1 ? above - Z0 : 0.0) + depth, 0.0);
            next = std::isfinite(next) ? std::max(next, furthest) : furthest;
            depth *= 2;
        }
        if (!(next < above) || !(next > below)) next = std::isinf(below) ? above - depth : 0.5 * (above + below);
        if (next == Z0 || next >= above || next <= below) {
            // Z0 is known to its last bit. What is missing beyond that is a jump of N(Z0): no separation carries N.
            const double ulp = std::nextafter(std::abs(Z0), kInfinity) - std::abs(Z0);
            const double resolved = 2 * ulp * std::abs(stiffness()) + first_place_force(2 * ulp);
            if (std::abs(level.force - N) > resolved) level.status = LevelStatus::not_converged;
            break;
        }
        Z0 = next;
        if (i + 1 == most) level.status = LevelStatus::not_converged;
    }
    if (level.status != LevelStatus::not_converged) accept();
    level.iterations = iterations;
    level.products = products;
    return level;
}

}  // namespace rsc
