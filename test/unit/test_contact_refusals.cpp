// What a contact, its laws, its sums and its friction refuse: the whole sentence and the kind; and what is just right beside it is taken.
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "check.hpp"
#include "contact/asperity_contact.hpp"
#include "contact/contact_curve.hpp"
#include "contact/element_contact.hpp"
#include "contact/equivalent.hpp"
#include "contact/interaction/lattice.hpp"
#include "contact/interaction/mesh.hpp"
#include "contact/interaction/pairs.hpp"
#include "contact/law/ellipse.hpp"
#include "contact/law/hardness.hpp"
#include "error.hpp"

using namespace rsc;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFlat = kInfinity;

struct Refusal {
    const char* said;
    std::function<void(double)> act;
    std::vector<double> wrong, right;
    Failure kind = Failure::bad_input;
};

Asperities summits() {
    Asperities a;
    a.x = {0.4, 0.6}, a.y = {0.5, 0.3}, a.z = {0.01, 0.012}, a.radius = {1e-3, 2e-3};
    return a;
}

HeightMap bumps(int nx = 8, double dx = 0.1, double dy = 0.1) {
    HeightMap map;
    map.allocate(nx, 6, nx);
    map.dx = dx, map.dy = dy;
    for (int j = 0; j < 6; ++j)
        for (int i = 0; i < nx; ++i) map.row(j)[i] = 0.01 * std::cos(1.3 * i + j * j);
    return map;
}

void asperities(const Indenter& tip, const SolverOptions& options = {}) {
    const Asperities a = summits();
    AsperityContact(a, tip, options).at_separation(0.009);
}
SolverOptions of_elements(double tolerance = 1e-6, Hardness hardness = {}) {
    SolverOptions o;
    o.tolerance = tolerance, o.hardness = hardness;
    return o;
}
void elements(const Indenter& tip, const SolverOptions& options = of_elements(), const HeightMap& map = bumps()) {
    make_element_contact(map, tip, options)->at_separation(0.005);
}

// Of a contact of either model.
std::vector<Refusal> of_contacts() {
    static const Asperities two = summits();
    static const HeightMap map = bumps();
    std::vector<Refusal> all;
    for (int model = 0; model < 3; ++model) {
        const auto made = [model]() -> std::unique_ptr<Contact> {
            if (model == 0) return std::make_unique<AsperityContact>(two, Indenter{2, 3, 0.5, 0.4, {}}, SolverOptions{});
            return make_element_contact(map, model == 1 ? Indenter{2, 3, 0.5, 0.4, {}} : Indenter{2, kFlat, 0, 0, {map.Lx(), map.Ly()}},
                                        of_elements());
        };
        all.push_back(
            {"the separation must be finite", [=](double v) { made()->at_separation(v); }, {kNaN, kInfinity, -kInfinity}, {0.008, 1e300}});
        all.push_back(
            {"the force must be positive and finite", [=](double v) { made()->at_force(v); }, {0, -1, kNaN, kInfinity}, {1e-9, 1e-5}});
        all.push_back(
            {"the tip's position must be finite", [=](double v) { made()->move_tip(v, 0); }, {kNaN, kInfinity, -kInfinity}, {0.3, -7}});
        all.push_back(
            {"the tip's position must be finite", [=](double v) { made()->move_tip(0, v); }, {kNaN, kInfinity, -kInfinity}, {0.3, -7}});
    }
    all.push_back({"no asperity lies under the sphere: no force can be carried",
                   [](double x0) {
                       AsperityContact(two, {2, 1, x0, 0.5, {}}, {}).at_force(1e-6);
                   },
                   {3, -2},
                   {0.5, -0.55}});
    all.push_back({"no asperity lies under the sphere: no force can be carried",
                   [](double y0) {
                       ElementContact(map, {2, 1, 0.4, y0, {}}, of_elements()).at_force(1e-6);
                   },
                   {3, -2},
                   {0.5, -0.9}});
    return all;
}

