// Elements that attract without a range (physics/adhesion/adhesive_edges.hpp), against Johnson,
// Kendall and Roberts's sphere, Johnson's wave between flats, and a slow minimiser.
#include "base/error.hpp"
#include "check.hpp"
#include "contact/make.hpp"
#include "contact/quantities.hpp"
#include "interaction/kernel.hpp"
#include "physics/adhesion/adhesive_edges.hpp"
#include "physics/adhesion/sticking.hpp"
#include "support/bodies.hpp"
#include "support/height_maps.hpp"
#include "support/judged.hpp"
#include "truth/elimination.hpp"

namespace test_without_range {

using namespace rsc;

SolverOptions sharp(double w) { return {.physics = bodies_with(Adhesion{w, 0})}; }

// Of radius 1 on a half-space of modulus E* = 1, by the radius of the contact.
struct Jkr {
    double w;
    double force(double a) const { return 4 * a * a * a / 3 - std::sqrt(8 * pi * w * a * a * a); }
    double approach(double a) const { return a * a - std::sqrt(2 * pi * w * a); }
    double at_rest() const { return std::cbrt(4.5 * pi * w); }  // the radius at zero force
    double last() const { return std::cbrt(pi * w / 8); }       // at fixed grips
    double pull_off() const { return 1.5 * pi * w; }
    double radius(double d) const {  // of the stable branch
        double low = last(), high = 1;
        for (int i = 0; i < 100; ++i) {
            const double a = 0.5 * (low + high);
            (approach(a) < d ? low : high) = a;
        }
        return low;
    }
    // From the contact at first touch to pull-off and back.
    double lost() const {
        double sum = 0, high = radius(0);
        for (const int i : indices(100000)) {
            const double a = last() + (high - last()) * i / 1e5,
                         b = last() + (high - last()) * (i + 1) / 1e5;
            sum -= 0.5 * (force(a) + force(b)) * (approach(b) - approach(a));
        }
        return sum;
    }
};

// n points across four radii of the contact at zero force, which the tip does not lie on.
HeightMap sphere(const Jkr& truth, int n, double x = 0.1, double y = 0.07) {
    const double h = 4 * truth.at_rest() / n;
    return height_map(n, n, h, h, [=](int i, int j) {
        return -0.5 * h * h *
               (std::pow(i - 0.5 * (n - 1) + x, 2) + std::pow(j - 0.5 * (n - 1) - y, 2));
    });
}
Indenter flat_over(const HeightMap& map) {
    return {1.0, kInfinity, 0.5 * map.Lx(), 0.5 * map.Ly()};
}

struct Loop {
    double pull_off, lost, worst;  // relative to the truth; largest error of N over the pull-off
};
// Pressed and pulled off in `levels` levels.
Loop loop(int n, int levels) {
    const Jkr truth{1e-4};
    const HeightMap map = sphere(truth, n);
    const auto contact = make_element_contact(map, flat_over(map), sharp(truth.w));
    const double unit = truth.at_rest() * truth.at_rest() / 3;
    Loop result{};
    Level level = contact->at_separation(0.5 * unit);
    CHECK(level.contacts == 0 && level.force == 0);
    const auto go = [&](double d) {
        level = judged(contact->at_separation(-d), *contact, sharp(truth.w), &map);
        CHECK(level.converged);
        if (d < -0.7 * unit) return;  // near the end of the branch
        const double a = truth.radius(d), error = std::abs(level.force - truth.force(a));
        result.worst = std::max(result.worst, error / truth.pull_off());
        CHECK(error <= level.force_error_expected * std::abs(level.force));
        CHECK(std::abs(level.area / (pi * a * a) - 1) <= level.area_error_expected);
    };
    for (const int k : indices(levels)) go((0.05 + 1.45 * k / levels) * unit);
    for (int k = 0; k <= 2 * levels; ++k) go((1.5 - 2.2 * k / (2 * levels)) * unit);
    for (int k = 1; k <= levels; ++k) go((-0.7 - 0.5 * k / levels) * unit);
    CHECK(level.contacts == 0 && level.force == 0);
    CHECK_CLOSE(contact->energy(), 0.0, 0.0);
    return {-level.least_force / truth.pull_off(), level.energy_lost / truth.lost(), result.worst};
}

// First order in the pixel: with 8, 16 and 32 pixels to the radius at zero force.
TEST(test_jkr) {
    for (const int pixels : {8, 16, 32}) {
        const Loop of = loop(4 * pixels, 12);
        CHECK_CLOSE(of.pull_off, 1, 0.6 / pixels);
        CHECK_CLOSE(of.lost, 1, 1.0 / pixels);
        CHECK(of.worst < 0.9 / pixels);
    }
}

// A sphere of radius 1 with axisymmetric waves A (1 - cos(2 pi r/lambda)) on a body of E* = 1,
// in contact within r < a (Guduru, J. Mech. Phys. Solids 55, 2007). H(a) is the approach without
// adhesion; at the approach D the edge releases G = (H - D)^2/(2 pi a).
struct WavySphere {
    static constexpr int kRadii = 4000;
    double w, A, lambda, widest;  // the largest radius of the path is less than `widest`
    std::vector<double> H = heights();
    double lost = 0, pull_off = 0;

