// Contacts of a body that relaxes, asperities and elements, free and between flats, against the
// elastic contact: the correspondence principle while contacts grow, the two elastic answers in the
// limits, conservation of energy, convergence.
#include "base/error.hpp"
#include "check.hpp"
#include "contact/deflection.hpp"
#include "contact/make.hpp"
#include "physics/relaxation/relaxation.hpp"
#include "support/asperities.hpp"
#include "support/bodies.hpp"
#include "support/height_maps.hpp"

namespace test_relaxing_contact {

using namespace rsc;

constexpr double kE = 10;
const Relaxation kBody{{0.3, 0.4}, {0.9, 3}};  // levels closer than 0.9/16 are one step of time

HeightMap waves() {
    constexpr int n = 24;
    return height_map(n, n, 1.0 / n, 1.0 / n, [](int i, int j) {
        const double x = 2 * pi * i / n, y = 2 * pi * j / n;
        return 0.01 * (std::cos(x) * std::cos(2 * y + 1) + 0.7 * std::cos(3 * x + 2 * y) +
                       0.4 * std::sin(5 * y - 2 * x));
    });
}

// Six asperities, or a wavy map.
struct Kind {
    const char* name;
    bool elements, periodic;
    LawKind law = LawKind::hertz;
    double depth = 0.02;
};
constexpr Kind kModels[] = {{"asperities", false, false},
                            {"fourth order", false, false, LawKind::fourth_order},
                            {"asperities between flats", false, true},
                            {"elements", true, false},
                            {"elements between flats", true, true, LawKind::hertz, 0.008}};

std::unique_ptr<Path> make(const Kind& model, const Relaxation& body) {
    static const HeightMap map = waves();
    static const Asperities asperities = curved(asperities_at({{0.2, 0.3, 0.002, 0.2},
                                                               {0.35, 0.4, 0, 0.1},
                                                               {0.7, 0.2, -0.004, 0.15},
                                                               {0.8, 0.75, 0.006, 0.1},
                                                               {0.4, 0.8, 0.003, 0.3},
                                                               {0.6, 0.5, -0.01, 0.25}}),
                                                1.3, 0.5, 20);
    SolverOptions options{.law = model.law, .tolerance = 1e-11, .physics = bodies_with(body)};
    Indenter indenter{kE, model.periodic ? kInfinity : 4.0, 0.5, 0.5,
                      model.periodic ? Period{1, 1} : Period{}};
    if (model.elements) return make_element_contact(map, indenter, options);
    return make_asperity_contact(asperities, indenter, options);
}

// Pressed in at a constant rate, the contact is the elastic one of its separation, and N = int
// phi(t - t') dN_e: of second order in the steps.
void test_growing(const Kind& model) {
    const Creep creep(kBody);
    const auto run = [&](int steps, double& worst_area) {
        const auto soft = make(model, kBody), elastic = make(model, {});
        const double touch = elastic->first_touch();
        double expected = 0, last = 0, force = 0;
        for (int k = 0; k <= steps; ++k) {
            const double Z0 = touch - model.depth * k / steps, t = 2.0 * k / steps;
            soft->set_time(t);
            const Level level = soft->at_separation(Z0), e = elastic->at_separation(Z0);
            // int phi over the steps that remain, the rise of N_e being linear in each.
            const Passage rest(creep, 2.0 / steps);
            const double left = 2 - t;
            double mean = creep.last();
            for (const auto b : indices(creep.branches()))
                mean += creep.branches()[b].share * rest.decays[b].change *
                        std::exp(-creep.branches()[b].rate * left);
            expected += mean * (e.force - last);
            last = e.force;
            force = level.force;
            if (k > 0)
                worst_area = check::worse(worst_area, std::abs(level.area - e.area) / e.area);
        }
        return force / expected - 1;
    };
    double area = 0, ignored = 0;
    const double coarse = run(40, ignored), fine = run(80, area);
    CHECK(std::abs(fine) <
          (model.elements ? 2e-3 : 1e-7));  // asperities: nothing but the solver's tolerance
    if (model.elements) CHECK(std::abs(fine) < 0.35 * std::abs(coarse));
    CHECK(area < (model.elements ? 0.06 : 1e-7));  // a pixel more or less
}

// Held at once and for long, the two elastic contacts; under a force, too; and everything forgotten
// after a long time without contact.
void test_limits(const Kind& model) {
    const auto soft = make(model, kBody), elastic = make(model, {});
    const double touch = elastic->first_touch(), Z0 = touch - model.depth;
    const Level e = elastic->at_separation(Z0);
    const auto as_elastic = [&](const Level& level, double of) {
        CHECK_RELATIVE(level.force, of * e.force, 1e-8);
        CHECK_RELATIVE(level.area, e.area, 1e-8);
    };
    as_elastic(soft->at_separation(Z0), 1);
    CHECK_RELATIVE(soft->stiffness(), elastic->stiffness(), 1e-7);
    CHECK_RELATIVE(soft->energy(), elastic->energy(), 1e-8);
    soft->set_time(1e-10);
    as_elastic(soft->at_separation(Z0), 1);
    double time = 0;
    for (int k = 0; k < 6; ++k) {
        soft->set_time(time += 1e4);
        (void)soft->at_separation(Z0);
    }
    soft->set_time(time += 1e4);
    const Level relaxed = soft->at_separation(Z0);
    as_elastic(relaxed, 0.3);
    CHECK_RELATIVE(soft->energy() + relaxed.energy_lost, elastic->energy(),
                   1e-5);  // no work; a few pixels leave and enter the contact
    const auto pressed = make(model, kBody);
    for (const int k : indices(7)) {
        pressed->set_time(1e4 * k);
        (void)pressed->at_force(0.3 * e.force);
    }
    pressed->set_time(1e5);
    const Level held = pressed->at_force(0.3 * e.force);
    CHECK_RELATIVE(held.separation - touch, e.separation - touch, 1e-7);
    CHECK_RELATIVE(held.area, e.area, 1e-6);
    for (int k = 0; k < 7; ++k) {
        soft->set_time(time += 1e4);
        CHECK(soft->at_separation(touch + 5 * model.depth).force == 0);
    }
    as_elastic(soft->at_separation(Z0), 1);
}

// Down, held, up, down again: work = stored + lost; and the forces converge, both with the square
// of the step.
void test_path(const Kind& model) {
    struct End {
        double balance, force, lost;
    };
    const auto run = [&](int steps) {
        const auto soft = make(model, kBody);
        const double touch = soft->first_touch();
        double work = 0;
        Level last;
        for (int k = 0; k <= steps; ++k) {
            const double t = 3.0 * k / steps;
            soft->set_time(t);
            const double depth = model.depth * (t < 1     ? t
                                                : t < 1.5 ? 1
                                                : t < 2   ? 2.5 - t
                                                          : 0.5 + 0.2 * (t - 2));
            const Level level = soft->at_separation(touch - depth);
            if (k > 0)
                work += 0.5 * (level.force + last.force) * (last.separation - level.separation);
            last = level;
        }
        return End{(soft->energy() + last.energy_lost) / work - 1, last.force,
                   last.energy_lost / work};
    };
    const int steps = model.elements ? 30 : 60;
    const End a = run(steps), b = run(2 * steps), c = run(4 * steps);
    CHECK(c.lost > 0.1 && std::abs(c.balance) < (model.elements ? 3e-4 : 1e-4) &&
          std::abs(c.balance) < 0.3 * std::max(std::abs(a.balance), std::abs(b.balance)));
    const double order = std::abs(a.force - b.force) / std::abs(b.force - c.force);
    if (!model.elements) CHECK(std::abs(order - 4) < 0.3);
    CHECK(std::abs(b.force - c.force) < 3e-3 * c.force);
}

// Levels far apart in time, under separations and under forces, are reached in steps: as by 20
// levels on the way.
void test_far_apart(const Kind& model) {
    constexpr double bound = 0.011;  // that of TimeSteps
    const auto elastic = make(model, {});
    const double touch = elastic->first_touch(),
                 unit = 0.4 * elastic->at_separation(touch - model.depth).force;
    const auto run = [&](int parts, bool by_force) {
        const auto soft = make(model, kBody);
        std::vector<double> values;
        double last = by_force ? 0.3 : 0.2;
        (void)(by_force ? soft->at_force(last * unit)
                        : soft->at_separation(touch - last * model.depth));
        for (const double next : {1.0, 1.0, 0.6, 0.1}) {
            Level level;
            for (int k = 1; k <= parts; ++k) {
                soft->set_time(soft->time() + 4.0 / parts);
                const double to = last + (next - last) * k / parts;
                level = by_force ? soft->at_force(to * unit)
                                 : soft->at_separation(touch - to * model.depth);
            }
            values.push_back(by_force ? touch - level.separation : level.force);
            values.push_back(level.energy_lost);
            last = next;
        }
        return values;
    };
    for (const bool by_force : {false, true}) {
        const auto coarse = run(1, by_force), fine = run(20, by_force);
        for (const auto k : indices(fine)) CHECK_RELATIVE(coarse[k], fine[k], bound);
    }
}

// A level below full contact is refused on the way, and leaves nothing behind. What a contact
// remembers: test_guest_state.
void test_refused(const Kind& model) {
    const auto soft = make(model, kBody);
    const double touch = soft->first_touch();
    (void)soft->at_separation(touch - model.depth);
    const Path::State before = soft->state();
    soft->set_time(5);
    CHECK_THROWS((void)soft->at_separation(touch - 1e3 * model.depth), Error);
    const Path::State after = soft->state();
    CHECK(after.history == before.history && after.time == before.time);
    Path::State other_bodies = soft->state();
    other_bodies.history = {0.0, 3.0};
    CHECK_THROWS(soft->restore(other_bodies), Error);
    // A load that the body carries with a gap at first closes it later.
    const double nearly = make(model, {})->at_separation(5e-4).force;
    const auto pressed = make(model, kBody);
    CHECK(pressed->at_force(nearly).area_fraction < 1);
    pressed->set_time(10);
    const Level closed = pressed->at_force(nearly);
    CHECK(closed.converged && closed.area_fraction == 1);
    CHECK(pressed->at_force(0.1 * nearly).converged);
}

// The deflections are those of the elastic contact while the indenter is held, at once and after
// long, as only the forces relax. Those left by a contact that ended are the instantaneous body's
// under the loads of the retardations, and fade.
void test_deflections(const Kind& model) {
    const auto soft = make(model, kBody), elastic = make(model, {});
    CHECK(!elastic->remains(Level{}).lasting_loads);
    const auto kernel = make_kernel(Interaction::point, substrate_of(elastic->indenter()),
                                    elastic->indenter().period);
    const double touch = elastic->first_touch(), Z0 = touch - model.depth;
    const Level e = elastic->at_separation(Z0);
    const auto at = [&](const Level& level, double x) {
        return deflection(level, *kernel, x, 0.35);
    };
    const auto as_elastic = [&](const Level& level, double share) {
        const Level lasting = *soft->remains(level).lasting_loads;
        for (const double x : {0.05, 0.45, 0.9})
            CHECK_CLOSE(at(lasting, x), share * at(e, x), 1e-6 * std::abs(at(e, 0.45)));
    };
    double time = 0;
    for (int k = 0; k < 8; ++k, soft->set_time(time += 1e4)) as_elastic(soft->at_separation(Z0), 1);
    // Released at once after a long hold: the loads of the retardations alone are left, 1 - 0.3 of
    // those of the relaxed body.
    soft->set_time(time = soft->time() - 1e4 + 1e-9);
    const Level released = soft->at_separation(touch + 5 * model.depth);
    CHECK(released.force == 0);
    as_elastic(released, 0.7);
    soft->set_time(time + 1e4);
    as_elastic(soft->at_separation(touch + 5 * model.depth), 0);
}

TEST(relaxing_contact) {
    for (const Kind& kind : kModels) {
        test_growing(kind);
        test_limits(kind);
        test_path(kind);
        test_far_apart(kind);
        if (kind.elements && kind.periodic) test_refused(kind);
        test_deflections(kind);
    }
}

}  // namespace test_relaxing_contact
