// Summits where bodies touch: the second-order shift against a search, levels that do not depend on
// the way of the tip, the lateral force as gradient of the energy; and summits of maps with pits
// and steps and of rounded maps against elements on the same points.
#include "asperities/shifted_summits.hpp"
#include "check.hpp"
#include "contact/answers.hpp"
#include "physics/indenter/shapes.hpp"
#include "problem/bodies.hpp"
#include "support/height_maps.hpp"
#include "support/judged.hpp"
#include "support/paths.hpp"
#include "surface/defects.hpp"
#include "surface/detection.hpp"
#include "surface/synthesis.hpp"

namespace test_shifted_summits {

using namespace rsc;

Case polished(double sigma, const char* model) {
    Case c;
    c.run.threads = 1;
    c.surface.n = 256;
    c.surface.L_lambda_l = 8;
    c.surface.L_lambda_s = 32;
    c.surface.sigma = sigma;
    c.asperities.law = LawKind::fourth_order;
    c.solver.model = model[0] == 'e' ? ModelKind::elements : ModelKind::asperities;
    return c;
}

Level at(const Case& c, const SurfaceModel& model, double Z0) {
    const SolverOptions options = solver_of(c, model.domain);
    const auto contact = make_contact(model, indenter_of(c, model.domain), options);
    return judged(contact->at_separation(Z0), *contact, options);
}

// The map as a surface that was measured.
Surface measured(const HeightMap& map) {
    Surface surface;
    surface.map = map.copy();
    surface.sigma = 1e-3;
    return surface;
}

// The shifted summit is the highest point of z - z'' d''d/2 - s(d) for the paraboloids of both
// bodies within the range of the summit: found by a search over the directions and distances.
TEST(shift_is_the_highest_point) {
    constexpr double kSame = 1e-12;
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    int inside = 0, border = 0;
    for (int k = 0; k < 60; ++k) {
        ShapeKeys keys;
        keys.radii[0] = 1 + 5 * uniform(random);
        keys.radii[1] = 1 + 5 * uniform(random);
        keys.angle = 3 * uniform(random);
        const Indenter tip{1e5, make_shape(shape_number("paraboloid"), keys), 0.1, -0.2};
        const double high = 1 + 20 * uniform(random), low = high * uniform(random),
                     angle = uniform(random) - 0.5;
        Asperities one;
        one.x = {uniform(random)};
        one.y = {uniform(random)};
        one.z = {0.01};
        one.kappa1 = {high};
        one.kappa2 = {low};
        one.angle = {angle};
        one.radius = {1 / std::sqrt(high * low)};
        const double farthest = 0.02 + 0.1 * uniform(random);
        ShiftedSummits shifts(one, tip, farthest);
        shifts.shift_and_prepare(0);
        const Asperities& found = shifts.summits();
        const auto clearance = [&](double dx, double dy) {
            const double u = dx * std::cos(angle) + dy * std::sin(angle),
                         v = dy * std::cos(angle) - dx * std::sin(angle);
            return tip.clearance(one.x[0] + dx, one.y[0] + dy,
                                 one.z[0] - 0.5 * (low * u * u + high * v * v));
        };
        double best = clearance(0, 0), far = 0;
        constexpr int around = 2000, out = 100;
        for (const int a : indices(around))
            for (int r = 1; r <= out; ++r) {
                const double t = 2 * pi * a / around, d = farthest * r / out,
                             here = clearance(d * std::cos(t), d * std::sin(t));
                if (here > best) {
                    best = here;
                    far = d;
                }
            }
        const double dx = found.x[0] - one.x[0], dy = found.y[0] - one.y[0],
                     top = tip.clearance(found.x[0], found.y[0], found.z[0]);
        CHECK_CLOSE(top, clearance(dx, dy), kSame);
        CHECK(top >= best - kSame && top <= best + (high + 1) * std::pow(farthest / out, 2));
        CHECK(std::hypot(dx, dy) <= farthest * (1 + kSame));
        (far < farthest ? inside : border) += 1;
        CHECK(top - clearance(0, 0) <= shifts.most_gained(top));
        // Both curvature tensors add up: their traces and determinants.
        const auto C = tip.shape->curvature(one.x[0] - tip.x0, one.y[0] - tip.y0);
        CHECK_RELATIVE(found.kappa1[0] + found.kappa2[0], high + low + C.xx + C.yy, 1e-12);
    }
    CHECK(inside > 10 && border > 10);
}

// N, A and the first touch at one place of the tip and one separation are those of a new contact
// there, whatever the way of the tip and the levels before; and a force is found at the separation
// whose level has this force.
TEST(no_history) {
    constexpr double kTolerance = 1e-11, kSame = 30 * kTolerance;
    for (const LawKind law : {LawKind::hertz, LawKind::elliptic, LawKind::fourth_order})
        for (const char* shape : {"sphere", "cone", "map"}) {
            Case c = polished(3e-4, "asperities");
            c.surface.L_lambda_l = 4;
            c.surface.L_lambda_s = 16;
            c.solver.tolerance = kTolerance;
            c.asperities.law = law;
            const SurfaceModel model = make_surface_model(c, 1, 1);
            ShapeKeys keys;
            keys.R = 6;
            keys.slope = 0.008;
            auto map = std::make_shared<HeightMap>(
                make_surface(polished(1e-4, "elements"), 7, 1).map.copy());
            map->periodic = false;
            keys.map = std::move(map);
            Indenter tip = indenter_of(c, model.domain);
            tip.shape = make_shape(shape_number(shape), keys);
            const SolverOptions options = solver_of(c, model.domain);
            Indenter there = tip;
            there.x0 += 0.031;
            there.y0 -= 0.017;
            Path fresh = asperity_path(model.asperities, there, options);
            const double touch = fresh.first_touch(), Z0 = touch - 4e-4;
            const Level truth = fresh.at_separation(Z0);
            CHECK(truth.contacts > 0);
            for (const int way : indices(3)) {
                Path moving = asperity_path(model.asperities, tip, options);
                const int steps = way == 0 ? 1 : 12;
                for (int k = 1; k <= steps; ++k) {
                    const double t = way == 2 && k < steps ? 1.5 * k / steps : double(k) / steps;
                    (void)moving.at_separation(Z0 + 2e-5 * (k % 3));
                    moving.move_tip(tip.x0 + 0.031 * t, tip.y0 - 0.017 * t);
                }
                moving.move_tip(there.x0, there.y0);
                CHECK(moving.first_touch() == touch);
                const Level level = moving.at_separation(Z0);
                CHECK(level.contacts == truth.contacts);
                CHECK_RELATIVE(level.force, truth.force, kSame);
                CHECK_RELATIVE(level.area, truth.area, kSame);
                CHECK_RELATIVE(moving.at_force(truth.force).separation, Z0, kSame);
            }
        }
}

TEST(summits_of_maps) {
    // The summits of law 'hertz' are grid points below the tops between them: where only these
    // touch, N = 0 is no promise.
    for (const bool flat : {false, true}) {
        Case c = polished(1e-3, "asperities");
        c.surface.n = 128;  // four points in the shortest wave
        if (flat) {
            c.solids.R[1] = kInfinity;
            c.indentation.boundary = Boundary::periodic;
        }
        c.asperities.law = LawKind::elliptic;
        const SurfaceModel between = make_surface_model(c, 1, 1);
        const double top =
            make_contact(between, indenter_of(c, between.domain), solver_of(c, between.domain))
                ->first_touch();
        c.asperities.law = LawKind::hertz;
        const SurfaceModel points = make_surface_model(c, 1, 1);
        CHECK(at(c, points, top - 1e-6).force == 0 &&
              at(c, points, top - 1e-6).doubts == bit(Cause::missed_contact));
        CHECK(at(c, points, top + 1e-3).doubts == 0);
    }

    // Grooves and a step beside summits: none is found above the points around it, and the load
    // stays that of elements.
    const Spectrum s{.L = 1, .L_lambda_l = 4, .L_lambda_s = 24, .sigma = 1e-3};
    HeightMap clean = synthesize(s, 256, Normalise::sample, 3, 1);
    clean.periodic = false;
    Case c;
    c.run.threads = 1;
    c.solids.R[1] = 20;
    c.asperities.law = LawKind::fourth_order;
    const auto forces = [&](const HeightMap& map, LawKind law, double& model, double& truth) {
        const Surface surface = measured(map);
        c.asperities.law = law;
        c.solver.model = ModelKind::asperities;
        model = at(c, make_surface_model(surface, c, 1), 1e-3).force;
        c.solver.model = ModelKind::elements;
        truth = at(c, make_surface_model(surface, c, 1), 1e-3).force;
    };
    double sound, model, truth;
    forces(clean, LawKind::fourth_order, sound, truth);
    CHECK_RELATIVE(sound, truth, 0.08);
    for (const char* what : {"grooves", "step"}) {
        Surface broken = measured(clean);
        HeightMap& map = broken.map;
        if (what[0] == 'g')
            for (const int k : indices(256)) {
                map.row(k)[100] -= 8e-3;
                map.row(140)[k] -= 8e-3;
            }
        if (what[0] == 's')
            for (const int j : indices(256))
                for (int i = 128; i < 256; ++i) map.row(j)[i] -= 4e-3;
        const Asperities found =
            find_asperities(map, Curvature::geometric, nullptr, 1, Detail::subgrid);
        double above = 0;
        for (const auto k : indices(found)) {
            const int i = int(std::lround(found.x[k] / map.dx)),
                      j = int(std::lround(found.y[k] / map.dy));
            double highest = -1;
            for (int dj = -1; dj <= 1; ++dj)
                for (int di = -1; di <= 1; ++di) highest = std::max(highest, map(i + di, j + dj));
            above = std::max(above, found.z[k] - highest);
        }
        forces(map, LawKind::fourth_order, model, truth);
        CHECK(above < 0.1e-3);
        CHECK_RELATIVE(model, truth, 0.12);
    }

    // A map far flatter than the ball is round: where the tip is between points of the map, its
    // summit is no spike, and the force is Hertz's.
    {
        constexpr double
            kBump = 50,
            kDeep = 1e-6,
            kHertz = 1e-3;  // deeper is wider than the paraboloids of the ball and of the map
        c.solids.R[1] = 1;
        c.asperities.law = LawKind::elliptic;
        c.solver.model = ModelKind::asperities;
        const SurfaceModel bump = make_surface_model(
            measured(height_map(64, 64, 1.0 / 64, 1.0 / 64,
                                [](int i, int j) {
                                    return -((i - 32) * (i - 32) + (j - 32) * (j - 32)) /
                                           (8192 * kBump);
                                })),
            c, 1);
        const Indenter tip = indenter_of(c, bump.domain);  // over the middle of the map
        const auto contact = make_contact(bump, tip, solver_of(c, bump.domain));
        const double R = 1 / (1 + 1 / kBump),
                     touch = -std::pow(std::hypot(0.5, 0.5) / 64, 2) / (2 * (kBump + 1));
        CHECK_RELATIVE(contact->at_separation(touch - kDeep).force,
                       4.0 / 3 * tip.E_star * std::sqrt(R) * std::pow(kDeep, 1.5), kHertz);
    }

    // Rounded to a tenth of sigma, a map carries what it did.
    for (const double part : {0.03, 0.1}) {
        Surface rounded = measured(clean);
        HeightMap& map = rounded.map;
        const double step = part * 1e-3;
        for (const int j : indices(map.ny))
            for (const int i : indices(map.nx)) map.row(j)[i] = step * std::round(map(i, j) / step);
        CHECK_RELATIVE(height_step(map), step, 1e-6);
        CHECK(height_step(clean) == 0);
        for (const bool rows :
             {true, false})  // also where its rows, or columns, were levelled one by one
            CHECK_RELATIVE(
                height_step(height_map(
                    map.nx, map.ny, map.dx, map.dy,
                    [&](int i, int j) { return map(i, j) + 0.3 * step * std::sin(rows ? j : i); })),
                step, 1e-6);
        for (const LawKind law : {LawKind::hertz, LawKind::fourth_order}) {
            double as_it_was, now;
            forces(clean, law, as_it_was, truth);
            forces(map, law, now, truth);
            CHECK_RELATIVE(now, as_it_was, 0.06);
        }
    }
}

// The lateral force is -dW/d(x0, y0) at a fixed separation, by central differences between new
// contacts; W with the plastic work. Under a paraboloid the curvatures of a summit do not change
// with the tip and the sum over the contacts is the gradient; under a sphere it misses the order of
// (d/R)^2, d the distance of the contacts from the tip.
TEST(lateral_force_is_the_gradient) {
    constexpr double kStep = 4e-6, kForce = 1e-6;  // of the side; of N
    double largest = 0;
    for (const char* body : {"elastic", "layers", "hardness", "relaxation", "adhesion"})
        for (const char* name : {"paraboloid", "sphere"})
            for (const LawKind law : {LawKind::hertz, LawKind::elliptic, LawKind::fourth_order}) {
                const std::string of = body;
                Case c = polished(3e-4, "asperities");
                c.run.seed = 3;
                c.surface.n = 128;
                c.surface.L_lambda_l = 4;
                c.surface.L_lambda_s = 16;
                c.solver.tolerance = 1e-11;
                c.asperities.law = law;
                if (of == "layers") {
                    c.solids.layer_thickness = {0.1};
                    c.solids.layer_E = {4e4};
                    c.solids.layer_nu = {0.3};
                }
                if (of == "hardness") c.solids.hardness = 200;
                if (of == "relaxation") {
                    c.solids.relaxation_share = {0.5, 0.3};
                    c.solids.relaxation_time = {1, 10};
                }
                if (of == "adhesion") c.solids.adhesion = 1e-4;
                const SurfaceModel model = make_surface_model(c, 1, 1);
                ShapeKeys keys;
                keys.R = 6;
                keys.radii[0] = 4;
                keys.radii[1] = 9;
                keys.angle = 0.4;
                Indenter tip = indenter_of(c, model.domain);
                tip.shape = make_shape(shape_number(name), keys);
                const SolverOptions options = solver_of(c, model.domain);
                const auto made = [&](double dx, double dy) {
                    Indenter there = tip;
                    there.x0 += dx;
                    there.y0 += dy;
                    return make_contact(model, there, options);
                };
                const auto contact = made(0, 0);
                const double Z0 = contact->first_touch() - 6e-4;
                const Level level = contact->at_separation(Z0);
                CHECK(level.contacts > 1);
                const auto energy = [&](double dx, double dy) {
                    const auto there = made(dx, dy);
                    const Level near = there->at_separation(Z0);
                    return there->energy() + (of == "hardness" ? near.plastic_work : 0.0);
                };
                const Vec2 force = lateral_force(tip, level);
                const double h = kStep, x = (energy(-h, 0) - energy(h, 0)) / (2 * h),
                             y = (energy(0, -h) - energy(0, h)) / (2 * h);
                double far = 0;
                for (const auto k : indices(level.x))
                    far = std::max(far, std::hypot(level.x[k] - tip.x0, level.y[k] - tip.y0));
                const double more = name[0] == 's' ? std::pow(far / keys.R, 2) : 0;
                CHECK(std::hypot(force.x - x, force.y - y) <=
                      kForce * level.force + more * std::hypot(x, y));
                largest = std::max(largest, std::hypot(x, y) / level.force);
            }
    CHECK(largest > 1e-3);
}

}  // namespace test_shifted_summits
