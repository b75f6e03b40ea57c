// Elements between two flats that repeat: against an independent solver, closed forms, conservation, and themselves by another way.
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "check.hpp"
#include "contact/element_contact.hpp"
#include "contact/lateral.hpp"
#include "error.hpp"
#include "periodic_elements.hpp"
#include "rough/synthesis.hpp"

using namespace rsc;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kE = 2.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

SolverOptions options(double tolerance) {
    SolverOptions o;
    o.tolerance = tolerance;
    o.max_iterations = 200;
    return o;
}

HeightMap empty(int nx, int ny, double dx, double dy) {
    HeightMap map;
    map.allocate(nx, ny, nx);
    map.dx = dx, map.dy = dy;
    map.periodic = true;
    return map;
}

Indenter flat(const HeightMap& map) { return {kE, kInfinity, 0, 0, {map.Lx(), map.Ly()}}; }

constexpr double kSigma = 0.01;
HeightMap rough(int n, double L_lambda_s, double* slope = nullptr) {
    const Spectrum spectrum{1, 0.8, 4, L_lambda_s, false, kSigma};
    if (slope) *slope = std::sqrt(2 * theoretical_moments(spectrum).m2);
    return synthesize(spectrum, n, Normalise::sample, 1, 1, nullptr, 1);
}

std::vector<double> values(const HeightMap& map) {
    std::vector<double> z;
    for (int j = 0; j < map.ny; ++j) z.insert(z.end(), map.row(j), map.row(j) + map.nx);
    return z;
}

// Conjugate gradients in double on the whole grid: the same pixels to a few that carry next to nothing, the same separation. By force and
// at the separation found.
void independent(int n, double L_lambda_s) {
    constexpr double kArea = 1e-4, kSeparation = 1e-6, kForce = 1e-5;
    double slope;
    const HeightMap map = rough(n, L_lambda_s, &slope);
    const auto contact = make_element_contact(map, flat(map), options(1e-8));
    PeriodicElementSolver other(n, 1, values(map), kE);
    for (const double p : {0.1, 0.05, 0.02, 0.005}) {
        const double N = p * kE * slope;
        const PeriodicElements truth = other.press(N, 1e-8, 20000);
        const Level level = contact->at_force(N);
        CHECK(level.status == LevelStatus::converged);
        std::printf(
            "%d^2, p/(E* h') = %.3f: A %.6f, %.1e from the independent one; separation %.1e sigma; %d rounds, %ld products (its: %d)\n", n,
            p, level.area, level.area / truth.border - 1, (level.separation - truth.separation) / kSigma, level.iterations,
            static_cast<long>(level.products), 2 * truth.iterations);
        CHECK(truth.gap < 1e-8);
        CHECK_RELATIVE(level.force, N, 1e-12);
        CHECK_RELATIVE(level.area, truth.border, kArea);
        CHECK_RELATIVE(level.area_pixels, truth.area_fraction, kArea);
        CHECK_CLOSE(level.separation / kSigma, truth.separation / kSigma, kSeparation);
        const Level again = contact->at_separation(level.separation);
        CHECK(again.status == LevelStatus::converged);
        CHECK_RELATIVE(again.force, N, kForce);
        CHECK_RELATIVE(again.area, level.area, kArea);
    }
}

