// What is behind the handles of rsc.h.
#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string_view>

#include "case/case.hpp"
#include "contact/contact.hpp"
#include "rough/asperities.hpp"
#include "rough/surface.hpp"
#include "rsc.h"

struct rsc_case {
    rsc::Case settings;
};

struct rsc_surface {
    rsc::HeightMap map;
    double points_per_wave = 0;          // grid steps in the shortest wave of a synthetic surface; 0: not known
    std::optional<rsc::Moments> theory;  // of synthetic surfaces
    double sigma = 0;                    // rms height that is meant: the one asked for, or that of the heights
};

// Asperities with what the surface they come from says of them.
struct rsc_asperities {
    struct Content {
        rsc::Asperities asperities;
        double sigma = 0;         // rms height [length]
        double mean_spacing = 0;  // <d> [length]; 0: not known
        double x_middle = 0, y_middle = 0;
    };
    std::shared_ptr<const Content> content;  // shared with the contacts made from it
};

struct rsc_contact {
    rsc_contact(std::shared_ptr<const rsc_asperities::Content> on_, const rsc::Indenter& indenter, const rsc::SolverOptions& options_)
        : on(std::move(on_)), options(options_), contact(on->asperities, indenter, options) {}
    std::shared_ptr<const rsc_asperities::Content> on;
    rsc::SolverOptions options;
    rsc::Contact contact;
    std::optional<rsc::Level> level;
    double energy = 0;
};

namespace rsc::api {

// The settings of a case, or the defaults for null.
const Case& settings_of(const rsc_case* a_case);

// Throws Error(bad_input) if check_case finds fault with keys of these groups, or of these keys ("group%key").
void require_sound(const Case& settings, std::initializer_list<std::string_view> names);

int threads_of(const Case& settings);
Spectrum spectrum_of(const Case& settings);

}  // namespace rsc::api
