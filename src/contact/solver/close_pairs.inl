// Cell lists: cells as wide as the largest distance at which a pair can be close, so that only neighbouring cells are searched.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rsc {

template <class Visit>
void for_close_pairs(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& reach, Visit&& visit) {
    std::vector<std::size_t> points;
    double widest = 0, x_low = 0, x_high = 0, y_low = 0, y_high = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(reach[i] > 0)) continue;
        if (points.empty()) {
            x_low = x_high = x[i];
            y_low = y_high = y[i];
        }
        points.push_back(i);
        widest = std::max(widest, reach[i]);
        x_low = std::min(x_low, x[i]);
        x_high = std::max(x_high, x[i]);
        y_low = std::min(y_low, y[i]);
        y_high = std::max(y_high, y[i]);
    }
    if (points.size() < 2) return;
    // About one point a cell at most: narrower cells would only cost memory.
    const double side = std::max(x_high - x_low, y_high - y_low) / std::sqrt(static_cast<double>(points.size()));
    const double width = std::max(2 * widest, side);
    const auto cells_along = [&](double extent) { return static_cast<std::size_t>(extent / width) + 1; };
    const std::size_t nx = cells_along(x_high - x_low), ny = cells_along(y_high - y_low);
    const auto cell = [&](std::size_t i) {
        const auto cx = std::min(nx - 1, static_cast<std::size_t>((x[i] - x_low) / width));
        const auto cy = std::min(ny - 1, static_cast<std::size_t>((y[i] - y_low) / width));
        return cy * nx + cx;
    };
    // Points in the order of their cells, row by row: the cells to be searched are two runs of them.
    std::vector<std::size_t> first(nx * ny + 1, 0);
    for (std::size_t i : points) ++first[cell(i) + 1];
    for (std::size_t c = 0; c < nx * ny; ++c) first[c + 1] += first[c];
    struct Point {
        double x, y, reach;
        std::size_t index;
    };
    std::vector<Point> sorted(points.size());
    auto next = first;
    for (std::size_t i : points) sorted[next[cell(i)]++] = {x[i], y[i], reach[i], i};

    const auto search = [&](const Point& p, std::size_t from, std::size_t to) {
        for (std::size_t b = from; b < to; ++b) {
            const Point& q = sorted[b];
            const double limit = p.reach + q.reach, dx = p.x - q.x, dy = p.y - q.y;
            const double d2 = dx * dx + dy * dy;
            if (d2 < limit * limit) visit(std::min(p.index, q.index), std::max(p.index, q.index), std::sqrt(d2));
        }
    };
    for (std::size_t cy = 0; cy < ny; ++cy) {
        for (std::size_t cx = 0; cx < nx; ++cx) {
            const std::size_t c = cy * nx + cx, left = cx > 0, right = cx + 1 < nx;
            for (std::size_t a = first[c]; a < first[c + 1]; ++a) {
                search(sorted[a], a + 1, first[c + 1 + right]);
                if (cy + 1 < ny) search(sorted[a], first[c + nx - left], first[c + nx + 1 + right]);
            }
        }
    }
}

}  // namespace rsc
