// Contacts: levels, their results, and the deflection of the surface around them.

#include "api/guard.hpp"
#include "api/handles.hpp"
#include "contact/deflection.hpp"
#include "surface/asperities.hpp"

namespace rsc::api {
namespace {

// The level statuses of rsc.h are those of contact/level.hpp.
static_assert(kLevelStatusNames.size() == RSC_LEVEL_LAST_ + 1 &&
              int(LevelStatus::converged) == RSC_LEVEL_CONVERGED &&
              int(LevelStatus::out_of_validity) == RSC_LEVEL_OUT_OF_VALIDITY &&
              int(LevelStatus::overlapping) == RSC_LEVEL_OVERLAPPING &&
              int(LevelStatus::not_unique) == RSC_LEVEL_NOT_UNIQUE &&
              int(LevelStatus::not_converged) == RSC_LEVEL_NOT_CONVERGED);

void require_contact_keys(const Case& settings) {
    require_valid(settings, {"solver", "solids%resistivity", "solids%relaxation_share",
                             "solids%relaxation_time", "asperities%law", "indentation%selection",
                             "indentation%selection_factor", "surface%sigma", "surface%L"});
}

// Asperities, and points for elements, are made for one solver%model: a case with the other model
// is refused. 'auto' accepts both.
void require_model(const SurfaceModel& on, const Case& settings, int argument) {
    if (settings.solver.model == ModelKind::automatic) return;
    const bool elements = settings.solver.model == ModelKind::elements;
    if (elements && !on.points)
        refuse(argument, "a_case",
               "has solver%model = 'elements', but the asperities were made without it");
    if (!elements && on.points)
        refuse(
            argument, "a_case",
            "has solver%model = 'asperities', but these were made with solver%model = 'elements'");
}

const char kNoState[] = "the solver found no state: there are no results";

// The last level, also one for which the solver found no state, whose values are not-a-number.
const Level& last_level_of(const rsc_contact* contact) {
    require(contact, 1, "contact");
    if (!contact->path.level())
        throw Outcome{
            RSC_NO_RESULT,
            "the contact has no result yet: call rsc_contact_indent or rsc_contact_press first"};
    return *contact->path.level();
}

const Level& level_of(const rsc_contact* contact) {
    const Level& level = last_level_of(contact);
    if (std::isnan(level.force)) throw Outcome{RSC_NO_RESULT, kNoState};
    return level;
}

// Reaches a level by `go`. After an exception the contact has no result; a level that did not
// converge is kept with that status.
template <class Go>
void reach(rsc_contact& contact, bool by_force, Go&& go) {
    (void)go(contact.path);
    contact.judge.judge(*contact.path.level(), contact.path, by_force);
}

void put_finite(double* to, double value) {
    if (std::isnan(value)) throw Outcome{RSC_NO_RESULT, "the level has no such value"};
    if (!std::isfinite(value))
        throw Outcome{RSC_NO_RESULT, "the result overflows double precision: choose other units"};
    put(to, value);
}

void tell_convergence(const rsc_contact& contact) {
    const Level& level = *contact.path.level();
    if (level.converged) return;
    if (level.fallback == Fallback::held)
        throw Outcome{RSC_NOT_CONVERGED,
                      "no state has this force: the result is the level of smallest force"};
    if (level.fallback == Fallback::jump)
        throw Outcome{
            RSC_NOT_CONVERGED,
            "the force jumps over this one: the result is a state at one side of the jump"};
    if (std::isnan(level.force)) throw Outcome{RSC_NOT_CONVERGED, kNoState};
    throw Outcome{
        RSC_NOT_CONVERGED,
        "the solver did not reach its tolerance; the results are those of its last iterate"};
}

// Computes a quantity of the last level, which has a state, if it does not come with the solution.
void compute(rsc_contact& contact, const LevelQuantity& quantity) {
    if (!quantity.compute) return;
    (void)level_of(&contact);
    LevelSource source = source_of(contact);
    if (const char* const none = quantity.compute(source)) throw Outcome{RSC_NO_RESULT, none};
}

double computed(rsc_contact& contact, std::string_view name) {
    const auto found = find_quantity(name);
    compute(contact, *found->quantity);
    return found->of(*contact.path.level());
}

QuantityComponent quantity_of(const char* name) {
    require(name, 2, "name");
    const auto found = find_quantity(name);
    if (!found) refuse(2, "name", "must be one of ", names_of_quantities());
    return *found;
}

}  // namespace
}  // namespace rsc::api

