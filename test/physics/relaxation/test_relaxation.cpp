// A body that relaxes (physics/relaxation/relaxation.hpp, relaxing.hpp): its creep function against
// an inversion of the Laplace transform, and one asperity against the solutions of Lee and Radok
// (1960) and of Ting (1966), by integrals worked out here.
#include "check.hpp"
#include "physics/relaxation/relaxing.hpp"
#include "support/asperities.hpp"
#include "support/simpson.hpp"

namespace test_relaxation {

using namespace rsc;

constexpr double kRadius = 0.3, kE = 2.5, kFactor = 4.0 / 3 * kE;

// --- creep

// J(t)/J(0) from its transform soft/(s e(s)) + (1 - soft)/s, e(s) = s times that of the relaxation
// function, by Talbot's contour (Abate and Valko,
// Int. J. Numer. Meth. Eng. 60, 2004).
double talbot(const Relaxation& body, double t) {
    using C = std::complex<long double>;
    constexpr int terms = 28;
    const auto transform = [&](C s) {
        C e = 1;
        for (const auto k : indices(body.share))
            e -= C(body.share[k]) / (C(1) + s * C(body.time[k]));
        return (C(body.soft) / e + C(1 - body.soft)) / s;
    };
    const long double r = 2.0L * terms / (5 * t);
    long double sum = 0.5L * std::exp(r * t) * transform(r).real();
    for (int k = 1; k < terms; ++k) {
        const long double a = k * std::numbers::pi_v<long double> / terms, cot = 1 / std::tan(a);
        const C s = r * a * C(cot, 1);
        sum += (std::exp(s * C(t)) * transform(s) * C(1, a + (a * cot - 1) * cot)).real();
    }
    return double(sum * r / terms);
}

TEST(test_creep) {
    const std::vector<double> shares{0.05, 0.2, 0.1, 0.3, 0.02, 0.08},
        times{1e-3, 0.02, 0.3, 0.31, 7, 2e3};
    Relaxation sixteen;
    for (const int k : indices(kMostRelaxations)) {
        sixteen.share.push_back(0.06);
        sixteen.time.push_back(std::pow(3.0, k - 8));
    }
    for (const Relaxation& body :
         {Relaxation{shares, times}, Relaxation{shares, times, 0.4},
          Relaxation{{0.5, 0.5}, {1, 30}, 1}, Relaxation{{0.5, 0.5}, {1, 30}, 0.7},
          Relaxation{{1}, {2}}, sixteen}) {
        const Creep creep(body);
        for (double t = 1e-4; t < 1e5; t *= 7) {
            CHECK_RELATIVE(creep.compliance(t), talbot(body, t), 1e-10);
            // int phi(t - t') dJ(t') = 1: with the sums of exponentials of both, term by term.
            double one = creep.modulus(t);
            for (const auto& [rate, flow] : creep.retardations()) {
                const auto rises = [&](double r) { return r > 0 ? -std::expm1(-r * t) / r : t; };
                one += creep.last() * flow * rises(rate);
                for (const auto& [share, relaxing] : creep.branches())
                    one += share * flow * std::exp(-std::min(rate, relaxing) * t) *
                           rises(std::abs(rate - relaxing));
            }
            CHECK_RELATIVE(one, 1.0, 1e-10);
        }
    }
}

// --- one asperity

struct One {
    Asperities asperities = asperities_at({{0, 0, 0, kRadius}});
    std::unique_ptr<RelaxingLaw> law;
    const Creep creep;