const Refusal kRefusals[] = {
    {"E* must be positive and finite",
     [](double v) {
         asperities({v, 2, 0.5, 0.5, {}});
     },
     {0, -1, kInfinity, kNaN},
     {1e-3, 1e12}},
    {"E* must be positive and finite",
     [](double v) {
         elements({v, 2, 0.5, 0.5, {}});
     },
     {0, -1, kInfinity, kNaN},
     {1e-3, 1e12}},
    {"the sphere's radius must be positive (Infinity: flat)",
     [](double v) {
         asperities({1, v, 0.5, 0.5, {}});
     },
     {0, -1, kNaN},
     {1e-3, kFlat}},
    {"the sphere's radius must be positive (Infinity: flat)",
     [](double v) {
         elements({1, v, 0.5, 0.5, {}});
     },
     {0, -1, kNaN},
     {1e-3, kFlat}},
    {"a periodic contact is one of two flats: both radii must be Infinity",
     [](double v) {
         asperities({1, v, 0, 0, {1, 1}});
     },
     {1, 1e300},
     {kFlat}},
    {"a periodic contact is one of two flats: both radii must be Infinity",
     [](double v) {
         elements({1, v, 0, 0, {0.8, 0.6}});
     },
     {1, 1e300},
     {kFlat}},
    {"the tolerance must be positive",
     [](double v) {
         elements({1, 2, 0.5, 0.5, {}}, of_elements(v));
     },
     {0, -1e-6, kNaN},
     {1e-9, 1e-2}},
    {"elements: the map of heights is empty",
     [](double v) {
         HeightMap map = bumps();
         map.nx = static_cast<int>(v);
         elements({1, 2, 0, 0, {}}, of_elements(), map);
     },
     {0, -1},
     {1, 8}},
    {"elements: the map of heights is empty",
     [](double v) {
         HeightMap map = bumps();
         map.ny = static_cast<int>(v);
         elements({1, 2, 0, 0, {}}, of_elements(), map);
     },
     {0, -1},
     {1, 6}},
    {"elements: the map of heights is empty",
     [](double v) {
         elements({1, 2, 0, 0, {}}, of_elements(), bumps(8, v, 0.1));
     },
     {0, -1, kNaN},
     {0.1}},
    {"elements: the map of heights is empty",
     [](double v) {
         elements({1, 2, 0, 0, {}}, of_elements(), bumps(8, 0.1, v));
     },
     {0, -1, kNaN},
     {0.1}},
    {"elements: pixels of 4.125000 by 0.125000 are longer than 32 times their width",
     [](double v) {
         elements({1, 2, 0, 0, {}}, of_elements(), bumps(8, v, 0.125));
     },
     {4.125},
     {4.0}},
    {"elements: pixels of 0.125000 by 4.125000 are longer than 32 times their width",
     [](double v) {
         elements({1, 2, 0, 0, {}}, of_elements(), bumps(8, 0.125, v));
     },
     {4.125},
     {4.0}},
    {"solids%hardness must be positive (Infinity: elastic)",
     [](double v) {
         elements({1, 2, 0, 0, {}}, of_elements(1e-6, {v, 0}));
     },
     {0, -1, kNaN},
     {0.3, kInfinity}},
    {"solids%size_effect: elements have no radius to scale the hardness by; give the hardness that holds",
     [](double v) {
         elements({1, 2, 0, 0, {}}, of_elements(1e-6, {0.3, v}));
     },
     {1e-9, 1},
     {0}},
    {"solids%hardness must be positive (Infinity: elastic)",
     [](double v) {
         asperities({1, 2, 0.5, 0.5, {}}, of_elements(1e-6, {v, 0}));
     },
     {0, -1, kNaN},
     {0.3, kInfinity}},
    {"solids%size_effect must not be negative",
     [](double v) {
         asperities({1, 2, 0.5, 0.5, {}}, of_elements(1e-6, {0.3, v}));
     },
     {-1e-9, kInfinity, kNaN},
     {0, 1}},
    {"the ratio of the principal curvatures of a summit must be finite and at least 1",
     [](double v) { ellipse_factors(v); },
     {1 - 1e-15, 0, -2, kInfinity, kNaN},
     {1, 1e6}},
    {"the sides of a periodic surface must be positive and finite",
     [](double v) {
         Lattice({v, 1});
     },
     {0, -1, kInfinity, kNaN},
     {0.25, 4}},
    {"the sides of a periodic surface must be positive and finite",
     [](double v) {
         Lattice({1, v});
     },
     {0, -1, kInfinity, kNaN},
     {0.25, 4}},
    {"a periodic surface with sides 4.500000 and 1.000000: the longer may be at most 4 times the shorter",
     [](double v) {
         Lattice({v, 1});
     },
     {4.5},
     {4}},
    {"a periodic surface with sides 1.000000 and 4.500000: the longer may be at most 4 times the shorter",
     [](double v) {
         Lattice({1, v});
     },
     {4.5},
     {4}},
    {"mesh product: relative error 0.020000 is outside of 1e-10 to 1e-2",
     [](double v) {
         const double x[] = {0, 1};
         MeshPotential(2, x, x, v);
     },
     {0.02},
     {1e-2, 1e-10}},
    {"mesh product: coordinates of point 2 must be finite",
     [](double v) {
         const double x[] = {0, v}, y[] = {0, 1};
         MeshPotential(2, x, y, 1e-3), MeshPotential(2, y, x, 1e-3);
     },
     {kNaN, kInfinity},
     {1}},
    {"target point 2: coordinates (0.000000, inf) must be finite",
     [](double v) {
         const double x[] = {0, 0}, y[] = {1, v}, zero = 0;
         double phi[2];
         pair_potential(2, x, y, 1, &zero, &zero, x, phi);
     },
     {kInfinity},
     {2}},
    {"source point 1: coordinates (-inf, 1.000000) must be finite",
     [](double v) {
         const double x[] = {v}, y[] = {1}, zero = 0;
         double phi[1];
         pair_potential(1, &zero, &zero, 1, x, y, y, phi), pair_potential_single(1, &zero, &zero, 1, x, y, y, phi);
     },
     {-kInfinity},
     {2}},
    {"contact point 2: coordinates (nan, 0.500000) must be finite",
     [](double v) {
         const double x[] = {0, v}, y[] = {0.25, 0.5};
         PairSet().assign(2, x, y);
     },
     {kNaN},
     {2}},
    {"the points are too far apart: their extent overflows",
     [](double v) {
         const double x[] = {-v, v}, y[] = {0, 0};
         PairSet().assign(2, x, y);
     },
     {1.5e308},
     {1e307}},
    {"Young's modulus of body 1 must be positive (Infinity for a rigid body)",
     [](double v) {
         equivalent_modulus({v, 1}, {0, 0});
     },
     {0, -1, kNaN},
     {1, kInfinity}},
    {"Young's modulus of body 2 must be positive (Infinity for a rigid body)",
     [](double v) {
         equivalent_modulus({1, v}, {0, 0});
     },
     {0, -1, kNaN},
     {1, kInfinity}},
    {"Poisson's ratio of body 1 must be between -1 and 0.5",
     [](double v) {
         tangential_ratio({1, 1}, {v, 0});
     },
     {-1.001, 0.501, kNaN},
     {-0.999, 0.5}},
    {"Poisson's ratio of body 2 must be between -1 and 0.5",
     [](double v) {
         equivalent_modulus({1, 1}, {0, v});
     },
     {-1.001, 0.501, kNaN},
     {-1, 0.5}},
    {"both bodies are rigid: at least one of the moduli E must be finite",
     [](double v) {
         equivalent_modulus({kInfinity, v}, {0, 0});
     },
     {kInfinity},
     {1e9}},
    {"radius of body 1 must be positive (Infinity for a flat body)",
     [](double v) {
         equivalent_radius({v, 1});
     },
     {0, -1, kNaN},
     {1, kInfinity}},
    {"radius of body 2 must be positive (Infinity for a flat body)",
     [](double v) {
         equivalent_radius({1, v});
     },
     {0, -1, kNaN},
     {1, kInfinity}},
};

