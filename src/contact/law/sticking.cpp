#include "contact/law/sticking.hpp"

namespace rsc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Between two positive numbers, where a property holds at `yes` and not at `no`: its border.
template <class Property>
double border(double yes, double no, Property&& holds) {
    for (int i = 0; i < 1100; ++i) {
        const double middle = std::sqrt(yes) * std::sqrt(no);
        if (middle == yes || middle == no) break;
        (holds(middle) ? yes : no) = middle;
        if (std::abs(yes - no) <= 2 * std::numeric_limits<double>::epsilon() * yes) break;
    }
    return yes;
}

}  // namespace

double Sticking::spreading(int asperity, double s) const {
    double f, D, W;
    law_.respond(1, &asperity, &s, &f, &D, &W);
    return law_.widening(asperity, s) * std::sqrt(w_ * law_.area(asperity, s) / D);
}

void Sticking::prepare(std::span<const int> asperities) {
    law_.prepare(asperities);
    constexpr double deepest = 1e100;
    for (int i : asperities) {
        if (place_.size() <= static_cast<std::size_t>(i)) place_.resize(static_cast<std::size_t>(i) + 1, -1);
        int& place = place_[static_cast<std::size_t>(i)];
        if (place >= 0) continue;
        place = static_cast<int>(limits_.size());
        // A small contact is that of a paraboloid, where l h is proportional to s^(-3/4).
        double s = 1e-100;
        const double start = std::pow(spreading(i, s), 4.0 / 3) * s;  // l h = 1 of the paraboloid
        const auto stands = [&](double at) { return spreading(i, at) <= 1; };
        Limits limits;
        limits.last = kInfinity;
        double high = deepest;
        if (law_.beyond(i, deepest)) {
            const double end = border(0.01 * start < deepest && !law_.beyond(i, 1e-3 * start) ? 1e-3 * start : 1e-200, deepest,
                                      [&](double at) { return !law_.beyond(i, at); });
            // l h falls from 1 on and rises again before the trough.
            double low = std::min(1e-3 * start, 0.5 * end);
            high = end;
            for (int k = 0; k < 100; ++k) {
                const double a = low + (high - low) / 3, b = high - (high - low) / 3;
                (spreading(i, a) > spreading(i, b) ? low : high) = spreading(i, a) > spreading(i, b) ? a : b;
            }
            const double calmest = 0.5 * (low + high);
            high = calmest;
            const auto calm = [&](double at) { return spreading(i, at) <= 1.0 / 3; };
            limits.last = !calm(calmest) ? calmest : calm(end * (1 - 1e-12)) ? end : border(calmest, end, calm);
        } else {
            high = std::max(4 * start, 1e-300);
            while (!stands(high)) high *= 2;
        }
        limits.least = stands(high) ? border(high, std::min(0.1 * start, 0.1 * high), stands) : limits.last;
        limits_.push_back(limits);
        limits_.back().lets_go = at(i, limits.least).u;
    }
}

Sticking::State Sticking::bare(int asperity, double s) const {
    State state;
    double f0, D, W0;
    law_.respond(1, &asperity, &s, &f0, &D, &W0);
    const double A = law_.area(asperity, s), h = std::sqrt(w_ * A / D), lh = law_.widening(asperity, s) * h;
    state.u = s - 2 * h;
    state.f = f0 - 2 * h * D;
    state.du = 1 - lh;
    state.df = D * (1 - 3 * lh);
    state.stiffness = D;
    state.energy = W0 - 2 * h * f0 + w_ * A;
    state.area = A;
    return state;
}

Sticking::State Sticking::at(int asperity, double s) const {
    const double last = limits_[place(asperity)].last;
    if (!(s > last)) return bare(asperity, s);
    State state = bare(asperity, last);
    const double past = s - last;
    state.energy += past * (state.f + 0.5 * state.stiffness * past);
    state.u += past;
    state.f += state.stiffness * past;
    state.du = 1;
    state.df = state.stiffness;
    state.beyond = true;
    return state;
}

// u(s) is convex up to where the radius stays: Newton's method from above, between bounds.
double Sticking::state_at(int asperity, double u) const {
    double low = least(asperity), high = std::max({2 * low, 2 * u, low - lets_go(asperity) + u});
    while (at(asperity, high).u < u) low = high, high *= 2;
    double s = high;
    for (int i = 0; i < 200; ++i) {
        const State now = at(asperity, s);
        (now.u > u ? high : low) = s;
        double next = s - (now.u - u) / now.du;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - s) <= 4 * std::numeric_limits<double>::epsilon() * s) break;
        s = next;
    }
    return s;
}

}  // namespace rsc
