// The pixels of a level of elements, and what the contact answers beside it, against the full
// matrix of a small map: pressures by an active set of its own with Gaussian elimination, the rest
// from these pressures. Maps of oblong pixels that begin somewhere, more columns than rows; a
// sphere beside the middle, a flat, a flat that repeats; elastic and yielding, along a path down,
// up, down and aside.
#include "check.hpp"
#include "contact/answers.hpp"
#include "contact/deflection.hpp"
#include "contact/make.hpp"
#include "interaction/lattice.hpp"
#include "interaction/pixel_kernels.hpp"
#include "physics/hardness/hardness.hpp"
#include "support/bodies.hpp"
#include "support/height_maps.hpp"
#include "truth/elimination.hpp"

namespace test_element_levels {

using namespace rsc;

using Vector = std::vector<double>;
constexpr double kE = 3.0;
// Levels are asked for a residual of 1e-11; the matrices' condition is some hundreds. Sums over
// pixels that touch come down to rounding.
constexpr double kSame = 1e-8, kTolerance = 1e-11;
constexpr std::array<double, 2> kResistivity = {2, 3};

void complete(Path& contact, Level& level) {
    LevelSource source{contact, level, kResistivity};
    compute_quantities(source);
}

struct Truth {
    const HeightMap& map;
    Indenter tip;
    SolverOptions options;
    Vector z, pressed;      // heights as they are, and by how much they were lowered
    std::vector<Vector> K;  // deflection of a pixel under unit pressure on another
    Vector p, w;
    std::optional<Lattice> lattice;

    int nx() const { return map.nx; }
    int ny() const { return map.ny; }
    std::size_t n() const { return z.size(); }
    double x(std::size_t k) const { return map.x0 + map.dx * (int(k) % nx()); }
    double y(std::size_t k) const { return map.y0 + map.dy * (int(k) / nx()); }
    double pixel() const { return map.dx * map.dy; }
    bool repeats() const { return tip.period.finite(); }

    Truth(const HeightMap& map_, const Indenter& tip_, const SolverOptions& options_)
        : map(map_), tip(tip_), options(options_) {
        for (const int j : indices(ny()))
            for (const int i : indices(nx())) z.push_back(map(i, j));
        if (repeats()) lattice.emplace(tip.period);
        pressed.assign(n(), 0.0);
        K.assign(n(), Vector(n()));
        for (const std::size_t k : indices(n()))
            for (const std::size_t l : indices(n()))
                K[k][l] = !repeats()
                              ? love(x(k) - x(l), y(k) - y(l), map.dx / 2, map.dy / 2) / (pi * kE)
                          : k > 0 ? K[0][shifted(l, k)]
                                  : answer(int(l) % nx(), int(l) / nx());
    }
    // Where pixel l lies seen from k.
    std::size_t shifted(std::size_t l, std::size_t k) const {
        const int i = int(l) % nx() - int(k) % nx(), j = int(l) / nx() - int(k) / nx();
        return (j + ny()) % ny() * nx() + (i + nx()) % nx();
    }
    // The modes that the pixels carry, each with 2/(E* |k|).
    double answer(int i, int j) const {
        double sum = 0;
        for (const int b : indices(ny()))
            for (const int a : indices(nx())) {
                if (a == 0 && b == 0) continue;
                const double kx = 2 * pi * (2 * a <= nx() ? a : a - nx()) / (nx() * map.dx),
                             ky = 2 * pi * (2 * b <= ny() ? b : b - ny()) / (ny() * map.dy);
                sum += 2 / (kE * std::hypot(kx, ky)) *
                       std::cos(2 * pi * (double(a * i) / nx() + double(b * j) / ny()));
            }
        return sum / double(n());
    }

    double height(std::size_t k) const {
        if (std::isinf(tip.shape->hertz_radius())) return z[k];
        const double rho2 = std::pow(x(k) - tip.x0, 2) + std::pow(y(k) - tip.y0, 2);
        return rho2 <= tip.shape->hertz_radius() * tip.shape->hertz_radius()
                   ? z[k] +
                         std::sqrt(tip.shape->hertz_radius() * tip.shape->hertz_radius() - rho2) -
                         tip.shape->hertz_radius()
                   : -kInfinity;
    }

