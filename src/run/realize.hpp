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

// Realization `number` of the case. `on_level` is called with each level and its number, in their
// order. Results do not depend on the number of threads.
Realization realize(const Job& job, std::int64_t number, int threads,
                    const std::function<void(std::size_t, const Level&)>& on_level = {});

}  // namespace rsc
