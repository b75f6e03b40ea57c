#include "run/level_checks.hpp"

#include <algorithm>
#include <cmath>

namespace rsc {

void judge_filled(Level& level, const Measured& map, const Domain& domain) {
    if (map.filled.empty() || level.contacts == 0) return;
    double filled = 0, all = 0;
    if (const LevelPixels& pixels = level.pixels; !pixels.index.empty()) {
        all = static_cast<double>(pixels.index.size());
        for (const std::int32_t k : pixels.index) filled += map.filled[static_cast<std::size_t>(k)];
    }
    for (std::size_t c = 0; c < level.a.size() && level.pixels.index.empty(); ++c) {
        const double x = level.x[c] - domain.x0, y = level.y[c] - domain.y0, a = level.a[c];
        const auto first = [](double from, double step) { return std::max(0, static_cast<int>(std::ceil(from / step))); };
        const auto last = [](double to, double step, int n) { return std::min(n - 1, static_cast<int>(std::floor(to / step))); };
        for (int j = first(y - a, map.dy); j <= last(y + a, map.dy, map.ny); ++j)
            for (int i = first(x - a, map.dx); i <= last(x + a, map.dx, map.nx); ++i) {
                if (std::hypot(i * map.dx - x, j * map.dy - y) > a) continue;
                all += 1;
                filled += map.filled[static_cast<std::size_t>(j) * static_cast<std::size_t>(map.nx) + static_cast<std::size_t>(i)];
            }
    }
    level.filled_share = all > 0 ? filled / all : 0.0;
    if (level.filled_share > kMuchFilled) level.status = graver(level.status, LevelStatus::out_of_validity);
}

}  // namespace rsc
