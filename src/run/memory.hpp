// Sizes of a case and its memory, before it runs.
#pragma once

#include "problem/job.hpp"

namespace rsc {

// Number of asperities higher than the sphere at the separation Z0 [length], which are passed to
// the solver. Counted if the asperities are known; for a synthetic surface the expectation for
// Gaussian summits of the theoretical density and the rms height of the surface.
double expected_candidates(const Job& job, double Z0);

// The expected separation of a level of job.levels: the level itself, or under force control one
// with approximately that force.
double likely_separation(const Job& job, double level);

// Numbers of grid points of elements with points_per_wave points in the shortest wavelength: all,
// and those that are higher than the indenter at Z0.
struct ElementSize {
    double points, under;
};
ElementSize element_size(const Job& job, double Z0, double points_per_wave);

// The unknowns of the largest level, as estimated before the run: their number, and in words the
// model with its grid.
struct Unknowns {
    double number;
    std::string text;
};
Unknowns expected_unknowns(const Job& job);

// Memory [MB] of a run with `workers` realizations in parallel at its peak, estimated for elements
// from the points of the surface and those under the indenter, for coated asperities from the
// values of the kernel that are kept. 0 for other asperities, which need little. An estimate, not
// a bound: of four cases the peak was 0.65 to 1.1 times as high.
double expected_megabytes(const Job& job, double workers);

}  // namespace rsc
