// A level's solution over all candidates by Newton's method on those near contact.
#pragma once

#include "contact/candidates.hpp"
#include "contact/solver/newton.hpp"

namespace rsc {

// A solution over the candidates: penetrations v with interaction (negative: no contact), forces and slopes of the law.
struct Solution {
    std::vector<double> v, force, slope;
    void clear() { v.clear(), force.clear(), slope.clear(); }
};

struct WorkingSetOptions {
    double tolerance;
    int max_iterations;
    bool rough_start;  // the start is a guess: the set is drawn anew once the solution is known to some ten per cent, and what is
                       // found is a minimum of the energy. After another start only a proof of uniqueness tells.
};

// From penetrations `start` over the candidates to the solution. Candidates far from touching are left out of the working set, checked
// at the end, and taken in where they do touch after all. `newton` uses `products`.
NewtonOutcome solve_candidates(const WorkingSet& candidates, Newton& newton, Products& products, const WorkingSetOptions& options,
                               const std::vector<double>& start, Solution& solution);

}  // namespace rsc
