// Candidates, the asperities for which a level is solved, and its solution by Newton's method on
// those near contact.
#pragma once

#include "asperities/law.hpp"
#include "asperities/newton.hpp"
#include "asperities/ranking.hpp"
#include "asperities/shifted_summits.hpp"
#include "contact/indentation.hpp"
#include "interaction/kernel.hpp"

namespace rsc {

// Asperities in their order under the indenter. With `shifts` the ranking is that of the summits of
// the surface, and those of the difference are determined as far as they are needed.
struct Contenders {
    Ranking& ranking;
    const Indenter& indenter;
    ShiftedSummits* shifts;
    Law& law;

    // Number of entries of the ranking that may be above Z0.
    std::size_t above(double Z0);
    // Clearance of an entry.
    double height(std::size_t rank) const;
    // Largest clearance; -Infinity if there are no asperities.
    double highest();
};

struct Candidates {
    WorkingSet set;
    std::vector<std::size_t> rank;  // position of each candidate in the ranking
    int size() const { return set.size(); }
    template <class Archive, class Self>
    static void archive(Archive& a, Self& my) {
        a(my.rank, my.set.asperity, my.set.x, my.set.y, my.set.g0);
    }
};

// Selects the asperities with g0 > 0. No others can touch, because forces only lower the surface (B
// F >= 0). Selection::paper also drops those outside r0 = 1.5 sqrt(2 (4 sigma - Z0) R) (paper,
// section 4). The law is prepared for all candidates. The places between which forces interact are
// those of the summits of the surface, which do not change with the tip: then the lateral force of
// contact/answers.hpp is the gradient of the energy.
void select_candidates(Contenders contenders, const SolverOptions& options, double Z0,
                       Candidates& candidates);

// Solution over the candidates: penetrations v with interaction (negative: no contact), forces and
// slopes of the law.
struct Solution {
    std::vector<double> v, force, slope;
    void clear() {
        v.clear();
        force.clear();
        slope.clear();
    }
    template <class Archive, class Self>
    static void archive(Archive& a, Self& my) {
        a(my.v, my.force, my.slope);
    }
};

struct WorkingSetOptions {
    double tolerance;
    int max_iterations;
    // True if the start is a guess: the set is selected again once the solution is known to 10 %,
    // and the result is tested to be a minimum. Otherwise the caller must prove uniqueness.
    bool rough_start;
};

// Solves from penetrations `start` over the candidates. Candidates far from contact are excluded
// from the working set, checked at the end, and included if they touch. `newton` uses `products`.
NewtonOutcome solve_candidates(const WorkingSet& candidates, Newton& newton, Products& products,
                               const WorkingSetOptions& options, const std::vector<double>& start,
                               Solution& solution);

}  // namespace rsc
