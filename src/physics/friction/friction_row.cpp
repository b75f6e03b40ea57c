#include "physics/friction/friction_row.hpp"
#include "base/format.hpp"

namespace rsc {
namespace {

std::vector<Key> friction_keys() {
    using namespace keys;
    return {
        number(RSC_KEY(solids, friction), "1", kNotNegative,
               "coefficient of friction mu; if above 0, the result has the tangential force at "
               "each level (one realization only)"),
    };
}

void check_friction(const Case& settings, const Complain& complain) {
    if (settings.solids.friction > 0 && settings.run.realizations > 1)
        complain({"run%realizations"}, "only one with solids%friction > 0");
}

// Dundurs' second parameter, which couples the normal and the tangential problem; 0 for equal
// bodies.
double coupling(const Case::Solids& s) {
    const auto compliance = [&](int i) {
        return std::isinf(s.E[i]) ? 0.0 : 2 * (1 + s.nu[i]) / s.E[i];
    };  // 1/G
    const double above = (1 - 2 * s.nu[0]) * compliance(0) - (1 - 2 * s.nu[1]) * compliance(1);
    const double below = 2 * ((1 - s.nu[0]) * compliance(0) + (1 - s.nu[1]) * compliance(1));
    return above / below;
}

void print_coupling(std::ostream& out, const RunFacts& run) {
    constexpr double much = 0.05;
    const double beta = coupling(run.settings.solids);
    if (std::abs(beta) > much)
        out << format(
            "  friction between unlike bodies: the coupling of pressure and tangential "
            "displacement (Dundurs' beta = %.2f) is neglected in the tangential forces.\n",
            beta);
}

}  // namespace

const Physics kFriction = {
    .name = "friction",
    .key = "solids%friction",
    .keys = friction_keys,
    .take = [](const Case& c, BodyPhysics& bodies) { bodies.friction = c.solids.friction; },
    .asked = [](const BodyPhysics& bodies) { return bodies.friction > 0; },
    .excludes = {{"solids%layer_thickness", "it is not for layers",
                  [](const Combination& c) { return c.layers; }}},
    .check = check_friction,
    .calibrated = [](const BodyPhysics&, bool) { return true; },  // levels do not depend on it
    .remark = print_coupling,
};

}  // namespace rsc
