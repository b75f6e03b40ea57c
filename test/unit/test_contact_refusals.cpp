// What a contact, its laws, its sums and its friction refuse, and the values just right beside them.
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
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
using List = std::vector<double>;
const List kNotFinite{kNaN, kInfinity, -kInfinity}, kNotPositive{0, -1, kNaN}, kNotPositiveFinite{0, -1, kInfinity, kNaN};

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

SolverOptions with(double tolerance, Hardness hardness = {}) {
    SolverOptions o;
    o.tolerance = tolerance, o.hardness = hardness;
    return o;
}
void asperities(const Indenter& tip, const SolverOptions& options = {}) {
    const Asperities a = summits();
    AsperityContact(a, tip, options).at_separation(0.009);
}
void elements(const Indenter& tip, const SolverOptions& options = with(1e-6), const HeightMap& map = bumps()) {
    make_element_contact(map, tip, options)->at_separation(0.005);
}

// Each wrong value is bad input, with this word in its message; each right one is taken.
void refuses(const char* word, const List& wrong, const List& right, const std::function<void(double)>& act) {
    const auto said = [&](double v) -> std::string {
        try {
            act(v);
        } catch (const Error& e) {
            return e.kind() == Failure::bad_input ? e.what() : "another kind of failure";
        }
        return {};
    };
    for (const double v : wrong) {
        const std::string text = said(v);
        if (text.find(word) == std::string::npos) std::printf("%s, %g: '%s'\n", word, v, text.c_str());
        CHECK(text.find(word) != std::string::npos);
    }
    for (const double v : right) {
        if (!said(v).empty()) std::printf("%s, %g is right: '%s'\n", word, v, said(v).c_str());
        CHECK(said(v).empty());
    }
}
#define REFUSES(word, wrong, right, ...) refuses(word, wrong, List right, [=]([[maybe_unused]] double v) { __VA_ARGS__; })

void numbers() {
    REFUSES("E*", kNotPositiveFinite, ({1e-3, 1e12}), asperities({v, 2, 0.5, 0.5, {}}));
    REFUSES("E*", kNotPositiveFinite, ({1e-3, 1e12}), elements({v, 2, 0.5, 0.5, {}}));
    REFUSES("radius", kNotPositive, ({1e-3, kFlat}), asperities({1, v, 0.5, 0.5, {}}));
    REFUSES("radius", kNotPositive, ({1e-3, kFlat}), elements({1, v, 0.5, 0.5, {}}));
    REFUSES("two flats", (List{1, 1e300}), ({kFlat}), asperities({1, v, 0, 0, {1, 1}}));
    REFUSES("two flats", (List{1, 1e300}), ({kFlat}), elements({1, v, 0, 0, {0.8, 0.6}}));
    REFUSES("tolerance", (List{0, -1e-6, kNaN}), ({1e-9, 1e-2}), elements({1, 2, 0.5, 0.5, {}}, with(v)));
    REFUSES("empty", (List{0, -1}), ({1, 8}), HeightMap map = bumps(); map.nx = static_cast<int>(v);
            elements({1, 2, 0, 0, {}}, with(1e-6), map));
    REFUSES("empty", (List{0, -1}), ({1, 6}), HeightMap map = bumps(); map.ny = static_cast<int>(v);
            elements({1, 2, 0, 0, {}}, with(1e-6), map));
    REFUSES("empty", kNotPositive, ({0.1}), elements({1, 2, 0, 0, {}}, with(1e-6), bumps(8, v, 0.1)));
    REFUSES("empty", kNotPositive, ({0.1}), elements({1, 2, 0, 0, {}}, with(1e-6), bumps(8, 0.1, v)));
    REFUSES("32 times", (List{4.125}), ({4.0}), elements({1, 2, 0, 0, {}}, with(1e-6), bumps(8, v, 0.125)));
    REFUSES("32 times", (List{4.125}), ({4.0}), elements({1, 2, 0, 0, {}}, with(1e-6), bumps(8, 0.125, v)));
    REFUSES("hardness", kNotPositive, ({0.3, kInfinity}), elements({1, 2, 0, 0, {}}, with(1e-6, {v, 0})));
    REFUSES("size_effect", (List{1e-9, 1}), ({0}), elements({1, 2, 0, 0, {}}, with(1e-6, {0.3, v})));
    REFUSES("hardness", kNotPositive, ({0.3, kInfinity}), asperities({1, 2, 0.5, 0.5, {}}, with(1e-6, {v, 0})));
    REFUSES("size_effect", (List{-1e-9, kInfinity, kNaN}), ({0, 1}), asperities({1, 2, 0.5, 0.5, {}}, with(1e-6, {0.3, v})));
    REFUSES("ratio", (List{1 - 1e-15, 0, -2, kInfinity, kNaN}), ({1, 1e6}), ellipse_factors(v));
    REFUSES("sides", kNotPositiveFinite, ({0.25, 4}), Lattice({v, 1}));
    REFUSES("sides", kNotPositiveFinite, ({0.25, 4}), Lattice({1, v}));
    REFUSES("4 times", (List{4.5}), ({4}), Lattice({v, 1}));
    REFUSES("4 times", (List{4.5}), ({4}), Lattice({1, v}));
    REFUSES("relative error", (List{0.02}), ({1e-2, 1e-10}), const double x[] = {0, 1}; MeshPotential(2, x, x, v));
    REFUSES("point 2", (List{kNaN, kInfinity}), ({1}), const double x[] = {0, v}, y[] = {0, 1}; MeshPotential(2, x, y, 1e-3);
            MeshPotential(2, y, x, 1e-3));
    REFUSES("target point 2", (List{kInfinity}), ({2}), const double x[] = {0, 0}, y[] = {1, v}, zero = 0; double phi[2];
            pair_potential(2, x, y, 1, &zero, &zero, x, phi));
    REFUSES("source point 1", (List{-kInfinity}), ({2}), const double x[] = {v}, y[] = {1}, zero = 0; double phi[1];
            pair_potential(1, &zero, &zero, 1, x, y, y, phi); pair_potential_single(1, &zero, &zero, 1, x, y, y, phi));
    REFUSES("contact point 2", (List{kNaN}), ({2}), const double x[] = {0, v}, y[] = {0.25, 0.5}; PairSet().assign(2, x, y));
    REFUSES("too far apart", (List{1.5e308}), ({1e307}), const double x[] = {-v, v}, y[] = {0, 0}; PairSet().assign(2, x, y));
    REFUSES("body 1", kNotPositive, ({1, kInfinity}), equivalent_modulus({v, 1}, {0, 0}));
    REFUSES("body 2", kNotPositive, ({1, kInfinity}), equivalent_modulus({1, v}, {0, 0}));
    REFUSES("body 1", (List{-1.001, 0.501, kNaN}), ({-0.999, 0.5}), tangential_ratio({1, 1}, {v, 0}));
    REFUSES("body 2", (List{-1.001, 0.501, kNaN}), ({-1, 0.5}), equivalent_modulus({1, 1}, {0, v}));
    REFUSES("rigid", (List{kInfinity}), ({1e9}), equivalent_modulus({kInfinity, v}, {0, 0}));
    REFUSES("body 1", kNotPositive, ({1, kInfinity}), equivalent_radius({v, 1}));
    REFUSES("body 2", kNotPositive, ({1, kInfinity}), equivalent_radius({1, v}));
}

