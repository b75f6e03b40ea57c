// A tip that moves sideways over points that attract (physics/adhesion/adhesive_elements.hpp).
#include "base/error.hpp"
#include "check.hpp"
#include "contact/answers.hpp"
#include "contact/make.hpp"
#include "physics/indenter/shapes.hpp"
#include "support/adhesive_paths.hpp"
#include "support/height_maps.hpp"

namespace test_adhesive_tips {

using namespace rsc;

constexpr double kWork = 0.01, kPlace = 0.7;

// A surface with the period `side`, of waves, or of none if they have no height. It begins `turned`
// points later.
HeightMap waves(int n, double side, double height, int turned = 0) {
    HeightMap map = height_map(n, n, side / n, side / n, [=](int i, int j) {
        const double x = 10 * pi / n * (i + turned + 0.5), y = 10 * pi / n * (j + 0.5);
        return height * (std::cos(x) + std::cos(y) + 0.6 * std::cos(x + 2 * y + 1) +
                         0.5 * std::sin(2 * x - y));
    });
    map.periodic = true;
    map.x0 = (turned + 0.5) * map.dx;
    map.y0 = 0.5 * map.dy;
    return map;
}

Indenter sphere(double x, double side) {
    Indenter tip{1.0, 1.0, x, 0.5 * side};
    tip.repeats = {side, side};
    return tip;
}

struct Moved {
    Level level;
    double energy, work;  // of the lateral force, by the trapezoidal rule
};

// The tip goes to x in steps, at the separation Z.
Moved move(Path& contact, double Z, double x, int steps) {
    Moved moved{contact.at_separation(Z), 0, 0};
    const double from = contact.indenter().x0;
    double force = lateral_force(contact.indenter(), moved.level).x;
    for (int k = 1; k <= steps; ++k) {
        contact.move_tip(k < steps ? from + (x - from) * k / steps : x, contact.indenter().y0);
        moved.level = contact.at_separation(Z);
        const double next = lateral_force(contact.indenter(), moved.level).x;
        moved.work -= 0.5 * (force + next) * (x - from) / steps;
        force = next;
    }
    moved.energy = contact.energy();
    return moved;
}

// The state does not depend on how a way is cut; over a closed cycle of many steps the work of the
// lateral force is the energy lost.
TEST(test_cycle) {
    const HeightMap map = waves(40, 2, 0.02);
    const SolverOptions options = sticky(kWork, 0.12);
    std::vector<double> forces, losses;
    for (const int steps : {1, 32}) {
        const auto contact = make_element_contact(map, sphere(kPlace, 2), options);
        (void)contact->at_separation(0);
        (void)move(*contact, 0, kPlace + 0.25, steps);
        const Moved begin = move(*contact, 0, kPlace, steps),
                    there = move(*contact, 0, kPlace + 0.25, steps),
                    back = move(*contact, 0, kPlace, steps);
        CHECK(there.level.contacts > 0 &&
              std::abs(there.level.force / back.level.force - 1) > 0.01);
        CHECK_RELATIVE(back.energy, begin.energy, 1e-9);
        forces.push_back(there.level.force);
        losses.push_back(back.level.energy_lost - begin.level.energy_lost);
        CHECK_RELATIVE(forces.back(), forces.front(), 1e-9);
        // Edges move continuously: nothing jumps here.
        if (steps == 32) CHECK_CLOSE(there.work + back.work, losses.back(), 1e-4 * kWork);
    }
    for (const double loss : losses) CHECK(loss == losses.back());
}

// Over the border of a surface that repeats the tip takes the short way, as over the middle of a
// map that begins elsewhere.
TEST(test_border) {
    const HeightMap map = waves(36, 2, 0.02), other = waves(36, 2, 0.02, 18);
    const auto one = make_element_contact(map, sphere(1.9, 2), sticky(kWork, 0.1)),
               two = make_element_contact(other, sphere(1.9, 2), sticky(kWork, 0.1));
    for (Path* contact : {one.get(), two.get()}) {
        contact->move_tip(1.8, 1.0);
        (void)contact->at_separation(0);
    }
    double lost = one->at_separation(0).energy_lost, first = 0;
    for (const double x :
         {0.1, 1.9}) {  // and back over the border; the long way would lose several times as much
        one->move_tip(x, 1.0);
        two->move_tip(x, 1.0);
        const Level a = one->at_separation(0), b = two->at_separation(0);
        CHECK(a.force != 0 && a.contacts == b.contacts);
        CHECK_RELATIVE(a.force, b.force, 1e-9);
        CHECK_RELATIVE(a.energy_lost, b.energy_lost, 1e-6);
        first = first > 0 ? first : a.energy_lost - lost;
        CHECK(a.energy_lost - lost <= 2 * first);
        lost = a.energy_lost;
        CHECK_RELATIVE(lateral_force(one->indenter(), a).x, lateral_force(two->indenter(), b).x,
                       1e-6);
    }
}

// A contact goes on from its memory after a move, and with another map as its body between flats.
TEST(test_memory) {
    const HeightMap map = waves(32, 2, 0.02), face = waves(32, 2, 0.01, 7);
    ShapeKeys keys;
    keys.map = std::make_shared<HeightMap>(face.copy());
    Indenter flats{1.0, make_shape(shape_number("map"), keys), kPlace, 1.0};
    flats.period = {2, 2};
    for (const Indenter& tip : {sphere(kPlace, 2), flats}) {
        const double Z = tip.period.finite() ? 0.07 : 0.0;
        const auto contact = make_element_contact(map, tip, sticky(kWork, 0.12)),
                   other = make_element_contact(map, tip, sticky(kWork, 0.12));
        (void)contact->at_separation(Z);
        contact->move_tip(kPlace + 0.25, 1.1);
        other->restore(contact->state());
        CHECK(other->indenter().x0 == contact->indenter().x0 && other->indenter().y0 == 1.1);
        CHECK_RELATIVE(other->energy(), contact->energy(), 1e-8);
        for (Path* one : {contact.get(), other.get()}) one->move_tip(kPlace + 0.1, 0.9);
        const Level a = contact->at_separation(Z), b = other->at_separation(Z);
        CHECK(a.force != 0 && contact->indenter().x0 == kPlace + 0.1);
        CHECK_RELATIVE(a.force, b.force, 1e-8);
        CHECK_RELATIVE(a.energy_lost, b.energy_lost, 1e-6);
    }
}

// A punch cannot be moved over points that attract at its edge; the attempt leaves no trace.
TEST(test_edge) {
    const HeightMap map = waves(32, 2, 0.02);
    ShapeKeys keys;
    keys.radius = 0.6;
    const auto contact = make_element_contact(
        map, {1.0, make_shape(shape_number("punch"), keys), 1.0, 1.0}, sticky(kWork, 0.12));
    const Level before = contact->at_separation(0.03);
    const std::vector<double> history = contact->state().history;
    CHECK_THROWS(contact->move_tip(1.2, 1.0), Error);
    CHECK(contact->indenter().x0 == 1.0 && contact->state().history == history);
    CHECK_RELATIVE(contact->at_separation(0.03).force, before.force, 1e-9);
    (void)contact->at_separation(0.5);  // pulled off
    contact->move_tip(1.2, 1.0);
    CHECK(contact->indenter().x0 == 1.2);
    // A sphere whose edge comes to a step of nearly its height after some pieces of the way.
    HeightMap step = waves(32, 2, 0.02);
    for (const int j : indices(32))
        for (const int i : indices(32)) step.row(j)[i] += step.x0 + i * step.dx > 1.3 ? 0.95 : 0.0;
    const auto sphere = make_element_contact(step, {1.0, 1.0, 0.25, 1.0}, sticky(kWork, 0.12));
    (void)sphere->at_separation(0);
    const double energy = sphere->energy(), stiffness = sphere->stiffness();
    CHECK_THROWS(sphere->move_tip(0.6, 1.0), Error);
    CHECK(sphere->indenter().x0 == 0.25 && stiffness < 0);
    CHECK_RELATIVE(sphere->energy(), energy, 1e-6);
    CHECK_RELATIVE(sphere->stiffness(), stiffness, 1e-6);
}

// A tip above a low half of a surface, where nothing attracts, moves over a high half: what it
// loses and what it does are counted.
TEST(test_climb) {
    HeightMap map = waves(28, 2, 0);
    for (const int j : indices(28))
        for (int i = 14; i < 28; ++i) map.row(j)[i] = 0.5;
    const auto contact = make_element_contact(map, {1.0, 1.0, 0.2, 1.0}, sticky(kWork, 0.1));
    CHECK(contact->at_separation(0.25).force == 0);
    contact->move_tip(1.5, 1.0);
    const Level there = contact->at_separation(0.25);
    CHECK(there.force > 0 && there.energy_lost > -1e-3 * std::abs(contact->energy()));
    contact->move_tip(0.2, 1.0);
    const Level back = contact->at_separation(0.25);
    CHECK(back.force == 0 && back.energy_lost > there.energy_lost);
}

// Between flats, a bump beside the tip: its force acts at the bump, including that of points that
// attract without contact.
TEST(test_moment) {
    HeightMap map = waves(32, 2, 0);
    const double x = map.x0 + 10 * map.dx, y = map.y0 + 13 * map.dy;
    for (const int j : indices(32))
        for (const int i : indices(32))
            map.row(j)[i] =
                0.3 *
                std::exp(-8 * (std::pow((i - 10) * map.dx, 2) + std::pow((j - 13) * map.dy, 2)));
    const Indenter flats{1.0, kInfinity, 1.0, 1.0, {2, 2}};
    const auto contact = make_element_contact(map, flats, sticky(kWork, 0.12));
    (void)contact->at_separation(0.25);
    for (const double Z : {0.25, 0.35}) {
        const Level level = contact->at_separation(Z);
        CHECK(level.cohesive_area > 0);
        const Vec2 moment = tip_moment(flats, level);
        CHECK_RELATIVE(moment.x, level.force * (y - flats.y0), 1e-6);
        CHECK_RELATIVE(moment.y, -level.force * (x - flats.x0), 1e-6);
    }
}

}  // namespace test_adhesive_tips
