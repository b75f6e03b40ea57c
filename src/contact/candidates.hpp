// Candidates: the asperities for which a level is solved.
#pragma once

#include "contact/indentation.hpp"
#include "contact/interaction/kernel.hpp"
#include "contact/law/law.hpp"
#include "contact/ranking.hpp"
#include "contact/solver/newton.hpp"

namespace rsc {

struct Candidates {
    WorkingSet set;
    std::vector<std::size_t> rank;  // position of each candidate in the ranking
    int size() const { return set.size(); }
};

// Selects the asperities with g0 > 0. No others can touch, because forces only lower the surface (B F >= 0). Selection::paper also drops
// those outside r0 = 1.5 sqrt(2 (4 sigma - Z0) R) (paper, section 4). The law is prepared for all candidates.
Candidates select_candidates(Ranking& ranking, const Asperities& asperities, const Indenter& indenter, const SolverOptions& options,
                             Law& law, double Z0);

}  // namespace rsc
