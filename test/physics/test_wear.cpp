// Wear by sliding: a worn ball by rings, volumes, waves in full contact, steps, states, files.
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "case/read_case.hpp"
#include "check.hpp"
#include "contact/make.hpp"
#include "height_maps.hpp"
#include "physics/indenter/shapes.hpp"
#include "result_reader.hpp"
#include "run/run.hpp"
#include "truth/wear.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;

namespace {

const double pi = std::numbers::pi;

SolverOptions wearing(double k, double tolerance = 1e-7) {
    SolverOptions options;
    options.tolerance = tolerance;
    options.wear.coefficient = k;
    return options;
}

// Waves of short and long length over a period 1, with the rms height 1.2e-3.
HeightMap waves(int n) {
    return height_map(n, n, 1.0 / n, 1.0 / n, [n](int i, int j) {
        const double x = 2 * pi * i / n, y = 2 * pi * j / n;
        return 1e-3 * (std::cos(x + 0.3) * std::cos(2 * y) + std::sin(3 * x - y) +
                       0.7 * std::cos(5 * y + 0.5) * std::sin(4 * x));
    });
}

struct Body {
    const char* name;
    HeightMap map;
    Indenter indenter;
    double force;
};

// A ball on the free surface, a roller along y, two flats.
std::vector<Body> bodies() {
    ShapeKeys roller;
    roller.radii[0] = 2;
    roller.radii[1] = kInfinity;
    std::vector<Body> all;
    all.push_back({"ball", waves(48), {1e3, 2.0, 0.5, 0.5}, 0.2});
    all.push_back({"roller",
                   waves(48),
                   {1e3, make_shape(shape_number("paraboloid"), roller), 0.5, 0.5},
                   0.5});
    all.back().indenter.period = {kInfinity, 1};
    all.push_back({"flats", waves(64), {1e3, kInfinity, 0, 0, {1, 1}}, 1});
    return all;
}

std::unique_ptr<Path> path_of(const Body& body, double k = 2e-3) {
    return make_element_contact(body.map, body.indenter, wearing(k));
}

Level slid(Path& path, double distance, double force) {
    path.set_time(distance);
    return path.at_force(force);
}

bool same(const Level& a, const Level& b) {
    return a.separation == b.separation && a.force == b.force && a.area == b.area &&
           a.worn_volume == b.worn_volume && a.wear_depth_max == b.wear_depth_max &&
           a.pixels.index == b.pixels.index && a.pixels.pressure == b.pixels.pressure;
}

}  // namespace

// The pressures of a ball spread over a contact twice as wide as Hertz's.
TEST(worn_ball) {
    const double E = 1e3, R = 1, N = 0.02, k = 1e-4;
    constexpr int n = 96;
    const double step = 0.13 / n, middle = 0.5 * (n - 1) * step;
    const HeightMap map = flat_map(n, n, step, step);
    const auto path = make_element_contact(map, {E, R, middle, middle}, wearing(k));
    (void)slid(*path, 0, N);
    constexpr double within = 0.01;
    for (const double s : {0.1, 0.5, 2.0}) {
        (void)slid(*path, 0.5 * s, N);
        const Level level = slid(*path, s, N);
        const truth::WornBall truth = truth::worn_ball(E, R, N, k, s, 0.06, 240, 200);
        CHECK_RELATIVE(truth.volume, k * N * s, 1e-10);
        CHECK_RELATIVE(level.separation, truth.separation, within);
        CHECK_RELATIVE(level.wear_depth_max, truth.depth, within);
        CHECK_RELATIVE(level.area, truth.area, within);
        CHECK_RELATIVE(*std::ranges::max_element(level.pixels.pressure), truth.largest_pressure,
                       within);
        std::printf("  Z0 %.4g depth %.4g A %.4g p %.4g\n", level.separation/truth.separation-1, level.wear_depth_max/truth.depth-1, level.area/truth.area-1,*std::ranges::max_element(level.pixels.pressure)/truth.largest_pressure-1);
    }
}

// Archard's volume k N s, whatever the steps; no wear is the elastic contact, bit for bit.
TEST(volume) {
    for (const Body& body : bodies()) {
        const double k = 2e-3;
        const auto path = path_of(body, k), elastic = path_of(body, 0);
        const Level first = slid(*path, 0, body.force);
        const Level unworn = slid(*elastic, 0, body.force);
        CHECK(first.separation == unworn.separation && first.area == unworn.area &&
              first.pixels.pressure == unworn.pixels.pressure && first.worn_volume == 0);
        CHECK(elastic->clock() == PathClock::none && std::isnan(unworn.worn_volume));
        double last = first.separation;
        for (const double s : {0.01, 0.1, 0.5}) {
            const Level level = slid(*path, s, body.force);
            CHECK(level.converged && level.distance == s);
            CHECK_RELATIVE(level.worn_volume, k * body.force * s, 1e-6);
            CHECK(level.separation < last);
            last = level.separation;
        }
        // At a given separation the force is worn off.
        const Level held = [&] {
            path->set_time(1);
            return path->at_separation(last);
        }();
        CHECK(held.force < body.force && held.force > 0);
        CHECK_THROWS(path->set_time(0.9), Error);
    }
}

// Levels between, and with them shorter steps, change the last one by less than its error.
TEST(steps) {
    for (const Body& body : bodies()) {
        const auto far = path_of(body), near = path_of(body);
        (void)slid(*far, 0, body.force);
        (void)slid(*near, 0, body.force);
        for (const double s : {0.05, 0.2, 0.8}) {
            const Level level = slid(*far, s, body.force);
            for (int part = 1; part < 4; ++part)
                (void)slid(*near, s * (0.25 + 0.75 * part / 4), body.force);
            const Level finer = slid(*near, s, body.force);
            const double depth = far->first_touch() - level.separation;
            CHECK(level.sliding_error > 0 && level.sliding_error < 2e-3);
            std::printf("  %s %g: %.3g of %.3g\n", body.name, s, std::abs(finer.separation - level.separation)/depth, level.sliding_error);
            CHECK(std::abs(finer.separation - level.separation) <=
                  1.5 * level.sliding_error * depth);
        }
    }
}