// A wave of one direction: Westergaard (Johnson 1985, section 13.2): p/p* = sin^2(pi A/(2 A0)), p* = E* k Delta/2.
void westergaard() {
    constexpr double Delta = 0.01;
    const double k = 2 * kPi, closed = kE * k * Delta / 2;
    // Widths are known to a pixel and its neighbour, separations converge with the square of the pixel.
    double before = 0;
    for (const int n : {32, 64, 128, 256}) {
        HeightMap map = empty(n, 4, 1.0 / n, 8.0 / n);
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < n; ++i) map.row(j)[i] = Delta * std::cos(k * i / n);
        const auto contact = make_element_contact(map, flat(map), options(1e-10));
        for (const double share : {0.1, 0.5, 0.9}) {
            const Level level = contact->at_force(share * closed * map.Ly());
            const double width = 2 / kPi * std::asin(std::sqrt(share));
            CHECK(level.status == LevelStatus::converged);
            CHECK_CLOSE(level.area_pixels / map.Ly(), width, 1.5 / n);
            if (share != 0.5) continue;
            // With s = p/p* the stiffness is p*/(Delta ln(1/s)): Z0 = Delta (1 - s + s ln s).
            const double Z0 = Delta * (1 - share + share * std::log(share)), error = level.separation / Z0 - 1;
            const double stiffness = closed * map.Ly() / (Delta * std::log(1 / share));
            std::printf("Westergaard, %3d points a wave: A %.4f (%.4f), Z0 %.2e, stiffness %.2e\n", n, level.area_pixels / map.Ly(), width,
                        error, -contact->stiffness() / stiffness - 1);
            CHECK(std::abs(error) < 2 / static_cast<double>(n * n));
            if (before != 0) CHECK_CLOSE(std::log2(before / error), 2.0, 0.25);
            CHECK_RELATIVE(contact->stiffness(), -stiffness, 3.5 / n);
            // What the pressure did: the integral of p dZ0.
            const double s = share, work = closed * Delta * map.Ly() * (s * s / 4 - s * s / 2 * std::log(s));
            CHECK_RELATIVE(contact->energy(), work, 20.0 / (n * n));
            before = error;
        }
        // Closed altogether it is told, with the pressure that does it, to rounding here.
        try {
            contact->at_force(1.001 * closed * map.Ly());
            CHECK(!"a closed gap is told");
        } catch (const Error& e) {
            const std::string said = e.what();
            CHECK(e.kind() == Failure::bad_input && said.find("closes the gap altogether") != std::string::npos);
            const std::size_t from = said.find(" from ");
            CHECK_RELATIVE(std::strtod(said.c_str() + from + 6, nullptr), closed, 1e-8);
        }
        CHECK(contact->at_force(0.9999 * closed * map.Ly()).area_pixels < map.Ly());
        CHECK_THROWS(contact->at_separation(0), Error);
        CHECK_THROWS(contact->at_separation(-1), Error);
    }
}

// The surface moved by any number of pixels, or turned over its diagonal: nothing changes, contacts move with it.
void moved_and_turned() {
    constexpr double kSame = 1e-9;
    double slope;
    const HeightMap map = rough(128, 16, &slope);
    const int n = map.nx;
    const Level level = make_element_contact(map, flat(map), options(1e-11))->at_force(0.03 * kE * slope);
    CHECK(level.contacts > 5);
    const auto same = [&](const Level& other) {
        CHECK(other.status == LevelStatus::converged);
        CHECK(other.contacts == level.contacts);
        CHECK_CLOSE(other.separation / kSigma, level.separation / kSigma, kSame);
        CHECK_RELATIVE(other.area, level.area, kSame);
        CHECK(other.area_pixels == level.area_pixels);
    };
    for (const auto& [right, up] : {std::pair{37, 101}, {1, 0}, {64, 127}}) {
        HeightMap moved = empty(n, n, map.dx, map.dy);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) moved.row((j + up) % n)[(i + right) % n] = map(i, j);
        const Level other = make_element_contact(moved, flat(moved), options(1e-11))->at_force(level.force);
        same(other);
        double worst = 0;
        for (std::size_t k = 0; k < level.f.size(); ++k) {
            double nearest = kInfinity;
            for (std::size_t l = 0; l < other.f.size(); ++l) {
                const double dx = std::remainder(other.x[l] - level.x[k] - right * map.dx, 1.0),
                             dy = std::remainder(other.y[l] - level.y[k] - up * map.dy, 1.0);
                nearest = std::min(nearest, std::hypot(dx, dy) + std::abs(other.f[l] / level.f[k] - 1) +
                                                std::abs(other.a[l] / level.a[k] - 1) + std::abs(other.u[l] / level.u[k] - 1));
                CHECK(other.x[l] >= 0 && other.x[l] < 1 && other.y[l] >= 0 && other.y[l] < 1);
            }
            worst = check::worse(worst, nearest);
        }
        CHECK(worst < 1e-6);  // of the smallest contacts' forces
    }
    // Every second column left out: pixels of 2 dx by dy, and the same turned over.
    HeightMap longer = empty(n / 2, n, 2 * map.dx, map.dy), turned = empty(n, n / 2, map.dx, 2 * map.dx);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n / 2; ++i) longer.row(j)[i] = turned.row(i)[j] = map(2 * i, j);
    const auto one = make_element_contact(longer, flat(longer), options(1e-11)),
               two = make_element_contact(turned, flat(turned), options(1e-11));
    const Level a = one->at_force(level.force), b = two->at_force(level.force);
    CHECK(a.contacts == b.contacts && a.area_pixels == b.area_pixels);
    CHECK_CLOSE(a.separation / kSigma, b.separation / kSigma, kSame);
    CHECK_RELATIVE(two->stiffness(), one->stiffness(), 1e-7);
    CHECK_CLOSE(a.separation / kSigma, level.separation / kSigma, 0.05);  // half as many points see about the same
    // Two periods are one, taken twice.
    HeightMap tiled = empty(n, 2 * n, map.dx, map.dy);
    for (int j = 0; j < 2 * n; ++j) std::copy_n(map.row(j % n), n, tiled.row(j));
    const Level twice = make_element_contact(tiled, flat(tiled), options(1e-11))->at_force(2 * level.force);
    CHECK_CLOSE(twice.separation / kSigma, level.separation / kSigma, kSame);
    CHECK_RELATIVE(twice.area_fraction, level.area_fraction, kSame);
    CHECK(twice.contacts == 2 * level.contacts);
}

