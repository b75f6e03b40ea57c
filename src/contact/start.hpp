// The start of the solution of a level: predicted from earlier levels where that is safe, otherwise given by the rule that defines the
// answer.
#pragma once

#include "contact/candidates.hpp"
#include "contact/interaction/products.hpp"

namespace rsc {

// Earlier levels, from which B F of the next level is extrapolated.
class EarlierLevels {
public:
    // The level at Z0 with penetrations v over the candidates. `unique`: it is proved to be the only solution.
    void remember(double Z0, const Candidates& candidates, const std::vector<double>& v, bool unique);

    // The same of a solution that will not stay: it gives way to the next. It may be one of several.
    void remember_passed(double Z0, const Candidates& candidates, const std::vector<double>& v);

    // The tip moves: ranks lose their meaning, the last level is kept by asperity as the start of the first level after the move.
    void carry(const Candidates& candidates, const std::vector<double>& v, std::size_t asperities);

    bool unique() const { return unique_; }  // the last is proved to be the only solution
    // Penetrations to start from at Z0; candidates that no earlier level knew are taken not to touch (which is checked at the end). False: none.
    bool predict(double Z0, const Candidates& candidates, std::vector<double>& start) const;

    // A start for force control, if there is one below `first_touch`.
    std::optional<double> likely_separation(double first_touch) const;
    std::size_t size() const { return solved_; }  // remembered since the tip moved

private:
    struct Past {
        double separation;
        std::vector<double> phi;  // B F by rank; NaN: not known
        bool passed = false;
    };
    std::deque<Past> past_;
    std::size_t solved_ = 0;
    bool unique_ = true;

    struct Carried {
        double separation = 0;
        std::vector<double> phi;  // B F by asperity; NaN: not known
        std::vector<int> known;   // whose is known; empty: none
    } carried_;
};

// The no-interaction forces F = f(<g0 - s>) of a sphere held higher by s, where s is the mean of B F over those forces: the mean field
// of the interaction. Found by bisection, with a fixed number of products. Returns the penetrations g0 - s.
std::vector<double> cold_start(const Law& law, Products& products, const WorkingSet& candidates);

}  // namespace rsc