    double radius(int i) const { return widest * i / kRadii; }
    std::vector<double> heights() const {
        std::vector<double> all(kRadii + 1);
        for (int i = 0; i <= kRadii; ++i)
            for (const int k : indices(200)) {
                const double r = radius(i) * std::sin((k + 0.5) / 200 * pi / 2),
                             q = 2 * pi / lambda;
                all[i] += radius(i) * (r + A * q * std::sin(q * r)) * pi / 400;
            }
        return all;
    }
    double release(int i, double D) const { return std::pow(H[i] - D, 2) / (2 * pi * radius(i)); }
    bool grows(int i, double D) const { return H[i] < D || release(i, D) < w; }
    double force(int i, double D) const {
        double sum = 0;
        for (int j = 0; j <= i; ++j) sum += H[j] * widest / kRadii;
        return 2 * (D * radius(i) - sum);
    }
    // Touches at D = 0, is pressed to `most` and pulled off, as far as its edge moves at each of
    // many approaches; what is not released by the bodies is lost.
    void go(double most) {
        int i = 0;
        for (const int k : indices(30000)) {
            const double D = k < 10000 ? most * k / 1e4 : most - 4 * most * (k - 10000) / 2e4;
            const auto move = [&](int to) {
                lost += std::abs(w - release(std::max(i, to), D)) * pi *
                        std::abs(std::pow(radius(to), 2) - std::pow(radius(i), 2));
                i = to;
            };
            if (i == 0) move(1);
            while (grows(i + 1, D)) move(i + 1);
            while (i > 0 && !grows(i, D)) move(i - 1);
            if (i == 0) return;
            if (k % 50 == 0) pull_off = std::min(pull_off, force(i, D));
        }
    }
};

// The last level of the loop of a wavy sphere, whose edge jumps inwards and outwards, in 5 levels
// while pressed and `back` while pulled off.
Level loop(const WavySphere& truth, const Jkr& smooth, double depth, int n, int back) {
    HeightMap map = sphere(smooth, n);
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) {
            double& z = map.row(j)[i];
            z -= truth.A * (1 - std::cos(2 * pi * std::sqrt(-2 * z) / truth.lambda));
        }
    const auto contact = make_element_contact(map, flat_over(map), sharp(smooth.w));
    Level level;
    for (int k = 0; k < 5; ++k) level = contact->at_separation(-depth * 0.2 * k);
    for (int k = 0; k <= back; ++k) level = contact->at_separation(-depth * (1 - 2.5 * k / back));
    CHECK(level.contacts == 0);
    return level;
}

