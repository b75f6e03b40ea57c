// &compare: levels of the asperity model compared with elements on the same surface.
#pragma once

#include "io/result.hpp"
#include "problem/job.hpp"

namespace rsc {

// True if levels are compared: those listed, or with compare%levels = 'auto' and `automatically`,
// the last one if elements are small.
bool compares(const Job& job, bool automatically);

// `levels` are those of realization `number`; the one nearest to each entry of compare%levels is
// used. A line for each is written to `table`, if not null; the remaining levels are skipped once
// `stop` returns true. Errors are NaN if elements do not converge. Under force control both models
// have the same force. The grid of a synthetic surface is refined until N changes by less than 1 %,
// for at most about a minute. With hardness the results depend on the path: elements solve the
// compared levels in the order of the run, and the reversals between them. Unloading and reloading
// is elastic, so that no other levels are needed.
ComparedLevels compare_levels(const Job& job, std::int64_t number, int threads,
                              const std::vector<LevelValues>& levels, std::ostream* table,
                              const std::function<bool()>& stop);

}  // namespace rsc