// N = -dW/dZ0, S = -dN/dZ0; sums; nothing pushes sideways; out of reach nothing touches.
void conservation() {
    double slope;
    const HeightMap map = rough(128, 16, &slope);
    const auto contact = make_element_contact(map, flat(map), options(1e-10));
    const Level level = contact->at_force(0.05 * kE * slope);
    const double S = contact->stiffness(), W = contact->energy(), step = 1e-4 * kSigma;
    const auto at = [&](double dz) {
        const Level other = contact->at_separation(level.separation + dz);
        CHECK(other.status == LevelStatus::converged);
        return std::pair{other.force, contact->energy()};
    };
    const auto up = at(step), down = at(-step), here = at(0);
    CHECK_RELATIVE(here.first, level.force, 1e-8);
    CHECK_RELATIVE(here.second, W, 1e-8);
    CHECK_RELATIVE((down.second - up.second) / (2 * step), level.force, 1e-6);
    CHECK_RELATIVE((up.first - down.first) / (2 * step), S, 3e-3);  // pixels come and go
    const Vec2 sideways = lateral_force(contact->indenter(), level);
    CHECK(sideways.x == 0 && sideways.y == 0);
    double f = 0, p = 0, area = 0;
    for (std::size_t k = 0; k < level.f.size(); ++k) f += level.f[k], area += kPi * level.a[k] * level.a[k];
    for (double v : level.pixels.pressure) p += v * map.dx * map.dy;
    CHECK_RELATIVE(f, level.force, 1e-12);
    CHECK_RELATIVE(p, level.force, 1e-12);
    CHECK_RELATIVE(area, level.area, 1e-12);
    CHECK_RELATIVE(level.pressure, level.force, 1e-14);
    const Level none = contact->at_separation(contact->first_touch());
    CHECK(none.contacts == 0 && none.force == 0 && none.area == 0 && none.status == LevelStatus::converged);
    CHECK(contact->stiffness() == 0 && contact->energy() == 0);
    CHECK_THROWS(make_element_contact(empty(0, 0, 1, 1), flat(map), options(1e-8)), Error);
    Indenter ball = flat(map);
    ball.R = 1;
    CHECK_THROWS(make_element_contact(map, ball, options(1e-8)), Error);
    HeightMap smooth = empty(8, 8, 1, 1);
    std::fill_n(smooth.data.get(), 64, 3.0);
    CHECK_THROWS(make_element_contact(smooth, flat(smooth), options(1e-8)), Error);
    SolverOptions few = options(1e-10);
    few.max_iterations = 1;
    CHECK(make_element_contact(map, flat(map), few)->at_force(level.force).status == LevelStatus::not_converged);
}

