// Elements between two flats that repeat: against closed forms, conservation, and on grids of any
// shape.
#include "base/error.hpp"
#include "check.hpp"
#include "contact/make.hpp"
#include "support/height_maps.hpp"
#include "surface/synthesis.hpp"

#include "base/parallel.hpp"
#include "support/refused.hpp"

namespace test_periodic_elements {

using namespace rsc;
constexpr double kE = 2.0;

SolverOptions options(double tolerance) { return {.tolerance = tolerance, .max_iterations = 200}; }

HeightMap empty(int nx, int ny, double dx, double dy) {
    HeightMap map = flat_map(nx, ny, dx, dy);
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

// The nominal pressure that just closes the gap: above it every pressure grows by the increase of
// the nominal one, so that it is less than a larger one by the least pressure.
double closing(Path& contact, double force) {
    const Level level = contact.at_force(force);
    CHECK(level.converged && level.contacts == 1);
    CHECK_RELATIVE(level.area_fraction, 1, 1e-12);
    CHECK_RELATIVE(level.force, force, 1e-9);
    CHECK(std::isnan(contact.stiffness()));  // the separation no longer depends on the force
    return level.pressure - std::ranges::min(level.pixels.pressure);
}

// A wave of one direction: Westergaard (Johnson 1985, section 13.2): p/p* = sin^2(pi A/(2 A0)), p*
// = E* k Delta/2.
TEST(westergaard) {
    constexpr double Delta = 0.01;
    const double k = 2 * pi, closed = kE * k * Delta / 2;
    // Widths are known to a pixel and its neighbour, separations converge with the square of the
    // pixel.
    double before = 0;
    for (const int n : {32, 64, 128, 256}) {
        HeightMap map = empty(n, 4, 1.0 / n, 8.0 / n);
        for (const int j : indices(4))
            for (const int i : indices(n)) map.row(j)[i] = Delta * std::cos(k * i / n);
        const auto contact = make_element_contact(map, flat(map), options(1e-10));
        for (const double share : {0.1, 0.5, 0.9}) {
            const Level level = contact->at_force(share * closed * map.Ly());
            const double width = 2 / pi * std::asin(std::sqrt(share));
            CHECK(level.converged);
            CHECK_CLOSE(level.area_pixels / map.Ly(), width, 1.5 / n);
            if (share != 0.5) continue;
            // With s = p/p* the stiffness is p*/(Delta ln(1/s)): Z0 = Delta (1 - s + s ln s).
            const double Z0 = Delta * (1 - share + share * std::log(share)),
                         error = level.separation / Z0 - 1;
            const double stiffness = closed * map.Ly() / (Delta * std::log(1 / share));
            CHECK(std::abs(error) < 2.0 / (n * n));
            if (before != 0) CHECK_CLOSE(std::log2(before / error), 2.0, 0.25);
            CHECK_RELATIVE(contact->stiffness(), -stiffness, 3.5 / n);
            // What the pressure did: the integral of p dZ0.
            const double s = share,
                         work = closed * Delta * map.Ly() * (s * s / 4 - s * s / 2 * std::log(s));
            CHECK_RELATIVE(contact->energy(), work, 20.0 / (n * n));
            before = error;
        }
        // In full contact the flat is at the mean plane, and the wave's energy is the elastic one
        // of flattening it, E* k Delta^2/8 for each unit of area.
        for (const double share : {1.001, 7.0}) {
            CHECK_RELATIVE(closing(*contact, share * closed * map.Ly()), closed, 1e-8);
            CHECK_CLOSE(contact->level()->separation, 0, 1e-8 * Delta);
            CHECK_RELATIVE(contact->energy(), kE * k * Delta * Delta / 8 * map.Ly(), 1e-8);
        }
        CHECK(contact->at_force(0.9999 * closed * map.Ly()).area_pixels < map.Ly());
        CHECK_THROWS(contact->at_separation(0), Error);
        CHECK_THROWS(contact->at_separation(-1), Error);
    }
}

// The products do not grow with the range of waves, which the elements always resolve alike.
TEST(products_of_many_waves) {
    for (const double pressure : {0.1, 0.6}) {
        std::vector<std::int64_t> products;
        for (const int n : {512, 1024}) {
            double slope = 0;
            const HeightMap map = rough(n, n / 8, &slope);
            const auto contact = make_element_contact(map, flat(map), options(1e-6));
            products.push_back(contact->at_force(pressure * kE * slope).products);
        }
        // A round of the iteration takes three or four products.
        CHECK(products[1] < products[0] + 4);
        CHECK(products[1] <= 25);
    }
}

// Random heights on small grids of any shape, from a first touch to where hardly anything is left
// of the gap: under a pressure, and at the separation it has.
TEST(any_grid) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const int sides[] = {2, 3, 5, 7, 16, 31, 64};
    for (int trial = 0; trial < 15; ++trial) {
        const int nx = sides[random() % 7], ny = sides[random() % 7];
        HeightMap map = empty(nx, ny, 1, std::pow(4.0, uniform(random)));
        const bool waves = random() % 2 == 0;
        for (const int j : indices(ny))
            for (const int i : indices(nx))
                map.row(j)[i] =
                    (waves ? 0.3 : 1.0) * uniform(random) +
                    (waves ? std::cos(4 * pi * i / nx) + std::cos(2 * pi * j / ny) : 0.0);
        SolverOptions thorough = options(1e-9);
        thorough.max_iterations = 300;
        const auto contact = make_element_contact(map, flat(map), thorough);
        const double closed = closing(*contact, 1e3 * kE * map.Lx() * map.Ly());
        CHECK(closed > 0);
        for (const double share : {1e-4, 0.03, 0.4, 0.9, 0.999}) {
            const double N = share * closed * map.Lx() * map.Ly();
            const Level level = contact->at_force(N),
                        again = contact->at_separation(level.separation);
            CHECK(level.converged && again.converged);
            CHECK_RELATIVE(again.force, N, 1e-4);
            CHECK(level.area_fraction > 0 && std::ssize(level.pixels.index) < nx * ny);
        }
    }
}

// On surfaces with the same points in their shortest waves the number of products does not grow
// with the number of points, also near full contact: the preconditioner knows long waves.
TEST(products_do_not_grow) {
    const auto products = [](int n) {
        double slope = 0;
        const HeightMap map = rough(n, n / 8.0, &slope);
        const auto contact = make_element_contact(map, flat(map), options(1e-6));
        return contact->at_force(0.2 * kE * slope * map.Lx() * map.Ly()).products;
    };
    CHECK(products(512) <= products(128));
}

TEST(threads_change_no_bit) {
    const HeightMap map = rough(640, 40);
    std::vector<Level> levels;
    std::vector<double> stiffness;
    for (const int threads : {1, 3}) {
        const rsc::LoopThreads loops(threads);
        const auto contact = make_element_contact(map, flat(map), options(1e-6));
        levels.push_back(contact->at_force(2e-3));
        stiffness.push_back(contact->stiffness());
    }
    CHECK(levels[0].converged);
    CHECK(levels[0].pixels.pressure == levels[1].pixels.pressure &&
          levels[0].separation == levels[1].separation);
    CHECK(stiffness[0] == stiffness[1]);
}

}  // namespace test_periodic_elements