TEST(test_wavy_sphere) {
    const Jkr smooth{1e-4};
    const double unit = smooth.at_rest() * smooth.at_rest(), depth = 0.28 * unit;
    WavySphere truth{smooth.w, 0.0562 * unit, 0.53 * smooth.at_rest(), 2 * smooth.at_rest()};
    truth.go(depth);
    const Level level = loop(truth, smooth, depth, 128, 25);
    // First order in the pixel, of which 32 fit into the radius at zero force.
    CHECK_RELATIVE(level.energy_lost, truth.lost, 1.0 / 32);
    CHECK_RELATIVE(level.least_force, truth.pull_off, 0.6 / 32);
    // In few levels, too: the smallest force, shortly before a jump between two of them, to the 1 %
    // for which the way is divided and what small jumps add; the loss to the error of its
    // quadrature.
    const Level many = loop(truth, smooth, depth, 64, 200);
    for (const int levels : {3, 4, 5, 7}) {
        const Level few = loop(truth, smooth, depth, 64, levels);
        CHECK_RELATIVE(few.least_force, many.least_force, 0.015);
        CHECK_RELATIVE(few.energy_lost, many.energy_lost, 0.03);
    }
}

// A sphere that just jumps into contact pulls with 8/9 of its pull-off force, F, and raises points
// at the distance r by F/(pi E* r): a summit there touches, too, if it lies less deep.
TEST(test_raised_summit) {
    const Jkr truth{1e-4};
    constexpr int n = 64, column = 58, row = 32;
    const double r = (column - 0.5 * (n - 1) + 0.1) * 4 * truth.at_rest() / n,
                 raised = 8.0 / 9 * truth.pull_off() / (pi * r);
    for (const double depth : {0.5, 1.5}) {
        HeightMap map = sphere(truth, n);
        map.row(row)[column] = -depth * raised;
        const auto contact = make_element_contact(map, flat_over(map), sharp(truth.w));
        const Level level = contact->at_separation(-0.1 * raised);
        CHECK(level.converged && level.force < 0);
        const auto touches = std::ranges::count(level.pixels.index, row * n + column);
        CHECK(touches == (depth < 1 ? 1 : 0));
    }
}

TEST(test_error_of_the_smallest_force) {
    // That of N there, unless contacts outside the range of validity come apart later: on a finer
    // grid they may hold longer and pull harder.
    std::vector<LevelValues> levels(3);
    for (LevelValues& level : levels) level.contacts = 1;
    levels[1].force = -2;
    levels[1].force_error_expected = 0.02;
    CHECK(error_of_least_force(levels) == 0.02);
    levels[0].status = LevelStatus::out_of_validity;
    CHECK(error_of_least_force(levels) == 0.02);
    levels[2].status = LevelStatus::out_of_validity;
    CHECK(std::isnan(error_of_least_force(levels)));
    levels[2].contacts = 0;
    CHECK(error_of_least_force(levels) == 0.02);
}

// Pull-off and energy lost do not depend on the number of levels, but for the last force before
// contact is lost.
TEST(test_number_of_levels) {
    const Loop few = loop(64, 6), many = loop(64, 24);
    CHECK_CLOSE(few.lost, many.lost, 0.01);
    CHECK_CLOSE(few.pull_off, many.pull_off, 0.02);
}

// Under a force: each that JKR's sphere can bear has a state, wherever its tip lies between the
// points. The pull-off force is held, and no smaller one is.
TEST(test_force) {
    const Jkr truth{1e-4};
    constexpr int n = 24;
    for (const int place : indices(6)) {
        const HeightMap map = sphere(truth, n, 0.1 + 0.05 * place, 0.07 * place);
        const auto contact = make_element_contact(map, flat_over(map), sharp(truth.w));
        for (const double N : {0.5, 0.1, 0.0, -0.1, -0.5, -0.9}) {
            const Level level = contact->at_force(N * truth.pull_off());
            CHECK(level.converged);
            CHECK_CLOSE(level.force, N * truth.pull_off(), 1e-4 * truth.pull_off());
        }
        const Level held = contact->at_force(-2 * truth.pull_off());
        CHECK(!held.converged && held.fallback == Fallback::held);
        CHECK_RELATIVE(held.force, -truth.pull_off(), 0.6 * 4 / n);
    }
}