    // p and w at a separation; false: the conditions of contact were not met.
    bool press(double Z0) {
        const double H = options.physics.of<Hardness>().H0;
        std::vector<int> state(n());  // 0 without pressure, 1 free, 2 at the hardness
        for (const std::size_t k : indices(n())) state[k] = height(k) > Z0;
        for (int round = 0; round < 200; ++round) {
            std::vector<std::size_t> free;
            for (const std::size_t k : indices(n()))
                if (state[k] == 1) free.push_back(k);
            std::vector<Vector> A(free.size(), Vector(free.size()));
            Vector b(free.size());
            for (const auto i : indices(free)) {
                b[i] = height(free[i]) - Z0;
                for (const std::size_t l : indices(n()))
                    if (state[l] == 2) b[i] -= K[free[i]][l] * H;
                for (const auto j : indices(free)) A[i][j] = K[free[i]][free[j]];
            }
            const Vector q = solved(A, b);
            p.assign(n(), 0.0);
            w.assign(n(), 0.0);
            for (const auto i : indices(free)) p[free[i]] = q[i];
            for (const std::size_t k : indices(n()))
                if (state[k] == 2) p[k] = H;
            bool settled = true;
            for (const std::size_t k : indices(n())) {
                for (const std::size_t l : indices(n())) w[k] += K[k][l] * p[l];
                w[k] -= height(k) - Z0;
                if (state[k] == 1) w[k] = 0;
                const int next = state[k] == 1   ? (p[k] <= 0   ? 0
                                                    : p[k] >= H ? 2
                                                                : 1)
                                 : state[k] == 0 ? (w[k] < 0)
                                 : w[k] > 0      ? 1
                                                 : 2;
                settled = settled && next == state[k];
                state[k] = next;
            }
            if (settled) return true;
        }
        return false;
    }

    // The level stays: what penetrates at the hardness is gone.
    void accept() {
        for (const std::size_t k : indices(n()))
            if (p[k] >= options.physics.of<Hardness>().H0 && w[k] < 0) {
                pressed[k] -= w[k];
                z[k] += w[k];
                w[k] = 0;
            }
    }