using namespace rsc;
using namespace rsc::api;

int32_t rsc_contact_create(rsc_contact** contact, const rsc_asperities* asperities, double E_star,
                           double R, double x0, double y0, const rsc_case* a_case) {
    return constructed(7, contact, "contact", [&] {
        require(asperities, 2, "asperities");
        if (!usable_positive(E_star)) refuse(3, "E_star", kPositiveBounds);
        if (!usable_positive(R) && !(R > 0 && std::isinf(R)))
            refuse(4, "R", "must be from 1e-50 to 1e50, or Infinity");
        require_finite(x0, 5, "x0");
        require_finite(y0, 6, "y0");
        const Case& settings = settings_of(a_case);
        require_contact_keys(settings);
        if (!settings.solids.layer_thickness.empty())
            refuse(7, "a_case",
                   "has layers, which one modulus E* does not describe: use "
                   "rsc_contact_create_from_case");
        if (settings.indenter.shape != 0)
            refuse(7, "a_case",
                   "has a shape other than a sphere: use rsc_contact_create_from_case");
        const auto& on = asperities->model;
        require_model(*on, settings, 7);
        const SurfaceDomain domain = domain_of(settings, *on);
        const Indenter indenter{E_star, R, x0, y0, period_of(settings, domain)};
        auto made = std::make_unique<rsc_contact>(on, std::make_shared<const Case>(settings),
                                                  surrounded(indenter, domain));
        made->given = {E_star, R};
        return made.release();
    });
}

int32_t rsc_contact_create_from_case(rsc_contact** contact, const rsc_asperities* asperities,
                                     const rsc_case* a_case) {
    return constructed(3, contact, "contact", [&] {
        require(asperities, 2, "asperities");
        const Case& settings = settings_of(a_case);
        require_contact_keys(settings);
        require_valid(settings, {"solids", "indenter"});
        const auto& on = asperities->model;
        require_model(*on, settings, 3);
        const SurfaceDomain domain = domain_of(settings, *on);
        return new rsc_contact(on, std::make_shared<const Case>(settings),
                               surrounded(indenter_of(settings, domain), domain));
    });
}

int32_t rsc_contact_destroy(rsc_contact** contact) { return destroyed(contact, "contact"); }

int32_t rsc_contact_move_tip(rsc_contact* contact, double x0, double y0) {
    return on(contact, "contact", 2, [&] {
        require_finite(x0, 2, "x0");
        require_finite(y0, 3, "y0");
        const Vec2 place = place_of(*contact, x0, y0);
        const Indenter& now = contact->path.indenter();
        if (place.x == now.x0 && place.y == now.y0) return;
        // Contacts with a memory follow the tip at once: what can be asked of the last level is
        // computed before.
        if (contact->path.path_dependent() && contact->path.level()) {
            LevelSource source = source_of(*contact);
            compute_quantities(source);
        }
        contact->path.move_tip(place.x, place.y);
    });
}

int32_t rsc_contact_tip(const rsc_contact* contact, double* x0, double* y0) {
    return on(contact, "contact", 0, [&] {
        put(x0, contact->path.indenter().x0);
        put(y0, contact->path.indenter().y0);
    });
}

int32_t rsc_contact_first_touch(const rsc_contact* contact, double* separation) {
    return on(contact, "contact", 0, [&] {
        require(separation, 2, "separation");
        const double touch = contact->path.first_touch();
        if (!std::isfinite(touch)) refuse(1, "contact", "has no asperity under its sphere");
        put(separation, touch);
    });
}

