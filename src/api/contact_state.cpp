// Creation, copy, commit and rollback of a contact.

#include "api/guard.hpp"
#include "api/handles.hpp"

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
    const Indenter& indenter = contact.contact.indenter();
    SurfaceDomain domain = contact.on->domain;
    if (indenter.period.finite() || indenter.repeats.finite())
        return {onto(x0, domain.x0, domain.Lx), onto(y0, domain.y0, domain.Ly)};
    if (const Rectangle& known = contact.options.surface; known.known()) {
        domain = {known.x0, known.y0, known.Lx, known.Ly};
        domain.guessed = false;
    }
    require_tip_above(domain, indenter.shape, x0, y0);
    return {x0, y0};
}

Indenter surrounded(Indenter indenter, const SurfaceDomain& domain) {
    if (!domain.repeats || indenter.period.finite()) return indenter;
    indenter.repeats = {domain.Lx, domain.Ly};
    indenter.x0 = onto(indenter.x0, domain.x0, domain.Lx),
    indenter.y0 = onto(indenter.y0, domain.y0, domain.Ly);
    return indenter;
}

namespace {

// If the tip stays, earlier levels are kept as better initial guesses.
void put_tip(rsc_contact& contact, double x0, double y0) {
    const Indenter& now = contact.contact.indenter();
    if (now.x0 != x0 || now.y0 != y0) contact.contact.move_tip(x0, y0);
}

}  // namespace
}  // namespace rsc::api

rsc_contact::rsc_contact(std::shared_ptr<const rsc::SurfaceModel> on_,
                         std::shared_ptr<const rsc::Case> keys_, const rsc::Indenter& indenter)
    : on(std::move(on_)),
      keys(std::move(keys_)),
      options(rsc::solver_of(*keys, domain_of(*keys, *on))),
      model(rsc::make_contact(*on, indenter, options)),
      contact(*model),
      judge(options, rsc::JudgedSurface{on->points.get()}),
      committed(state()) {}

rsc_contact::rsc_contact(const rsc_contact& like)
    : rsc_contact(like.on, like.keys, like.contact.indenter()) {
    given = like.given;
}

const rsc_contact::Known& rsc_contact::answer() {
    if (!known.level || !std::isnan(known.lateral.x)) return known;
    rsc::Indenter tip = contact.indenter();
    tip.x0 = known.x0, tip.y0 = known.y0;
    known.lateral = rsc::lateral_force(tip, *known.level);
    known.moment = rsc::tip_moment(tip, *known.level);
    return known;
}

rsc_contact::State rsc_contact::state() const {
    return {contact.indenter().x0, contact.indenter().y0, contact.memory(), known};
}

void rsc_contact::go_back(const State& state) {
    const bool path = contact.path_dependent();
    const bool moves = contact.indenter().x0 != state.x0 || contact.indenter().y0 != state.y0;
    if (contact.pulls() || (path && moves))
        contact.forget();  // what is replaced below would follow the tip
    put_tip(*this, state.x0, state.y0);
    known = state.known;
    if (path)
        recall(state.memory);
    else
        recalled =
            !known
                 .level;  // an elastic contact restores its level only when more results are needed
}

void rsc_contact::recall(const std::vector<double>& memory) {
    const double x0 = contact.indenter().x0, y0 = contact.indenter().y0;
    if (known.level && !contact.pulls()) {  // with adhesion the memory has the tip
        if (contact.path_dependent() && (known.x0 != x0 || known.y0 != y0))
            contact.forget();  // what it holds would follow the tip
        put_tip(*this, known.x0, known.y0);
    }
    contact.recall(memory, known.level ? &*known.level : nullptr);
    const bool moves = contact.indenter().x0 != x0 || contact.indenter().y0 != y0;
    if (known.level && moves && std::isnan(known.level->stiffness))
        known.level->stiffness = contact.stiffness();  // lost by the move
    put_tip(*this, x0, y0);
    recalled = true;
}

int32_t rsc_contact_copy(rsc_contact** contact, const rsc_contact* original) {
    return constructed(0, contact, "contact", [&] {
        require(original, 2, "original");
        auto made = std::make_unique<rsc_contact>(*original);
        made->go_back(original->state());
        made->contact.set_time(original->contact.time());
        made->committed = original->committed;
        return made.release();
    });
}

int32_t rsc_contact_commit(rsc_contact* contact) {
    return on(contact, "contact", 0, [&] { contact->committed = contact->state(); });
}

int32_t rsc_contact_rollback(rsc_contact* contact) {
    return on(contact, "contact", 0, [&] { contact->go_back(contact->committed); });
}
