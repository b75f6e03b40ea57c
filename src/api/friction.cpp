// Friction: a contact along a path of separations and slides.

#include "api/guard.hpp"
#include "api/handles.hpp"
#include "contact/equivalent.hpp"
#include "surface/asperities.hpp"

namespace rsc::api {
namespace {

constexpr const char* kNoPath = "friction has no path yet: call rsc_friction_update first";

const FrictionHistory& path_of(const rsc_friction* friction) {
    require(friction, 1, "friction");
    if (!(friction->elements ? friction->elements->state().begun : friction->history.state().begun))
        throw Outcome{RSC_NO_RESULT, kNoPath};
    return friction->history;
}

const FrictionHistory& contact_of(const rsc_friction* friction) {
    const FrictionHistory& history = path_of(friction);
    if (friction->elements ? !friction->elements->touches() : history.state().nodes.empty())
        throw Outcome{RSC_NO_RESULT, "friction: there is no contact yet"};
    return history;
}

void require_elastic(const rsc_contact& contact) {
    if (contact.path.path_dependent())
        refuse(2, "contact",
               "must be elastic: friction is not available with hardness or adhesion");
    if (contact.path.indenter().layers.count > 0)
        refuse(2, "contact", "has layers: friction is not available for them yet");
}

// Moves the tip of both contacts of the load curve.
void put_tip(rsc_friction& friction, const Vec2& tip) {
    const Indenter& now = friction.outer.path.indenter();
    if (now.x0 == tip.x && now.y0 == tip.y) return;
    friction.outer.path.move_tip(tip.x, tip.y);
    friction.inner.path.move_tip(tip.x, tip.y);
    friction.curve.forget();
}

const Indenter& tip_of(const rsc_contact* contact) { return contact->path.indenter(); }

// The share of the first level's force on contacts that also exist in the second level.
double shared_force(const Level& first, const Level& second) {
    double shared = 0;
    std::size_t k = 0;
    for (const auto j : indices(first.asperity)) {
        while (k < second.asperity.size() && second.asperity[k] < first.asperity[j]) ++k;
        if (k < second.asperity.size() && second.asperity[k] == first.asperity[j])
            shared += std::min(first.f[j], second.f[k]);
    }
    return std::min(1.0, shared / first.force);
}

void require_solved(bool solved) {
    if (!solved)
        throw Outcome{
            RSC_NOT_CONVERGED,
            "the solver did not reach its tolerance; the results are those of its last iterates"};
}

// Calls a function that computes levels; throws RSC_NOT_CONVERGED if one of them did not converge.
template <class Ask>
void with_levels(rsc_friction& friction, Ask&& ask) {
    const long failed = friction.curve.failed();
    ask();
    require_solved(friction.curve.failed() == failed);
}

// The spots of asperities or of elements.
template <class Spots>
void put_spots(const Spots& spots, std::int64_t n, std::int64_t* count, std::int32_t* asperity,
               double* radius, double* stick_radius, double* force_x, double* force_y) {
    put(count, spots.size());
    if (n < static_cast<int64_t>(spots.size()))
        refuse(2, "n", "must be at least the number of spots, ", spots.size());
    for (const auto k : indices(spots)) {
        if (asperity) asperity[k] = spots[k].asperity;
        if (radius) radius[k] = spots[k].radius;
        if (stick_radius) stick_radius[k] = spots[k].stick_radius;
        if (force_x) force_x[k] = spots[k].force.x;
        if (force_y) force_y[k] = spots[k].force.y;
    }
}

}  // namespace
}  // namespace rsc::api

using namespace rsc;
using namespace rsc::api;

int32_t rsc_tangential_ratio(const double* E, const double* nu, double* ratio) {
    return rsc_stiffness_ratio(E, nu, ratio);
}

int32_t rsc_stiffness_ratio(const double* E, const double* nu, double* ratio) {
    return on(E, "E", 1, [&] {
        require(nu, 2, "nu");
        require(ratio, 3, "ratio");
        for (const int i : indices(2))
            if (!(nu[i] >= -1 && nu[i] <= 0.5)) refuse(2, "nu", "must be between -1 and 0.5");
        const double moduli[2] = {E[0], E[1]}, ratios[2] = {nu[0], nu[1]};
        put(ratio, tangential_ratio(moduli, ratios));
    });
}

