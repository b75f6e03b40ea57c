// The asperities a level is solved for.
#pragma once

#include "contact/indentation.hpp"
#include "contact/interaction/kernel.hpp"
#include "contact/law/law.hpp"
#include "contact/ranking.hpp"
#include "contact/solver/newton.hpp"

namespace rsc {

struct Candidates {
    WorkingSet set;
    std::vector<std::size_t> rank;  // of each candidate in the ranking
    int size() const { return set.size(); }
};

// Those with g0 > 0: where every force only lowers the surface (B F >= 0), nothing else can touch. Selection::paper drops also those
// outside r0 = 1.5 sqrt(2 (4 sigma - Z0) R) (paper, section 4). The law is prepared for all of them.
Candidates select_candidates(Ranking& ranking, const Asperities& asperities, const Indenter& indenter, const SolverOptions& options,
                             Law& law, double Z0);

}  // namespace rsc
