// Levels as the judge leaves them.
#pragma once

#include "trust/judge.hpp"

inline rsc::Level judged(rsc::Level level, rsc::Path& contact, const rsc::SolverOptions& options,
                         const rsc::HeightMap* map = nullptr) {
    rsc::Judge(options, {map}).judge(level, contact, false);
    return level;
}