// A layer that is thin beside the contact on a rigid body: springs, whose pull-off force is
// 2 pi w R instead of JKR's. With the contact eight times as wide as the layer is thick, the
// force is 1 % from this limit, and the pixel adds 1 %.
TEST(test_thin_layer) {
    constexpr double E = 1, nu = 0.3, thickness = 0.01, a = 8 * thickness, depth = a * a / 2,
                     springs = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / thickness,
                     w = springs * depth * depth / 2;
    constexpr double h = thickness / 2.5;
    const HeightMap map = height_map(72, 72, h, h, [](int i, int j) {
        return -0.5 * h * h * (std::pow(i - 35.4, 2) + std::pow(j - 35.57, 2));
    });
    Indenter tip = flat_over(map);
    tip.E_star = E / (1 - nu * nu);
    tip.layers = {1, {{thickness, E, nu}}, kInfinity, nu};
    const auto contact = make_element_contact(map, tip, sharp(w));
    Level level;
    for (double d = 0.1; d > -1.2; d -= d > -0.7 ? 0.2 : 0.1)
        level = contact->at_separation(-d * depth);
    CHECK(level.contacts == 0);
    CHECK_RELATIVE(level.least_force, -2 * pi * w, 0.02);
    tip.layers.layer[0].thickness = 1.9 * h;
    CHECK_THROWS((void)make_element_contact(map, tip, sharp(w)), Error);
}

// One wave between flats (Johnson, Int. J. Solids Structures 32, 1995): with 2a of every wavelength
// in contact, phi = pi a/lambda, the mean pressure is pi E* D/lambda sin^2 phi - sqrt(2 E* w
// tan(phi)/lambda).
TEST(test_wave) {
    constexpr int rows = 4;
    constexpr double height = 0.1, alpha = 0.3, full = pi * height,
                     w = alpha * alpha * full * full / 2;
    const auto pressure = [=](double phi) {
        return full * (std::pow(std::sin(phi), 2) - alpha * std::sqrt(std::tan(phi)));
    };
    double truth = 0;
    for (double phi = 1e-3; phi < 1; phi += 1e-4) truth = std::min(truth, pressure(phi));
    for (const int n : {64, 128, 256}) {
        const double h = 1.0 / n;
        const HeightMap map = height_map(
            n, rows, h, h, [=](int i, int) { return height * std::cos(2 * pi * (i + 0.5) * h); });
        const auto contact =
            make_element_contact(map, {1.0, kInfinity, 0, 0, {1, rows * h}}, sharp(w));
        Level level = contact->at_separation(0.09);
        for (double Z = 0.08; level.force != 0; Z += 1e-3) {
            level = contact->at_separation(Z);
            CHECK(level.converged);
            if (!(level.contacts > 0)) break;
            CHECK_CLOSE(level.pressure, pressure(0.5 * pi * level.area_pixels / (rows * h)),
                        4 * h * full);
        }
        CHECK_CLOSE(level.least_force / (rows * h), truth, 2 * h * full);
    }
}

