// Solution of a level over all candidates, by Newton's method on those near contact.
#pragma once

#include "contact/candidates.hpp"
#include "contact/solver/newton.hpp"

namespace rsc {

// Solution over the candidates: penetrations v with interaction (negative: no contact), forces and slopes of the law.
struct Solution {
    std::vector<double> v, force, slope;
    void clear() { v.clear(), force.clear(), slope.clear(); }
};

struct WorkingSetOptions {
    double tolerance;
    int max_iterations;
    bool rough_start;  // the start is a guess: the set is selected again once the solution is known to 10 %, and the result is tested to be
                       // a minimum. Otherwise the caller must prove uniqueness.
};

// Solves from penetrations `start` over the candidates. Candidates far from contact are excluded from the working set, checked at the end,
// and included if they touch. `newton` uses `products`.
NewtonOutcome solve_candidates(const WorkingSet& candidates, Newton& newton, Products& products, const WorkingSetOptions& options,
                               const std::vector<double>& start, Solution& solution);

}  // namespace rsc