int32_t rsc_contact_indent(rsc_contact* contact, double separation, double* force) {
    return on(contact, "contact", 2, [&] {
        require_finite(separation, 2, "separation");
        // The present level is not computed again, unless the state may have changed on a way of
        // the tip there and back.
        Path& path = contact->path;
        const Indenter& tip = path.indenter();
        const Vec2 place = path.place_of_level();
        const bool same = path.level() && path.level()->separation == separation &&
                          place.x == tip.x0 && place.y == tip.y0 && !path.pulls() &&
                          (path.clock() == PathClock::none || path.level()->time == path.time() ||
                           path.level()->distance == path.time());
        if (!same) reach(*contact, false, [&](Path& p) { return p.at_separation(separation); });
        put(force, path.level()->force);
        tell_convergence(*contact);
    });
}

int32_t rsc_contact_set_time(rsc_contact* contact, double time) {
    return on(contact, "contact", 2, [&] {
        require_finite(time, 2, "time");
        if (contact->path.relaxes()) contact->path.set_time(time);
    });
}

int32_t rsc_contact_set_distance(rsc_contact* contact, double distance) {
    return on(contact, "contact", 2, [&] {
        require_finite(distance, 2, "distance");
        if (contact->path.clock() == PathClock::distance) contact->path.set_time(distance);
    });
}

int32_t rsc_contact_press(rsc_contact* contact, double force, double* separation) {
    return on(contact, "contact", 2, [&] {
        const bool pulls = contact->path.pulls();
        if (!(force >= 0 || pulls)) refuse(2, "force", "must be positive or zero");
        require_finite(force, 2, "force");
        const double touch = contact->path.first_touch();
        if (!std::isfinite(touch))
            refuse(1, "contact", "has no asperity under its sphere, so its force is always 0");
        const bool by_force = force > 0 || pulls;
        reach(*contact, by_force, [&](Path& path) {
            return by_force ? path.at_force(force) : path.at_separation(touch);
        });
        put(separation, contact->path.level()->separation);
        tell_convergence(*contact);
    });
}

int32_t rsc_contact_result(const rsc_contact* contact, double* separation, double* force,
                           double* area, int64_t* contacts) {
    return guarded(0, [&] {
        const Level& level = level_of(contact);
        put(separation, level.separation);
        put(force, level.force);
        put(area, level.area);
        put(contacts, level.asperity.size());
    });
}

int32_t rsc_contact_level(const rsc_contact* contact, int32_t* level_status, int64_t* candidates,
                          int64_t* iterations, int64_t* overlapping_pairs, double* residual) {
    return guarded(0, [&] {
        const Level& level = last_level_of(contact);
        put(level_status, level.status);
        put(candidates, level.candidates);
        put(iterations, level.iterations);
        put(overlapping_pairs, level.overlapping_pairs);
        put(residual, level.residual);
    });
}

int32_t rsc_contact_stiffness(rsc_contact* contact, double* stiffness) {
    return guarded(0, [&] {
        (void)level_of(contact);
        require(stiffness, 2, "stiffness");
        put_finite(stiffness, computed(*contact, "stiffness"));
    });
}

int32_t rsc_contact_energy(const rsc_contact* contact, double* energy) {
    return guarded(0, [&] {
        (void)level_of(contact);
        require(energy, 2, "energy");
        put_finite(energy, contact->path.level()->energy);
    });
}

int32_t rsc_contact_answer(rsc_contact* contact, double* separation, double* force,
                           double* stiffness, double* area, double* energy, double* lateral_x,
                           double* lateral_y, int32_t* level_status, int64_t* contacts,
                           int64_t* overlapping_pairs, int64_t* large_contacts, int64_t* beyond_law,
                           int64_t* edge_contacts) {
    return guarded(0, [&] {
        const Level& level = level_of(contact);
        double dN_dZ0 = 0, W = 0;  // nothing is written until all values are known to be finite
        if (stiffness) put_finite(&dN_dZ0, computed(*contact, "stiffness"));
        if (energy) put_finite(&W, level.energy);
        if (lateral_x || lateral_y) (void)computed(*contact, "lateral_force_x");
        put(separation, level.separation);
        put(force, level.force);
        put(stiffness, dN_dZ0);
        put(area, level.area);
        put(energy, W);
        put(lateral_x, level.lateral_x);
        put(lateral_y, level.lateral_y);
        put(level_status, level.status);
        put(contacts, level.contacts);
        put(overlapping_pairs, level.overlapping_pairs);
        put(large_contacts, level.large_contacts);
        put(beyond_law, level.beyond_law);
        put(edge_contacts, level.edge_contacts);
    });
}

