#include "elements/cut_map.hpp"

namespace rsc {

CutMap::CutMap(const HeightMap& heights) : map_x0_(heights.x0), map_y0_(heights.y0) {
    frame.nx = heights.nx;
    frame.ny = heights.ny;
    frame.dx = heights.dx;
    frame.dy = heights.dy;
    frame.x0 = heights.x0;
    frame.y0 = heights.y0;
}

void CutMap::cut_open(const Indenter& indenter, int block) {
    const auto cut = [block](double tip, double first, double step, int n, bool repeats, int& turn,
                             double& origin) {
        turn = 0;
        origin = first;
        const double place = (tip - first) / (n * step);
        if (!repeats || (place >= 0.25 && place < 0.75)) return;
        turn = n / 2 / block * block;
        origin = first + (place < 0.25 && turn > 0 ? turn - n : turn) * step;
    };
    cut(indenter.x0, map_x0_, frame.dx, frame.nx, indenter.around.finite(), turn_x, frame.x0);
    cut(indenter.y0, map_y0_, frame.dy, frame.ny, indenter.around.finite(), turn_y, frame.y0);
}

void CutMap::number_by_map(Level& level) const {
    if (turn_x == 0 && turn_y == 0) return;
    const std::size_t n = level.asperity.size();
    std::vector<std::size_t> order(n);
    for (std::size_t k = 0; k < n; ++k) {
        order[k] = k;
        level.asperity[k] = place({level.asperity[k] % frame.nx, level.asperity[k] / frame.nx});
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return level.asperity[a] < level.asperity[b]; });
    const auto sort = [&](auto& values) {
        const auto before = values;
        for (std::size_t k = 0; k < values.size(); ++k) values[k] = before[order[k]];
    };
    sort(level.asperity);
    sort(level.x);
    sort(level.y);
    sort(level.f);
    sort(level.a);
    sort(level.u);
    sort(level.yields);
    std::vector<std::int32_t> now(n);
    for (std::size_t k = 0; k < n; ++k) now[order[k]] = static_cast<std::int32_t>(k);
    for (std::int32_t& contact : level.pixels.contact)
        contact = now[static_cast<std::size_t>(contact)];
}

}  // namespace rsc
