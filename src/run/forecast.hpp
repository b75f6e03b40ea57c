// Estimate of the time that a case takes.
#pragma once

#include "run/job.hpp"

namespace rsc {

// Asperities under the sphere, higher than it at the separation Z0 [length]: those a level's solver is given. Counted where the asperities
// are known; of a synthetic surface expected for Gaussian summits of the theoretical density and the surface's own rms height.
double expected_candidates(const Job& job, double Z0);

// A separation about which the level of job.levels is expected to lie: itself, or under force control one that carries some such force.
double likely_separation(const Job& job, double level);

// Seconds for a level at Z0 by elements of so many points in the shortest wave, the making of their surface included.
double element_seconds(const Job& job, double Z0, double points_per_wave);

// Seconds that all realizations of the case take when `workers` are run at a time. The surface's share is measured on a smaller one
// of the same kind (some ten milliseconds), the levels' is their number of candidates at rates measured where rsc was written:
// right within a factor of some three.
double expected_seconds(const Job& job, double workers);

}  // namespace rsc
