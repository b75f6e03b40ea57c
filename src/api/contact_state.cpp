// Creation, copy, commit and rollback of a contact.

#include "api/guard.hpp"
#include "api/handles.hpp"

using namespace rsc;
using namespace rsc::api;

namespace rsc::api {

SurfaceDomain domain_of(const Case& settings, const SurfaceModel& on) {
    return on.list && settings.surface.L
               ? list_domain(on.asperities, settings.surface.L, "the asperities")
               : on.domain;
}

namespace {

double onto(double v, double first, double length) {
    if (v >= first && v < first + length) return v;
    const double beyond = std::fmod(v - first, length);
    return first + (beyond < 0 ? beyond + length : beyond);
}

}  // namespace

Vec2 place_of(const rsc_contact& contact, double x0, double y0) {
    const Indenter& indenter = contact.path.indenter();
    SurfaceDomain domain = contact.on->domain;
    if (indenter.period.finite() || indenter.repeats.finite())
        return {onto(x0, domain.x0, domain.Lx), onto(y0, domain.y0, domain.Ly)};
    if (indenter.period.along_x()) x0 = onto(x0, domain.x0, domain.Lx);
    if (indenter.period.along_y()) y0 = onto(y0, domain.y0, domain.Ly);
    if (const Rectangle& known = contact.options.surface.extent; known.known()) {
        domain = {{known.x0, known.y0, known.Lx, known.Ly}, {}};
    }
    require_tip_above(domain, indenter.shape, x0, y0);
    return {x0, y0};
}

LevelSource source_of(rsc_contact& contact) {
    const auto& resistivity = contact.keys->solids.resistivity;
    return {contact.path,
            *contact.path.level(),
            {resistivity[0], resistivity[1]},
            &contact.options.physics,
            contact.on->points.get()};
}

Indenter surrounded(Indenter indenter, const SurfaceDomain& domain) {
    if (!domain.repeats || indenter.period.finite() || indenter.period.line()) return indenter;
    indenter.repeats = {domain.Lx, domain.Ly};
    indenter.x0 = onto(indenter.x0, domain.x0, domain.Lx);
    indenter.y0 = onto(indenter.y0, domain.y0, domain.Ly);
    return indenter;
}

}  // namespace rsc::api

rsc_contact::rsc_contact(std::shared_ptr<const SurfaceModel> on_, std::shared_ptr<const Case> keys_,
                         const Indenter& indenter)
    : on(std::move(on_)),
      keys(std::move(keys_)),
      options(solver_of(*keys, domain_of(*keys, *on))),
      first(indenter),
      owned(make_contact(*on, first, options)),
      path(*owned),
      judge(options, JudgedSurface{on->points.get(), on->curvature, on->measured.get(),
                                   on->domain.x0, on->domain.y0}),
      committed(path.state()) {}

rsc_contact::rsc_contact(const rsc_contact& like, const Indenter& indenter)
    : rsc_contact(like.on, like.keys, indenter) {
    given = like.given;
}

void rsc_contact::restore(const Path::State& state) {
    const Indenter& now = path.indenter();
    if (now.repeats.finite() && now.around.finite() != state.moved) {
        Indenter tip = first;
        tip.around = state.moved ? tip.repeats : Period{};
        path = std::move(*make_contact(*on, tip, options));
    }
    path.restore(state);
}

int32_t rsc_contact_copy(rsc_contact** contact, const rsc_contact* original) {
    return constructed(0, contact, "contact", [&] {
        require(original, 2, "original");
        auto made = std::make_unique<rsc_contact>(*original, original->first);
        made->restore(original->path.state());
        made->committed = original->committed;
        return made.release();
    });
}

int32_t rsc_contact_commit(rsc_contact* contact) {
    return on(contact, "contact", 0, [&] { contact->committed = contact->path.state(); });
}

int32_t rsc_contact_rollback(rsc_contact* contact) {
    return on(contact, "contact", 0, [&] { contact->restore(contact->committed); });
}
