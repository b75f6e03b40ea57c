// Expected errors of N and A of the asperity model relative to boundary elements: bounds that held
// in nine of ten levels of a study of surfaces of many kinds (input/trust).
#pragma once

#include "contact/level.hpp"
#include "surface/asperities.hpp"

namespace rsc {

// Relative errors; NaN outside the study.
struct AsperityError {
    double force = kNotComputed, area = kNotComputed;
};

// True if the study has this law.
bool is_compared(LawKind law);

// Of a level with contacts, by their mean radius, weighted by the forces, over the mean spacing of
// the summits.
AsperityError asperity_error(const Level& level, const SolverOptions& options);

// The smallest error of N that is ever stated for a law; Infinity: none is stated.
double least_stated_error(LawKind law);

// True if the grid of the surface has fewer points in the shortest wave than those of the study.
bool few_points(const SolverOptions& options);

// Share of the force on spikes of a measured map, which are one point wide and of unknown load.
double share_on_spikes(const Level& level, const SolverOptions& options);

// True if the bodies may touch at a separation although no summit touches: within the mean spacing
// of a summit (of the difference, for laws that shift summits) the surface is not higher than its
// top, and the indenter may be lower than above it.
bool may_touch_between(const Asperities& asperities, const Indenter& indenter,
                       const SolverOptions& options, double Z0);

}  // namespace rsc
