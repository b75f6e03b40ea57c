#include "physics/stress/spot_stress.hpp"

#include "base/library_lock.hpp"

namespace rsc {
namespace {

constexpr double kPixels = 12, kPixelsOfDepth = 16;  // of a radius, and of the depth
constexpr double kMostPoints = 1 << 22;
constexpr int kParts = 4;  // samples of a pressure along a side of a pixel

// The rectangle that contains all spots and a margin.
Rectangle around(const Level& level, double margin) {
    double left = kInfinity, right = -kInfinity, below = kInfinity, above = -kInfinity;
    for (const auto k : indices(level.f)) {
        const double reach = level.a[k] + margin;
        left = std::min(left, level.x[k] - reach);
        right = std::max(right, level.x[k] + reach);
        below = std::min(below, level.y[k] - reach);
        above = std::max(above, level.y[k] + reach);
    }
    return {left, below, right - left, above - below};
}

PointGrid grid_of(const Level& level, bool repeats, const Rectangle& cell, double depth) {
    double radii = 0, largest = 0;
    for (const auto k : indices(level.f)) {
        radii += level.f[k] * level.a[k];
        largest = std::max(largest, level.a[k]);
    }
    double step = std::max(radii / sum_of(level.f) / kPixels, depth / kPixelsOfDepth);
    // The tension at small depths is largest within twice the radius of a spot.
    const Rectangle box = repeats ? cell : around(level, std::max(2 * depth, largest) + 4 * step);
    step = std::max(step, std::sqrt(box.Lx * box.Ly / kMostPoints));
    PointGrid grid;
    grid.nx = fast_size(int(std::ceil(box.Lx / step)), 2);
    grid.ny = fast_size(int(std::ceil(box.Ly / step)), 2);
    grid.dx = box.Lx / grid.nx;
    grid.dy = box.Ly / grid.ny;
    grid.x0 = box.x0 + 0.5 * grid.dx;
    grid.y0 = box.y0 + 0.5 * grid.dy;
    return grid;
}

// Adds the pressure of a spot, of force f, over its pixels.
void add_spot(std::vector<double>& pressure, const PointGrid& grid, double x, double y, double f,
              double a) {
    struct Part {
        std::size_t pixel;
        double weight;
    };
    std::vector<Part> parts;
    const auto range = [](double from, double to, double origin, double step) {
        return std::pair(int(std::floor((from - origin) / step + 0.5)),
                         int(std::floor((to - origin) / step + 0.5)));
    };
    const auto [i0, i1] = range(x - a, x + a, grid.x0, grid.dx);
    const auto [j0, j1] = range(y - a, y + a, grid.y0, grid.dy);
    const int samples = std::max(kParts, int(std::ceil(kParts * grid.dx / a)));
    const auto place = [&](int k, int part, double origin, double step) {
        return origin + step * (k - 0.5 + (part + 0.5) / samples);
    };
    double all = 0;
    for (int j = j0; j <= j1; ++j)
        for (int i = i0; i <= i1; ++i) {
            double weight = 0;
            for (const int v : indices(samples))
                for (const int u : indices(samples)) {
                    const double dx = (place(i, u, grid.x0, grid.dx) - x) / a,
                                 dy = (place(j, v, grid.y0, grid.dy) - y) / a;
                    weight += std::sqrt(std::max(0.0, 1 - dx * dx - dy * dy));
                }
            if (weight > 0)
                parts.push_back({grid.index(wrapped(i, grid.nx), wrapped(j, grid.ny)), weight});
            all += weight;
        }
    for (const Part& part : parts)
        pressure[part.pixel] += f / (grid.dx * grid.dy) * part.weight / all;
}

}  // namespace

SpotPressures pressures_of_spots(const Level& level, const Period& period, const Rectangle& cell,
                                 double depth) {
    SpotPressures spots;
    if (level.f.empty()) return spots;
    const PointGrid& grid = spots.grid = grid_of(level, period.finite(), cell, depth);
    std::vector<double> pressure(grid.points(), 0.0);
    for (const auto k : indices(level.f))
        if (level.a[k] > 0)
            add_spot(pressure, grid, level.x[k], level.y[k], level.f[k], level.a[k]);
    LevelPixels& pixels = spots.pixels;
    pixels.columns = grid.nx;
    for (const auto k : indices(pressure)) {
        if (!(pressure[k] > 0)) continue;
        pixels.index.push_back(std::int32_t(k));
        pixels.pressure.push_back(pressure[k]);
    }
    return spots;
}

}  // namespace rsc
