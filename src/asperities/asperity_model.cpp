#include "asperities/asperity_model.hpp"

#include "asperities/asperity_impl.hpp"
#include "asperities/dgesv.hpp"
#include "base/error.hpp"

namespace rsc {
namespace {

using Vector = std::vector<double>;

}  // namespace

AsperityModel::Impl::Impl(const Asperities& asperities_, const Indenter& indenter_,
                          const SolverOptions& options_, MakeAsperityPhysics make_)
    : ContactBodies(asperities_, indenter_, options_),
      make(make_),
      physics(make(*this)),
      law(physics.law.get()),
      history(physics.history.get()),
      direct(make_direct_products(kernel)),
      newton(*law),
      of_part(make_direct_products(kernel)),
      part_newton(*law) {
    part_newton.use(*of_part);
    use(Method::direct);
    if (options.selection == Selection::paper && std::isnan(indenter.shape->hertz_radius()))
        throw Error(Failure::bad_input,
                    "indentation%selection = 'paper' is defined for a sphere only");
    ranking.assign(of_surface, indenter);
}

void AsperityModel::Impl::use(Method how) {
    method = how;
    if (how == Method::mesh && !mesh) {
        // Full products determine the residual and must be more accurate than the tolerance; inner
        // products only determine steps.
        mesh = make_mesh_products(kernel, std::min(1e-4, 0.1 * options.tolerance), 1e-3);
    }
    products = how == Method::mesh ? mesh.get() : direct.get();
    newton.use(*products);
}

void AsperityModel::Impl::select(double Z0) {
    select_candidates(contenders(), options, Z0 - raised(), candidates);
    use(choose_method(options, *kernel, candidates.set));
    history->lower(candidates, *products);
}

NewtonOutcome AsperityModel::Impl::solve_from(const Vector& start, bool rough_start) {
    return solve_candidates(candidates.set, newton, *products,
                            {options.tolerance, options.max_iterations, rough_start}, start,
                            solution);
}

// Penetrations of a doubtful part from its own cold start, in the field of all other asperities.
Vector AsperityModel::Impl::alone(const std::vector<std::size_t>& part) {
    WorkingSet set;
    Solution own;
    for (const std::size_t k : part) {
        set.asperity.push_back(candidates.set.asperity[k]);
        set.x.push_back(candidates.set.x[k]);
        set.y.push_back(candidates.set.y[k]);
        own.v.push_back(solution.v[k]);
    }
    set.g0 = own.v;
    of_part->set_points(set.size(), set.x.data(), set.y.data());
    part_newton.take(set, own.v);
    for (const std::size_t k : indices(part)) set.g0[k] += part_newton.phi()[k];
    solve_candidates(set, part_newton, *of_part, {options.tolerance, options.max_iterations, true},
                     cold_start(*law, *of_part, set), own);
    return own.v;
}

// Whether the solution does not depend on the start it was found from: it is unique, or each
// doubtful part is in the state to which its own cold start leads in the field of the others.
bool AsperityModel::Impl::independent(bool& unique) {
    const auto parts = doubtful();
    unique = parts.empty();
    // Penetrations of candidates far from contact are computed in single precision.
    const double same = 1e-4 * *std::ranges::max_element(solution.v);
    return std::ranges::all_of(parts, [&](const auto& part) {
        if (2 * part.size() > solution.v.size()) return false;  // as much as to solve all
        const Vector v = alone(part);
        const auto agree = [&](double one, std::size_t k) {
            return std::abs(std::max(one, 0.0) - std::max(solution.v[k], 0.0)) < same;
        };
        return std::ranges::equal(v, part, agree);
    });
}

NewtonOutcome AsperityModel::Impl::solve_by_paper(Fallback& why_not) {
    auto& [v, force, slope] = solution;
    const PaperMethod paper{options.delta0 * options.surface.sigma, options.delta_cut,
                            options.tolerance, options.max_iterations};
    const PaperOutcome result =
        solve_by_dgesv(*law, *kernel, candidates.set, paper, v, force, slope);
    if (!result.converged)
        why_not = result.singular ? Fallback::dgesv_singular : Fallback::dgesv_not_converged;
    return result;
}

Level AsperityModel::Impl::report(double Z0) const {
    const WorkingSet& set = candidates.set;
    const auto& [v, force, slope] = solution;
    Level level;
    level.separation = Z0;
    level.candidates = candidates.size();
    std::vector<std::size_t> order;
    for (const auto k : indices(force)) {
        if (force[k] > 0) order.push_back(k);
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return set.asperity[a] < set.asperity[b]; });
    for (auto* list : {&level.x, &level.y, &level.f, &level.a, &level.u})
        list->reserve(order.size());
    level.asperity.reserve(order.size());
    level.yields.reserve(order.size());
    double extreme = 0;
    double peak = 0;
    for (std::size_t k : order) {
        const auto [area, axes, beyond] = law->footprint(set.asperity[k], v[k]);
        const double f = force[k] / scale();
        const auto i = at(set.asperity[k]);
        const Vec2 place = indenter.image(asperities.x[i], asperities.y[i]);
        level.add_contact(set.asperity[k], place.x, place.y, f, std::sqrt(area / pi), v[k]);
        level.force += f;
        level.area += area;
        level.beyond_law += beyond;
        level.yields.push_back(law->memory() && law->memory()->yields(set.asperity[k], v[k]));
        level.plastic_contacts += level.yields.back();
        if (f > kExtreme * indenter.E_star * area) extreme += area;
        peak = std::max(peak, 1.5 * f / area);
    }
    if (level.area > 0) level.extreme_area_fraction = extreme / level.area;
    if (peak > 0 && !law->memory()) level.pressure_max = peak;
    complete_level(level, *law, *this);
    return level;
}

