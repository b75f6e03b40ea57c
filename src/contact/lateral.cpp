#include "contact/lateral.hpp"

#include <cmath>

namespace rsc {

Vec2 lateral_force(const Indenter& indenter, const Level& level) {
    Vec2 sum;
    if (std::isinf(indenter.R)) return sum;
    const auto add = [&](double x, double y, double force) {  // each force along the inclined surface of the sphere
        const double dx = x - indenter.x0, dy = y - indenter.y0;
        const double slope = force / std::sqrt(indenter.R * indenter.R - (dx * dx + dy * dy));
        sum.x -= slope * dx;
        sum.y -= slope * dy;
    };
    const LevelPixels& pixels = level.pixels;
    for (std::size_t k = 0; k < pixels.index.size(); ++k) add(pixels.x(k), pixels.y(k), pixels.pressure[k] * pixels.dx * pixels.dy);
    if (!pixels.index.empty()) return sum;
    for (std::size_t k = 0; k < level.f.size(); ++k) add(level.x[k], level.y[k], level.f[k]);
    return sum;
}

}  // namespace rsc