    double energy() const {
        double sum = 0;
        for (const std::size_t k : indices(n()))
            for (const std::size_t l : indices(n())) sum += 0.5 * p[k] * K[k][l] * p[l];
        return sum * pixel();
    }
    double stiffness() const {  // on the way back all pixels are elastic
        std::vector<std::size_t> touching;
        for (const std::size_t k : indices(n()))
            if (p[k] > 0) touching.push_back(k);
        std::vector<Vector> A(touching.size(), Vector(touching.size()));
        for (const auto i : indices(touching))
            for (const auto j : indices(touching)) A[i][j] = K[touching[i]][touching[j]];
        double sum = 0;
        for (double q : solved(A, Vector(touching.size(), 1.0))) sum += q;
        return -sum * pixel();
    }
    double down(double px, double py) const {
        double sum = 0;
        for (const std::size_t k : indices(n())) {
            double dx = px - x(k), dy = py - y(k);
            if (repeats()) {
                dx = std::remainder(dx, tip.period.x);
                dy = std::remainder(dy, tip.period.y);
            }
            sum += p[k] * love(dx, dy, map.dx / 2, map.dy / 2);
            if (repeats()) sum += p[k] * pixel() * (lattice->at(dx, dy) - 1 / std::hypot(dx, dy));
        }
        return sum / (pi * kE);
    }
};

void same(double value, double truth, double scale, const char* what) {
    check::close(value, truth, kSame * std::abs(scale), what, __FILE__, __LINE__);
}
#define SAME(member, truth, scale) same(level.member, truth, scale, #member)

// Contacts, their areas and what follows of them are computed once more from the pixels in
// test_every_value.
void whole_level(const Level& level, const Truth& t, double Z0) {
    const double H = t.options.physics.of<Hardness>().H0, pixel = t.pixel(), sigma = 0.01;
    std::vector<std::size_t> touching;
    double force = 0, pressed = 0, most = 0;
    long candidates = 0;
    for (const std::size_t k : indices(t.n())) {
        candidates += t.repeats() || t.height(k) + t.pressed[k] > Z0;
        pressed += t.pressed[k];
        if (!(t.p[k] > 0)) continue;
        touching.push_back(k);
        force += t.p[k] * pixel;
        most = std::max(most, t.p[k]);
    }
    CHECK(touching.size() > 10);
    CHECK(level.pixels.columns == t.nx() && level.pixels.dx == t.map.dx &&
          level.pixels.dy == t.map.dy);
    CHECK(level.pixels.x0 == t.map.x0 && level.pixels.y0 == t.map.y0);
    CHECK(level.pixels.index == std::vector<std::int32_t>(touching.begin(), touching.end()));
    if (level.pixels.index.size() != touching.size()) return;
    // The highest pressure of each contact, and the penetration that its pressures need where this
    // is.
    std::vector<std::size_t> peak(level.contacts, t.n());
    for (const auto k : indices(touching)) {
        same(level.pixels.pressure[k], t.p[touching[k]], most, "pressure of a pixel");
        same(level.pixels.x(k), t.x(touching[k]), 1, "x of a pixel");
        same(level.pixels.y(k), t.y(touching[k]), 1, "y of a pixel");
        std::size_t& top = peak[level.pixels.contact[k]];
        if (top == t.n() || t.p[touching[k]] > t.p[top]) top = touching[k];
    }
    for (const auto c : indices(peak)) {
        double alone = 0;
        for (const auto k : indices(touching)) {
            if (std::cmp_not_equal(level.pixels.contact[k], c)) continue;
            double dx = t.x(touching[k]) - t.x(peak[c]), dy = t.y(touching[k]) - t.y(peak[c]);
            if (t.repeats()) {
                dx = std::remainder(dx, t.tip.period.x);
                dy = std::remainder(dy, t.tip.period.y);
            }
            alone += t.p[touching[k]] * love(dx, dy, t.map.dx / 2, t.map.dy / 2) / (pi * kE);
        }
        CHECK(level.asperity[c] == int(peak[c]));
        SAME(u[c], alone, sigma);
    }
    SAME(separation, Z0, sigma);
    SAME(force, force, force);
    // A contact that repeats answers with its stiffness to the square of 1e-5 times the condition
    // of its matrix.
    const double S = t.stiffness(), W = t.energy(), loose = t.repeats() ? 1e-6 / kSame : 1;
    SAME(stiffness, S, loose * S);
    SAME(energy, W, W);
    CHECK(level.candidates == candidates && level.residual <= kTolerance && level.iterations > 0 &&
          level.products > 0);
    CHECK(level.method == Method::automatic && level.fallback == Fallback::none &&
          level.overlapping_pairs == 0 && level.beyond_law == 0);
    if (std::isfinite(H))
        SAME(plastic_work, H * pixel * pressed, H * pixel * sigma);
    else
        CHECK(std::isnan(level.plastic_work));
}

void along_a_path(const HeightMap& map, const Indenter& tip, double hardness, const char* name) {
    const int before = check::failures;
    SolverOptions options{
        .tolerance = kTolerance,
        .max_iterations = 500,
        .physics = bodies_with(Hardness{.H0 = hardness}),
        .surface = {.mean_spacing = 0.1, .extent = {map.x0, map.y0, map.Lx(), map.Ly()}}};
    const auto contact = make_element_contact(map, tip, options);
    Truth t(map, tip, options);
    const auto kernel = make_kernel(Interaction::point, kE, tip.period);
    int large = 0, hard = 0;
    double deepest = 0;
    for (const double Z0 : {0.012, 0.006, 0.0085, 0.004}) {
        Level level = contact->at_separation(Z0);
        complete(*contact, level);
        CHECK(t.press(Z0));
        t.accept();
        whole_level(level, t, Z0);
        for (const auto& [x, y] : {std::pair{0.41, -0.02}, {0.7, 0.11}})
            same(deflection(level, *kernel, x, y), t.down(x, y), 0.01, "deflection");
        double top = -kInfinity;
        for (const std::size_t k : indices(t.n())) top = std::max(top, t.height(k));
        same(contact->first_touch(), top, 0.01, "first touch");
        deepest = level.force;
        large = std::max(large, level.contacts);
        hard = std::max(hard, level.plastic_contacts);
    }
    CHECK(large > 1 && (hard > 0) == std::isfinite(hardness));
    const ResidualProfile profile = contact->remains(*contact->level()).residual_profile;
    CHECK(profile.x.empty() || (profile.dx == map.dx && profile.dy == map.dy));
    std::size_t next = 0;
    for (const std::size_t k : indices(t.n())) {
        if (!(t.pressed[k] > 0)) continue;
        CHECK(next < profile.depth.size());
        if (next == profile.depth.size()) break;
        same(profile.x[next], t.x(k), 1, "x of the profile");
        same(profile.y[next], t.y(k), 1, "y of the profile");
        same(profile.depth[next++], t.pressed[k], 0.01, "depth of the profile");
    }
    CHECK(next == profile.depth.size());
    // By force, and with the tip elsewhere: the surface as it is now.
    const double N = 1.3 * deepest;
    Level level = contact->at_force(N);
    complete(*contact, level);
    CHECK(t.press(level.separation));
    t.accept();
    same(level.force, N, N, "force asked for");
    whole_level(level, t, level.separation);
    contact->move_tip(0.5, 0.12);
    t.tip.x0 = 0.5;
    t.tip.y0 = 0.12;
    level = contact->at_separation(0.005);
    complete(*contact, level);
    CHECK(t.press(0.005));
    t.accept();
    whole_level(level, t, 0.005);
    CHECK(contact->indenter().x0 == 0.5 && contact->indenter().y0 == 0.12);
    if (check::failures > before) std::printf("%s: %d failures\n", name, check::failures - before);
}

HeightMap uneven() {
    HeightMap map = height_map(20, 13, 0.03, 0.042, [](int i, int j) {
        double z = 0;
        for (const auto& [a, b, phase] :
             {std::tuple{3, 1, 0.3}, {2, -2, 1.1}, {4, 2, 2.0}, {1, 3, 0.7}, {3, -3, 1.9}})
            z +=
                0.03 / (a + std::abs(b)) * std::cos(2 * pi * (a * i / 20.0 + b * j / 13.0) + phase);
        return z;
    });
    map.x0 = 0.2;
    map.y0 = -0.15;
    return map;
}

// What the certificate of a level says of its pressures, from these and the full matrix. Levels of
// a loose tolerance, whose certificate is not rounding.
TEST(certificate) {
    HeightMap map = uneven();
    for (const bool repeats : {false, true})
        for (const double hardness : {kInfinity, 0.35}) {
            map.periodic = repeats;
            Indenter tip{kE, repeats ? kInfinity : 20.0, 0.47, 0.07, {}};
            if (repeats) tip.period = {map.Lx(), map.Ly()};
            SolverOptions options{.tolerance = 3e-3,
                                  .physics = bodies_with(Hardness{.H0 = hardness})};
            const auto contact = make_element_contact(map, tip, options);
            const Level level = contact->at_separation(0.006);
            const Truth t(map, tip, options);
            Vector p(t.n());
            for (const auto k : indices(level.pixels.index))
                p[std::size_t(level.pixels.index[k])] = level.pixels.pressure[k];
            double largest = 0, sum = 0, overlap = 0, product = 0;
            for (const std::size_t k : indices(t.n())) {
                double w = 0;
                for (const std::size_t l : indices(t.n())) w += t.K[k][l] * p[l];
                w -= t.height(k) - level.separation;
                const double wrong = p[k] >= hardness ? std::max(w, 0.0)
                                     : p[k] > 0       ? std::abs(w)
                                                      : std::max(-w, 0.0);
                largest = std::max(largest, wrong);
                sum += p[k];
                overlap += p[k] * (t.height(k) - level.separation);
                product += p[k] * wrong;
            }
            const double certificate = std::max(largest * sum, product) / overlap;
            CHECK(certificate > 1e-6);
            // The products of the solver have an error of a tenth of the tolerance.
            CHECK_CLOSE(level.certificate, certificate, 0.1 * options.tolerance);
        }
}

TEST(element_levels) {
    HeightMap map = uneven();
    const Indenter sphere{kE, 20.0, 0.47, 0.07, {}}, flat{kE, kInfinity, 0.47, 0.07, {}},
        repeating{kE, kInfinity, 0.47, 0.07, {map.Lx(), map.Ly()}};
    for (const double hardness : {kInfinity, 0.35}) {
        along_a_path(map, sphere, hardness, "sphere");
        along_a_path(map, flat, hardness, "flat");
        map.periodic = true;
        along_a_path(map, repeating, hardness, "repeating");
        map.periodic = false;
    }
}

}  // namespace test_element_levels