    explicit One(const Relaxation& body) : creep(body) {
        law = make_relaxing(make_law(LawKind::hertz, asperities, kE), 1, creep);
        constexpr int first = 0;
        law->prepare(std::span(&first, 1));
    }
    void step(double dt) { law->step(dt); }
    double force(double u) const { return law->modulus() * law->force(0, u); }
    // a^2/r, that is, the penetration at which the elastic contact is as large.
    double size(double u) const { return law->area(0, u) / (pi * kRadius); }
    double go(double u) {  // the force there, accepted
        const double f = force(u);
        constexpr int first = 0;
        law->commit(1, &first, &u);
        return f;
    }
    double under(double f) const {
        double low = 0, high = 9;
        for (int i = 0; i < 200; ++i)
            (force(0.5 * (low + high)) < f ? low : high) = 0.5 * (low + high);
        return high;
    }
};

double elastic(double u) { return kFactor * std::sqrt(kRadius) * std::pow(u, 1.5); }

// u = t up to the time 1, 2 - t from there: the force at t, and the time at which the contact was
// last as large on its way up.
std::pair<double, double> ting(const Creep& creep, double t) {
    const auto flow = [&](double from, double to) {
        return simpson(from, to, 4000, [&](double s) { return creep.modulus(t - s); });
    };
    double t1 = t;
    if (t > 1) {
        double low = 0, high = 1;
        for (int i = 0; i < 60; ++i) {
            t1 = 0.5 * (low + high);
            (flow(t1, 1) > flow(1, t) ? low : high) = t1;
        }
        if (t1 < 1e-9) return {0, 0};
    }
    // With s = x^2, (3/2) s^(1/2) ds = 3 x^2 dx.
    return {elastic(1) * simpson(0, std::sqrt(t1), 4000,
                                 [&](double x) { return 3 * x * x * creep.modulus(t - x * x); }),
            t1};
}

double ramp_error(const Relaxation& body, int steps) {
    One one(body);
    double worst = 0;
    for (int k = 0; k <= 2 * steps; ++k) {
        const double t = double(k) / steps, u = t <= 1 ? t : 2 - t;
        one.step(k > 0 ? 1.0 / steps : 0.0);
        const double size = one.size(u), f = one.go(u);
        if (k % (steps / 8) != 0) continue;
        const auto [force, t1] = ting(one.creep, t);
        worst = check::worse(worst, {std::abs(f - force) / elastic(1), std::abs(size - t1)});
    }
    return worst;
}

TEST(test_ramps) {
    for (const Relaxation& body :
         {Relaxation{{1}, {0.7}}, Relaxation{{0.6}, {0.5}}, Relaxation{{0.3, 0.4}, {0.05, 1.5}}}) {
        const double coarse = ramp_error(body, 200), fine = ramp_error(body, 400);
        CHECK(coarse / fine > 3);  // second order
        CHECK(ramp_error(body, 1600) < 1e-6);
    }
}

// A force put on at once and held: a^3 grows as J(t), to 1e-8 where two runs of different steps are
// extrapolated.
TEST(test_held_force) {
    const Relaxation body{{0.3, 0.5}, {0.2, 2}};
    const auto growth = [&](int steps) {
        One one(body);
        const double start = one.under(1);
        one.step(0);
        one.go(start);
        double size = 0;
        for (int k = 0; k < steps; ++k) {
            one.step(3.0 / steps);
            const double u = one.under(1);
            size = one.size(u);
            one.go(u);
        }
        return std::pow(size / start, 1.5);
    };
    const double coarse = growth(400), fine = growth(800), J = Creep(body).compliance(3);
    CHECK(std::abs((coarse - J) / (fine - J) - 4) < 0.1);
    CHECK_RELATIVE((4 * fine - coarse) / 3, J, 1e-8);
}

// Work done = stored + lost, on a path with turns, holds and a time without contact; lost never
// falls. Nothing is stored in the end.
TEST(test_energy) {
    One one(Relaxation{{0.3, 0.4}, {0.1, 2}});
    const auto path = [](double t) { return 0.2 * std::sin(2.2 * t) + 0.05 * std::sin(13 * t); };
    double work = 0, before = 0, f = 0, lost = 0;
    constexpr int steps = 8000;
    bool falls = false;
    one.step(0);
    one.go(0);
    for (int k = 1; k <= steps; ++k) {
        one.step(2.5 / steps);
        const double u = path(2.5 * k / steps), now = one.go(u);
        work += 0.5 * (now + f) * (u - before);
        f = now;
        before = u;
        falls = falls || one.law->lost() < lost - 1e-15;
        lost = one.law->lost();
    }
    CHECK(!falls && lost > 0);
    CHECK_CLOSE(one.law->stored() + lost, work, 1e-6 * lost);
    for (int k = 0; k < 400; ++k) {
        one.step(0.25);
        one.go(-1);
    }
    CHECK(one.law->stored() < 1e-12 * lost);
    CHECK_CLOSE(one.law->lost(), work, 2e-6 * lost);
}

}  // namespace test_relaxation
