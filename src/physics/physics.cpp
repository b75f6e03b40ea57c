#include "physics/physics.hpp"

#include "base/error.hpp"
#include "physics/adhesion/adhesion.hpp"
#include "physics/flow/flow_row.hpp"
#include "physics/friction/friction_row.hpp"
#include "physics/hardness/hardness.hpp"
#include "physics/relaxation/relaxing_asperities.hpp"
#include "physics/stress/stress_row.hpp"
#include "physics/wear/wear.hpp"

namespace rsc {
namespace {

const Physics* const kAll[] = {&kHardness, &kRelaxation, &kWear,  &kAdhesion,
                               &kFriction, &kFlow,       &kStress};

const Physics* named(std::string_view name) {
    for (const Physics* p : kAll)
        if (name == p->name) return p;
    return nullptr;
}

}  // namespace

std::span<const Physics* const> all_physics() { return kAll; }

std::span<const char* const> field_names() {
    static const std::vector<const char*> all = [] {
        std::vector<const char*> names = {"pressure", "gap", "contact", "heights"};
        for (const Physics* p : kAll)
            for (const PointField& f : p->fields) names.push_back(f.name);
        return names;
    }();
    return all;
}

bool has_field(const Case& settings, std::string_view name) {
    return std::ranges::any_of(settings.output.fields,
                               [&](double f) { return field_names()[at(f)] == name; });
}

std::size_t AskedCurves::values() const {
    std::size_t sum = 0;
    for (const LevelCurve& c : physics->curves) sum += axis.size > 0 ? c.count(axis) : 0;
    return sum;
}

std::size_t values_of(std::span<const AskedCurves> all) {
    std::size_t sum = 0;
    for (const AskedCurves& a : all) sum += a.values();
    return sum;
}

BodyPhysics physics_of(const Case& settings) {
    BodyPhysics bodies;
    for (const Physics* p : kAll) p->take(settings, bodies);
    return bodies;
}

std::vector<const Physics*> physics_asked(const BodyPhysics& bodies) {
    std::vector<const Physics*> asked;
    for (const Physics* p : kAll)
        if (p->asked(bodies)) asked.push_back(p);
    return asked;
}

std::vector<const Physics*> physics_asked(const Case& settings) {
    return physics_asked(physics_of(settings));
}

bool any_physics(const Case& settings, bool Physics::*has) {
    return std::ranges::any_of(physics_asked(settings), [&](const Physics* p) { return p->*has; });
}

double largest_pressure(const Case& settings, double radius) {
    const BodyPhysics bodies = physics_of(settings);
    double most = kInfinity;
    for (const Physics* p : physics_asked(bodies))
        if (p->largest_pressure) most = std::min(most, p->largest_pressure(bodies, radius));
    return most;
}

bool path_dependent(const Case& settings) {
    return std::ranges::any_of(physics_asked(settings),
                               [](const Physics* p) { return p->path != nullptr; });
}

void find_exclusions(const Combination& all, const Complain& refuse) {
    for (const Physics* p : physics_asked(all.bodies))
        for (const Exclusion& x : p->excludes) {
            const Physics* const other = named(x.other);
            if ((other && !other->asked(all.bodies)) || (x.when && !x.when(all))) continue;
            const std::string key = other ? other->key : x.other;
            const std::string law =
                key == "asperities%law" ? joined(" = '", kLawNames[at(all.law)], "'") : "";
            refuse({x.key ? x.key : p->key, key},
                   joined("not available together with ", key, law, *x.why ? "; " : "", x.why));
        }
}

}  // namespace rsc