// What friction asks of its numbers, on a sphere.
std::vector<Refusal> of_friction() {
    static const Asperities one{{0.5}, {0.5}, {0}, {1e-2}, {}, {}, {}, {}};
    static AsperityContact a(one, {2, kFlat, 0.5, 0.5, {}}, {}), b(one, {2, kFlat, 0.5, 0.5, {}}, {});
    static ContactCurve curve(a, b);
    const Friction half{0.5, 0.8};
    const double N = curve.load(1e-3).force;
    const std::string most = "the tangential force must be from 0 to mu N = " + std::to_string(0.5 * N);
    static const std::string kept = most;
    return {
        {"the coefficient of friction must be zero or positive, and finite",
         [](double v) {
             FrictionHistory({v, 1});
         },
         {-1e-9, kInfinity, kNaN},
         {0, 3}},
        {"the ratio m = 4 G*/E* of the tangential to the normal stiffness must be positive and finite",
         [](double v) {
             FrictionHistory({0.1, v});
         },
         {0, -1, kInfinity, kNaN},
         {1e-3, 2}},
        {"the coefficient of friction must be zero or positive, and finite",
         [](double v) {
             slide_to(curve, {v, 1}, 1e-3, {0.1});
         },
         {-1e-9, kInfinity, kNaN},
         {0, 3}},
        {"the coefficient of friction must be zero or positive, and finite",
         [](double v) {
             slide_at_force(curve, {v, 1}, 1e-3, 0);
         },
         {-1e-9, kInfinity, kNaN},
         {0, 3}},
        {"the coefficient of friction must be zero or positive, and finite",
         [](double v) {
             slide_cycle(curve, {v, 1}, 1e-3, 20);
         },
         {-1e-9, kInfinity, kNaN},
         {0, 3}},
        {"approach and slide must be finite", [=](double v) { FrictionHistory(half).go_to(curve, v, {}); }, {kInfinity, kNaN}, {1e-3, -1}},
        {"approach and slide must be finite",
         [=](double v) {
             FrictionHistory(half).go_to(curve, 1e-3, {v, 0});
         },
         {kInfinity, kNaN},
         {1e-3, -1}},
        {"approach and slide must be finite",
         [=](double v) {
             FrictionHistory(half).go_to(curve, 1e-3, {0, v});
         },
         {kInfinity, kNaN},
         {1e-3, -1}},
        {"the approach must be finite", [=](double v) { slide_to(curve, half, v, {0.1}); }, {kInfinity, kNaN}, {1e-3}},
        {"there is no contact yet that could be slid", [=](double v) { slide_to(curve, half, v, {0.1}); }, {0, -1}, {1e-3}},
        {"there is no contact yet that could be slid", [=](double v) { slide_at_force(curve, half, v, 0); }, {0, -1}, {1e-3}},
        {"there is no contact yet that could be slid", [=](double v) { slide_cycle(curve, half, v, 20); }, {0, -1}, {1e-3}},
        {"a slide of first loading must be zero or positive, and finite",
         [=](double v) {
             slide_to(curve, half, 1e-3, {0.1, v});
         },
         {-1e-9, kInfinity, kNaN},
         {0, 7}},
        {kept.c_str(), [=](double v) { slide_at_force(curve, half, 1e-3, v * 0.5 * N); }, {-1e-9, 1 + 1e-12, kNaN}, {0, 0.3, 1}},
        {"a cycle wants steps in multiples of 10",
         [=](double v) { slide_cycle(curve, half, 1e-3, static_cast<int>(v)); },
         {0, 10, 19, 25},
         {20, 30},
         Failure::internal},
    };
}

void try_all(const Refusal& r) {
    for (const double v : r.wrong) {
        std::string said = "nothing";
        Failure kind{};
        try {
            r.act(v);
        } catch (const Error& e) {
            said = e.what(), kind = e.kind();
        }
        if (said == r.said && kind == r.kind) {
            check::that(true, r.said, __FILE__, __LINE__);
            continue;
        }
        std::printf("%g: '%s' instead of '%s'\n", v, said.c_str(), r.said);
        check::that(false, "the refusal", __FILE__, __LINE__);
    }
    for (const double v : r.right) {
        try {
            r.act(v);
            check::that(true, r.said, __FILE__, __LINE__);
        } catch (const Error& e) {
            std::printf("%g beside '%s': '%s'\n", v, r.said, e.what());
            check::that(false, "what is right is taken", __FILE__, __LINE__);
        }
    }
}

}  // namespace

int main() {
    for (const Refusal& r : kRefusals) try_all(r);
    for (const Refusal& r : of_contacts()) try_all(r);
    for (const Refusal& r : of_friction()) try_all(r);
    return check::summary();
}
