// The stresses below the levels of a case.
#pragma once

#include "physics/stress/plane_stress.hpp"
#include "run/job.hpp"

namespace rsc {

// The depths of output%stress_depths, increasing; empty: no stresses. Throws Error(bad_input) if
// they are to be chosen and the surface has no points.
std::vector<double> stress_depths(const Job& job);

StressedBody stressed_body(const Job& job);

// Appends the largest stresses of a level at each depth, missing if it has no contact. `map`: of
// boundary elements, otherwise null.
void add_stresses(std::vector<LargestStress>& all, const Job& job, const HeightMap* map,
                  const Level& level);

// Says where von Mises's stress and the tension of the last level are largest.
void print_stresses(std::ostream& out, std::span<const LargestStress> stresses, const Job& job);

}  // namespace rsc
