// A second solution of the contact problem that shares nothing with the first: another unknown,
// another algorithm, another precision, every formula written out again. Slow, and meant to be.
//
// The unknown is the contact radius a_i of the summit with the profile (2 kappa/q^2) [1 - J0(q r)]:
// with
//     delta(a) = 2 kappa sum_m (-1)^m q^(2m) a^(2m+2)/(2m+2)!,    P(a) = 2 E* int a ddelta,
// power series that Sneddon's integrals give term by term, the equation of asperity i, all others
// held, is delta(a_i) F2_i = g0_i - sum_j P(a_j)/(pi E* d_ij), from which E* drops out. It is
// solved by bisection in a_i, sweep after sweep (Gauss-Seidel). Each such step minimises the energy
// over one force, so the sweeps go down to a minimum.
#pragma once

#include "check.hpp"

namespace independent {

using Real = long double;
using Vector = std::vector<Real>;
inline constexpr Real kPi = std::numbers::pi_v<Real>;

struct Summit {
    Real x = 0, y = 0, z = 0;
    Real kappa = 1, q2 = 0;           // 1/R_e, squared wave number of the profile
    Real F1_squared = 1, per_F2 = 1;  // elliptic summits
};

// Complete elliptic integrals K and E of the complementary modulus k' by the arithmetic-geometric
// mean.
inline std::pair<Real, Real> elliptic(Real complementary) {
    Real a = 1, g = complementary, c = std::sqrt(1 - g * g), sum = c * c / 2, power = 1;
    for (int i = 0; i < 40 && c > 1e-19L; ++i) {
        const Real next = (a + g) / 2;
        c = (a - g) / 2;
        g = std::sqrt(a * g);
        a = next;
        sum += power * c * c;
        power *= 2;
    }
    const Real K = kPi / (2 * a);
    return {K, K * (1 - sum)};
}

// Johnson 1985, eqs 4.25 to 4.32, for the axes ratio b/a of the contact: {kappa1/kappa2, F1, F2}.
struct Ellipse {
    Real ratio = 1, F1 = 1, F2 = 1;
};
inline Ellipse ellipse(Real axes) {
    const auto [K, E] = elliptic(axes);
    const Real e2 = 1 - axes * axes, p = E / (axes * axes) - K, q = K - E;
    Ellipse out;
    out.ratio = p / q;
    out.F1 = std::cbrt(4 / (kPi * e2)) * std::sqrt(axes) * std::pow(p * q, 1 / Real(6));
    out.F2 = 2 / kPi * std::sqrt(axes) * K / out.F1;
    return out;
}
inline Ellipse ellipse_of_ratio(Real ratio) {
    Real low = 1e-6L, high = 1 - 1e-6L;
    if (ellipse(high).ratio > ratio) return {};
    for (int i = 0; i < 80; ++i) {
        const Real middle = (low + high) / 2;
        (ellipse(middle).ratio > ratio ? low : high) = middle;
    }
    return ellipse(low);
}

// sum over m of weight(m) (-q^2 a^2)^m/(2m+2)!, 1/2 weight(0) first; |q| a is at most pi or so
// here.
template <class Weight>
Real series(const Summit& s, Real a, Weight weight) {
    Real sum = 0, term = 1 / Real(2);
    for (int m = 0; m < 60 && term != 0; ++m) {
        sum += weight(m) * term;
        term *= -s.q2 * a * a / ((2 * m + 3) * (2 * m + 4));
    }
    return sum;
}
inline Real delta(const Summit& s, Real a) {
    return 2 * s.kappa * a * a * series(s, a, [](int) { return Real(1); });
}
inline Real load(const Summit& s, Real a) {  // P/E*
    return 4 * s.kappa * a * a * a *
           series(s, a, [](int m) { return Real(2 * m + 2) / (2 * m + 3); });
}
// The largest radius at which delta(a) still grows.
inline Real last_radius(const Summit& s) { return s.q2 > 0 ? kPi / std::sqrt(s.q2) : Real(1e30L); }

// delta(a) = d by bisection; d must lie in the law's own range.
inline Real radius(const Summit& s, Real d) {
    if (d <= 0) return 0;
    Real low = 0, high = std::min(last_radius(s), std::sqrt(d / s.kappa));
    while (delta(s, high) < d && high < last_radius(s)) high = std::min(2 * high, last_radius(s));
    for (int i = 0; i < 70; ++i) {
        const Real middle = (low + high) / 2;
        (delta(s, middle) < d ? low : high) = middle;
    }
    return (low + high) / 2;
}

struct Answer {
    Vector a, load;  // contact radius of the paraboloid, force/E*
    Real force = 0, area = 0;
    int sweeps = 0;
    bool converged = false;
};

// R = infinity(): flat.
inline Answer press(const std::vector<Summit>& summits, Real R, Real x0, Real y0, Real Z0,
                    Real tolerance, int most = 20000) {
    const std::size_t n = summits.size();
    Vector g0(n), nearness(n * n);
    for (const std::size_t i : indices(n)) {
        const Summit& s = summits[i];
        const Real rho2 = (s.x - x0) * (s.x - x0) + (s.y - y0) * (s.y - y0);
        if (std::isinf(R))
            g0[i] = s.z - Z0;
        else
            g0[i] = rho2 <= R * R ? s.z + std::sqrt(R * R - rho2) - R - Z0 : -1;
        for (const std::size_t j : indices(n)) {
            const Real dx = s.x - summits[j].x, dy = s.y - summits[j].y;
            nearness[i * n + j] = i == j ? 0 : 1 / (kPi * std::sqrt(dx * dx + dy * dy));
        }
    }
    Answer out{Vector(n), Vector(n)};
    while (out.sweeps < most && !out.converged) {
        ++out.sweeps;
        Real change = 0, total = 0;
        for (const std::size_t i : indices(n)) {
            Real g = g0[i];
            for (std::size_t j = 0; j < n && g > 0; ++j) g -= nearness[i * n + j] * out.load[j];
            out.a[i] = radius(summits[i], g * summits[i].per_F2);
            const Real fresh = load(summits[i], out.a[i]);
            change += std::abs(fresh - out.load[i]);
            total += fresh;
            out.load[i] = fresh;
        }
        out.converged = change <= tolerance * total;
    }
    for (const std::size_t i : indices(n)) {
        out.force += out.load[i];
        out.area += kPi * summits[i].F1_squared * out.a[i] * out.a[i];
    }
    return out;
}

}  // namespace independent