// Random heights on small grids of any shape, from a first touch to where hardly anything is left of the gap: under a pressure, and at
// the separation it has.
void any_grid() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const int sides[] = {2, 3, 5, 7, 16, 31, 64};
    long levels = 0, rounds = 0, most = 0;
    for (int trial = 0; trial < 15; ++trial) {
        const int nx = sides[random() % 7], ny = sides[random() % 7];
        HeightMap map = empty(nx, ny, 1, std::pow(4.0, uniform(random)));
        const bool waves = random() % 2 == 0;
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                map.row(j)[i] =
                    (waves ? 0.3 : 1.0) * uniform(random) + (waves ? std::cos(4 * kPi * i / nx) + std::cos(2 * kPi * j / ny) : 0.0);
        SolverOptions thorough = options(1e-9);
        thorough.max_iterations = 300;
        const auto contact = make_element_contact(map, flat(map), thorough);
        double closing = 0;  // as the message says it
        try {
            contact->at_force(1e3 * kE * map.Lx() * map.Ly());
        } catch (const Error& e) {
            const std::string said = e.what();
            closing = std::strtod(said.c_str() + said.find(" from ") + 6, nullptr);
        }
        CHECK(closing > 0);
        for (const double share : {1e-4, 0.03, 0.4, 0.9, 0.999}) {
            const double N = share * closing * map.Lx() * map.Ly();
            const Level level = contact->at_force(N), again = contact->at_separation(level.separation);
            CHECK(level.status == LevelStatus::converged && again.status == LevelStatus::converged);
            CHECK_RELATIVE(again.force, N, 1e-4);
            CHECK(level.area_fraction > 0 && level.pixels.index.size() < static_cast<std::size_t>(nx * ny));
            ++levels, rounds += level.iterations, most = std::max<long>(most, level.iterations);
        }
    }
    std::printf("random heights: %.1f rounds a level, %ld at most\n", static_cast<double>(rounds) / static_cast<double>(levels), most);
}

// A bump on the seam and the same in the middle: one contact, its centroid in the map.
void across_the_seam() {
    constexpr int n = 63;  // odd: transforms of any length
    const double h = 1.0 / n;
    const auto pressed = [&](double cx, double cy) {
        HeightMap map = empty(n, n, h, h);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const double dx = std::remainder(i * h - cx, 1.0), dy = std::remainder(j * h - cy, 1.0);
                map.row(j)[i] = -dx * dx - 1.3 * dy * dy;
            }
        return make_element_contact(map, flat(map), options(1e-11))->at_force(0.05);
    };
    const Level middle = pressed(31.2 * h, 31.4 * h), seam = pressed(0.2 * h, 62.4 * h);
    CHECK(middle.contacts == 1 && seam.contacts == 1);
    CHECK(middle.pixels.index.size() > 50);
    CHECK_RELATIVE(seam.a[0], middle.a[0], 1e-9);
    CHECK_RELATIVE(seam.u[0], middle.u[0], 1e-9);
    CHECK_CLOSE(seam.x[0], middle.x[0] - 31 * h, 1e-9);
    CHECK_CLOSE(seam.y[0], middle.y[0] + 31 * h, 1e-9);
    CHECK_CLOSE(middle.x[0], 31.2 * h, 0.05 * h);
}

void threads_change_no_bit() {
    const HeightMap map = rough(640, 40);
    std::vector<Level> levels;
    std::vector<double> stiffness;
    const int before = omp_get_max_threads();
    for (const int threads : {1, 3}) {
        omp_set_num_threads(threads);
        const auto contact = make_element_contact(map, flat(map), options(1e-6));
        levels.push_back(contact->at_force(2e-3));
        stiffness.push_back(contact->stiffness());
    }
    omp_set_num_threads(before);
    CHECK(levels[0].status == LevelStatus::converged);
    CHECK(levels[0].pixels.pressure == levels[1].pixels.pressure && levels[0].separation == levels[1].separation);
    CHECK(stiffness[0] == stiffness[1]);
}