// Of a contact of any model.
void contacts() {
    static const Asperities two = summits();
    static const HeightMap map = bumps();
    for (int model = 0; model < 3; ++model) {
        const auto made = [model]() -> std::unique_ptr<Contact> {
            if (model == 0) return std::make_unique<AsperityContact>(two, Indenter{2, 3, 0.5, 0.4, {}}, SolverOptions{});
            return make_element_contact(map, model == 1 ? Indenter{2, 3, 0.5, 0.4, {}} : Indenter{2, kFlat, 0, 0, {map.Lx(), map.Ly()}},
                                        with(1e-6));
        };
        REFUSES("separation", kNotFinite, ({0.008, 1e300}), made()->at_separation(v));
        REFUSES("force", kNotPositiveFinite, ({1e-9, 1e-5}), made()->at_force(v));
        REFUSES("tip", kNotFinite, ({0.3, -7}), made()->move_tip(v, 0));
        REFUSES("tip", kNotFinite, ({0.3, -7}), made()->move_tip(0, v));
    }
    REFUSES("no asperity", (List{3, -2}), ({0.5, -0.55}), AsperityContact(two, {2, 1, v, 0.5, {}}, {}).at_force(1e-6));
    REFUSES("no asperity", (List{3, -2}), ({0.5, -0.9}), ElementContact(map, {2, 1, 0.4, v, {}}, with(1e-6)).at_force(1e-6));
}

void friction() {
    static const Asperities one{{0.5}, {0.5}, {0}, {1e-2}, {}, {}, {}, {}};
    static AsperityContact a(one, {2, kFlat, 0.5, 0.5, {}}, {}), b(one, {2, kFlat, 0.5, 0.5, {}}, {});
    static ContactCurve curve(a, b);
    const Friction half{0.5, 0.8};
    const double N = curve.load(1e-3).force;
    const List negative{-1e-9, kInfinity, kNaN}, none{0, -1};
    REFUSES("coefficient", negative, ({0, 3}), FrictionHistory({v, 1}));
    REFUSES("ratio", kNotPositiveFinite, ({1e-3, 2}), FrictionHistory({0.1, v}));
    REFUSES("coefficient", negative, ({0, 3}), slide_to(curve, {v, 1}, 1e-3, {0.1}));
    REFUSES("coefficient", negative, ({0, 3}), slide_at_force(curve, {v, 1}, 1e-3, 0));
    REFUSES("coefficient", negative, ({0, 3}), slide_cycle(curve, {v, 1}, 1e-3, 20));
    REFUSES("finite", kNotFinite, ({1e-3, -1}), FrictionHistory(half).go_to(curve, v, {}));
    REFUSES("finite", kNotFinite, ({1e-3, -1}), FrictionHistory(half).go_to(curve, 1e-3, {v, 0}));
    REFUSES("finite", kNotFinite, ({1e-3, -1}), FrictionHistory(half).go_to(curve, 1e-3, {0, v}));
    REFUSES("approach", (List{kInfinity, kNaN}), ({1e-3}), slide_to(curve, half, v, {0.1}));
    REFUSES("no contact", none, ({1e-3}), slide_to(curve, half, v, {0.1}));
    REFUSES("no contact", none, ({1e-3}), slide_at_force(curve, half, v, 0));
    REFUSES("no contact", none, ({1e-3}), slide_cycle(curve, half, v, 20));
    REFUSES("slide", negative, ({0, 7}), slide_to(curve, half, 1e-3, {0.1, v}));
    REFUSES("mu N", (List{-1e-9, 1 + 1e-12, kNaN}), ({0, 0.3, 1}), slide_at_force(curve, half, 1e-3, v * 0.5 * N));
}

}  // namespace

TESTS {
    numbers();
    contacts();
    friction();
}
