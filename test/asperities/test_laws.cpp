// Each asperity law against its own limits and against independent quadratures.
#include "asperities/ellipse.hpp"
#include "asperities/law.hpp"
#include "asperities/uniqueness.hpp"
#include "base/error.hpp"
#include "check.hpp"
#include "physics/adhesion/sticking.hpp"
#include "physics/hardness/hardness.hpp"
#include "physics/relaxation/relaxing.hpp"
#include "support/asperities.hpp"

namespace test_laws {

using namespace rsc;

constexpr double kE = 94.0e3;

struct Answer {
    double force, slope, work, area;
};
Answer ask(Law& law, double u) {
    const int zero = 0;
    law.prepare({&zero, 1});
    Answer r{};
    law.respond(1, &zero, &u, &r.force, &r.slope, &r.work);
    r.area = law.area(0, u);
    return r;
}

// int_0^1 by Gauss-Legendre on 64 panels of 3 points; enough for 1e-13 on what is smooth here.
template <class F>
double integrate(double from, double to, F f) {
    const double node = std::sqrt(0.6), h = (to - from) / 64;
    double sum = 0;
    for (const int i : indices(64)) {
        const double m = from + (i + 0.5) * h;
        sum += h * (5 * f(m - 0.5 * h * node) + 8 * f(m) + 5 * f(m + 0.5 * h * node)) / 18;
    }
    return sum;
}

// The factors against the integrals that define the ellipse, taken by quadrature, not by elliptic
// functions: with semi-axes a >= b a pressure p0 sqrt(1 - x^2/a^2 - y^2/b^2) gives u = (p0 b/E*) [K
// - (K - E)/e^2 x^2/a^2 - ...] (Johnson, eqs 3.64, 4.21 to 4.23).
TEST(ellipse_against_quadrature) {
    for (double axes : {0.9, 0.5, 0.1, 0.01}) {
        const double a = 1, b = axes, e2 = 1 - b * b;
        const auto root = [&](double t) { return std::sqrt(1 - e2 * std::pow(std::sin(t), 2)); };
        // The integrands peak at pi/2 when e is near 1: split there.
        const auto whole = [&](auto f) {
            double sum = 0, left = 0;
            for (double piece : {0.8, 1.3, 1.5, 1.56, 0.5 * pi}) {
                sum += integrate(left, piece, f);
                left = piece;
            }
            return sum;
        };
        const double K = whole([&](double t) { return 1 / root(t); }), E = whole(root);
        const double D = (K - E) / e2, B = (E - b * b * K) / e2;
        // Curvatures (p0 = E* = 1): 2 kappa = second derivatives of u: kappa along x: b D/a^2 2
        // /..., along y: B/b.
        const double kx = 2 * b * D / (a * a), ky = 2 * B / b;
        const double ratio = ky / kx, delta = b * K, force = 2.0 / 3 * pi * a * b;
        const EllipseFactors f = ellipse_factors(ratio);
        CHECK_RELATIVE(f.axes, axes, 1e-9);
        const double R = 1 / std::sqrt(kx * ky);
        CHECK_RELATIVE(4.0 / 3 * std::sqrt(R) * std::pow(delta / f.F2, 1.5), force, 1e-9);
        CHECK_RELATIVE(f.F1 * f.F1 * R * delta / f.F2, a * b, 1e-9);
    }
}

TEST(ellipse_limits) {
    const EllipseFactors circle = ellipse_factors(1.0);
    CHECK_CLOSE(circle.F1, 1, 1e-13);
    CHECK_CLOSE(circle.F2, 1, 1e-13);
    double last = 1;
    for (double ratio = 1; ratio < 1e12; ratio *= 1.7) {
        const EllipseFactors f = ellipse_factors(ratio);
        CHECK(f.axes <= last && f.axes > 0 && std::isfinite(f.F1) && f.F2 <= 1 + 1e-14);
        last = f.axes;
    }
    // Smooth through the switches of the evaluation: neighbouring ratios give neighbouring factors.
    for (double ratio = 1.0; ratio < 3; ratio += 1e-3)
        CHECK_CLOSE(ellipse_factors(ratio + 1e-9).F2, ellipse_factors(ratio).F2, 1e-9);
    CHECK_THROWS(ellipse_factors(0.5), Error);
}

// Every function of every law against the others: force and work are integrals of the slope and of
// the force, the slope is 2 E* a/(F1 F2) of the equivalent radius, a^2 pi the area; the spread is
// that area and goes on straight; the penetration where a mean pressure is reached is the first.
// Nothing before touching. Of two summits, so that each is asked for its own.
TEST(everything_of_every_law) {
    Asperities s = curved(asperities_at({{0, 0, 0, 1 / 6000.0}, {1, 1, 1, 1 / 300.0}}), 1.5);
    s.kappa1[1] = 900;
    s.kappa2[1] = 100;
    const std::vector<int> both = {0, 1};
    for (LawKind kind : {LawKind::hertz, LawKind::elliptic, LawKind::fourth_order})
        for (double flattening : {-4e11, -1e7, 0.0, 1e7, 2e11, 3e12}) {
            s.biharmonic = {flattening, flattening * 1e-4};
            const auto law = make_law(kind, s, kE);
            law->prepare(both);
            law->prepare(both);  // once more changes nothing
            const LawCapabilities can = law->capabilities();
            CHECK(can.convex && !law->memory());
            CHECK(can.paraboloid == (kind != LawKind::fourth_order));
            for (const int i : both) {
                const auto k = i;
                const EllipseFactors f = kind == LawKind::hertz
                                             ? EllipseFactors{}
                                             : ellipse_factors(s.kappa1[k] / s.kappa2[k]);
                CHECK(law->footprint(i, 1e-9).axes == f.axes);
                const double kappa = 1 / s.radius[k];
                const double q2 = kind == LawKind::fourth_order
                                      ? s.biharmonic[k] / (s.kappa1[k] + s.kappa2[k])
                                      : 0;
                const double last = q2 > 0 ? 4 * kappa / q2 * f.F2 : 1e300,
                             flattest = 0.7444 * last;
                const auto respond = [&](double u) {
                    const int which[2] = {1 - i, i};
                    const double at[2] = {0.3 * u, u};
                    double force[2], slope[2], work[2];
                    law->respond(2, which, at, force, slope, work);
                    return Answer{force[1], slope[1], work[1], law->area(i, u)};
                };
                for (double u : {0.0, -1e-3}) {
                    const Answer r = respond(u);
                    CHECK(r.force == 0 && r.slope == 0 && r.work == 0 && r.area == 0 &&
                          law->force(i, u) == 0 && !law->footprint(i, u).beyond);
                }
                CHECK(law->onset(i) == 0);
                const double most = q2 > 0 ? 2.5 * last : 1e-2;
                double work = 0, force = 0, before = 0;
                for (double u = 1e-4 * most; u < most; u *= 1.31) {
                    const Answer r = respond(u);
                    CHECK_RELATIVE(law->force(i, u), r.force, 1e-14);
                    CHECK_RELATIVE(r.slope, 2 * kE * std::sqrt(r.area / pi) / (f.F1 * f.F2), 1e-12);
                    CHECK(law->footprint(i, u).beyond == (u > last));
                    // From the last penetration to this one, in the root of it, and up to the end
                    // of the law's own range apart.
                    for (const auto& [from, to] :
                         {std::pair{before, std::min(u, std::max(before, last))},
                          {std::max(before, std::min(u, last)), u}}) {
                        const double low = std::sqrt(from), high = std::sqrt(to);
                        force += integrate(low, high,
                                           [&](double t) { return 2 * t * respond(t * t).slope; });
                        work += integrate(low, high,
                                          [&](double t) { return 2 * t * law->force(i, t * t); });
                    }
                    CHECK_RELATIVE(r.force, force, 1e-6);  // the slope ends like a root at `last`
                    CHECK_RELATIVE(r.work, work, 1e-7);
                    before = u;
                    const Truncation::Spread now = can.truncation->spread(i, u);
                    const double h = 1e-4 * u;
                    if (u < flattest) CHECK_RELATIVE(now.area, r.area, 1e-12);
                    if (u > flattest)
                        CHECK_RELATIVE(now.slope, can.truncation->spread(i, flattest).slope, 1e-12);
                    // The radius grows like the root of the area: d ln(a)/du.
                    if (u < std::min(flattest, last))
                        CHECK_RELATIVE(can.widening->widening(i, u), 0.5 * now.slope / now.area,
                                       1e-12);
                    const Truncation::Spread low = can.truncation->spread(i, u - h),
                                             high = can.truncation->spread(i, u + h);
                    CHECK_RELATIVE(now.slope, (high.area - low.area) / (2 * h), 1e-6);
                    CHECK_RELATIVE(now.area, (high.integral - low.integral) / (2 * h), 1e-6);
                    CHECK(now.integral > 0 && now.integral < u * now.area);
                    // Asked for the mean pressure here: the same place or, where it was reached
                    // before, that one.
                    const double pressure = r.force / r.area,
                                 first = can.truncation->yield_penetration(i, pressure);
                    CHECK_RELATIVE(law->force(i, first), pressure * law->area(i, first), 1e-11);
                    if (u < flattest) CHECK_RELATIVE(first, u, 1e-8);
                    CHECK(first <= u * (1 + 1e-8));
                    for (double part : {0.1, 0.3, 0.6, 0.9, 0.99})
                        CHECK(law->force(i, part * first) <
                              pressure * law->area(i, part * first) * (1 + 1e-9));
                }
            }
        }
}

// The tabulated functions against Sneddon's closed forms in long double: cos and sin, or cosh and
// sinh.
TEST(fourth_order_to_the_last_digits) {
    // of u, whose cosine is flat near the end of the range, and of a polynomial
    constexpr double kRounding = 3e-14;
    const double kappa = 6000, q = 400, A = 2 * kappa / (q * q);
    for (int sign : {1, -1}) {
        const Asperities s =
            curved(asperities_at({{0, 0, 0, 1 / kappa}}), 1, 0, sign * 2 * kappa * q * q);
        const auto law = make_law(LawKind::fourth_order, s, kE);
        for (int k = 1; k < 300; ++k) {
            const long double x = k * 0.0103L, c = sign > 0 ? std::cos(x) : std::cosh(x),
                              v = sign > 0 ? std::sin(x) : std::sinh(x);
            const long double half = sign > 0 ? std::sin(x / 2) : std::sinh(x / 2);
            const Answer r = ask(*law, double(2 * A * half * half));
            const double slack = kRounding / double(std::abs(v));
            CHECK_RELATIVE(std::sqrt(r.area / pi) * q, double(x), slack);
            if (k < 30) continue;  // the closed form of P cancels
            CHECK_RELATIVE(r.force, double(2 * kE * A / q * sign * (v - x * c)), slack);
            CHECK_RELATIVE(r.force, law->force(0, double(2 * A * half * half)), kRounding);
        }
    }
}

// A cone of slope 0.1 (Sneddon 1965), which says nothing of itself beyond its response.
class Cone final : public Law {
public:
    void prepare(std::span<const int>) override {}
    void respond(int n, const int*, const double* u, double* force, double* slope,
                 double* work) const override {
        for (const int k : indices(n)) {
            const double x = std::max(u[k], 0.0);
            slope[k] = 4 / pi * kE / 0.1 * x;
            force[k] = 0.5 * slope[k] * x;
            work[k] = force[k] * x / 3;
        }
    }
    Footprint footprint(int, double u) const override {
        return {4 / pi * std::pow(std::max(u, 0.0) / 0.1, 2), 1, false};
    }
};

// What a law does not say is not available with it, nor proved of it.
TEST(law_without_capabilities) {
    const Asperities one = asperities_at({{0, 0, 0, 1 / 6000.0}});
    CHECK_THROWS((void)make_yielding(std::make_unique<Cone>(), one, {4000, 0}), Error);
    const Creep creep({{0.5}, {1.0}});
    CHECK_THROWS((void)make_relaxing(std::make_unique<Cone>(), 1, creep), Error);
    Cone cone;
    CHECK_THROWS((void)Sticking(cone, 1e-3), Error);
    const std::vector<double> zero = {0}, u = {1e-3};
    const Response r = cone.response(0, u[0]);
    const auto proved = [&](const Law& law) {
        return doubtful_parts(law, *make_kernel(Interaction::point, kE), {0}, zero, zero, u,
                              {r.force}, {r.slope})
            .empty();
    };
    CHECK(!proved(cone));
    CHECK(cone.onset(0) == 0 && !cone.memory());
}

}  // namespace test_laws
