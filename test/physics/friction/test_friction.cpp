// Partial slip and its memory against closed forms, and against springs with friction one by one
// (physics of src/physics/friction/friction.hpp).
#include "base/error.hpp"
#include "check.hpp"
#include "contact/equivalent.hpp"
#include "physics/friction/friction.hpp"

namespace test_friction {

using namespace rsc;

constexpr double kE = 94.0e3;
const Friction kFriction{0.3, 0.8};

// Spheres of radius R that touch at different approaches and do not feel each other; the closed
// forms of Hertz.
struct Spheres : LoadCurve {
    std::vector<double> touch, R;
    Spheres(std::vector<double> touch_, std::vector<double> R_)
        : touch(std::move(touch_)), R(std::move(R_)) {}
    double first_touch() const override { return *std::ranges::min_element(touch); }
    Load load(double delta) override {
        Load sum;
        for (const auto i : indices(R)) {
            const double u = std::max(0.0, delta - touch[i]);
            sum.force += 4.0 / 3.0 * kE * std::sqrt(R[i]) * std::pow(u, 1.5);
            sum.energy += 8.0 / 15.0 * kE * std::sqrt(R[i]) * std::pow(u, 2.5);
        }
        return sum;
    }
    double stiffness(double delta) override {
        double sum = 0;
        for (const auto i : indices(R))
            sum += 2 * kE * std::sqrt(R[i] * std::max(0.0, delta - touch[i]));
        return sum;
    }
    double approach(double force) override {
        double low = first_touch(), high = low + 1;
        while (load(high).force < force) high *= 2;
        for (int i = 0; i < 200; ++i) {
            const double middle = 0.5 * (low + high);
            (load(middle).force < force ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }
};
Spheres sphere() { return {{0.0}, {2.5}}; }
Spheres several() { return {{-0.001, 0.0004, 0.002, 0.0021, 0.005}, {0.3, 1.0, 0.7, 2.0, 0.5}}; }

// 4 G*/E* of a glass sphere on steel from Mindlin's compliances, written out again.
TEST(ratio_of_stiffnesses) {
    const double E[2] = {70e3, 210e3}, nu[2] = {0.22, 0.3};
    double G_star = 0, E_star = 0;
    for (const int i : indices(2)) {
        G_star += (2 - nu[i]) / (E[i] / (2 * (1 + nu[i])));
        E_star += (1 - nu[i] * nu[i]) / E[i];
    }
    CHECK_RELATIVE(tangential_ratio(E, nu), 4 * E_star / G_star, 1e-14);
    const double like[2] = {70e3, 70e3}, same[2] = {0.22, 0.22}, rigid[2] = {70e3, kInfinity};
    CHECK_RELATIVE(tangential_ratio(like, same), 2 * (1 - 0.22) / (2 - 0.22), 1e-14);
    CHECK_RELATIVE(tangential_ratio(rigid, same), 2 * (1 - 0.22) / (2 - 0.22), 1e-14);
}

// Mindlin (1949): Q = mu N [1 - (1 - xi/xi_1)^(3/2)], xi_1 = 3 mu N/(16 G* a), with G* = m E*/4.
TEST(mindlin_first_loading) {
    Spheres curve = sphere();
    const double delta = 0.004, N = curve.load(delta).force, a = std::sqrt(2.5 * delta),
                 G_star = kFriction.ratio * kE / 4;
    const double xi_1 = 3 * kFriction.coefficient * N / (16 * G_star * a);
    CHECK_RELATIVE(full_slip(curve, kFriction, delta), xi_1, 1e-13);
    std::vector<double> xi;
    for (int k = 0; k <= 12; ++k) xi.push_back(0.1 * k * xi_1);
    const auto points = slide_to(curve, kFriction, delta, xi);
    FrictionHistory path(kFriction);
    path.go_to(curve, delta, {7, -3});  // only differences of xi count
    CHECK_RELATIVE(path.stiffness(curve).xx, 8 * G_star * a, 1e-13);
    for (const auto k : indices(xi)) {
        const double left = std::max(0.0, 1 - xi[k] / xi_1);
        const double Q = kFriction.coefficient * N * (1 - std::pow(left, 1.5));
        CHECK_CLOSE(points[k].force, Q, 1e-13 * N);
        path.go_to(curve, delta, {7 + 0.6 * xi[k], -3 + 0.8 * xi[k]});
        CHECK_CLOSE(path.tangential_force().x, 0.6 * Q,
                    1e-12 * N);  // slides of 1e-3 counted from 7
        CHECK_CLOSE(path.tangential_force().y, 0.8 * Q, 1e-12 * N);
        // The stick radius: c = a (1 - Q/(mu N))^(1/3).
        if (left > 0)
            CHECK_CLOSE(std::sqrt(2.5 * path.stick_approach()),
                        a * std::cbrt(1 - Q / (kFriction.coefficient * N)), 1e-12 * a);
        if (Q < kFriction.coefficient * N)
            CHECK_CLOSE(slide_at_force(curve, kFriction, delta, Q).displacement, xi[k],
                        1e-12 * xi_1);
    }
    CHECK_THROWS(slide_at_force(curve, kFriction, delta, 1.01 * kFriction.coefficient * N), Error);
}

// Mindlin and Deresiewicz (1953), constant N: unloading from Q_A, and the work lost in a cycle
// between +-Q_A,
//     Delta W = 9 mu^2 N^2/(10 a G*) { 1 - (1 - q)^(5/3) - (5 q/6) [1 + (1 - q)^(2/3)] }, q =
//     Q_A/(mu N)  (Johnson 1985, section 7.4).
TEST(mindlin_deresiewicz_cycle) {
    Spheres curve = sphere();
    const double delta = 0.004, N = curve.load(delta).force, a = std::sqrt(2.5 * delta),
                 G_star = kFriction.ratio * kE / 4;
    const double mu = kFriction.coefficient, xi_1 = 3 * mu * N / (16 * G_star * a),
                 xi_A = 0.9 * xi_1;
    const double q = 1 - std::pow(0.1, 1.5), Q_A = q * mu * N;
    const double work = 9 * mu * mu * N * N / (10 * a * G_star) *
                        (1 - std::pow(1 - q, 5.0 / 3) - 5 * q / 6 * (1 + std::pow(1 - q, 2.0 / 3)));
    FrictionHistory path(kFriction);
    path.go_to(curve, delta, {});
    path.go_to(curve, delta, {xi_A, 0});
    const double first = path.work_lost();
    constexpr int steps = 50;
    for (int k = 1; k <= 2 * steps; ++k) {
        const bool down = k <= steps;
        const double xi = down ? xi_A * (1 - 2.0 * k / steps) : xi_A * (2.0 * k / steps - 3);
        path.go_to(curve, delta, {xi, 0});
        // Deresiewicz: half the slide doubled, from the point of reversal.
        const double back = down ? xi_A - xi : xi + xi_A;
        const double Q = Q_A - 2 * mu * N * (1 - std::pow(1 - back / (2 * xi_1), 1.5));
        CHECK_CLOSE(path.tangential_force().x, down ? Q : -Q, 1e-12 * N);
    }
    CHECK_CLOSE(path.tangential_force().x, Q_A, 1e-12 * mu * N);  // the loop is closed
    CHECK_RELATIVE(path.work_lost() - first, work, 1e-11);
    const SlideCycles in{.steps = 40, .cycles = 2};
    const SlideCycle cycle = slide_cycle(curve, kFriction, delta, xi_A, in);
    CHECK_RELATIVE(cycle.work, work, 1e-11);
    CHECK(cycle.force.size() == in.points() && in.points() == 41 + 161 && in.first() == 41);
    CHECK_RELATIVE(cycle.displacement[40], xi_1, 1e-13);
    CHECK_RELATIVE(cycle.force[40], mu * N, 1e-13);
    CHECK_RELATIVE(cycle.displacement[41], xi_A, 1e-13);
    CHECK_CLOSE(cycle.force[41], cycle.force.back(), 1e-12 * mu * N);
    CHECK_CLOSE(cycle.displacement[41], cycle.displacement.back(), 1e-12 * xi_1);
    CHECK_CLOSE(cycle.force[41 + 40], -cycle.force[41], 1e-12 * mu * N);
    // Beyond full slip a cycle loses 4 mu N over the rest of its way.
    const double beyond = slide_cycle(curve, kFriction, delta, 1.5 * xi_1, in).work,
                 full = slide_cycle(curve, kFriction, delta, xi_1, in).work;
    CHECK_RELATIVE(beyond - full, 2 * mu * N * xi_1, 1e-11);
}

// Springs with friction one by one (Iwan), on an even grid of s: the spring at s carries what makes
// N exact at the grid points.
struct Springs {
    double first, step;
    std::vector<double> stiffness;  // normal
    std::vector<Slide> u;
    double lost = 0;
    Springs(LoadCurve& curve, double low, double high, std::size_t n)
        : first(low), step((high - low) / double(n)) {
        for (const std::size_t k : indices(n)) {
            const double s = low + step * double(k);
            stiffness.push_back((curve.load(s + step).force - 2 * curve.load(s).force +
                                 curve.load(s - step).force) /
                                step);
            u.push_back({});
        }
    }
    // A short piece of path: the radial return of plasticity.
    void go(const Friction& f, double from, double delta, Slide dxi) {
        const double c = f.coefficient / f.ratio;
        for (const auto k : indices(u)) {
            const double s = first + step * double(k);
            if (from <= s && delta <= s) break;
            // A spring that touches on the way, or lets go, follows its part of the slide only.
            double part = 1;
            if (from < s) part = (delta - s) / (delta - from);
            if (delta < s) part = (from - s) / (from - delta);
            const double limit = c * std::max(0.0, delta - s);
            Slide free{u[k].x + part * dxi.x, u[k].y + part * dxi.y};
            const double length = std::hypot(free.x, free.y), over = length - limit;
            const double mean_limit =
                0.5 * c * (std::max(0.0, from - s) + std::max(0.0, delta - s));
            if (over > 0) {
                lost += f.ratio * stiffness[k] * mean_limit * over;
                free = {free.x * limit / length, free.y * limit / length};
            }
            u[k] = free;
        }
    }
    Slide force(const Friction& f) const {
        Slide sum;
        for (const auto k : indices(u)) {
            sum.x += f.ratio * stiffness[k] * u[k].x;
            sum.y += f.ratio * stiffness[k] * u[k].y;
        }
        return sum;
    }
};

// A random step of a history along a line: now and then at constant approach, out of contact,
// small, or without slide.
struct Step {
    double delta, xi;
};
Step random_step(std::mt19937_64& random, double low, double high, double c, Step from) {
    std::uniform_real_distribution<double> uniform(0, 1);
    const double kind = uniform(random), whole = c * (high - low);
    Step to{kind < 0.3   ? from.delta
            : kind < 0.4 ? low - 0.0002
                         : low + (high - low) * uniform(random),
            kind > 0.9 ? from.xi
                       : from.xi + (uniform(random) - 0.5) * (kind < 0.6 ? 1.0 : 3.0) * whole};
    if (kind > 0.8 && kind < 0.9)
        to = {from.delta + 1e-3 * (to.delta - from.delta), from.xi + 1e-3 * (to.xi - from.xi)};
    return to;
}

// A hundred random histories along a line against the springs, and what any path must keep.
TEST(random_histories) {
    Spheres curve = several();
    constexpr double low = -0.001, high = 0.008;
    const double c = kFriction.slide_per_approach(),
                 most = kFriction.coefficient * curve.load(high).force;
    const double far = c * (high - low);
    for (unsigned seed = 0; seed < 100; ++seed) {
        std::mt19937_64 random(seed);
        Springs springs(curve, low, high, 3000);
        FrictionHistory path(kFriction);
        Step at{0.002, 0};
        path.go_to(curve, at.delta, {});
        springs.go(kFriction, low - 1, at.delta, {});
        for (int step = 0; step < 12; ++step) {
            const Step to = random_step(random, low, high, c, at);
            path.go_to(curve, to.delta, {to.xi, 0});
            constexpr int parts = 60;
            for (const int k : indices(parts)) {
                const double dd = (to.delta - at.delta) / parts;
                springs.go(kFriction, at.delta + k * dd, at.delta + (k + 1) * dd,
                           {(to.xi - at.xi) / parts, 0});
            }
            // 3000 springs, each in its own place: their sum is in error by the square of their
            // spacing.
            CHECK_CLOSE(path.tangential_force().x, springs.force(kFriction).x, 1e-6 * most);
            CHECK_CLOSE(path.work_lost(), springs.lost,
                        2e-3 * most * far);  // the springs' loss is that of 60 substeps
            CHECK(std::abs(path.tangential_force().x) <=
                  kFriction.coefficient * path.force() * (1 + 1e-12));
            CHECK(path.tangential_force().y == 0);
            CHECK(path.step_lost() >= -1e-15 * most * far);
            CHECK(path.tangential_energy() >= 0);
            at = to;
        }
    }
}

// Two directions: along a line in any direction it is the problem of one; a turned path gives
// turned forces; what is lost is positive; the friction disc holds; and springs with the radial
// return one by one give nearly the same.
TEST(two_directions) {
    Spheres curve = several();
    constexpr double low = -0.001, high = 0.008;
    const double c = kFriction.slide_per_approach(),
                 most = kFriction.coefficient * curve.load(high).force;
    const double far = c * (high - low);
    double worst = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const double turn = seed < 10 ? 0.004 : 0.2;  // at each step of 2 % of full slip, at most
        std::mt19937_64 random(2000 + seed);
        std::uniform_real_distribution<double> uniform(0, 1);
        FrictionHistory path(kFriction), turned(kFriction);
        Springs springs(curve, low, high, 1000);
        double delta = 0.004;
        Slide xi;
        path.go_to(curve, delta, xi);
        turned.go_to(curve, delta, xi);
        springs.go(kFriction, low - 1, delta, {});
        double work = 0, curvature = 0, course = 6 * uniform(random);
        for (const int step : indices(300)) {
            if (step % 60 == 0) curvature = turn * (uniform(random) - 0.5);
            course += curvature;
            const double next =
                std::max(low + 0.002, std::min(high, delta + 2e-4 * (uniform(random) - 0.5)));
            const Slide to{xi.x + 0.02 * far * std::cos(course),
                           xi.y + 0.02 * far * std::sin(course)};
            const Slide before = path.tangential_force();
            path.go_to(curve, next, to);
            turned.go_to(curve, next, {0.6 * to.x - 0.8 * to.y, 0.8 * to.x + 0.6 * to.y});
            springs.go(kFriction, delta, next, {to.x - xi.x, to.y - xi.y});
            const Slide Q = path.tangential_force(), T = turned.tangential_force(),
                        F = springs.force(kFriction);
            work += 0.5 * ((before.x + Q.x) * (to.x - xi.x) + (before.y + Q.y) * (to.y - xi.y));
            CHECK(std::hypot(Q.x, Q.y) <= kFriction.coefficient * path.force() * (1 + 1e-12));
            CHECK(path.step_lost() >= -1e-14 * most * far);
            CHECK_CLOSE(T.x, 0.6 * Q.x - 0.8 * Q.y, 1e-10 * most);
            CHECK_CLOSE(T.y, 0.8 * Q.x + 0.6 * Q.y, 1e-10 * most);
            if (seed < 10)
                worst = std::max(worst, std::hypot(Q.x - F.x, Q.y - F.y) /
                                            (kFriction.coefficient * path.force()));
            delta = next;
            xi = to;
        }
        CHECK_CLOSE(path.work_lost() + path.tangential_energy(), work,
                    0.02 * work);  // steps of 2 % of full slip
    }
    // Where the path turns over lengths of ten full slips or more, the direction of each spring
    // matters little.
    CHECK(worst < 0.1);
}

// The tangent is the derivative of a further slide the same way.
TEST(tangent) {
    Spheres curve = several();
    const double c = kFriction.slide_per_approach(), delta = 0.006, far = c * 0.007;
    FrictionHistory path(kFriction);
    path.go_to(curve, 0.004, {});
    path.go_to(curve, 0.005, {0.4 * 0.001 * c, 0.3 * 0.001 * c});  // sticks
    path.go_to(curve, delta, {0.1 * 0.001 * c, 0.5 * 0.001 * c});
    const auto S = path.stiffness(curve);
    CHECK_RELATIVE(S.xx, kFriction.ratio * curve.stiffness(delta), 1e-13);
    CHECK(S.xy == 0 && S.yy == S.xx && path.stick_approach() == delta);
    for (const double amount : {0.3, 0.2, 5.0}) {  // the last one: all slips
        const Slide from = path.slide();
        const Slide to{from.x + 0.8 * amount * far, from.y - 0.6 * amount * far};
        path.go_to(curve, delta, to);
        const auto K = path.stiffness(curve);
        const double h = 1e-7 * far;
        const auto moved = [&](double dx, double dy) {
            FrictionHistory p = path;
            p.go_to(curve, delta, {to.x + dx, to.y + dy});
            return p.tangential_force();
        };
        // One-sided, onwards: backwards, everything sticks. Two slides onwards in different
        // directions.
        const double most = kFriction.coefficient * path.force() / far;
        const Slide Q = path.tangential_force(), A = moved(h, -0.2 * h), B = moved(0.3 * h, -h);
        CHECK_CLOSE((A.x - Q.x) / h, K.xx - 0.2 * K.xy, 2e-5 * most);
        CHECK_CLOSE((A.y - Q.y) / h, K.yx - 0.2 * K.yy, 2e-5 * most);
        CHECK_CLOSE((B.x - Q.x) / h, 0.3 * K.xx - K.xy, 2e-5 * most);
        CHECK_CLOSE((B.y - Q.y) / h, 0.3 * K.yx - K.yy, 2e-5 * most);
    }
}

// A larger reversal wipes out what smaller ones left; states that are taken back.
TEST(memory) {
    Spheres curve = several();
    const double c = kFriction.slide_per_approach(), delta = 0.006, far = c * 0.007;
    FrictionHistory path(kFriction), plain(kFriction);
    for (FrictionHistory* p : {&path, &plain}) p->go_to(curve, delta, {});
    path.go_to(curve, delta, {0.5 * far, 0});
    plain.go_to(curve, delta, {0.5 * far, 0});
    for (double xi : {-0.3, 0.2, -0.1, 0.1, 0.0, 0.05}) path.go_to(curve, delta, {xi * far, 0});
    CHECK(path.state().nodes.size() > 6);
    const auto before = path.state();
    path.go_to(curve, delta, {0.9 * far, 0});
    plain.go_to(curve, delta, {0.9 * far, 0});
    CHECK(path.state().nodes.size() == plain.state().nodes.size());
    CHECK_CLOSE(path.tangential_force().x, plain.tangential_force().x,
                1e-13 * kFriction.coefficient * path.force());
    path.restore(before);
    CHECK(path.slide().x == 0.05 * far && path.state().nodes.size() > 6);
    FrictionHistory other(kFriction);
    other.restore(path.state());
    for (FrictionHistory* p : {&path, &other}) p->go_to(curve, 0.004, {-0.2 * far, 0.1 * far});
    CHECK(path.tangential_force().x == other.tangential_force().x &&
          path.work_lost() == other.work_lost());
    auto broken = path.state();
    broken.nodes.front().deflection.x = 2 * far;
    CHECK_THROWS(other.restore(broken), Error);
    // Load gone, memory gone.
    path.go_to(curve, -1, {});
    CHECK(path.tangential_force().x == 0 && path.force() == 0 && path.state().nodes.empty() &&
          path.tangential_energy() == 0);
    path.go_to(curve, -1, {3, 3});
    CHECK(path.step_lost() == 0);
    path.go_to(curve, delta, {3, 3});
    CHECK(path.tangential_force().x == 0 && path.force() > 0);
}

}  // namespace test_friction
