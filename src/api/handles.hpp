// The objects behind the handles of rsc.h.
#pragma once

#include "case/registry.hpp"
#include "contact/answers.hpp"
#include "physics/friction/contact_curve.hpp"
#include "physics/friction/element_friction.hpp"
#include "physics/friction/friction.hpp"
#include "problem/bodies.hpp"
#include "rsc.h"
#include "trust/judge.hpp"

namespace rsc::api {

// The first member of every handle: identifies its kind during its lifetime, so that released
// handles and those of another kind are recognised as long as their memory can be read.
template <std::uint64_t kKind>
struct Tag {
    Tag() = default;
    Tag(const Tag&) {}
    Tag& operator=(const Tag&) { return *this; }
    ~Tag() { kind = 0; }
    bool sound() const { return kind == kKind; }
    // volatile: compilers omit stores before memory is released
    volatile std::uint64_t kind = kKind;
};

}  // namespace rsc::api

struct rsc_case {
    rsc::api::Tag<0x7273635f63617365> tag;
    rsc::Case settings;
};

struct rsc_surface {
    rsc::api::Tag<0x7273635f68656967> tag;
    rsc::Surface surface;
};

struct rsc_asperities {
    rsc::api::Tag<0x7273635f61737065> tag;
    std::shared_ptr<const rsc::SurfaceModel> model;  // shared with the contacts made from it
};

struct rsc_contact {
    rsc::api::Tag<0x7273635f636f6e74> tag;
    // All but the indenter is determined by the keys of the case. Throws Error(bad_input) for
    // invalid keys.
    rsc_contact(std::shared_ptr<const rsc::SurfaceModel> on, std::shared_ptr<const rsc::Case> keys,
                const rsc::Indenter& indenter);
    rsc_contact(const rsc_contact& like, const rsc::Indenter& indenter);  // without a result
    std::shared_ptr<const rsc::SurfaceModel> on;
    std::shared_ptr<const rsc::Case> keys;
    std::optional<std::array<double, 2>>
        given;  // E* and R of rsc_contact_create; none: those of the case
    rsc::SolverOptions options;
    // With which the contact was made. A model takes units from the gap under it, so that copies
    // are made with it, too.
    rsc::Indenter first;
    std::unique_ptr<rsc::Path> owned;
    rsc::Path& path;
    rsc::Judge judge;
    rsc::Path::State committed;  // initially the new contact
    // Also of a state before the first move of the tip.
    void restore(const rsc::Path::State& state);
};

struct rsc_friction {
    rsc::api::Tag<0x7273635f66726963> tag;
    rsc_friction(const rsc_contact& like, const rsc::Indenter& indenter,
                 const rsc::Friction& friction)
        : outer(like, indenter),
          inner(like, indenter),
          curve(outer.path, inner.path),
          history(friction),
          elements(on_elements(outer, friction)),
          committed(state()) {}
    // All that later answers depend on, to the last bit.
    struct State {
        rsc::FrictionHistory::State path;
        rsc::Path::State outer, inner;
        std::array<bool, 2> known;  // ContactCurve::known()
        rsc::ElementFriction::State elements;
    };
    State state() const {
        return {history.state(), outer.path.state(), inner.path.state(), curve.known(),
                elements ? elements->state() : rsc::ElementFriction::State{}};
    }
    static std::unique_ptr<rsc::ElementFriction> on_elements(rsc_contact& contact,
                                                             const rsc::Friction& friction);
    void restore(const State& state);
    rsc_contact outer, inner;  // the outer and inner end of the memory of the path
    rsc::ContactCurve curve;
    rsc::FrictionHistory history;
    std::unique_ptr<rsc::ElementFriction>
        elements;     // on `outer`, instead of these; null: asperities
    State committed;  // initially the new contact
};

namespace rsc::api {

// The last level, with what its quantities are computed from.
LevelSource source_of(rsc_contact& contact);

// The settings of a case, or the defaults for null.
const Case& settings_of(const rsc_case* a_case);

int threads_of(const Case& settings);

// The position of the tip for the contact: on a periodic surface moved by whole periods onto its
// rectangle. Refuses argument 2 for a position outside the surface.
Vec2 place_of(const rsc_contact& contact, double x0, double y0);

// The indenter of a contact of the library, which can move across the borders of a periodic
// surface.
Indenter surrounded(Indenter indenter, const SurfaceDomain& domain);

// For asperities from arrays the size of the surface is that of the case (surface%L).
SurfaceDomain domain_of(const Case& settings, const SurfaceModel& on);

}  // namespace rsc::api