// Where there is no contact the surface sinks as the contacts do on the average.
double AsperityModel::Impl::force_slope(double tolerance) {
    const double slope = newton.stiffness(tolerance);
    const Vector sinking = newton.sinking();
    if (follows() || sinking.empty()) return slope / scale();
    const double mean =
        std::accumulate(sinking.begin(), sinking.end(), 0.0) / double(sinking.size());
    Vector change(solution.force.size(), -1 - mean);
    for (std::size_t k = 0, active = 0; k < change.size(); ++k)
        if (solution.force[k] > 0) change[k] = -1 - sinking[active++];
    earlier.bend(candidates, change);
    return slope / scale();
}

Level AsperityModel::Impl::level(double Z0, const NewtonOutcome& outcome, bool unique) const {
    Level level = report(Z0);
    level.residual = outcome.residual;
    level.method = method;
    if (options.method == Method::mesh && method != Method::mesh)
        level.fallback = Fallback::no_interaction;
    level.unique = unique;
    level.converged = outcome.converged;
    return level;
}

AsperityModel::AsperityModel(const Asperities& asperities, const Indenter& indenter,
                             const SolverOptions& options, MakeAsperityPhysics physics)
    : impl_(std::make_unique<Impl>(asperities, indenter, options, physics)) {}
AsperityModel::~AsperityModel() = default;

// A trial only continues from earlier levels.
std::optional<Level> AsperityModel::Impl::solve_trial(double Z0) {
    Vector start;
    if (follows() || candidates.size() == 0 || method == Method::dgesv ||
        !earlier.predict(Z0, candidates, start))
        return std::nullopt;
    const long products_before = products_taken();
    const NewtonOutcome outcome = solve_from(start, false);
    if (!outcome.converged) return std::nullopt;
    tried = {Z0, outcome};
    earlier.remember(Z0, candidates, solution.v);
    Level level;
    level.separation = Z0;
    level.force = std::accumulate(solution.force.begin(), solution.force.end(), 0.0);
    level.iterations = outcome.iterations;
    level.products = products_taken() - products_before;
    level.residual = outcome.residual;
    level.provisional = true;
    return level;
}

