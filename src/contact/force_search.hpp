// The one search for a force: every model that does not solve under a force itself
// (Model::solve_under) is solved at separations between bracket, until one has it.
#pragma once

#include "contact/model.hpp"

namespace rsc {

// Separations between which the solution lies; infinite: not known.
struct Bracket {
    double low, high;
    bool contain(double z) const { return z > low && z < high; }
    bool closed() const { return low == high; }
    double close(double z) { return low = high = z; }
};

enum class SearchEnd { closed, most, stuck };  // most: of evaluations; stuck: no z is left

// evaluate(z, bracket, i) narrows the bracket, at the end to z, and returns the next z, e.g. that
// of Newton's method with the slope of the force; outside the bracket: the next is halfway.
template <class Evaluate>
SearchEnd search_force(double z, Bracket bracket, int most, Evaluate&& evaluate) {
    for (const int i : indices(most)) {
        if (!bracket.contain(z)) z = 0.5 * (bracket.low + bracket.high);
        if (!bracket.contain(z)) return SearchEnd::stuck;
        z = evaluate(z, bracket, i);
        if (bracket.closed()) return SearchEnd::closed;
    }
    return SearchEnd::most;
}

// A depth below first touch, before half of which the force cannot be N.
inline double least_depth(Model& model, double N) {
    double depth =
        std::numeric_limits<double>::epsilon() *
        std::max(std::abs(model.contact_range().first_touch), std::numeric_limits<double>::min());
    while (model.force_at_most(depth) < N) depth *= 2;
    return depth;
}

}  // namespace rsc