// The energy of a few pixels by the shares f of their area that touch, which deform as springs of
// the compliance S (1/f - 1) on the pixels: elastic energy minus w f. Its minimum is found by small
// steps downhill from the last one.
class Minimiser {
public:
    Minimiser(const HeightMap& map, double w) : map_(map), w_(w), f_(map.points(), 0.0) {
        S_ = AdhesiveEdges::kRow * map.dx;
    }
    double force(double Z) {
        for (int step = 0; step < 4000; ++step) {
            solve(Z);
            double most = 0;
            for (const auto i : indices(f_)) {
                const double t = f_[i] > 0 ? -p_[i] / f_[i] : gap(i, Z) / S_,
                             release = std::copysign(t * t * S_ / (2 * w_), t);
                if (f_[i] == 0 && !beside(i)) continue;
                const double now = std::clamp(f_[i] + 0.1 * (1 - release), 0.0, 1.0);
                most = std::max(most, std::abs(now - f_[i]));
                f_[i] = now < 1e-9 ? 0 : now;
            }
            if (most < 1e-9) break;
        }
        solve(Z);
        return map_.dx * map_.dx * std::accumulate(p_.begin(), p_.end(), 0.0);
    }
    void touch(std::size_t i) { f_[i] = 1; }
    double energy(double Z) {
        solve(Z);
        double sum = 0;
        for (const auto i : indices(f_)) sum += 0.5 * p_[i] * (clearance(i) - Z) - w_ * f_[i];
        return map_.dx * map_.dx * sum;
    }
    // The least energy after a change of the share of one pixel at an edge.
    double beside_it(double Z) {
        const std::vector<double> f = f_, p = p_;
        double least = kInfinity;
        for (const auto i : indices(f))
            for (const double by : {-0.02, 0.02}) {
                f_ = f;
                const bool pressed = f[i] == 1 && p[i] > 0;
                f_[i] = std::clamp(f[i] + by, 0.0, 1.0);
                if (f_[i] != f[i] && !pressed && (f[i] > 0 || beside(i)))
                    least = std::min(least, energy(Z));
            }
        f_ = f;
        p_ = p;
        return least;
    }

private:
    double clearance(std::size_t i) const { return map_(int(i) % map_.nx, int(i) / map_.nx); }
    double K(std::size_t i, std::size_t j) const {
        const int nx = map_.nx, di = int(i) % nx - int(j) % nx, dj = int(i) / nx - int(j) / nx;
        return body_.under_pixel(di * map_.dx, dj * map_.dy, map_.dx, map_.dy);
    }
    double gap(std::size_t i, double Z) const {
        double u = Z - clearance(i);
        for (const auto j : indices(p_)) u += K(i, j) * p_[j];
        return u;
    }
    bool beside(std::size_t i) const {
        const int nx = map_.nx;
        for (const auto j : indices(f_))
            if (f_[j] > 0 && std::abs(int(i) % nx - int(j) % nx) < 2 &&
                std::abs(int(i) / nx - int(j) / nx) < 2)
                return true;
        return false;
    }
    void solve(double Z) {
        std::vector<std::size_t> in;
        for (const auto i : indices(f_))
            if (f_[i] > 0) in.push_back(i);
        const std::size_t n = in.size();
        std::vector<double> m(n * n), rest(n);
        for (const auto a : indices(in)) {
            rest[a] = clearance(in[a]) - Z;
            for (const auto b : indices(in)) m[a * n + b] = K(in[a], in[b]);
            m[a * n + a] += S_ * (1 / f_[in[a]] - 1);
        }
        p_.assign(f_.size(), 0.0);
        const std::vector<double> p = solved(m, rest);
        for (const auto a : indices(in)) p_[in[a]] = p[a];
    }

    const HeightMap& map_;
    Substrate body_{1.0};
    double w_, S_;
    std::vector<double> f_, p_;
};

TEST(test_minimiser) {
    for (unsigned seed = 0; seed < 12; ++seed) {
        std::mt19937 generator(seed);
        std::uniform_real_distribution<double> uniform(-1, 1);
        std::array<double, 6> c;
        for (double& value : c) value = uniform(generator);
        const int n = 9;
        const HeightMap map = height_map(n, n, 0.1, 0.1, [&](int i, int j) {
            const double x = 0.1 * (i - 4), y = 0.1 * (j - 4);
            return -0.5 * (x * x + y * y) + 0.01 * c[0] * std::sin(9 * x + 6 * c[1]) +
                   0.01 * c[2] * std::sin(9 * y + 6 * c[3]) +
                   0.01 * c[4] * std::sin(8 * x + 7 * y + 6 * c[5]);
        });
        const double w = 2e-4;
        const auto contact = make_element_contact(map, flat_over(map), sharp(w));
        Minimiser slow(map, w);
        const double top = contact->first_touch();
        std::size_t highest = 0;
        for (std::size_t i = 0; i < map.points(); ++i)
            if (map(int(i) % n, int(i) / n) == top) highest = i;
        slow.touch(highest);
        double largest = 0;
        for (const double depth : {0.002, 0.008, 0.014, 0.02, 0.012, 0.004, -0.004, -0.008}) {
            const Level level = contact->at_separation(top - depth);
            const double force = slow.force(top - depth);
            largest = std::max(largest, std::abs(force));
            CHECK_CLOSE(level.force, force, 2e-3 * largest);
            const double energy = slow.energy(top - depth), one = w * map.dx * map.dx;
            CHECK_CLOSE(contact->energy(), energy, 1e-3 * one);
            CHECK(seed > 1 || energy < slow.beside_it(top - depth));
        }
    }
}

}  // namespace test_without_range
