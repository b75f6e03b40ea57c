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
    for (const auto r : indices(last)) shifts->shift(at(ranking[r].asperity));
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
    for (const auto r : indices(last)) most = std::max(most, height(r));
    return most;
}

void select_candidates(Contenders contenders, const SolverOptions& options, double Z0,
                       Candidates& candidates) {
    const auto& [ranking, indenter, shifts, law] = contenders;
    const std::size_t last = contenders.above(Z0);
    double r0_squared = kInfinity;
    if (options.selection == Selection::paper) {
        const double depth = std::max(0.0, 4 * options.surface.sigma - Z0);
        r0_squared = options.selection_factor * options.selection_factor * 2 * depth *
                     indenter.shape->hertz_radius();
    }
    WorkingSet& set = candidates.set;
    for (auto* list : {&set.x, &set.y, &set.g0}) list->resize(last);
    candidates.rank.resize(last);
    set.asperity.resize(last);
    std::size_t n = 0;
    for (const auto r : indices(last)) {
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

namespace {

using Vector = std::vector<double>;

// The division of the candidates into those of the working set and those outside.
class Division {
public:
    explicit Division(const WorkingSet& candidates)
        : candidates_(candidates), in_(at(candidates.size())) {
        working.reserve(in_.size());
    }

    WorkingSet working;
    Vector working_v;  // penetrations of its points
    std::vector<std::size_t> inside, outside;

    // Includes the candidates near or in contact.
    void draw(const Vector& penetration) {
        const double highest = *std::max_element(penetration.begin(), penetration.end());
        for (const auto k : indices(in_)) in_[k] = penetration[k] > -0.03 * highest;
    }

    // Sets the working set, with penetrations v.
    void divide(const Vector& v) {
        inside.clear();
        outside.clear();
        working.clear();
        working_v.clear();
        for (std::size_t k = 0; k < in_.size(); ++k) {
            if (!in_[k]) {
                outside.push_back(k);
                continue;
            }
            inside.push_back(k);
            working.asperity.push_back(candidates_.asperity[k]);
            working.x.push_back(candidates_.x[k]);
            working.y.push_back(candidates_.y[k]);
            working.g0.push_back(candidates_.g0[k]);
            working_v.push_back(v[k]);
        }
    }

    // The solution of the working set, with forces and slopes 0 outside.
    void take(const Newton& newton, Solution& solution) const {
        auto& [v, force, slope] = solution;
        force.assign(in_.size(), 0.0);
        slope.assign(in_.size(), 0.0);
        for (const auto k : indices(inside)) {
            force[inside[k]] = newton.force()[k];
            slope[inside[k]] = newton.slope()[k];
            v[inside[k]] =
                working_v[k] > 0 ? working_v[k] : candidates_.g0[inside[k]] - newton.phi()[k];
        }
    }

    // Penetrations outside under the forces of the working set.
    void extend(Newton& newton, Vector& v) {
        xo_.clear();
        yo_.clear();
        for (const std::size_t k : outside) {
            xo_.push_back(candidates_.x[k]);
            yo_.push_back(candidates_.y[k]);
        }
        phi_.resize(outside.size());
        newton.potential_at(outside.size(), xo_.data(), yo_.data(), phi_.data());
        for (const auto k : indices(outside)) v[outside[k]] = candidates_.g0[outside[k]] - phi_[k];
    }

    // Includes points outside that touch, or are within the error of single precision of touching.
    // True if there are none.
    bool complete(const Vector& v) {
        bool none = true;
        for (const auto k : indices(outside)) {
            if (v[outside[k]] > -1e-4 * phi_[k]) {
                in_[outside[k]] = 1;
                none = false;
            }
        }
        return none;
    }

private:
    const WorkingSet& candidates_;
    std::vector<char> in_;
    Vector xo_, yo_, phi_;
};

}  // namespace

NewtonOutcome solve_candidates(const WorkingSet& candidates, Newton& newton, Products& products,
                               const WorkingSetOptions& options, const std::vector<double>& start,
                               Solution& solution) {
    Division division(candidates);
    division.draw(start);
    bool settle = !options.rough_start;
    bool saddle = false;  // all touching candidates are included, but the solution is not a minimum
    Vector& v = solution.v;
    v = start;
    NewtonOutcome total;
    for (;;) {
        division.divide(v);
        const WorkingSet& working = division.working;
        products.set_points(working.size(), working.x.data(), working.y.data());
        const double tolerance = settle ? options.tolerance : std::max(options.tolerance, 0.1);
        const bool ask = settle && options.rough_start && (division.outside.empty() || saddle);
        const auto outcome = newton.solve(
            working, tolerance, options.max_iterations - total.iterations, division.working_v, ask);
        total.iterations += outcome.iterations;
        total.converged = outcome.converged;
        total.minimum = outcome.minimum;
        total.residual = outcome.residual;
        division.take(newton, solution);
        if (division.outside.empty() && settle) break;
        division.extend(newton, v);
        if (!settle) {
            settle = true;
            division.draw(v);
            continue;
        }
        const bool complete = division.complete(v);
        if (!total.converged) break;
        if (!complete) continue;
        if (ask || !options.rough_start || newton.at_minimum(working)) break;
        saddle = true;
    }
    return total;
}

}  // namespace rsc
