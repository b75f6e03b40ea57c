// Common parts of contacts of asperities with and without adhesion: selection of summits and
// method, and evaluation of levels.
#pragma once

#include "asperities/law.hpp"
#include "asperities/newton.hpp"
#include "asperities/shifted_summits.hpp"
#include "contact/level.hpp"

namespace rsc {

// Resolves method `auto` to direct or mesh by the estimated cost of a Newton solve, with rates
// measured by test/bench.
Method choose_method(const SolverOptions& options, const Kernel& kernel,
                     const WorkingSet& candidates);

// The bodies of a contact of asperities. The asperities are those given, or for laws with summits
// between the points of a surface the summits of the difference from a curved indenter.
struct ContactBodies {
    const Asperities& of_surface;
    SolverOptions options;
    Indenter indenter;
    std::unique_ptr<ShiftedSummits> of_difference;  // null: asperities are those of the surface
    const Asperities& asperities;                   // refers to one of the two above
    std::shared_ptr<const Kernel> kernel;

    ContactBodies(const Asperities& given, const Indenter& indenter, const SolverOptions& options);
    ContactBodies(const ContactBodies&) = delete;
    ContactBodies& operator=(const ContactBodies&) = delete;
};

// Completes a level that has contacts, force and the sum of areas: area of the union of elliptic
// spots, overlaps and slope_ratio.
void complete_level(Level& level, const Law& law, const ContactBodies& bodies);

}  // namespace rsc
