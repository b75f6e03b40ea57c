// Pairs of points that lie close to each other, by cell lists: points of similar reach share a grid of cells as wide as the largest
// distance at which two of them can be close, so that only neighbouring cells are searched, and one huge spot does not widen the
// cells of all others.
#pragma once

#include "contact/period.hpp"

namespace rsc {

// Calls visit(i, j, d) once for every pair i < j with d < reach[i] + reach[j], in an order that depends on the points alone. Points
// without reach (<= 0) have no pairs. Cost: n log n for n points spread over an area, and the pairs.
template <class Visit>
void for_close_pairs(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& reach, Visit&& visit) {
    std::vector<std::size_t> points;
    double x_low = 0, x_high = 0, y_low = 0, y_high = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(reach[i] > 0)) continue;
        if (points.empty()) {
            x_low = x_high = x[i];
            y_low = y_high = y[i];
        }
        points.push_back(i);
        x_low = std::min(x_low, x[i]);
        x_high = std::max(x_high, x[i]);
        y_low = std::min(y_low, y[i]);
        y_high = std::max(y_high, y[i]);
    }
    if (points.size() < 2) return;

    struct Point {
        double x, y, reach;
        std::size_t index;
    };
    // Points with 2 reach <= width that fit no finer grid, in the order of their cells, row by row: the cells to be searched are runs.
    struct Grid {
        double width = 0;
        std::size_t nx = 1, ny = 1;
        std::vector<Point> points;
        std::vector<std::size_t> first;  // of a cell's points; one more for the end
    };
    // The finest grid has about one point a cell: narrower cells would only cost memory. The coarsest is one cell.
    constexpr double growth = 2;
    const double extent = std::max(x_high - x_low, y_high - y_low);
    std::vector<Grid> grids;
    double width = extent / std::sqrt(static_cast<double>(points.size()));
    for (bool last = false; !last; width *= growth) {
        last = !(0 < width && width < extent);
        Grid grid;
        grid.width = width;
        if (!last) {
            grid.nx = static_cast<std::size_t>((x_high - x_low) / width) + 1;
            grid.ny = static_cast<std::size_t>((y_high - y_low) / width) + 1;
        }
        grids.push_back(std::move(grid));
    }
    for (std::size_t i : points) {
        std::size_t level = 0;
        while (level + 1 < grids.size() && 2 * reach[i] > grids[level].width) ++level;
        grids[level].points.push_back({x[i], y[i], reach[i], i});
    }
    const auto column = [&](const Grid& g, double px) {
        return g.nx == 1 ? 0 : std::min(g.nx - 1, static_cast<std::size_t>((px - x_low) / g.width));
    };
    const auto row = [&](const Grid& g, double py) {
        return g.ny == 1 ? 0 : std::min(g.ny - 1, static_cast<std::size_t>((py - y_low) / g.width));
    };
    for (Grid& g : grids) {
        if (g.points.empty()) continue;
        const auto cell = [&](const Point& p) { return row(g, p.y) * g.nx + column(g, p.x); };
        g.first.assign(g.nx * g.ny + 1, 0);
        for (const Point& p : g.points) ++g.first[cell(p) + 1];
        for (std::size_t c = 0; c < g.nx * g.ny; ++c) g.first[c + 1] += g.first[c];
        std::vector<Point> sorted(g.points.size());
        auto next = g.first;
        for (const Point& p : g.points) sorted[next[cell(p)]++] = p;
        g.points = std::move(sorted);
    }

    const auto search = [&](const Point& p, const Grid& g, std::size_t from, std::size_t to) {
        for (std::size_t b = from; b < to; ++b) {
            const Point& q = g.points[b];
            const double limit = p.reach + q.reach, dx = p.x - q.x, dy = p.y - q.y;
            const double d2 = dx * dx + dy * dy;
            if (d2 < limit * limit) visit(std::min(p.index, q.index), std::max(p.index, q.index), std::sqrt(d2));
        }
    };
    for (std::size_t level = 0; level < grids.size(); ++level) {
        const Grid& g = grids[level];
        if (g.points.empty()) continue;
        for (std::size_t cy = 0; cy < g.ny; ++cy) {
            for (std::size_t cx = 0; cx < g.nx; ++cx) {
                const std::size_t c = cy * g.nx + cx, left = cx > 0, right = cx + 1 < g.nx;
                for (std::size_t a = g.first[c]; a < g.first[c + 1]; ++a) {
                    search(g.points[a], g, a + 1, g.first[c + 1 + right]);
                    if (cy + 1 < g.ny) search(g.points[a], g, g.first[c + g.nx - left], g.first[c + g.nx + 1 + right]);
                }
            }
        }
        for (std::size_t coarser = level + 1; coarser < grids.size(); ++coarser) {
            const Grid& h = grids[coarser];
            if (h.points.empty()) continue;
            for (const Point& p : g.points) {
                const std::size_t cx = column(h, p.x), cy = row(h, p.y);
                const std::size_t left = cx > 0 ? cx - 1 : 0, right = std::min(cx + 1, h.nx - 1);
                for (std::size_t ry = cy > 0 ? cy - 1 : 0; ry <= std::min(cy + 1, h.ny - 1); ++ry) {
                    search(p, h, h.first[ry * h.nx + left], h.first[ry * h.nx + right + 1]);
                }
            }
        }
    }
}

// The same with distances to the nearest of all images, each pair once.
template <class Visit>
void for_close_pairs(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& reach, const Period& period,
                     Visit&& visit) {
    if (!period.finite()) return for_close_pairs(x, y, reach, visit);
    // Points near the low borders once more beyond the high ones.
    struct Image {
        std::size_t index;
        bool x, y;  // moved by a period
    };
    double longest = 0;
    for (double r : reach) longest = std::max(longest, r);
    std::vector<double> xs, ys, reaches;
    std::vector<Image> images;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(reach[i] > 0)) continue;
        const double x0 = x[i] - period.x * std::floor(x[i] / period.x), y0 = y[i] - period.y * std::floor(y[i] / period.y);
        const double far = reach[i] + longest;
        for (bool mx : {false, true})
            for (bool my : {false, true}) {
                if ((mx && x0 > far) || (my && y0 > far)) continue;
                xs.push_back(mx ? x0 + period.x : x0), ys.push_back(my ? y0 + period.y : y0);
                reaches.push_back(reach[i]);
                images.push_back({i, mx, my});
            }
    }
    for_close_pairs(xs, ys, reaches, [&](std::size_t a, std::size_t b, double d) {
        const Image &p = images[a], &q = images[b];
        if (p.index == q.index || (p.x && q.x) || (p.y && q.y)) return;  // an image of itself, or a pair that came up already
        const std::size_t i = p.index < q.index ? a : b, j = p.index < q.index ? b : a;
        const auto nearest = [](double offset, double side) { return -side / 2 < offset && offset <= side / 2; };
        if (nearest(xs[j] - xs[i], period.x) && nearest(ys[j] - ys[i], period.y)) visit(images[i].index, images[j].index, d);
    });
}

}  // namespace rsc
