#include "asperities/candidates.hpp"

namespace rsc {

std::size_t Contenders::above(double Z0) {
    std::vector<int> fresh;
    if (!shifts) {
        const std::size_t last = ranking.above(Z0, fresh);
        law.prepare(fresh);
        return last;
    }
    const std::size_t last = ranking.above(Z0 - shifts->most_gained(Z0), fresh);
    for (std::size_t r = 0; r < last; ++r) shifts->shift(at(ranking[r].asperity));
    return last;
}

double Contenders::height(std::size_t rank) const {
    if (!shifts) return ranking[rank].height;
    const Asperities& summits = shifts->summits();
    const std::size_t i = at(ranking[rank].asperity);
    return indenter.clearance(summits.x[i], summits.y[i], summits.z[i]);
}

double Contenders::highest() {
    double most = ranking.highest();
    if (!shifts || !std::isfinite(most)) return most;
    const std::size_t last = above(most);
    for (std::size_t r = 0; r < last; ++r) most = std::max(most, height(r));
    return most;
}

void select_candidates(Contenders contenders, const SolverOptions& options, double Z0,
                       Candidates& candidates) {
    const auto& [ranking, indenter, shifts, law] = contenders;
    const std::size_t last = contenders.above(Z0);
    double r0_squared = kInfinity;
    if (options.selection == Selection::paper) {
        const double depth = std::max(0.0, 4 * options.sigma - Z0);
        r0_squared = options.selection_factor * options.selection_factor * 2 * depth *
                     indenter.shape->hertz_radius();
    }
    WorkingSet& set = candidates.set;
    for (auto* list : {&set.x, &set.y, &set.g0}) list->resize(last);
    candidates.rank.resize(last);
    set.asperity.resize(last);
    std::size_t n = 0;
    for (std::size_t r = 0; r < last; ++r) {
        const double height = contenders.height(r);
        if (!(height > Z0)) continue;
        const auto [x, y] = ranking.place(r);
        const Vec2 d = indenter.from_tip(x, y), image = indenter.image(x, y);
        if (d.x * d.x + d.y * d.y > r0_squared) continue;
        candidates.rank[n] = r;
        set.asperity[n] = ranking[r].asperity;
        set.x[n] = image.x;
        set.y[n] = image.y;
        set.g0[n++] = height - Z0;
    }
    for (auto* list : {&set.x, &set.y, &set.g0}) list->resize(n);
    candidates.rank.resize(n);
    set.asperity.resize(n);
    std::vector<int> fresh;
    for (const int i : set.asperity)
        if (shifts && !shifts->prepared(at(i))) fresh.push_back(i);
    law.prepare(fresh);
}

NewtonOutcome solve_candidates(const WorkingSet& candidates, Newton& newton, Products& products,
                               const WorkingSetOptions& options, const std::vector<double>& start,
                               Solution& solution) {
    using Vector = std::vector<double>;
    const auto n = static_cast<std::size_t>(candidates.size());
    std::vector<char> in(n);
    const auto draw = [&](const Vector& penetration) {
        const double highest = *std::max_element(penetration.begin(), penetration.end());
        for (std::size_t k = 0; k < n; ++k) in[k] = penetration[k] > -0.03 * highest;
    };
    draw(start);
    bool settle = !options.rough_start;
    bool saddle = false;  // all touching candidates are included, but the solution is not a minimum
    auto& [v, force, slope] = solution;
    v = start;
    NewtonOutcome total;
    WorkingSet working;
    working.reserve(n);
    Vector working_v;
    std::vector<std::size_t> inside, outside;
    Vector xo, yo, phi;
    for (;;) {
        inside.clear();
        outside.clear();
        working.clear();
        working_v.clear();
        for (std::size_t k = 0; k < n; ++k) {
            if (!in[k]) {
                outside.push_back(k);
                continue;
            }
            inside.push_back(k);
            working.asperity.push_back(candidates.asperity[k]);
            working.x.push_back(candidates.x[k]);
            working.y.push_back(candidates.y[k]);
            working.g0.push_back(candidates.g0[k]);
            working_v.push_back(v[k]);
        }
        products.set_points(working.size(), working.x.data(), working.y.data());
        const double tolerance = settle ? options.tolerance : std::max(options.tolerance, 0.1);
        const bool ask = settle && options.rough_start && (outside.empty() || saddle);
        const auto outcome = newton.solve(
            working, tolerance, options.max_iterations - total.iterations, working_v, ask);
        total.iterations += outcome.iterations;
        total.converged = outcome.converged;
        total.minimum = outcome.minimum;
        total.residual = outcome.residual;
        force.assign(n, 0.0);
        slope.assign(n, 0.0);
        for (std::size_t k = 0; k < inside.size(); ++k) {
            force[inside[k]] = newton.force()[k];
            slope[inside[k]] = newton.slope()[k];
            v[inside[k]] =
                working_v[k] > 0 ? working_v[k] : candidates.g0[inside[k]] - newton.phi()[k];
        }
        if (outside.empty() && settle) break;
        xo.clear();
        yo.clear();
        for (std::size_t k : outside) {
            xo.push_back(candidates.x[k]);
            yo.push_back(candidates.y[k]);
        }
        phi.resize(outside.size());
        newton.potential_at(outside.size(), xo.data(), yo.data(), phi.data());
        for (std::size_t k = 0; k < outside.size(); ++k)
            v[outside[k]] = candidates.g0[outside[k]] - phi[k];
        if (!settle) {
            settle = true;
            draw(v);
            continue;
        }
        bool complete = true;
        for (std::size_t k = 0; k < outside.size(); ++k) {
            // Points within the error of single precision of touching are added to the working set.
            if (v[outside[k]] > -1e-4 * phi[k]) {
                in[outside[k]] = 1;
                complete = false;
            }
        }
        if (!total.converged) break;
        if (!complete) continue;
        if (ask || !options.rough_start || newton.at_minimum(working)) break;
        saddle = true;
    }
    return total;
}

}  // namespace rsc
