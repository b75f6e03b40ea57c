// Common parts of contacts of asperities with and without adhesion: selection of summits and method, and evaluation of levels.
#pragma once

#include "contact/law/law.hpp"
#include "contact/level.hpp"
#include "contact/solver/newton.hpp"
#include "contact/touching.hpp"

namespace rsc {

// Summits of the difference between surface and indenter; absent if the given asperities are to be used.
std::optional<Asperities> summits_of_difference(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options,
                                                const SummitSearch& search);

// Resolves method `auto` to direct or mesh by the estimated cost of a Newton solve, with rates measured by test/bench.
Method choose_method(const SolverOptions& options, const Kernel& kernel, const WorkingSet& candidates);

// Completes a level that has contacts, force and the sum of areas: area of the union of elliptic spots, overlaps, validity of the model,
// expected errors and status. `of_surface`: the asperities are summits of the surface, not of the difference.
void judge_asperities(Level& level, const Law& law, const Asperities& asperities, const Indenter& indenter, const SolverOptions& options,
                      bool of_surface);

}  // namespace rsc
