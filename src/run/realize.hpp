// One realization of a prepared case: its levels, one after another or in groups.
#pragma once

#include "io/result.hpp"
#include "problem/job.hpp"

namespace rsc {

// One realization: its surface, its asperities, its levels.
struct Realization {
    SurfaceStatistics statistics;
    Asperities asperities;
    std::vector<Level> levels;
    std::vector<double> curves;                // [step], as ObserveOptions::curves
    Remains remains;                           // after the last level, without loads
    std::shared_ptr<const HeightMap> heights;  // if requested by the case
    Fields fields;                             // likewise
};

// Levels of elements that do not depend on each other are solved in groups of this many, if there
// are at least kFewestGroups of them; groups whose levels have at most kFewPoints candidates side
// by side, by a contact for each thread.
inline constexpr std::size_t kGroup = 8, kFewestGroups = 4;
inline constexpr std::int32_t kFewPoints = 200000;

// Realization `number` of the case. `on_level` is called with each level and its number, in their
// order. Results do not depend on the number of threads.
Realization realize(const Job& job, std::int64_t number, int threads,
                    const std::function<void(std::size_t, const Level&)>& on_level = {});

}  // namespace rsc