int32_t rsc_friction_create(rsc_friction** friction, const rsc_contact* contact, double mu,
                            double ratio) {
    return constructed(3, friction, "friction", [&] {
        require(contact, 2, "contact");
        require_elastic(*contact);
        if (!(mu >= 0) || !usable(mu))
            refuse(3, "mu", "must be zero or positive, and at most 1e50");
        if (!usable_positive(ratio)) refuse(4, "ratio", kPositiveBounds);
        return new rsc_friction(*contact, tip_of(contact), {mu, ratio});
    });
}

int32_t rsc_friction_create_from_case(rsc_friction** friction, const rsc_contact* contact,
                                      const rsc_case* a_case) {
    return constructed(3, friction, "friction", [&] {
        require(contact, 2, "contact");
        require_elastic(*contact);
        const Case& settings = settings_of(a_case);
        require_valid(settings, {"solids"});
        return new rsc_friction(
            *contact, tip_of(contact),
            {settings.solids.friction, tangential_ratio(settings.solids.E, settings.solids.nu)});
    });
}

int32_t rsc_friction_copy(rsc_friction** friction, const rsc_friction* original) {
    return constructed(0, friction, "friction", [&] {
        require(original, 2, "original");
        const rsc_contact& outer = original->outer;
        auto made =
            std::make_unique<rsc_friction>(outer, outer.first, original->history.friction());
        made->restore(original->state());
        made->committed = original->committed;
        return made.release();
    });
}

std::unique_ptr<ElementFriction> rsc_friction::on_elements(rsc_contact& contact,
                                                           const Friction& friction) {
    if (contact.path.asperities()) return nullptr;
    return std::make_unique<ElementFriction>(contact.path, friction, *contact.on->points,
                                             std::min(1e-6, contact.options.tolerance));
}

void rsc_friction::restore(const State& state) {
    outer.restore(state.outer);
    if (elements) elements->restore(state.elements);
    inner.restore(state.inner);
    curve.recall(state.known);
    history.restore(state.path);
}

int32_t rsc_friction_destroy(rsc_friction** friction) { return destroyed(friction, "friction"); }

int32_t rsc_friction_update(rsc_friction* friction, double separation, double x, double y,
                            double* force, double* force_x, double* force_y, double* lost) {
    return on(friction, "friction", 2, [&] {
        require_finite(separation, 2, "separation");
        require_finite(x, 3, "x");
        require_finite(y, 4, "y");
        if (auto* elements = friction->elements.get()) {
            const bool solved = elements->go_to(separation, {x, y});
            put(force, elements->state().load);
            put(force_x, elements->tangential_force().x);
            put(force_y, elements->tangential_force().y);
            put(lost, elements->state().step_lost);
            return require_solved(solved);
        }
        with_levels(*friction, [&] {
            FrictionHistory& history = friction->history;
            history.go_to(friction->curve, -separation, {x, y});
            const Slide Q = history.tangential_force();
            put(force, history.force());
            put(force_x, Q.x);
            put(force_y, Q.y);
            put(lost, history.step_lost());
        });
    });
}

int32_t rsc_friction_move_tip(rsc_friction* friction, double x0, double y0) {
    return on(friction, "friction", 2, [&] {
        require_finite(x0, 2, "x0");
        require_finite(y0, 3, "y0");
        const Vec2 to = place_of(friction->outer, x0, y0);
        const Indenter& indenter = friction->outer.path.indenter();
        const Vec2 before{indenter.x0, indenter.y0};
        if (before.x == to.x && before.y == to.y) return;
        if (friction->elements) return require_solved(friction->elements->move_tip(to.x, to.y));
        with_levels(*friction, [&] {
            FrictionHistory& history = friction->history;
            const double delta = history.approach();
            try {
                const Level here = history.force() > 0 ? friction->curve.level(delta) : Level{};
                put_tip(*friction, to);
                if (history.state().begun)
                    history.move(
                        friction->curve,
                        here.force > 0 ? shared_force(here, friction->curve.level(delta)) : 0);
            } catch (...) {
                put_tip(*friction, before);
                throw;
            }
        });
    });
}

