#include "physics/adhesion/sticking.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include "base/error.hpp"

namespace rsc {
namespace {

constexpr double kSoftest = 0.1;  // least stiffness of an asperity with a range, relative to 2 E c

// Bisection between two positive numbers for the limit of a property that holds at `yes` and not at
// `no`.
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

const Widening& widening_of(const Law& law, double range) {
    const LawCapabilities can = law.capabilities();
    if (!can.widening || (range > 0 && !can.paraboloid))
        bad_input("solids%adhesion: not available with this asperities%law");
    return *can.widening;
}

}  // namespace

Sticking::Sticking(Law& law, double w, double range)
    : law_(law), widening_(widening_of(law, range)), w_(w), z0_(range) {}

double Sticking::spreading(int asperity, double s) const {
    return widening_.widening(asperity, s) *
           std::sqrt(w_ * law_.area(asperity, s) / law_.response(asperity, s).slope);
}

Sticking::Limits Sticking::limits_of_range(int i) const {
    Limits limits;
    const double slope = law_.response(i, z0_).slope,
                 a = std::sqrt(law_.area(i, z0_) / std::numbers::pi);
    limits.last = kInfinity;
    limits.E = slope / (2 * a);
    limits.r = a * a / z0_;
    const auto stands = [&](double s) { return attracting(limits, s).du >= 0; };
    double high = z0_;
    while (!stands(high)) high *= 2;
    limits.least = border(high, 1e-12 * high, stands);
    return limits;
}

Sticking::Limits Sticking::limits_of_jkr(int i) const {
    constexpr double deepest = 1e100;
    // Small contacts are those of a paraboloid, for which l h is proportional to s^(-3/4).
    double s = 1e-100;
    const double start = std::pow(spreading(i, s), 4.0 / 3) * s;  // l h = 1 of the paraboloid
    const auto stands = [&](double at) { return spreading(i, at) <= 1; };
    Limits limits;
    limits.last = kInfinity;
    double high = std::max(4 * start, 1e-300);
    const auto beyond = [&](double at) { return law_.footprint(i, at).beyond; };
    if (beyond(deepest)) {
        const double small =
            0.01 * start < deepest && !beyond(1e-3 * start) ? 1e-3 * start : 1e-200;
        const double end = border(small, deepest, [&](double at) { return !beyond(at); });
        // l h decreases from 1 and increases again before the trough.
        double low = std::min(1e-3 * start, 0.5 * end);
        high = end;
        for (int k = 0; k < 100; ++k) {
            const double a = low + (high - low) / 3, b = high - (high - low) / 3;
            const bool falls = spreading(i, a) > spreading(i, b);
            (falls ? low : high) = falls ? a : b;
        }
        const double calmest = 0.5 * (low + high);
        high = calmest;
        const auto calm = [&](double at) { return spreading(i, at) <= 1.0 / 3; };
        limits.last = !calm(calmest)            ? calmest
                      : calm(end * (1 - 1e-12)) ? end
                                                : border(calmest, end, calm);
    } else {
        while (!stands(high)) high *= 2;
    }
    limits.least =
        stands(high) ? border(high, std::min(0.1 * start, 0.1 * high), stands) : limits.last;
    return limits;
}

void Sticking::prepare(std::span<const int> asperities) {
    law_.prepare(asperities);
    for (int i : asperities) {
        if (place_.size() <= std::size_t(i)) place_.resize(std::size_t(i) + 1, -1);
        int& place = place_[std::size_t(i)];
        if (place >= 0) continue;
        place = int(limits_.size());
        limits_.push_back(z0_ > 0 ? limits_of_range(i) : limits_of_jkr(i));
        Limits& limits = limits_.back();
        const State last = at(i, limits.least);
        limits.lets_go = last.u;
        limits.lost_detaching = last.energy;
        limits.lost_attaching = -at(i, state_at(i, touches())).energy;
    }
}

Sticking::State Sticking::bare(int asperity, double s) const {
    State state;
    const auto [f0, D, W0] = law_.response(asperity, s);
    const double A = law_.area(asperity, s), h = std::sqrt(w_ * A / D),
                 lh = widening_.widening(asperity, s) * h;
    state.u = s - 2 * h;
    state.f = f0 - 2 * h * D;
    state.pressed = f0;
    state.du = 1 - lh;
    state.df = D * (1 - 3 * lh);
    state.stiffness = state.clamped = D;
    state.energy = W0 - 2 * h * f0 + w_ * A;
    state.area = state.outer = A;
    return state;
}

Sticking::State Sticking::attracting(const Limits& of, double s) const {
    using std::numbers::pi;
    const double r = of.r, E = of.E, s0 = w_ / z0_, c = std::sqrt(r * s);
    const auto missing = [&](double beta) {  // difference of the gap at c from z0
        const double half = std::sin(0.5 * beta);
        return c * c / (pi * r) * (0.5 * std::sin(2 * beta) - beta * std::cos(2 * beta)) +
               4 * s0 * c / (pi * E) * (beta * std::sin(beta) - 2 * half * half) - z0_;
    };
    double beta = 0.5 * pi;
    if (missing(beta) > 0) {
        std::uintmax_t steps = 100;
        const auto [low, high] = boost::math::tools::toms748_solve(
            missing, 0.0, beta, boost::math::tools::eps_tolerance<double>(52), steps);
        beta = 0.5 * (low + high);
    }
    const bool apart = beta == 0.5 * pi;
    const double a = apart ? 0 : c * std::cos(beta), e = c * std::sin(beta),
                 alpha = 0.5 * pi - beta;
    State state;
    state.u = apart ? 0.5 * c * c / r - 4 * s0 * c / (pi * E) - z0_ : a * a / r - 2 * s0 * e / E;
    const double root = 0.5 * (a * e + c * c * alpha);  // int_0^a sqrt(c^2 - t^2) dt
    state.f = 2 * E * a * (state.u - a * a / (3 * r)) - 4 * s0 * (0.25 * pi * c * c - root);
    state.pressed = 4 * E * a * a * a / (3 * r);
    // Derivatives with respect to c at a constant gap z0 at c: u_a da = G_c/(2 beta/pi) dc.
    const double u_c = -2 * s0 * c / (E * e);
    const double G_c = c / r - u_c * 2 * beta / pi +
                       2 / pi * ((a * e / c - c * alpha) / r - 2 * s0 / E * (1 - a / c));
    const double to_s = 0.5 * r / c,
                 slope = apart ? c / r - 4 * s0 / (pi * E) : u_c + G_c * 0.5 * pi / beta;
    state.du = to_s * slope;
    state.df = to_s * (2 * E * a * slope - 4 * s0 * c * beta);
    state.clamped = 2 * E * a;
    state.stiffness = 2 * E * std::max(a, kSoftest * c);
    state.area = pi * a * a;
    state.outer = pi * c * c;
    // Elastic energy E int_0^c chi^2 dt with chi = u - t^2/r in the contact and -(2 s0/E) sqrt(c^2
    // - t^2) outside, minus the adhesive energy.
    const double u = state.u,
                 elastic = E * a * (u * u - 2.0 / 3 * u * a * a / r + a * a * a * a / (5 * r * r)) +
                           4 * s0 * s0 / E * (2.0 / 3 * c * c * c - c * c * a + a * a * a / 3);
    const double root2 = 0.125 * (c * c * c * c * alpha -
                                  a * e * (c * c - 2 * a * a));  // int_0^a t^2 sqrt(c^2 - t^2) dt
    const double sunk =
        4 * (u * root - root2 / r - 2 * s0 / E * (2.0 / 3 * c * c * c - c * c * a + a * a * a / 3) -
             0.25 * pi * a * a *
                 (u - 0.25 * a * a / r));  // integral of the displacement over the cohesive ring
    const double gaps = 0.25 * pi * (c * c * c * c - a * a * a * a) / r - u * pi * e * e + sunk;
    state.energy = elastic - s0 * (z0_ * pi * c * c - gaps);
    return state;
}

Sticking::State Sticking::at(int asperity, double s) const {
    if (z0_ > 0) return attracting(limits_[place(asperity)], s);
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

// Bracketed Newton's method from above; u(s) is convex up to where the radius becomes constant.
double Sticking::state_at(int asperity, double u) const {
    double low = least(asperity), high = std::max({2 * low, 2 * u, low - lets_go(asperity) + u});
    while (at(asperity, high).u < u) {
        low = high;
        high *= 2;
    }
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
