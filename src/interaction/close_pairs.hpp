// Search for pairs of close points by a sweep along the longer side of their bounding box. Points
// are sorted by the lower ends of their reaches, and each is compared with those whose reach begins
// before its own ends.
#pragma once

#include "interaction/period.hpp"

namespace rsc {

// Calls visit(i, j, d) once for every pair i < j with d < reach[i] + reach[j], in an order that
// depends only on the points. Points with reach <= 0 have no pairs. Cost: n log n for n points,
// plus the pairs whose reaches overlap along the sweep (about sqrt(n) per point if the reach is
// similar to the spacing).
template <class Visit>
void for_close_pairs(const std::vector<double>& x, const std::vector<double>& y,
                     const std::vector<double>& reach, Visit&& visit) {
    struct Point {
        double low, x, y, reach;
        std::size_t index;
    };
    std::vector<Point> points;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (reach[i] > 0) points.push_back({x[i] - reach[i], x[i], y[i], reach[i], i});
    const auto extent = [&](double Point::*side) {
        const auto [low, high] =
            std::minmax_element(points.begin(), points.end(),
                                [&](const Point& a, const Point& b) { return a.*side < b.*side; });
        return points.empty() ? 0.0 : (*high).*side - (*low).*side;
    };
    if (extent(&Point::y) > extent(&Point::x))
        for (Point& p : points) {
            std::swap(p.x, p.y);
            p.low = p.x - p.reach;
        }
    const auto before = [](const Point& a, const Point& b) {
        return a.low != b.low ? a.low < b.low : a.index < b.index;
    };
    std::sort(points.begin(), points.end(), before);
    for (auto p = points.begin(); p != points.end(); ++p) {
        const double end = p->x + p->reach;
        for (auto q = p + 1; q != points.end() && q->low < end; ++q) {
            const double limit = p->reach + q->reach, dx = p->x - q->x, dy = p->y - q->y,
                         d2 = dx * dx + dy * dy;
            if (d2 < limit * limit)
                visit(std::min(p->index, q->index), std::max(p->index, q->index), std::sqrt(d2));
        }
    }
}

// Periodic version: d is the distance to the nearest image, and each pair is visited once.
template <class Visit>
void for_close_pairs(const std::vector<double>& x, const std::vector<double>& y,
                     const std::vector<double>& reach, const Period& period, Visit&& visit) {
    if (!period.finite()) return for_close_pairs(x, y, reach, visit);
    // Copies of points near the lower borders beyond the upper ones.
    struct Image {
        std::size_t index;
        bool x, y;  // true if shifted by a period
    };
    double longest = 0;
    for (double r : reach) longest = std::max(longest, r);
    std::vector<double> xs, ys, reaches;
    std::vector<Image> images;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(reach[i] > 0)) continue;
        const double x0 = x[i] - period.x * std::floor(x[i] / period.x),
                     y0 = y[i] - period.y * std::floor(y[i] / period.y);
        const double far = reach[i] + longest;
        for (bool mx : {false, true})
            for (bool my : {false, true}) {
                if ((mx && x0 > far) || (my && y0 > far)) continue;
                xs.push_back(mx ? x0 + period.x : x0);
                ys.push_back(my ? y0 + period.y : y0);
                reaches.push_back(reach[i]);
                images.push_back({i, mx, my});
            }
    }
    for_close_pairs(xs, ys, reaches, [&](std::size_t a, std::size_t b, double d) {
        const Image &p = images[a], &q = images[b];
        if (p.index == q.index || (p.x && q.x) || (p.y && q.y))
            return;  // an image of itself, or a pair that was visited already
        const std::size_t i = p.index < q.index ? a : b, j = p.index < q.index ? b : a;
        const auto nearest = [](double offset, double side) {
            return -side / 2 < offset && offset <= side / 2;
        };
        if (nearest(xs[j] - xs[i], period.x) && nearest(ys[j] - ys[i], period.y))
            visit(images[i].index, images[j].index, d);
    });
}

}  // namespace rsc
