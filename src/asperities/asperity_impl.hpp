// State of an AsperityModel, for the files that implement it.
#pragma once

#include "asperities/asperity_level.hpp"
#include "asperities/asperity_model.hpp"
#include "asperities/candidates.hpp"
#include "asperities/ranking.hpp"
#include "asperities/start.hpp"
#include "asperities/uniqueness.hpp"

namespace rsc {

struct AsperityModel::Impl : ContactBodies {
    MakeAsperityPhysics make;
    AsperityPhysics physics;
    Law* law;
    AsperityHistory* history;
    Ranking ranking;

    // The current level and its solution.
    Candidates candidates;
    Solution solution;
    Method method = Method::direct;
    double solved = 0;  // separation of the last result of solve()

    // All of the last solution but the points of the products.
    template <class Archive, class Self>
    static void archive(Archive& a, Self& my) {
        a(my.earlier, my.candidates, my.solution, my.solved, my.method);
        if (!my.solution.v.empty()) a(my.newton);
    }
    struct Tried {
        double separation;
        NewtonOutcome outcome;
    };
    std::optional<Tried> tried;  // the solution is that of a trial, not examined yet

    EarlierLevels earlier;
    std::unique_ptr<Products> direct, mesh;  // mesh: created on first use
    Products* products = nullptr;            // the products in use
    Newton newton;
    std::unique_ptr<Products> of_part;  // of a doubtful part alone
    Newton part_newton;

    Impl(const Asperities& asperities_, const Indenter& indenter_, const SolverOptions& options_,
         MakeAsperityPhysics make);

    // Ratio of the forces of the law to the true ones.
    double scale() const { return history->scale(); }
    // Shift of the separation used by solve() due to earlier loads of a relaxing body (periodic
    // flats).
    double raised() const { return kernel->shift() * history->rest(); }
    long products_taken() const { return direct->count() + (mesh ? mesh->count() : 0); }
    Contenders contenders() { return {ranking, indenter, of_difference.get(), *law}; }
    void use(Method how);
    void select(double Z0);  // determines candidates and method
    NewtonOutcome solve_from(const std::vector<double>& start, bool rough_start);
    // True if the solution continues the branch of the accepted levels (path-dependent laws). Of
    // several solutions for other laws, cold starts select the one.
    bool follows() const { return law->memory() != nullptr; }
    // Descends from the no-interaction start to a minimum of the energy. This defines the solution
    // if there are several.
    NewtonOutcome solve_cold() {
        return solve_from(cold_start(*law, *products, candidates.set), true);
    }
    double force_slope(
        double tolerance);  // dN/dZ0; the next level is predicted with what this takes
    Level level(double Z0, const NewtonOutcome& outcome, bool unique) const;
    std::optional<Level> solve_trial(double Z0);
    NewtonOutcome solve_by_paper(Fallback& why_not);
    // Parts of the solution that are not proved to be unique.
    std::vector<std::vector<std::size_t>> doubtful() const {
        const auto& [v, force, slope] = solution;
        const WorkingSet& set = candidates.set;
        return doubtful_parts(*law, *kernel, set.asperity, set.x, set.y, v, force, slope);
    }
    bool independent(bool& unique);
    std::vector<double> alone(const std::vector<std::size_t>& part);
    Level report(double Z0) const;
};

}  // namespace rsc