int32_t rsc_friction_stiffness(rsc_friction* friction, double* xx, double* xy, double* yx,
                               double* yy) {
    return on(friction, "friction", 0, [&] {
        if (friction->elements) {
            const auto [x, across, y] = friction->elements->stiffness();
            put(xx, x);
            put(xy, across);
            put(yx, across);
            put(yy, y);
            return;
        }
        with_levels(*friction, [&] {
            const auto tangent = friction->history.stiffness(friction->curve);
            put(xx, tangent.xx);
            put(xy, tangent.xy);
            put(yx, tangent.yx);
            put(yy, tangent.yy);
        });
    });
}

int32_t rsc_friction_state(const rsc_friction* friction, double* separation, double* x, double* y,
                           double* force, double* force_x, double* force_y, double* energy,
                           double* tangential_energy, double* lost, double* stick_separation) {
    return guarded(0, [&] {
        const FrictionHistory& history = path_of(friction);
        if (const auto* elements = friction->elements.get()) {
            const ElementFriction::State& now = elements->state();
            put(separation, now.separation);
            put(x, now.xi.x);
            put(y, now.xi.y);
            put(force, now.load);
            put(force_x, elements->tangential_force().x);
            put(force_y, elements->tangential_force().y);
            put(energy, now.energy);
            put(tangential_energy, elements->tangential_energy());
            put(lost, elements->work_lost());
            put(stick_separation, kNotComputed);
            return;
        }
        const Slide Q = history.tangential_force();
        put(separation, -history.approach());
        put(x, history.slide().x);
        put(y, history.slide().y);
        put(force, history.force());
        put(force_x, Q.x);
        put(force_y, Q.y);
        put(energy, history.normal_energy());
        put(tangential_energy, history.tangential_energy());
        put(lost, history.work_lost());
        put(stick_separation, -history.stick_approach());
    });
}

int32_t rsc_friction_commit(rsc_friction* friction) {
    return on(friction, "friction", 0, [&] { friction->committed = friction->state(); });
}

int32_t rsc_friction_rollback(rsc_friction* friction) {
    return on(friction, "friction", 0, [&] { friction->restore(friction->committed); });
}

int32_t rsc_friction_first_loading(rsc_friction* friction, int64_t n, const double* slide,
                                   double* force, double* stick_separation) {
    return guarded(3, [&] {
        const FrictionHistory& history = contact_of(friction);
        if (n < 0) refuse(2, "n", "must not be negative");
        if (n == 0) return;
        require_finite(slide, n, 3, "slide");
        require(force, 4, "force");
        if (friction->elements) {
            if (stick_separation) std::fill_n(stick_separation, n, kNotComputed);
            return require_solved(friction->elements->slide_to({slide, slide + n}, force));
        }
        with_levels(*friction, [&] {
            const auto points = slide_to(friction->curve, history.friction(), history.approach(),
                                         {slide, slide + n});
            for (const auto k : indices(points)) {
                force[k] = points[k].force;
                if (stick_separation) stick_separation[k] = -points[k].stick_approach;
            }
        });
    });
}

int32_t rsc_friction_slide(rsc_friction* friction, double force, double* slide) {
    return guarded(2, [&] {
        const FrictionHistory& history = contact_of(friction);
        require_finite(force, 2, "force");
        require(slide, 3, "slide");
        if (friction->elements)
            return require_solved(friction->elements->slide_at_force(force, *slide));
        with_levels(*friction, [&] {
            put(slide,
                slide_at_force(friction->curve, history.friction(), history.approach(), force)
                    .displacement);
        });
    });
}

int32_t rsc_friction_full_slip(const rsc_friction* friction, double* slide, double* force) {
    return guarded(0, [&] {
        const FrictionHistory& history = contact_of(friction);
        if (friction->elements) {
            put(slide, friction->elements->full_slip());
            put(force, history.friction().coefficient * friction->elements->state().load);
            return;
        }
        put(slide, full_slip(friction->curve, history.friction(), history.approach()));
        put(force, history.friction().coefficient * history.force());
    });
}

int32_t rsc_friction_spots(rsc_friction* friction, int64_t n, int64_t* count, int32_t* asperity,
                           double* radius, double* stick_radius, double* force_x, double* force_y) {
    return guarded(0, [&] {
        const FrictionHistory& history = path_of(friction);
        const auto give = [&](const auto& spots) {
            put_spots(spots, n, count, asperity, radius, stick_radius, force_x, force_y);
        };
        if (friction->elements) return give(friction->elements->spots());
        with_levels(*friction, [&] { give(slip_of_spots(friction->curve, history)); });
    });
}
