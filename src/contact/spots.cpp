#include "contact/spots.hpp"

#include "interaction/close_pairs.hpp"

namespace rsc {
namespace {

struct Vector {
    double x, y;
};
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }

struct Ellipse {
    Vector centre, axis;  // axis: unit vector along the major semi-axis
    double major, minor;
    Vector in_axes(const Vector& v) const {
        return {v.x * axis.x + v.y * axis.y, v.y * axis.x - v.x * axis.y};
    }
    // Half the extent along a unit vector.
    double extent(const Vector& direction) const {
        const Vector d = in_axes(direction);
        return std::sqrt(major * major * d.x * d.x + minor * minor * d.y * d.y);
    }
};

struct Interval {
    double from, to;
};

// Range of the parameter t along a border. It does not begin at 0, where spots often touch.
constexpr double kStart = 0.3, kEnd = kStart + 2 * pi;

// Sample points along a border, denser than the (at most four) extrema of f usually are.
struct Samples {
    static constexpr std::size_t count = 33;  // both ends
    std::array<double, count> t;
    std::array<double, count> c, s;  // cos t, sin t
    Samples() {
        for (const auto k : indices(count)) {
            t[k] = kStart + 2 * pi * double(k) / (count - 1);
            c[k] = std::cos(t[k]);
            s[k] = std::sin(t[k]);
        }
    }
};
const Samples& samples() {
    static const Samples all;
    return all;
}

// Part of the border of p inside q. For the points centre + (major cos t, minor sin t) on the
// border of p, the border of q is at the roots of f(t) = |c + u cos t + v sin t|^2 - 1, a
// trigonometric polynomial of second degree with at most four roots.
class Border {
public:
    Border(const Ellipse& p, const Ellipse& q) {
        const Vector c = q.in_axes({p.centre.x - q.centre.x, p.centre.y - q.centre.y}),
                     turn = q.in_axes(p.axis);
        c_ = {c.x / q.major, c.y / q.minor};
        u_ = {p.major * turn.x / q.major, p.major * turn.y / q.minor};
        v_ = {-p.minor * turn.y / q.major, p.minor * turn.x / q.minor};
        scale_ = 1 + dot(c_, c_) + dot(u_, u_) + dot(v_, v_);
    }

    void append_inside(std::vector<Interval>& covered) const {
        const Samples& at = samples();
        std::array<double, Samples::count> values, slopes;
        for (std::size_t k = 0; k < Samples::count; ++k) {
            const Answer a = ask({at.c[k], at.s[k]});
            values[k] = a.f;
            slopes[k] = a.half_slope;
        }
        const auto value = [](const Answer& a) { return Vector{a.f, 2 * a.half_slope}; };
        const auto slope = [](const Answer& a) { return Vector{a.half_slope, a.half_second}; };
        double from = kStart;
        for (std::size_t k = 1; k < Samples::count; ++k) {
            const double low = at.t[k - 1], high = at.t[k];
            const bool in = values[k - 1] < 0, stays = in == (values[k] < 0),
                       sinks = slopes[k - 1] < 0;
            if (!stays) {
                const double t = root(
                    low, high, low - values[k - 1] * (high - low) / (values[k] - values[k - 1]), in,
                    value);
                if (in)
                    covered.push_back({from, t});
                else
                    from = t;
            } else if (sinks != in && sinks != (slopes[k] < 0) &&
                       std::abs(values[k]) < 0.08 * scale_) {
                // An extremum between two samples may cross 0 (f'' is at most 4 scale_), which
                // gives two more roots unless it only touches.
                const double top = root(low, high, 0.5 * (low + high), sinks, slope),
                             f_top = ask({std::cos(top), std::sin(top)}).f;
                if ((f_top < 0) == in || std::abs(f_top) < 1e-13 * scale_) continue;
                const double first = root(low, top, 0.5 * (low + top), in, value),
                             last = root(top, high, 0.5 * (top + high), !in, value);
                if (in) {
                    covered.push_back({from, first});
                    from = last;
                } else {
                    covered.push_back({first, last});
                }
            }
        }
        if (values.back() < 0) covered.push_back({from, kEnd});
    }

private:
    struct Answer {
        double f, half_slope, half_second;
    };
    Answer ask(const Vector& t) const {  // cos t, sin t
        const Vector turned{u_.x * t.x + v_.x * t.y, u_.y * t.x + v_.y * t.y},
            w{c_.x + turned.x, c_.y + turned.y};
        const Vector slope{v_.x * t.x - u_.x * t.y, v_.y * t.x - u_.y * t.y};
        return {dot(w, w) - 1, dot(w, slope), dot(slope, slope) - dot(w, turned)};
    }

    // Newton's method from t between two points of different sign, with bisection if it leaves this
    // interval. The function is negative at `low` if it `rises`; `of` returns value and slope.
    template <class F>
    double root(double low, double high, double t, bool rises, F of) const {
        for (int k = 0; k < 100; ++k) {
            const Vector f = of(ask({std::cos(t), std::sin(t)}));
            if (f.x == 0) break;
            ((f.x < 0) == rises ? low : high) = t;
            const double newton = t - f.x / f.y;
            const bool inside = newton > low && newton < high;
            // The square of this step is below rounding.
            const bool last = inside && std::abs(newton - t) < 1e-8;
            t = inside ? newton : 0.5 * (low + high);
            if (last || !(low < t && t < high)) break;
        }
        return t;
    }
    Vector c_, u_, v_;
    double scale_;  // magnitude of the terms of f
};

// Half the integral of x dy - y dx along the border between two parameters, about an origin near
// it.
double swept(const Ellipse& e, const Vector& origin, double from, double to) {
    const double along = e.major * (std::cos(to) - std::cos(from)),
                 across = e.minor * (std::sin(to) - std::sin(from));
    const double x = e.centre.x - origin.x, y = e.centre.y - origin.y;
    const double dx = along * e.axis.x - across * e.axis.y,
                 dy = along * e.axis.y + across * e.axis.x;
    return 0.5 * (e.major * e.minor * (to - from) + x * dy - y * dx);
}

double area_of(const Ellipse& e) { return pi * e.major * e.minor; }

// The area of each of a number of spots that earlier spots cover, in its own frame, so that
// periodic images need no special treatment. Spots are numbered in the order in which they are met.
class Coverage {
public:
    // Adds a spot that has close neighbours; returns its number.
    std::size_t add(const Spot& s) {
        const Vector axis{std::cos(s.angle), std::sin(s.angle)};
        spots_.push_back({{{0, 0}, axis, s.major, s.minor}, {}, {}});
        return spots_.size() - 1;
    }

