#include "contact/lateral.hpp"

#include <cmath>

namespace rsc {

Vec2 lateral_force(const Indenter& indenter, const Level& level) {
    Vec2 sum;
    if (std::isinf(indenter.R)) return sum;
    for (std::size_t k = 0; k < level.f.size(); ++k) {  // each force along the inclined surface of the sphere
        const double dx = level.x[k] - indenter.x0, dy = level.y[k] - indenter.y0;
        const double slope = level.f[k] / std::sqrt(indenter.R * indenter.R - (dx * dx + dy * dy));
        sum.x -= slope * dx;
        sum.y -= slope * dy;
    }
    return sum;
}

}  // namespace rsc
