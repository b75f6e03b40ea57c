// Elements that attract within a range (physics/adhesion/adhesive_elements.hpp), against Maugis's
// sphere and Johnson's wave.
#include "base/error.hpp"
#include "check.hpp"
#include "contact/make.hpp"
#include "physics/indenter/shapes.hpp"
#include "support/adhesive_paths.hpp"
#include "support/bodies.hpp"
#include "support/height_maps.hpp"
#include "support/judged.hpp"

namespace test_adhesive_elements {

using namespace rsc;

// On a sphere of radius 1, E* = 1.
struct Sphere : Maugis {
    // The stable branch ends at the smallest penetration: m from there down.
    double last() const {
        double least = 1e300, where = 0;
        for (double m = 1.0005; m < 60; m *= 1.0005)
            if (const double u = at(m).u; u < least) {
                least = u;
                where = m;
            }
        return where;
    }
    State pressed(double u) const {
        double low = 1 + 1e-9, high = last();
        for (int i = 0; i < 100; ++i) {
            const double m = 0.5 * (low + high);
            (at(m).u < u ? high : low) = m;
        }
        return at(low);
    }
    double pull_off() const {
        double least = 0;
        for (double m = 1.0005; m < last(); m *= 1.0005) least = std::min(least, at(m).f);
        return least;
    }
    // In a loop without friction of edges: the branch between the separation where the attraction
    // begins and that where the branch ends.
    double lost() const {
        const double end = last();
        State before = at(end);
        double area = 0;
        for (double m = end; m > 1 + 1e-6; m = 1 + (m - 1) / 1.001) {
            const State now = at(m);
            if (now.u > -range()) break;
            area -= 0.5 * (now.f + before.f) * (now.u - before.u);
            before = now;
        }
        return area;
    }
};

HeightMap paraboloid(double side, int n) {
    const double h = side / n;
    return height_map(n, n, h, h, [=](int i, int j) {
        return -0.5 *
               (std::pow((i + 0.5) * h - side / 2, 2) + std::pow((j + 0.5) * h - side / 2, 2));
    });
}

SolverOptions attracting(double w, double range) {
    return {.physics = bodies_with(Adhesion{w, range})};
}

// The relative error of the pull-off force; forces at given penetrations are checked on the way up.
double pull_off_error(double lambda, double resolution) {
    const Sphere truth{{1, 0.01, lambda, 1}};
    const double h = truth.range() / resolution,
                 widest = 1.05 * truth.pressed(0).c + 3 * truth.range() / resolution;
    const int n = 2 * int(std::ceil(widest / h));
    const HeightMap map = paraboloid(n * h, n);
    const SolverOptions options = attracting(truth.w, truth.range());
    const auto contact =
        make_element_contact(map, {1.0, kInfinity, 0.5 * (n - 1) * h, 0.5 * (n - 1) * h}, options);
    const double unit = pi * truth.w, reach = truth.range();
    Level level;
    for (double Z = 1.05 * reach; Z > 0; Z -= 0.25 * reach) level = contact->at_separation(Z);
    level = contact->at_separation(0);
    const double end = truth.at(truth.last()).u;  // negative
    const int steps = 16;
    double least = 0;
    int jumps = 0, inside = 0, inside_area = 0, compared = 0;
    for (int k = 0; k <= steps; ++k) {
        const double u = 1.15 * end * k / steps;
        level = judged(contact->at_separation(-u), *contact, options, &map);
        CHECK(level.converged);
        least = level.least_force;
        jumps += level.jumps;
        if (u > 0.8 * end) {
            // First order in h/z0: an edge may rest anywhere within a pixel, where the traction s0
            // acts or not.
            CHECK_CLOSE(level.force, truth.pressed(u).f, 0.35 / resolution * unit);
            CHECK_CLOSE(level.a.at(0), truth.pressed(u).a, h);
            inside += std::abs(level.force - truth.pressed(u).f) <=
                      level.force_error_expected * std::abs(level.force);
            inside_area += std::abs(level.area / (pi * std::pow(truth.pressed(u).a, 2)) - 1) <=
                           level.area_error_expected;
            ++compared;
            CHECK(level.force_error_expected * std::abs(level.force) < 1.6 / resolution * unit);
        }
    }
    CHECK(inside >= 0.9 * compared && inside_area >= 0.9 * compared);  // of the expected errors
    level = contact->at_separation(2 * reach);
    jumps += level.jumps;
    CHECK(jumps == (truth.lost() > 0 ? 1 : 0));
    CHECK(level.contacts == 0 && level.force == 0);
    // Maugis's loop: edges that move from pixel to pixel lose nothing.
    CHECK_CLOSE(level.energy_lost, truth.lost(), 0.01 * truth.lost());
    CHECK_CLOSE(contact->energy(), 0.0, 0.0);
    return least / truth.pull_off() - 1;
}

TEST(test_sphere) {
    for (double lambda : {0.3, 1.0}) {
        const double coarse = pull_off_error(lambda, 2), fine = pull_off_error(lambda, 4);
        // Half the pixels, half the error at least, but for where the edge happens to rest.
        CHECK(std::abs(coarse) < 0.01);
        CHECK(std::abs(fine) < 0.5 * std::abs(coarse) + 0.001);
    }
}

// One wave between flats (Johnson, Int. J. Solids Structures 32, 1995): with 2a of every wavelength
// in contact, phi = pi a/lambda, the mean pressure is pi E* D/lambda sin^2 phi - sqrt(2 E* w
// tan(phi)/lambda). The tension at which it separates is the smallest of these. It is too large by
// the error of edges that rest on pixels, of first order in h over the length E* z0^2/w in which
// the traction acts, here with the range fixed, so that halving h halves it.
TEST(test_wave_pull_off) {
    constexpr int rows = 4;
    constexpr double height = 0.1, range = 1.0 / 64, alpha = 0.3, full = pi * height,
                     w = alpha * alpha * full * full / 2;
    double truth = 0;
    for (double phi = 1e-3; phi < 1; phi += 1e-4)
        truth =
            std::min(truth, full * (std::pow(std::sin(phi), 2) - alpha * std::sqrt(std::tan(phi))));
    double before = 0;
    for (const int n : {128, 256, 512}) {
        const double h = 1.0 / n, zone = range * range / w;
        const HeightMap map = height_map(
            n, rows, h, h, [=](int i, int) { return height * std::cos(2 * pi * (i + 0.5) * h); });
        const auto contact =
            make_element_contact(map, {1.0, kInfinity, 0, 0, {1, rows * h}}, attracting(w, range));
        Level level = contact->at_separation(0.09);
        for (double Z = 0.08; level.force != 0; Z += 5e-4) level = contact->at_separation(Z);
        const double error = level.least_force / (rows * h) / truth - 1;
        CHECK(error > -0.01 && error < 1.4 * h / zone);
        if (before > 0) CHECK_RELATIVE(error, 0.5 * before, 0.25);
        before = error;
    }
}

// What cannot be had.
TEST(test_refused) {
    const HeightMap map = paraboloid(1, 16);
    const Indenter tip{1.0, kInfinity, 0.5, 0.5};
    // Its traction acts across 0.4 of a pixel at edges, and across 0.6; heights, pressures and the
    // work of adhesion may be scaled by one number.
    for (const double scale : {1.0, 1.0 / 16}) {
        const auto range = [](double pixels) {
            return std::sqrt(pixels / 16 * 0.01 / (0.25 * pi));
        };
        const double w = 0.01 * scale * scale;
        CHECK_THROWS((void)make_element_contact(map, tip, attracting(w, scale * range(0.4))),
                     Error);
        (void)make_element_contact(map, tip, attracting(w, scale * range(0.6)));
    }
    const auto contact = make_element_contact(map, tip, attracting(0.01, 0.2));
    (void)contact->at_separation(0);
    Path::State other_bodies = contact->state();
    other_bodies.history = {1.0, 2.0};
    CHECK_THROWS(contact->restore(other_bodies), Error);
}

// Under a force, and held where nothing carries it.
TEST(test_force) {
    const HeightMap map = paraboloid(1.6, 24);
    const Indenter tip{1.0, kInfinity, 0.8 - 0.8 / 24, 0.8 - 0.8 / 24};
    const auto one = make_element_contact(map, tip, attracting(0.02, 0.15)),
               other = make_element_contact(map, tip, attracting(0.02, 0.15));
    const Level carried = one->at_force(0.02);
    CHECK_CLOSE(carried.force, 0.02, 1e-6);
    for (const double N :
         {0.013, 0.007, 0.003}) {  // within the tolerance of the larger one of force and attraction
        const Level level = make_element_contact(map, tip, attracting(0.02, 0.15))->at_force(N);
        CHECK_CLOSE(level.force, N,
                    1e-6 * std::max(N, 0.02 / 0.15 * (level.area + level.cohesive_area)));
    }
    const Level same = other->at_separation(carried.separation);
    CHECK_CLOSE(same.force, 0.02, 2e-6);
    const Level held = one->at_force(-10);
    CHECK(!held.converged && held.fallback == Fallback::held && held.force < 0);
    CHECK(held.least_force <= held.force);
    SolverOptions few = attracting(0.02, 0.15);
    few.max_iterations = 1;
    const Level none = make_element_contact(map, tip, few)->at_separation(carried.separation);
    CHECK(!none.converged && std::isnan(none.force) && std::isnan(none.area));
}

// No force between states that press and that pull, by the difference of pressure and attraction,
// which is exact to the tolerance of these.
TEST(test_no_force) {
    const double h = 0.1 / 32, w = 5e-5, range = 2e-3;
    for (const double phase : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
        const HeightMap map = height_map(32, 32, h, h, [=](int i, int j) {
            return 1e-4 * (std::sin(250 * i * h + phase) * std::cos(190 * j * h) +
                           std::sin(170 * i * h + 210 * j * h + 2 * phase));
        });
        const auto contact =
            make_element_contact(map, Indenter{10 / 0.75, 1.0, 0.05, 0.05}, attracting(w, range));
        for (const double before : {1e-5, 1e-6, -1e-6, 1e-7, -1e-7, 3e-5}) {
            CHECK(contact->at_force(before).converged);
            const Level level = contact->at_force(0);
            CHECK(level.converged && level.contacts > 0);
            CHECK(std::abs(level.force) <= 1e-6 * w / range * (level.area + level.cohesive_area));
        }
    }
}

// A level next to another one takes a number of products that is bounded by that of a first one,
// and towards the surface has its state: attraction closes gaps, and closed gaps attract more, so
// that the state next to that of bodies apart is one, whatever the levels on the way. The loss of a
// cycle in few levels is the work of one in many.
TEST(test_later_levels) {
    const double h = 0.1 / 32, range = 9e-4;
    const HeightMap map = height_map(32, 32, h, h, [=](int i, int j) {
        return 1e-3 * (std::sin(250 * i * h) * std::cos(190 * j * h) +
                       std::sin(170 * i * h + 210 * j * h + 2));
    });
    const auto make = [&] {
        return make_element_contact(map, Indenter{1.0, 1.0, 0.05, 0.05}, attracting(2e-4, range));
    };
    const auto few = make();
    const double touch = few->first_touch();
    std::int64_t first = 0;
    Level level;
    for (const double depth : {-2.5, -0.5, 0.25, 1.0, 2.5}) {
        const double Z = touch - depth * range;
        level = few->at_separation(Z);
        const Level alone = make()->at_separation(Z);
        first = std::max(first, alone.products);
        CHECK(level.products <= 8 * first);
        // The tolerances of both.
        CHECK_CLOSE(level.force, alone.force,
                    2e-6 * 2e-4 / range * (level.area + level.cohesive_area));
    }
    for (const double depth : {0.0, -3.0, -8.0}) {
        level = few->at_separation(touch - depth * range);
        CHECK(level.products <= 8 * first);
    }
    CHECK(level.force == 0 && level.energy_lost > 0);
    const auto many = make();
    double work = 0;
    constexpr int steps = 150;
    Level last = many->at_separation(touch + 2.5 * range);
    for (int k = 1; k <= 2 * steps; ++k) {
        const double along = k <= steps ? k : steps - (k - steps) * 2.1;
        const Level next = many->at_separation(touch + (2.5 - 5 * along / steps) * range);
        work += 0.5 * (next.force + last.force) * (last.separation - next.separation);
        last = next;
    }
    CHECK(last.force == 0);
    // The error of a loss: of the trapezoidal rule, and of solutions to 1e-4 of the attraction.
    CHECK_RELATIVE(last.energy_lost, work, 0.01);
    CHECK_RELATIVE(level.energy_lost, work, 0.005);
}

// A small map of body 2 in the middle of a flat one: its attraction ends at its border, which is
// told; that of a raised middle does not.
TEST(test_cut_body) {
    const HeightMap map = height_map(24, 24, 0.05, 0.05, [](int, int) { return 0.0; });
    for (const double edge : {0.0, 1.0}) {
        ShapeKeys keys;
        keys.map = std::make_shared<HeightMap>(height_map(12, 12, 0.05, 0.05, [=](int i, int j) {
            return std::min({i, j, 11 - i, 11 - j}) > 2 ? 0.0 : -edge;
        }));
        Indenter tip{100.0, kInfinity, 0.6, 0.6};
        tip.shape = make_shape(shape_number("map"), keys);
        SolverOptions options = attracting(0.02, 0.15);
        options.surface.extent = {0, 0, 1.2, 1.2};
        const auto contact = make_element_contact(map, tip, options);
        // attracts without contact
        const Level level =
            judged(contact->at_separation(contact->first_touch() + 0.1), *contact, options, &map);
        CHECK(level.force < 0 && level.contacts == 0);
        CHECK((level.edge_contacts > 0) == (edge == 0) &&
              (edge > 0 || level.status == LevelStatus::out_of_validity));
    }
}

// A saved state goes on as the contact itself.
TEST(test_saved) {
    const HeightMap map = paraboloid(1.6, 24);
    const Indenter tip{1.0, 2.0, 0.8, 0.8};
    const auto contact = make_element_contact(map, tip, attracting(0.02, 0.15)),
               other = make_element_contact(map, tip, attracting(0.02, 0.15));
    for (const double Z : {-0.1, 0.1}) (void)contact->at_separation(Z);
    other->restore(contact->state());
    const Level level = contact->at_separation(-0.1), same = other->at_separation(-0.1);
    CHECK(level.least_force < -0.1 * std::abs(level.force));
    CHECK(same.least_force == level.least_force && same.energy_lost == level.energy_lost &&
          same.jumps == level.jumps);
    CHECK_RELATIVE(same.force, level.force, 1e-6);
}

// Whole periods of a surface that repeats do not count.
TEST(test_wrapped) {
    const HeightMap map = paraboloid(1.6, 24);
    Indenter tip{1.0, 2.0, 0.8, 0.8};
    tip.repeats = {map.Lx(), map.Ly()};
    const auto contact = make_element_contact(map, tip, attracting(0.02, 0.15));
    const double force = contact->at_separation(-0.1).force;
    (void)contact->at_separation(2);  // lets go
    contact->move_tip(0.8 - 3 * map.Lx(), 0.8 + 5 * map.Ly());
    CHECK(force != 0);
    CHECK_RELATIVE(contact->at_separation(-0.1).force, force, 1e-6);  // the tolerance of a level
}

}  // namespace test_adhesive_elements
