#include "contact/spots.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "contact/uniqueness.hpp"

namespace rsc {
namespace {

using std::numbers::pi;

struct Interval {
    double from, to;
};

constexpr double kStart = 0.3, kEnd = kStart + 2 * pi;  // of the parameter along a border: no axis, where spots touch if anywhere

struct Direction {
    explicit Direction(double t_) : t(t_), c(std::cos(t_)), s(std::sin(t_)) {}
    double t, c, s;
};

// Along a border: finer than its extrema against another, four at most, usually are apart.
const std::vector<Direction>& samples() {
    static const std::vector<Direction> all = [] {
        constexpr int count = 64;
        std::vector<Direction> made;
        for (int k = 0; k <= count; ++k) made.emplace_back(kStart + 2 * pi * k / count);
        return made;
    }();
    return all;
}

// Where spot p's border lies inside spot q. With p's point at t being centre + (major cos t, minor sin t) in its axes, the border of q is
// f(t) = |c + u cos t + v sin t|^2 - 1 = 0, a trigonometric polynomial of second degree: four roots at most.
class Border {
public:
    Border(const Spot& p, const Spot& q) {
        const double turn = p.angle - q.angle, dx = p.x - q.x, dy = p.y - q.y;
        const double ca = std::cos(q.angle), sa = std::sin(q.angle), ct = std::cos(turn), st = std::sin(turn);
        c_ = {(dx * ca + dy * sa) / q.major, (dy * ca - dx * sa) / q.minor};
        u_ = {p.major * ct / q.major, p.major * st / q.minor};
        v_ = {-p.minor * st / q.major, p.minor * ct / q.minor};
        const auto square = [](const Vector& a) { return a.x * a.x + a.y * a.y; };
        scale_ = 1 + square(c_) + square(u_) + square(v_);
    }

    void append_inside(std::vector<Interval>& covered) const {
        std::vector<std::pair<double, double>> points;  // t and f
        points.reserve(samples().size() + 4);
        double before = 0;
        for (const Direction& d : samples()) {
            const double now = derivative(d), here = value(d);
            // An extremum, which two roots may embrace when f is near 0 (f'' is at most 4 scale_); a mere touch is none of them.
            if (!points.empty() && (before < 0) != (now < 0) && std::abs(here) < 0.01 * scale_) {
                const double t = root(points.back().first, d.t, [&](double s) { return derivative(Direction(s)); });
                const double f = value(Direction(t));
                if (std::abs(f) > 1e-13 * scale_) points.emplace_back(t, f);
            }
            points.emplace_back(d.t, here);
            before = now;
        }
        double from = kStart;
        for (std::size_t k = 1; k < points.size(); ++k) {
            const bool was = points[k - 1].second < 0, is = points[k].second < 0;
            if (was == is) continue;
            const double t = root(points[k - 1].first, points[k].first, [&](double s) { return value(Direction(s)); });
            if (is) from = t;
            else covered.push_back({from, t});
        }
        if (points.back().second < 0) covered.push_back({from, kEnd});
    }

private:
    struct Vector {
        double x, y;
    };

    double value(const Direction& d) const {
        const double x = c_.x + u_.x * d.c + v_.x * d.s, y = c_.y + u_.y * d.c + v_.y * d.s;
        return x * x + y * y - 1;
    }
    double derivative(const Direction& d) const {
        const double x = c_.x + u_.x * d.c + v_.x * d.s, y = c_.y + u_.y * d.c + v_.y * d.s;
        return x * (v_.x * d.c - u_.x * d.s) + y * (v_.y * d.c - u_.y * d.s);  // half of it
    }

    // Bisection and secants in turn (Illinois).
    template <class F>
    static double root(double low, double high, F f) {
        double f_low = f(low), f_high = f(high);
        if (f_low == 0) return low;
        if (f_high == 0) return high;
        for (int k = 0; k < 200; ++k) {
            const double middle = 0.5 * (low + high), secant = (low * f_high - high * f_low) / (f_high - f_low);
            if (!(middle > low && middle < high)) break;
            const double t = k % 4 != 3 && secant > low && secant < high ? secant : middle;
            const double value = f(t);
            if (value == 0) return t;
            if ((value < 0) == (f_low < 0)) {
                low = t, f_low = value;
                f_high *= 0.5;
            } else {
                high = t, f_high = value;
                f_low *= 0.5;
            }
        }
        return low;
    }

    Vector c_, u_, v_;
    double scale_;  // of the terms of f
};

// (1/2) the integral of x dy - y dx along the border of the spot from one parameter to another, from an origin near it.
double swept(const Spot& s, double x, double y, double from, double to) {
    const double ca = std::cos(s.angle), sa = std::sin(s.angle);
    const double along = s.major * (std::cos(to) - std::cos(from)), across = s.minor * (std::sin(to) - std::sin(from));
    return 0.5 * (s.major * s.minor * (to - from) + x * (along * sa + across * ca) - y * (along * ca - across * sa));
}

}  // namespace

double union_area(const std::vector<Spot>& spots) {
    const std::size_t n = spots.size();
    std::vector<double> x(n), y(n), reach(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = spots[i].x, y[i] = spots[i].y, reach[i] = spots[i].minor > 0 ? spots[i].major : 0;
    std::vector<std::vector<Interval>> covered(n);
    for_close_pairs(x, y, reach, [&](std::size_t i, std::size_t j, double) {
        Border(spots[i], spots[j]).append_inside(covered[i]);
        Border(spots[j], spots[i]).append_inside(covered[j]);
    });
    double area = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Spot& s = spots[i];
        if (covered[i].empty()) {
            area += pi * s.major * s.minor;
            continue;
        }
        std::sort(covered[i].begin(), covered[i].end(), [](const Interval& a, const Interval& b) { return a.from < b.from; });
        double open = kStart;  // the border outside all others is part of the union's
        for (const Interval& c : covered[i]) {
            if (c.from > open) area += swept(s, s.x - spots[0].x, s.y - spots[0].y, open, c.from);
            open = std::max(open, c.to);
        }
        area += swept(s, s.x - spots[0].x, s.y - spots[0].y, open, kEnd);
    }
    return area;
}

}  // namespace rsc
