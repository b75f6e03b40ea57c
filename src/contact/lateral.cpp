#include "contact/lateral.hpp"

#include <cmath>

namespace rsc {
namespace {

// The share of one contact: its force along the inclined surface of the sphere.
void add(const Indenter& indenter, double x, double y, double force, Vec2& sum) {
    const double dx = x - indenter.x0, dy = y - indenter.y0;
    const double slope = force / std::sqrt(indenter.R * indenter.R - (dx * dx + dy * dy));
    sum.x -= slope * dx;
    sum.y -= slope * dy;
}

}  // namespace

Vec2 lateral_force(const Indenter& indenter, std::span<const double> x, std::span<const double> y, std::span<const double> force) {
    Vec2 sum;
    if (std::isinf(indenter.R)) return sum;
    for (std::size_t k = 0; k < force.size(); ++k) add(indenter, x[k], y[k], force[k], sum);
    return sum;
}

Vec2 lateral_force(const Indenter& indenter, const Asperities& asperities, const Level& level) {
    Vec2 sum;
    if (std::isinf(indenter.R)) return sum;
    for (std::size_t k = 0; k < level.asperity.size(); ++k) {
        const auto i = static_cast<std::size_t>(level.asperity[k]);
        add(indenter, asperities.x[i], asperities.y[i], level.f[k], sum);
    }
    return sum;
}

}  // namespace rsc