Level AsperityModel::solve(double Z0, bool trial) {
    Impl& my = *impl_;
    const std::optional<Impl::Tried> tried = std::exchange(my.tried, std::nullopt);
    const bool completes = !trial && tried && tried->separation == Z0;
    if (!completes) my.select(Z0);
    if (trial)
        if (std::optional<Level> level = my.solve_trial(Z0)) return std::move(*level);
    if (my.candidates.size() == 0) {
        my.solution.clear();
        my.solved = Z0;
        if (!my.follows()) my.earlier.remember(Z0, my.candidates, my.solution.v);
        return my.report(Z0);
    }
    const long products_before = my.products_taken();
    NewtonOutcome outcome;
    int iterations = 0;
    bool unique = false, settled = false;
    const bool dense = my.method == Method::dgesv;
    Fallback fallback = Fallback::none;
    if (dense) {
        my.use(Method::direct);
        outcome = my.solve_by_paper(fallback);
        iterations = outcome.iterations;
        settled = unique = outcome.converged && my.doubtful().empty();
        my.products->set_points(my.candidates.size(), my.candidates.set.x.data(),
                                my.candidates.set.y.data());
        my.newton.take(my.candidates.set, my.solution.v);
    }
    const bool by_dgesv = dense && unique;
    Vector start;
    if (completes ||
        (!settled && (my.follows() || !dense) && my.earlier.predict(Z0, my.candidates, start))) {
        outcome = completes ? tried->outcome : my.solve_from(start, false);
        iterations += completes ? 0 : outcome.iterations;
        settled = outcome.converged && (my.independent(unique) || my.follows());
    }
    if (!settled) {
        outcome = my.solve_cold();
        iterations += outcome.iterations;
        unique = outcome.converged && my.doubtful().empty();
    }
    if (dense && !by_dgesv && fallback == Fallback::none) fallback = Fallback::not_unique;
    my.solved = Z0;
    if (!my.follows()) my.earlier.remember(Z0, my.candidates, my.solution.v);
    Level level = my.level(Z0, outcome, unique);
    level.iterations = iterations;
    level.products = by_dgesv ? iterations : my.products_taken() - products_before;
    if (by_dgesv) level.method = Method::dgesv;
    if (dense) level.fallback = fallback;
    return level;
}

void AsperityModel::accept(Level& level) {
    Impl& my = *impl_;
    if (!my.law->memory()) return;
    const WorkingSet& set = my.candidates.set;
    my.earlier.remember(my.solved, my.candidates, my.solution.v);
    my.history->accept(set, my.solution, *my.products, level);
    if (my.solution.v.empty()) return;
    // Forces are unchanged; energy and stiffness now refer to unloading.
    my.products->set_points(set.size(), set.x.data(), set.y.data());
    my.newton.take(set, my.solution.v);
}

History* AsperityModel::history() { return impl_->law->memory() ? this : nullptr; }

const Stepper* AsperityModel::stepper() const { return impl_->history->stepper(); }

void AsperityModel::step(double dt, double) { impl_->history->step(dt); }

void AsperityModel::forget() {
    const Impl& my = *impl_;
    if (my.law->memory()) {
        impl_ = std::make_unique<Impl>(my.of_surface, my.indenter, my.options, my.make);
        return;
    }
    impl_->earlier = {};
    impl_->tried.reset();
    impl_->candidates = {};
    impl_->solution.clear();
}

double AsperityModel::shift() const { return impl_->kernel->shift() * impl_->scale(); }

// The force without interaction, which is an upper bound.
double AsperityModel::force_at_most(double depth) {
    Impl& my = *impl_;
    const double Z0 = contact_range().first_touch - depth;
    Candidates there;
    select_candidates(my.contenders(), my.options, Z0, there);
    const WorkingSet& set = there.set;
    double sum = 0;
    for (const auto k : indices(set.g0)) sum += my.law->force(set.asperity[k], set.g0[k]);
    return sum / my.scale();
}

double AsperityModel::stiffness(Slope which) {
    constexpr double rough = 1e-3, exact = 1e-12;
    if (impl_->solution.v.empty()) return 0;
    if (which == Slope::rough) return impl_->force_slope(rough);
    return impl_->newton.stiffness(exact) / impl_->scale();
}

double AsperityModel::energy() const {
    if (const std::optional<double> stored = impl_->history->stored()) return *stored;
    return impl_->solution.v.empty() ? 0 : 0.0 - impl_->newton.energy();
}

void AsperityModel::move_tip(double x0, double y0) {
    Impl& my = *impl_;
    my.tried.reset();
    if (my.of_difference && my.law->memory()) return move_with_history(x0, y0);
    my.earlier.carry(my.candidates, my.solution.v, my.asperities.size(),
                     {my.indenter.x0, my.indenter.y0}, {x0, y0});
    my.indenter.move(x0, y0);
    my.ranking.move(x0, y0);
    if (my.of_difference) my.of_difference->forget();
}

ContactRange AsperityModel::contact_range() const {
    return {.first_touch = impl_->contenders().highest() + impl_->raised()};
}

const Indenter& AsperityModel::indenter() const { return impl_->indenter; }

std::shared_ptr<const Asperities> AsperityModel::asperities() const {
    const std::shared_ptr<const Asperities> present(std::shared_ptr<void>(), &impl_->asperities);
    if (!impl_->of_difference) return present;
    const auto all = std::make_shared<ShiftedSummits>(*impl_->of_difference);
    for (std::size_t i = 0; i < present->size(); ++i) all->shift_and_prepare(i);
    return {all, &all->summits()};
}

}  // namespace rsc
