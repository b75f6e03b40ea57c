// What is behind the handles of rsc.h.
#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string_view>

#include "case/case.hpp"
#include "contact/contact_curve.hpp"
#include "contact/friction.hpp"
#include "contact/lateral.hpp"
#include "rsc.h"
#include "run/prepare.hpp"

struct rsc_case {
    rsc::Case settings;
};

struct rsc_surface {
    rsc::Surface surface;
};

struct rsc_asperities {
    std::shared_ptr<const rsc::Ground> ground;  // shared with the contacts made from it
};

struct rsc_contact {
    rsc_contact(std::shared_ptr<const rsc::Ground> on_, const rsc::Indenter& indenter, const rsc::SolverOptions& options_)
        : on(std::move(on_)), options(options_), model(rsc::make_contact(*on, indenter, options)), contact(*model) {}
    std::shared_ptr<const rsc::Ground> on;
    rsc::SolverOptions options;
    std::unique_ptr<rsc::Contact> model;
    rsc::Contact& contact;
    std::optional<rsc::Level> level;
    // Of that level; the tip may have moved since.
    bool moved = false;
    double energy = 0;
    rsc::Vec2 lateral, moment;
    double resistivity[2] = {0, 0};  // of the case it was made from
};

struct rsc_friction {
    rsc_friction(const rsc_contact& like, const rsc::Friction& friction)
        : outer(like.on, like.contact.indenter(), like.options),
          inner(like.on, like.contact.indenter(), like.options),
          curve(outer.contact, inner.contact),
          history(friction) {}
    rsc_contact outer, inner;  // two ends of the path's memory
    rsc::ContactCurve curve;
    rsc::FrictionHistory history;
};

namespace rsc::api {

// The settings of a case, or the defaults for null.
const Case& settings_of(const rsc_case* a_case);

// Throws Error(bad_input) if check_case finds fault with keys of these groups, or of these keys ("group%key").
void require_sound(const Case& settings, std::initializer_list<std::string_view> names);

int threads_of(const Case& settings);

}  // namespace rsc::api
