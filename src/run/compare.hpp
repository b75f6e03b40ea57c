// &compare: levels of the asperity model compared with elements on the same surface.
#pragma once

#include "file/result.hpp"
#include "run/job.hpp"

namespace rsc {

// True if levels are compared: those listed, or with compare%levels = 'auto' and `automatically`, the last one if the forecast
// for it is short.
bool compares(const Job& job, bool automatically);

// `levels` are those of realization `number`; of each level asked for the nearest one is taken. A line for each goes to `table`, if there
// is one; once `stop` says so, the rest is left out. Errors are NaN where elements do not converge. Under force control both models carry
// the same force. The grid of a made surface is refined until N changes by less than 1 %, as far as a minute goes.
// With hardness both models have a path: elements go through the levels compared in the order of the run's, and through those between them
// where it turns round. Unloading and reloading is elastic, so that nothing else matters.
ComparedLevels compare_levels(const Job& job, std::int64_t number, int threads, const std::vector<LevelValues>& levels, std::ostream* table,
                              const std::function<bool()>& stop);

}  // namespace rsc
