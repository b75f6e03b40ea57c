#include "contact/candidates.hpp"

namespace rsc {

Candidates select_candidates(Ranking& ranking, const Asperities& asperities, const Indenter& indenter, const SolverOptions& options,
                             Law& law, double Z0) {
    std::vector<int> fresh;
    const std::size_t last = ranking.above(Z0, fresh);
    law.prepare(fresh);
    double r0_squared = std::numeric_limits<double>::infinity();
    if (options.selection == Selection::paper) {
        const double depth = std::max(0.0, 4 * options.sigma - Z0);
        r0_squared = options.selection_factor * options.selection_factor * 2 * depth * indenter.shape->hertz_radius();
    }
    Candidates candidates;
    WorkingSet& set = candidates.set;
    for (std::size_t r = 0; r < last; ++r) {
        const auto i = static_cast<std::size_t>(ranking[r].asperity);
        const Vec2 d = indenter.from_tip(asperities.x[i], asperities.y[i]), image = indenter.image(asperities.x[i], asperities.y[i]);
        if (d.x * d.x + d.y * d.y > r0_squared) continue;
        candidates.rank.push_back(r);
        set.asperity.push_back(ranking[r].asperity);
        set.x.push_back(image.x);
        set.y.push_back(image.y);
        set.g0.push_back(ranking[r].height - Z0);
    }
    return candidates;
}

}  // namespace rsc