int32_t rsc_contact_value(rsc_contact* contact, const char* name, double* value) {
    return guarded(0, [&] {
        const Level& level = last_level_of(contact);
        const QuantityComponent asked = quantity_of(name);
        require(value, 3, "value");
        compute(*contact, *asked.quantity);
        put_finite(value, asked.of(level));
    });
}

int32_t rsc_contact_error(const rsc_contact* contact, const char* name, double* error) {
    return guarded(0, [&] {
        const Level& level = level_of(contact);
        const QuantityComponent asked = quantity_of(name);
        require(error, 3, "error");
        const double expected = asked.error(level);
        if (std::isnan(expected)) throw Outcome{RSC_NO_RESULT, "no error of this value is stated"};
        put(error, expected);
    });
}

int32_t rsc_contact_spots(const rsc_contact* contact, int64_t n, int32_t* asperity, double* force,
                          double* radius, double* penetration) {
    return guarded(0, [&] {
        const Level& level = level_of(contact);
        if (n < static_cast<int64_t>(level.asperity.size())) {
            refuse(2, "n", "must be at least the number of contacts, ", level.asperity.size());
        }
        if (asperity) std::ranges::copy(level.asperity, asperity);
        if (force) std::ranges::copy(level.f, force);
        if (radius) std::ranges::copy(level.a, radius);
        if (penetration) std::ranges::copy(level.u, penetration);
    });
}

int32_t rsc_contact_per_asperity(const rsc_contact* contact, int64_t n, double* force,
                                 double* radius, double* penetration) {
    return guarded(0, [&] {
        const Level& level = level_of(contact);
        if (contact->on->points)
            refuse(1, "contact", "has no asperities: it is solved by boundary elements");
        if (n != static_cast<int64_t>(contact->path.asperities()->size()))
            refuse(2, "n",
                   "must be the number of the contact's asperities (rsc_contact_asperities)");
        const auto spread = [&](double* output, const std::vector<double>& values) {
            if (!output) return;
            std::fill(output, output + n, 0.0);
            for (const auto k : indices(values)) output[level.asperity[k]] = values[k];
        };
        spread(force, level.f);
        spread(radius, level.a);
        spread(penetration, level.u);
    });
}

int32_t rsc_contact_asperities(rsc_asperities** asperities, const rsc_contact* contact) {
    return constructed(0, asperities, "asperities", [&] {
        require(contact, 2, "contact");
        const auto touched = contact->path.asperities();
        if (!touched) refuse(2, "contact", "has no asperities: it is solved by boundary elements");
        SurfaceModel model;
        model.asperities = *touched;
        model.domain = contact->on->domain;
        model.statistics = contact->on->statistics;
        model.list = contact->on->list;
        auto made = std::make_unique<rsc_asperities>();
        made->model = std::make_shared<const SurfaceModel>(std::move(model));
        return made.release();
    });
}

int32_t rsc_contact_deflection(const rsc_contact* contact, int64_t n, const double* x,
                               const double* y, double* deflection) {
    return guarded(0, [&] {
        const Level& last = level_of(contact);
        if (n < 0) refuse(2, "n", "must not be negative");
        if (n == 0) return;
        require_finite(x, n, 3, "x");
        require_finite(y, n, 4, "y");
        require(deflection, 5, "deflection");
        const Indenter indenter = contact->path.indenter_at_level();
        const auto kernel =
            make_kernel(Interaction::point, substrate_of(indenter), indenter.period);
        const std::optional<Level> lasting = contact->path.remains(last).lasting_loads;
        const Level& level = lasting ? *lasting : last;
        for (int64_t i = 0; i < n; ++i) {
            const Vec2 place = indenter.image(x[i], y[i]);
            deflection[i] = rsc::deflection(level, *kernel, place.x, place.y);
        }
    });
}
