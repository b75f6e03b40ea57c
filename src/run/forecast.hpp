// Estimate of the time that a case takes.
#pragma once

#include "run/job.hpp"

namespace rsc {

// Asperities under the sphere, higher than it at the separation Z0 [length]: those a level's solver is given. Counted where the asperities
// are known; of a synthetic surface expected for Gaussian summits of the theoretical density and the surface's own rms height.
double expected_candidates(const Job& job, double Z0);

// The expected separation of a level of job.levels: the level itself, or under force control one with about that force.
double likely_separation(const Job& job, double level);

// Seconds for a level at Z0 by elements of so many points in the shortest wave, the making of their surface included.
double element_seconds(const Job& job, double Z0, double points_per_wave);

// Time of all realizations of the case [s], `workers` of them in parallel. The time of a surface is measured on a smaller one (some ten
// milliseconds), that of the levels follows from their numbers of candidates at typical rates: correct within a factor of about three.
double expected_seconds(const Job& job, double workers);

}  // namespace rsc
