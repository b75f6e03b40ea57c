// Estimate of the time that a case takes.
#pragma once

#include "run/job.hpp"

namespace rsc {

// Number of asperities higher than the sphere at the separation Z0 [length], which are passed to
// the solver. Counted if the asperities are known; for a synthetic surface the expectation for
// Gaussian summits of the theoretical density and the rms height of the surface.
double expected_candidates(const Job& job, double Z0);

// The expected separation of a level of job.levels: the level itself, or under force control one
// with approximately that force.
double likely_separation(const Job& job, double level);

// Seconds for a level at Z0 by elements with points_per_wave points in the shortest wavelength,
// including the synthesis of the surface.
double element_seconds(const Job& job, double Z0, double points_per_wave);

// Time of all realizations of the case [s], `workers` of them in parallel. The time of a surface is
// measured on a smaller one (about ten milliseconds), that of the levels follows from their numbers
// of candidates and typical rates, mostly within a factor of two.
double expected_seconds(const Job& job, double workers);

// Largest memory [MB] of a run with `workers` realizations in parallel: of elements from the sizes
// of the surface and of the contact, of coated asperities from the values of the kernel that are
// kept. 0 for other asperities, which need little.
double expected_megabytes(const Job& job, double workers);

}  // namespace rsc
