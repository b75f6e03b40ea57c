// The objects behind the handles of rsc.h.
#pragma once

#include "case/case.hpp"
#include "contact/contact_curve.hpp"
#include "contact/friction.hpp"
#include "contact/lateral.hpp"
#include "rsc.h"
#include "run/prepare.hpp"

namespace rsc::api {

// The first member of every handle: identifies its kind while it exists, so that released handles and those of another kind are recognised
// as long as their memory can be read.
template <std::uint64_t kKind>
struct Tag {
    Tag() = default;
    Tag(const Tag&) {}
    Tag& operator=(const Tag&) { return *this; }
    ~Tag() { kind = 0; }
    bool sound() const { return kind == kKind; }
    volatile std::uint64_t kind = kKind;  // volatile: a compiler leaves out what is written before memory is released
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
    // The keys of the case decide on all but the indenter. Throws Error(bad_input) for keys that are refused.
    rsc_contact(std::shared_ptr<const rsc::SurfaceModel> on, std::shared_ptr<const rsc::Case> keys, const rsc::Indenter& indenter);
    explicit rsc_contact(const rsc_contact& like);  // the same one without a result
    std::shared_ptr<const rsc::SurfaceModel> on;
    std::shared_ptr<const rsc::Case> keys;
    std::optional<std::array<double, 2>> given;  // E* and R given to rsc_contact_create; none: those of the case
    rsc::SolverOptions options;
    std::unique_ptr<rsc::Contact> model;
    rsc::Contact& contact;
    // The last level and what is known of it.
    struct Known {
        std::optional<rsc::Level> level;
        double x0 = 0, y0 = 0;  // where the tip was; it may have moved since
        double energy = 0;
        rsc::Vec2 lateral, moment;
    };
    Known known;
    bool recalled = true;  // `contact` speaks of that level; false: recall() has to be called first

    // All that the next level depends on, and the last one.
    struct State {
        double x0 = 0, y0 = 0;       // the tip
        std::vector<double> memory;  // Contact::memory()
        Known known;
    };
    State state() const;
    void go_back(const State& state);
    void recall(const std::vector<double>& memory = {});
    State committed;  // at first as it was made
};

struct rsc_friction {
    rsc::api::Tag<0x7273635f66726963> tag;
    rsc_friction(const rsc_contact& like, const rsc::Friction& friction)
        : outer(like),
          inner(like),
          curve(outer.contact, inner.contact),
          history(friction),
          committed_tip{like.contact.indenter().x0, like.contact.indenter().y0} {}
    rsc_contact outer, inner;  // two ends of the path's memory
    rsc::ContactCurve curve;
    rsc::FrictionHistory history;
    rsc::Vec2 committed_tip;  // of history's committed state
};

namespace rsc::api {

// The settings of a case, or the defaults for null.
const Case& settings_of(const rsc_case* a_case);

// Throws Error(bad_input) if check_case finds fault with keys of these groups, or of these keys ("group%key").
void require_sound(const Case& settings, std::initializer_list<std::string_view> names);

int threads_of(const Case& settings);

// The place of the tip as the contact has it: on a surface that repeats moved by whole periods onto its rectangle. Refuses argument 2
// unless the tip may be put there.
Vec2 place_of(const rsc_contact& contact, double x0, double y0);

// An indenter of the library can go round a surface that repeats.
Indenter surrounded(Indenter indenter, const SurfaceDomain& domain);

// For asperities given one by one the case says how large the surface is (surface%L).
SurfaceDomain domain_of(const Case& settings, const SurfaceModel& on);

}  // namespace rsc::api
