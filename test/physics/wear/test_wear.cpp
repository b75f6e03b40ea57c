// Wear by sliding: a worn ball by rings, volumes, waves in full contact, steps, states, files.
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "contact/make.hpp"
#include "physics/adhesion/sticking.hpp"
#include "physics/hardness/hardness.hpp"
#include "physics/indenter/shapes.hpp"
#include "physics/relaxation/relaxation.hpp"
#include "physics/wear/wear.hpp"
#include "support/height_maps.hpp"
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"
#include "truth/wear.hpp"

namespace test_wear {

using namespace rsc;

SolverOptions wearing(double k, double tolerance = 1e-7) {
    SolverOptions options;
    options.tolerance = tolerance;
    options.physics.of<Wear>().coefficient = k;
    return options;
}

// Waves of short and long length over a period 1, with the rms height 1.2e-3.
HeightMap waves(int nx, int ny) {
    return height_map(nx, ny, 1.0 / nx, 1.0 / ny, [=](int i, int j) {
        const double x = 2 * pi * i / nx, y = 2 * pi * j / ny;
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
    all.push_back({"ball", waves(48, 60), {1e3, 2.0, 0.5, 0.5}, 0.2});
    all.push_back({"roller",
                   waves(48, 48),
                   {1e3, make_shape(shape_number("paraboloid"), roller), 0.5, 0.5},
                   0.5});
    all.back().indenter.period = {kInfinity, 1};
    all.push_back({"flats", waves(64, 64), {1e3, kInfinity, 0, 0, {1, 1}}, 1});
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
    }
}

// Archard's volume k N s, whatever the steps; no wear is the elastic contact, bit for bit.
TEST(volume) {
    for (const Body& body : bodies()) {
        const double k = 2e-3;
        const auto path = path_of(body, k), elastic = path_of(body, 0);
        const Level first = slid(*path, 0, body.force), unworn = slid(*elastic, 0, body.force);
        CHECK(first.separation == unworn.separation && first.area == unworn.area &&
              first.pixels.pressure == unworn.pixels.pressure && first.worn_volume == 0);
        CHECK(elastic->clock() == PathClock::none && std::isnan(unworn.worn_volume));
        double last = first.separation;
        for (const double s : {0.01, 0.1, 0.5}) {
            const Level level = slid(*path, s, body.force);
            CHECK(level.converged && level.distance == s && level.separation < last);
            CHECK_RELATIVE(level.worn_volume, k * body.force * s, 1e-6);
            last = level.separation;
        }
        // A force that grows linearly wears by its mean.
        const double grown = slid(*path, 1, 1.4 * body.force).worn_volume;
        CHECK_RELATIVE(grown, k * body.force * (0.5 + 0.5 * 1.2), 1e-3);
        // At a given separation the force wears off.
        const Level begin = *path->level();
        path->set_time(3);
        const Level held = path->at_separation(begin.separation);
        CHECK(held.force < 0.9 * begin.force && held.worn_volume > begin.worn_volume);
        CHECK_THROWS(path->set_time(2.9), Error);
        // Without its past a contact is a new one.
        path->forget();
        CHECK(same(slid(*path, 0, body.force), first));
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
            const double change = slid(*near, s, body.force).separation - level.separation;
            CHECK(level.sliding_error > 0 && level.sliding_error < 2e-3);
            CHECK(std::abs(change) <=
                  level.sliding_error * (far->first_touch() - level.separation));
        }
    }
}

// Bodies that yield and wear: the volume is still k N s, no pressure exceeds the hardness, which a
// hardness out of reach does not change; and where all of the contact yields, N = H A.
TEST(hardness) {
    for (const Body& body : bodies()) {
        const double k = 2e-3;
        SolverOptions options = wearing(k);
        options.physics.of<Hardness>().H0 = 1e6;
        const auto elastic = path_of(body, k),
                   same_as = make_element_contact(body.map, body.indenter, options);
        options.physics.of<Hardness>().H0 = 2 * body.force / (body.map.Lx() * body.map.Ly());
        const auto soft = make_element_contact(body.map, body.indenter, options);
        for (const double s : {0.0, 0.02, 0.1}) {
            const Level a = slid(*elastic, s, body.force), b = slid(*same_as, s, body.force),
                        c = slid(*soft, s, body.force);
            CHECK_RELATIVE(b.separation, a.separation, 1e-5);
            CHECK_CLOSE(b.worn_volume, a.worn_volume, 1e-6 * (k * body.force * s));
            CHECK_CLOSE(c.worn_volume, k * body.force * s, 1e-5 * (k * body.force * s));
            CHECK(c.converged && c.pressure_max <= options.physics.of<Hardness>().H0 * (1 + 1e-9));
            CHECK(c.plastic_work > 0 &&
                  c.area_pixels >= (0.5 - 1e-9) * body.map.Lx() * body.map.Ly());
        }
    }
}

// A force that falls by ten in one level: the pressures of the worn surface are those of many
// levels.
TEST(falling_force) {
    const Body flats = std::move(bodies()[2]);
    const auto one = path_of(flats), many = path_of(flats);
    for (const auto& path : {&one, &many}) {
        (void)slid(**path, 0, flats.force);
        (void)slid(**path, 0.05, flats.force);
    }
    constexpr int levels = 20;
    Level last;
    for (int k = 1; k <= levels; ++k)
        last = slid(*many, 0.05 + 0.2 * k / levels, flats.force * (1 - 0.9 * k / levels));
    const Level level = slid(*one, 0.25, 0.1 * flats.force);
    CHECK_RELATIVE(level.separation, last.separation, 5e-3);
    CHECK_RELATIVE(level.pressure_max, last.pressure_max, 0.1);  // it changes by less per halving
}

// What remains of a wave in full contact: K of E* is 2/(E* q) for the wavenumber q, so that the
// amplitude falls by exp(-k E* q s/2); the mean height falls by k p s, and with it Z0.
TEST(full_contact) {
    constexpr int n = 32;
    const double E = 1e3, k = 1e-3, p = 1, q = 2 * pi, a = 4e-4;  // closed by pi E* a = 1.26
    const HeightMap map = height_map(n, n, 1.0 / n, 1.0 / n,
                                     [&](int i, int) { return a * std::cos(2 * pi * i / n); });
    const auto path = make_element_contact(map, {E, kInfinity, 0, 0, {1, 1}}, wearing(k, 1e-9));
    CHECK(slid(*path, 0, p).area_fraction < 1);
    const Level closed = slid(*path, 0.5, p);
    CHECK(closed.area_fraction == 1 && closed.converged);
    double last = closed.worn_rms;
    for (int step = 1; step <= 4; ++step) {
        const double ds = 0.05;
        const Level level = slid(*path, 0.5 + step * ds, p);
        CHECK_CLOSE(level.separation, -k * p * level.distance, 1e-12);
        CHECK_RELATIVE(level.worn_rms / last, std::exp(-0.5 * k * E * q * ds), 1e-3);
        last = level.worn_rms;
    }
}

// Threads, a state that is taken back, and a copy made from it leave no trace.
TEST(states) {
    for (const Body& body : bodies()) {
        const auto one = path_of(body), other = path_of(body);
        const auto go = [&](Path& path) {
            (void)slid(path, 0, body.force);
            return slid(path, 0.1, body.force);
        };
        const Level level = [&] {
            const LoopThreads loops(1);
            return go(*one);
        }();
        const LoopThreads loops(3);
        CHECK(same(go(*other), level));
        const Path::State state = one->state();
        one->restore(state);
        const Level next = slid(*one, 0.3, body.force);
        one->restore(state);
        CHECK(same(slid(*one, 0.3, body.force), next));
        const auto copy = path_of(body);
        copy->restore(state);
        CHECK_RELATIVE(copy->stiffness(), other->stiffness(), 1e-3);
        CHECK_RELATIVE(copy->energy(), level.energy, 1e-4);  // of the body, without the wear
        CHECK(same(slid(*copy, 0.3, body.force), next));
    }
}

// A case, its file, and a second case that goes on from the heights of the first.
TEST(files) {
    const Folder folder;
    const std::string
        common =
            "&solids E=1e5, Infinity nu=0.3, 0 R=Infinity, Infinity wear_coefficient=1e-8 /"
            "&indentation boundary='periodic' control='pressure' unit='pressure' levels=3*100 ",
        made = " / &surface L=1 L_lambda_l=2 L_lambda_s=8 n=128 sigma=1e-3 /";
    const auto run = [&](const std::string& text, const std::string& name) {
        return run_to(folder / name, common + text);
    };
    const Reader whole = run("distances=0, 10, 20" + made +
                                 "&output heights=.true. fields='heights','gap','contact' "
                                 "field_levels=0, 20 /",
                             "whole.nc");
    CHECK(whole.values("distance") == (std::vector<double>{0, 10, 20}));
    const std::vector<double> before = whole.values("field_height"), worn = whole.values("height");
    const std::size_t points = worn.size();
    CHECK(before.size() == 2 * points);
    double lost = 0, deepest = 0, mean = 0, square = 0;
    for (const std::size_t i : indices(points)) {
        CHECK(before[points + i] == worn[i]);
        lost += before[i] - worn[i];
        deepest = std::max(deepest, before[i] - worn[i]);
        mean += worn[i] / double(points);
    }
    for (const double z : worn) square += (z - mean) * (z - mean) / double(points);
    CHECK_RELATIVE(lost / double(points), whole.values("worn_volume")[2], 1e-9);
    CHECK_RELATIVE(lost / double(points), 1e-8 * 100 * 20, 1e-6);
    CHECK_RELATIVE(deepest, whole.values("wear_depth_max")[2], 1e-9);
    CHECK_RELATIVE(std::sqrt(square), whole.values("worn_rms")[2], 1e-9);
    // Where the bodies touch there is no gap, elsewhere there is one.
    const std::vector<double> gap = whole.values("field_gap"),
                              contact = whole.values("field_contact");
    for (const auto i : indices(gap)) CHECK((gap[i] == 0) == (contact[i] == 1));

    const Reader first = run("distances=0, 5, 10" + made + "&output heights=.true. /", "first.nc");
    const Reader second =
        run("distances=10, 15, 20 / &surface source='heights' detrend='none' file='" +
                (folder / "first.nc") + "' /",
            "second.nc");
    for (const char* of : {"separation", "contact_area"})
        CHECK_RELATIVE(second.values(of)[2], whole.values(of)[2], 1e-3);
    CHECK_RELATIVE(second.values("separation")[0], first.values("separation")[2], 1e-5);
}

// The errors that a run states on a coarse grid cover those against the ball of TEST(worn_ball).
TEST(errors) {
    const Folder folder;
    const std::string map = folder.write(
        "flat.txt", rows_of_text(24, 24, [](int i, int j) { return (i + j) % 2 ? 1e-9 : -1e-9; }));
    const Reader run = run_to(
        folder / "ball.nc",
        "&solids E=1e3, Infinity nu=0, 0 R=Infinity, 1 wear_coefficient=1e-4 /"
        "&surface source='heights' detrend='none' L=0.13 file='" +
            map + "' / &indentation control='force' levels=4*0.02 distances=0, 0.1, 0.5, 2 /");
    const auto depths = run.values("wear_depth_max"),
               errors = run.values("wear_depth_max_error_expected"),
               of_volume = run.values("worn_volume_error_expected");
    for (int k = 1; k < 4; ++k) {
        const double s = run.values("distance")[at(k)];
        const truth::WornBall truth = truth::worn_ball(1e3, 1, 0.02, 1e-4, s, 0.06, 240, 200);
        CHECK(std::abs(depths[at(k)] / truth.depth - 1) <= errors[at(k)] && errors[at(k)] < 0.3);
        CHECK(of_volume[at(k)] < 1e-9);  // the force is given
        CHECK_RELATIVE(run.values("worn_volume")[at(k)], 1e-4 * 0.02 * s, 1e-9);
    }
}

TEST(refused) {
    const HeightMap map = flat_map(16, 16, 0.01, 0.01);
    const Indenter ball{1e3, 1.0, 0.075, 0.075};
    SolverOptions sticky = wearing(1e-4), soft = sticky;
    sticky.physics.of<Adhesion>() = {1e-3, 1e-4};
    soft.physics.of<Relaxation>() = {{0.5}, {1.0}};
    for (const SolverOptions& options : {sticky, soft, wearing(-1), wearing(kInfinity)})
        CHECK_THROWS(make_element_contact(map, ball, options), Error);
    Asperities one;
    CHECK_THROWS(make_asperity_contact(one, ball, wearing(1e-4)), Error);
}

}  // namespace test_wear