    // Two spots meet; `centre` is that of the first relative to the later one, at a distance d.
    void meet(std::size_t first, std::size_t later, const Vector& centre, double d) {
        Ellipse p = spots_[first].ellipse;
        const Ellipse q = spots_[later].ellipse;
        p.centre = centre;
        const Vector direction{centre.x / d, centre.y / d};
        if (d > 0 && d >= p.extent(direction) + q.extent(direction)) return;
        cover(p, q, first, later);
        cover(q, p, later, first);
        spots_[later].before.push_back({first, centre});
    }

    // Area of each spot that earlier ones cover; after all spots have met.
    std::vector<double> areas() {
        for (Covered& p : spots_)
            std::ranges::sort(p.parts, [](const Part& a, const Part& b) {
                return a.from != b.from ? a.from < b.from : a.by < b.by;
            });
        std::vector<double> covered(spots_.size(), 0.0);
        for (const auto k : indices(spots_)) {
            const Covered& p = spots_[k];
            if (p.before.empty()) continue;
            covered[k] = area_of(p.ellipse) - open_part(p, {0, 0}, {kStart, kEnd}, k);
            for (const auto& [spot, centre] : p.before) {
                const Covered& q = spots_[spot];
                for (const Part& c : q.parts)
                    if (c.by == k) covered[k] += open_part(q, centre, c, k);
            }
        }
        return covered;
    }

private:
    struct Part : Interval {  // of a border, covered by another spot
        std::size_t by;
    };
    struct Before {
        std::size_t spot;
        Vector centre;  // relative to the later spot
    };
    struct Covered {
        Ellipse ellipse;
        std::vector<Part> parts;
        std::vector<Before> before;
    };

    void cover(const Ellipse& p, const Ellipse& q, std::size_t whose, std::size_t by) {
        std::vector<Interval> inside;
        Border(p, q).append_inside(inside);
        for (const Interval& part : inside) spots_[whose].parts.push_back({part, by});
    }

    // Area swept by a part of the border of p about the origin, where it is not covered by spots
    // before number `later`.
    static double open_part(const Covered& p, const Vector& centre, Interval part,
                            std::size_t later) {
        Ellipse e = p.ellipse;
        e.centre = centre;
        double sum = 0;
        for (const Part& c : p.parts) {
            if (c.by >= later || c.to <= part.from) continue;
            if (c.from >= part.to) break;
            if (c.from > part.from) sum += swept(e, {0, 0}, part.from, c.from);
            part.from = std::max(part.from, c.to);
        }
        return part.from < part.to ? sum + swept(e, {0, 0}, part.from, part.to) : sum;
    }

    std::vector<Covered> spots_;
};

}  // namespace

long count_overlapping(const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<double>& a, const Period& period) {
    long pairs = 0;
    for_close_pairs(x, y, a, period, [&](std::size_t, std::size_t, double) { ++pairs; });
    return pairs;
}

double union_area(const std::vector<Spot>& spots, long* close, const Period& period,
                  std::vector<double>* own) {
    const std::size_t n = spots.size();
    std::vector<double> x(n), y(n), reach(n);
    double area = 0;
    for (const auto i : indices(n)) {
        x[i] = spots[i].x;
        y[i] = spots[i].y;
        reach[i] = spots[i].minor > 0 ? spots[i].major : 0;
        area += pi * spots[i].major * spots[i].minor;
    }
    struct Near {
        std::size_t i, j;
        double d;
    };
    std::vector<Near> pairs;
    for_close_pairs(x, y, reach, period, [&](std::size_t i, std::size_t j, double d) {
        pairs.push_back({i, j, d});
    });
    const auto radius = [&](std::size_t i) { return std::sqrt(spots[i].major * spots[i].minor); };
    if (close)
        *close = std::ranges::count_if(
            pairs, [&](const Near& p) { return p.d < radius(p.i) + radius(p.j); });

    constexpr std::size_t none = at(-1);
    std::vector<std::size_t> number(n, none);  // in `coverage`, of a spot with close neighbours
    Coverage coverage;
    const auto number_of = [&](std::size_t i) {
        if (number[i] == none) number[i] = coverage.add(spots[i]);
        return number[i];
    };
    for (const auto& [i, j, d] : pairs) {
        const std::size_t l = number_of(j), k = number_of(i);
        const double dx = period.nearest_x(x[j] - x[i]), dy = period.nearest_y(y[j] - y[i]);
        coverage.meet(std::min(k, l), std::max(k, l), k < l ? Vector{-dx, -dy} : Vector{dx, dy}, d);
    }
    const std::vector<double> covered = coverage.areas();
    for (const double hidden : covered) area -= hidden;
    if (own) {
        own->clear();
        for (const auto i : indices(n))
            own->push_back(pi * spots[i].major * spots[i].minor -
                           (number[i] == none ? 0.0 : covered[number[i]]));
    }
    return area;
}

}  // namespace rsc