// What the conditions miss at most, by a product of the test's own: |w| where 0 < p < H, -w where p = 0, w where p = H.
double conditions(const HeightMap& map, const Level& level, double H) {
    const auto n = static_cast<std::size_t>(map.nx);
    std::vector<double> p(n * n, 0.0);
    for (std::size_t k = 0; k < level.pixels.index.size(); ++k)
        p[static_cast<std::size_t>(level.pixels.index[k])] = level.pixels.pressure[k];
    PeriodicElementSolver solver(map.nx, map.Lx(), values(map), kE);
    const std::vector<double> u = solver.deflections(p);
    double worst = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        const double w = u[k] - map(static_cast<int>(k % n), static_cast<int>(k / n)) + level.separation;
        worst = check::worse(worst, p[k] >= H ? std::max(w, 0.0) : p[k] > 0 ? std::abs(w) : std::max(-w, 0.0));
    }
    return worst;
}

// A hardness: no pressure above it, the conditions of contact with it, and what was pressed out stays so.
void yielding() {
    double slope;
    const HeightMap map = rough(128, 16, &slope);
    const double N = 0.05 * kE * slope, H = 0.3 * kE * slope;
    CHECK(conditions(map, make_element_contact(map, flat(map), options(1e-10))->at_force(N), kInfinity) < 1e-9 * kSigma);
    SolverOptions hard = options(1e-10);
    hard.hardness.H0 = H;
    const auto contact = make_element_contact(map, flat(map), hard);
    const Level level = contact->at_force(N);
    CHECK(level.status == LevelStatus::converged);
    CHECK_RELATIVE(level.force, N, 1e-12);
    CHECK(*std::max_element(level.pixels.pressure.begin(), level.pixels.pressure.end()) == H);
    CHECK(conditions(map, level, H) < 1e-9 * kSigma);
    const ResidualProfile pressed = contact->residual_profile();
    double volume = 0;
    for (double depth : pressed.depth) volume += depth * map.dx * map.dy;
    CHECK(volume > 0);
    CHECK_RELATIVE(level.plastic_work, H * volume, 1e-12);
    // On the way back and down again the contact is elastic: the same answer, no more work.
    const double W = contact->energy(), S = contact->stiffness(), step = 1e-4 * kSigma;
    const Level back = contact->at_separation(level.separation + step);
    CHECK_RELATIVE((back.force - level.force) / step, S, 0.02);
    const double up = contact->energy();
    CHECK_RELATIVE((W - up) / step, 0.5 * (level.force + back.force), 1e-6);
    contact->at_force(0.3 * N);
    const Level again = contact->at_force(N);
    CHECK_CLOSE(again.separation / kSigma, level.separation / kSigma, 1e-7);
    CHECK_RELATIVE(again.area_pixels, level.area_pixels, 1e-3);
    CHECK_CLOSE(again.plastic_work, level.plastic_work, 1e-8 * level.plastic_work);
    // Nearly all of the hardness: the mean plane is passed, which elastic flats cannot.
    const Level deep = contact->at_force(0.95 * H);
    CHECK(deep.status == LevelStatus::converged && deep.separation < 0);
    CHECK(deep.area_fraction > 0.95 && conditions(map, make_element_contact(map, flat(map), hard)->at_force(0.95 * H), H) < 1e-9 * kSigma);
    // Soft: the whole load is carried by the hardness. Too soft to carry it: told.
    hard.hardness.H0 = 0.02 * H;
    CHECK_RELATIVE(make_element_contact(map, flat(map), hard)->at_force(0.1 * hard.hardness.H0).area_pixels, 0.1, 0.02);
    CHECK_THROWS(make_element_contact(map, flat(map), hard)->at_force(1.01 * hard.hardness.H0), Error);
}

}  // namespace

int main(int argc, char**) {
    if (argc > 1) {
        independent(512, 32);
        return check::summary();
    }
    independent(128, 16);
    westergaard();
    moved_and_turned();
    conservation();
    any_grid();
    across_the_seam();
    threads_change_no_bit();
    yielding();
    return check::summary();
}
