#include "contact/asperity_contact.hpp"

#include "contact/adhesive_contact.hpp"
#include "contact/answers.hpp"
#include "contact/asperity_level.hpp"
#include "contact/candidates.hpp"
#include "contact/interaction/products.hpp"
#include "contact/law/ellipse_law.hpp"
#include "contact/law/hardness.hpp"
#include "contact/ranking.hpp"
#include "contact/relaxing_asperities.hpp"
#include "contact/solver/dgesv.hpp"
#include "contact/solver/uniqueness.hpp"
#include "contact/start.hpp"
#include "error.hpp"

namespace rsc {
namespace {

using Vector = std::vector<double>;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

// Distance that the tip may move before the summits of the difference are detected again.
double summits_keep(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options) {
    double curvature = 0;
    for (std::size_t i = 0; i < asperities.kappa1.size(); ++i) curvature += std::sqrt(asperities.kappa1[i] * asperities.kappa2[i]);
    const double size = options.rms_slope * static_cast<double>(asperities.kappa1.size()) / curvature;
    return std::fmax(0.1 * size, 0.02 * options.rms_slope * indenter.shape->hertz_radius());  // hertz_radius() is NaN unless it is a sphere
}

// Number of summits not deeper than `depth` below the highest one under the indenter.
std::size_t count_reachable(const Asperities& asperities, const Indenter& indenter, double depth) {
    std::vector<double> height(asperities.size());
    for (std::size_t i = 0; i < height.size(); ++i) height[i] = indenter.clearance(asperities.x[i], asperities.y[i], asperities.z[i]);
    const double highest = height.empty() ? 0.0 : *std::max_element(height.begin(), height.end());
    return static_cast<std::size_t>(std::count_if(height.begin(), height.end(), [&](double h) { return h > highest - depth; }));
}

// True if the law is that of most loaded ellipses.
bool of_ellipses(const ContactBodies& bodies) {
    const SolverOptions& options = bodies.options;
    const auto& found = bodies.of_difference;
    return traits(options.law).needs_heights && found && found->map && !std::isfinite(options.hardness.H0) && options.relaxation.none() &&
           bodies.indenter.layers.count == 0 && options.mean_spacing > 0 &&
           count_reachable(bodies.asperities, bodies.indenter, kDeepest * options.sigma) <= kMostEllipses;
}

std::unique_ptr<Law> law_of(const ContactBodies& bodies, std::optional<RelaxingAsperities>& relaxing) {
    const Asperities& asperities = bodies.asperities;
    const SolverOptions& options = bodies.options;
    auto law = make_law(options.law, asperities, bodies.indenter.E_star);
    if (of_ellipses(bodies)) law = make_ellipse_law(std::move(law), *bodies.of_difference, bodies.indenter, options.mean_spacing);
    law = make_yielding(std::move(law), asperities, options.hardness, traits(options.law).sinks);
    if (options.relaxation.none()) return law;
    const Creep creep(options.relaxation);
    auto relaxes = make_relaxing(std::move(law), asperities.size(), creep);
    relaxing.emplace(asperities, bodies.indenter, *relaxes, creep, options.tolerance);
    return relaxes;
}

// A tip beside the present one, with the summits it touches and their law.
struct Beside {
    Indenter indenter;
    FoundSummits found;
    std::unique_ptr<Law> law;
};

}  // namespace

struct AsperityContact::Impl : ContactBodies {
    double found_x, found_y;  // position of the tip at which the summits were found
    double keeps;             // distance from there up to which they are kept
    std::optional<RelaxingAsperities> relaxing;
    std::unique_ptr<Law> law;
    Ranking ranking;

    // The current level and its solution.
    Candidates candidates;
    Solution solution;
    Method method = Method::direct;
    NewtonOutcome outcome;  // outcome of pass() and settle()
    bool passed = false;    // the solution is that of pass() and has not been settled
    long guessing = 0;      // products taken by guessed_separation() and not yet told
    struct {
        double separation = 0;
        bool unique = true;  // the solution is proved to be unique
    } solved;                // last result of solve()

    EarlierLevels earlier;
    LastingProof proof;
    std::unique_ptr<Products> direct, mesh;  // mesh: created on first use
    Products* products = nullptr;            // the products in use
    Newton newton;
    std::deque<Beside> beside;   // west, east, south, north
    double beside_lowest = 0;    // with ellipses, clearance down to which summits were followed
    std::vector<bool> followed;  // without, those that were

    Impl(const Asperities& asperities_, const Indenter& indenter_, const SolverOptions& options_, SummitSearch search_)
        : ContactBodies(asperities_, indenter_, options_, std::move(search_)),
          found_x(indenter_.x0),
          found_y(indenter_.y0),
          keeps(of_difference && !of_difference->map ? summits_keep(of_surface, indenter, options) : 0),
          law(law_of(*this, relaxing)),
          direct(make_direct_products(kernel, true)),
          newton(*law) {
        use(Method::direct);
        if (options.selection == Selection::paper && std::isnan(indenter.shape->hertz_radius()))
            throw Error(Failure::bad_input, "indentation%selection = 'paper' is defined for a sphere only");
        ranking.assign(asperities, indenter);
    }

    double scale() const { return relaxing ? relaxing->scale() : 1.0; }  // ratio of the forces of the law to the true ones
    // Shift of the separation used by solve() due to earlier loads of a relaxing body (periodic flats).
    double raised() const { return relaxing ? kernel->shift() * relaxing->rest() : 0.0; }
    long products_taken() const { return direct->count() + (mesh ? mesh->count() : 0); }
    void use(Method how);
    void expect_repeats(bool expect) { newton.expect_repeats(expect), direct->expect_repeats(expect); }
    void select(double Z0);  // determines candidates and method
    NewtonOutcome solve_from(const Vector& start, bool rough_start);
    // True if the solution continues the branch of the accepted levels (path-dependent laws). For other laws solve_cold() selects among
    // several solutions.
    bool follows() const { return law->path_dependent(); }
    // Descends from the no-interaction start to a minimum of the energy. This defines the solution if there are several.
    NewtonOutcome solve_cold() { return solve_from(cold_start(*law, *products, candidates.set), true); }
    double force_slope(double tolerance);  // dN/dZ0; the next level is predicted with what this takes
    Level level(double Z0, const NewtonOutcome& outcome, bool unique) const;
    NewtonOutcome solve_by_paper(Fallback& why_not);
    bool one_solution() {
        const auto& [v, force, slope] = solution;
        // On a soft layer self() < 0: a spot wider than the layer can be unstable by itself (no minimum of the energy).
        if (std::any_of(slope.begin(), slope.end(), [&](double rate) { return 1 + rate * kernel->self() <= 0; })) return false;
        const WorkingSet& set = candidates.set;
        if (follows()) return has_one_solution(*law, *kernel, set.asperity, set.x, set.y, v, force, slope);
        return proof.holds(*law, *kernel, set.asperity, set.x, set.y, v, force, slope, {set.g0.front(), indenter.x0, indenter.y0});
    }
    Level report(double Z0) const;
    double step_beside() const { return 2e-3 * of_difference->map->dx; }
    void look_beside(const Level& level);
};

// With ellipses all summits down to a depth are followed, which is counted in half octaves, so that results do not depend on earlier levels;
// otherwise those in contact.
void AsperityContact::Impl::look_beside(const Level& level) {
    const bool ellipses = of_ellipses(*this);
    double lowest = 0;
    if (ellipses) {
        constexpr double more = 1.1;  // nodes of the law's tables are up to a twentieth beyond the penetration
        const double depth = more * (ranking.highest() - level.separation + kernel->shift() * level.force);
        lowest = ranking.highest() - std::exp2(0.5 * std::ceil(2 * std::log2(depth)));
    }
    std::vector<std::size_t> which;
    if (beside.empty() || lowest != beside_lowest) {
        beside.clear(), followed.assign(asperities.size(), false), beside_lowest = lowest;
        for (const Vec2 way : {Vec2{-1, 0}, Vec2{1, 0}, Vec2{0, -1}, Vec2{0, 1}}) {
            Beside& to = beside.emplace_back(Beside{indenter, *of_difference, nullptr});
            to.indenter.x0 += way.x * step_beside(), to.indenter.y0 += way.y * step_beside();
            to.found.summits = asperities;
        }
        for (std::size_t i = 0; i < asperities.size() && ellipses; ++i)
            if (indenter.clearance(asperities.x[i], asperities.y[i], asperities.z[i]) > lowest) which.push_back(i);
    }
    for (const int k : level.asperity)
        if (!ellipses && !followed[at(k)]) which.push_back(at(k)), followed[at(k)] = true;
    if (which.empty()) return;
    for (Beside& to : beside) {
        to.found.summits = follow_summits(*to.found.map, std::move(to.found.summits), which, to.found.lay, to.found.threads,
                                          to.found.points_per_wave, Face(to.indenter), to.found.breaks.get());
        to.law = make_law(options.law, to.found.summits, indenter.E_star);
        if (ellipses) to.law = make_ellipse_law(std::move(to.law), to.found, to.indenter, options.mean_spacing, law.get());
    }
}

void AsperityContact::Impl::use(Method how) {
    method = how;
    if (how == Method::mesh && !mesh) {
        // Full products determine the residual and must be more accurate than the tolerance; inner products only determine steps.
        mesh = make_mesh_products(kernel, std::min(1e-4, 0.1 * options.tolerance), 1e-3);
    }
    products = how == Method::mesh ? mesh.get() : direct.get();
    newton.use(*products);
}

void AsperityContact::Impl::select(double Z0) {
    candidates = select_candidates(ranking, asperities, indenter, options, *law, Z0 - raised());
    use(choose_method(options, *kernel, candidates.set));
    if (relaxing) relaxing->lower(candidates, *products);
}

NewtonOutcome AsperityContact::Impl::solve_from(const Vector& start, bool rough_start) {
    return solve_candidates(candidates.set, newton, *products, {options.tolerance, options.max_iterations, rough_start}, start, solution);
}

NewtonOutcome AsperityContact::Impl::solve_by_paper(Fallback& why_not) {
    auto& [v, force, slope] = solution;
    const PaperMethod paper{options.delta0 * options.sigma, options.delta_cut, options.tolerance, options.max_iterations};
    const PaperOutcome result = solve_by_dgesv(*law, *kernel, candidates.set, paper, v, force, slope);
    if (!result.converged) why_not = result.singular ? Fallback::dgesv_singular : Fallback::dgesv_not_converged;
    return result;
}

Level AsperityContact::Impl::report(double Z0) const {
    const WorkingSet& set = candidates.set;
    const auto& [v, force, slope] = solution;
    Level level;
    level.separation = Z0;
    level.candidates = candidates.size();
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < force.size(); ++k) {
        if (force[k] > 0) order.push_back(k);
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return set.asperity[a] < set.asperity[b]; });
    for (auto* list : {&level.x, &level.y, &level.f, &level.a, &level.u}) list->reserve(order.size());
    level.asperity.reserve(order.size()), level.yields.reserve(order.size());
    double extreme = 0;
    for (std::size_t k : order) {
        const double area = law->area(set.asperity[k], v[k]);
        const double f = force[k] / scale();
        level.add_contact(set.asperity[k], set.x[k], set.y[k], f, std::sqrt(area / std::numbers::pi), v[k]);
        level.force += f;
        level.area += area;
        level.beyond_law += law->beyond(set.asperity[k], v[k]);
        level.yields.push_back(law->yields(set.asperity[k], v[k]));
        level.plastic_contacts += level.yields.back();
        if (f > kExtreme * indenter.E_star * area) extreme += area;
    }
    if (level.area > 0) level.extreme_area_fraction = extreme / level.area;
    judge_asperities(level, *law, *this);
    return level;
}

// Where there is no contact the surface sinks as the contacts do on the average.
double AsperityContact::Impl::force_slope(double tolerance) {
    const double slope = newton.stiffness(tolerance);
    const Vector sinking = newton.sinking();
    if (follows() || sinking.empty()) return slope / scale();
    const double mean = std::accumulate(sinking.begin(), sinking.end(), 0.0) / static_cast<double>(sinking.size());
    Vector change(solution.force.size(), -1 - mean);
    for (std::size_t k = 0, active = 0; k < change.size(); ++k)
        if (solution.force[k] > 0) change[k] = -1 - sinking[active++];
    earlier.bend(candidates, change);
    return slope / scale();
}

Level AsperityContact::Impl::level(double Z0, const NewtonOutcome& outcome, bool unique) const {
    Level level = report(Z0);
    level.residual = outcome.residual;
    level.method = method;
    if (options.method == Method::mesh && method != Method::mesh) level.fallback = Fallback::no_interaction;
    if (!unique) level.status = graver(level.status, LevelStatus::not_unique);
    if (!outcome.converged) level.status = LevelStatus::not_converged;
    return level;
}

AsperityContact::AsperityContact(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options, SummitSearch search)
    : impl_(std::make_unique<Impl>(asperities, indenter, options, std::move(search))) {}
AsperityContact::~AsperityContact() = default;
AsperityContact::AsperityContact(AsperityContact&&) noexcept = default;

Level AsperityContact::solve(double Z0) {
    Impl& my = *impl_;
    my.passed = false;
    my.select(Z0);
    if (my.candidates.size() == 0) {
        my.solution.clear();
        my.solved = {Z0, true};
        if (!my.follows()) my.earlier.remember(Z0, my.candidates, my.solution.v, true);
        return my.report(Z0);
    }
    const long products_before = my.products_taken();
    NewtonOutcome outcome;
    int iterations = 0;
    bool unique = false, followed = false;
    const bool dense = my.method == Method::dgesv;
    Fallback fallback = Fallback::none;
    if (dense) {
        my.use(Method::direct);
        outcome = my.solve_by_paper(fallback);
        iterations = outcome.iterations;
        unique = outcome.converged && my.one_solution();
        my.products->set_points(my.candidates.size(), my.candidates.set.x.data(), my.candidates.set.y.data());
        my.newton.take(my.candidates.set, my.solution.v);
    }
    const bool by_dgesv = dense && unique;
    if (Vector start; !unique && (my.follows() || (!dense && my.earlier.unique())) && my.earlier.predict(Z0, my.candidates, start)) {
        outcome = my.solve_from(start, false);
        iterations += outcome.iterations;
        unique = outcome.converged && my.one_solution();
        followed = my.follows() && outcome.converged;
    }
    if (!unique && !followed) {
        outcome = my.solve_cold();
        iterations += outcome.iterations;
        unique = outcome.converged && my.one_solution();
    }
    if (dense && !by_dgesv && fallback == Fallback::none) fallback = Fallback::not_unique;
    my.solved = {Z0, unique};
    if (!my.follows()) my.earlier.remember(Z0, my.candidates, my.solution.v, unique);
    Level level = my.level(Z0, outcome, unique);
    level.iterations = iterations;
    level.products = by_dgesv ? iterations : my.products_taken() - products_before + std::exchange(my.guessing, 0);
    if (by_dgesv) level.method = Method::dgesv;
    if (dense) level.fallback = fallback;
    return level;
}

Level AsperityContact::pass(double Z0) {
    Impl& my = *impl_;
    my.select(Z0);
    Vector start;
    if (my.follows() || my.candidates.size() == 0 || my.method == Method::dgesv || !my.earlier.predict(Z0, my.candidates, start))
        return solve(Z0);
    const long products_before = my.products_taken();
    my.outcome = my.solve_from(start, false);
    if (!my.outcome.converged) return solve(Z0);
    my.passed = true;
    my.earlier.remember(Z0, my.candidates, my.solution.v, false, true);
    Level level;
    level.separation = Z0;
    for (double f : my.solution.force) level.force += f / my.scale();
    level.iterations = my.outcome.iterations;
    level.products = my.products_taken() - products_before + std::exchange(my.guessing, 0);
    return level;
}

// Without interaction the force N belongs to a depth, which the interaction increases by s, the mean of B F. There a solution to some per
// cent shows by its slope where the force is N.
std::optional<double> AsperityContact::guessed_separation(double N) {
    Impl& my = *impl_;
    if (my.follows() || my.options.method == Method::dgesv) return {};
    constexpr double near = 0.05, rough = 0.02, slope = 1e-2;
    constexpr double shallow = 0.25, shrink = 0.125, grow = 3;  // in rms heights; the ranking is extended seldom
    constexpr int depths = 200;
    double depth = std::max(shallow * my.options.sigma, std::numeric_limits<double>::epsilon() * std::abs(first_touch()));
    double force_there = force_at_most(depth), power = 5;
    for (int i = 0; i < depths && std::abs(force_there / N - 1) > near; ++i) {  // secants of logarithms
        const double ratio = force_there > 0 ? std::clamp(std::pow(N / force_there, 1 / power), shrink, grow) : grow;
        const double next = force_at_most(depth *= ratio);
        if (next > 0 && force_there > 0 && ratio != 1) power = std::max(std::log(next / force_there) / std::log(ratio), 1.0);
        force_there = next;
    }
    if (!(force_there > 0)) return {};
    const long products_before = my.products_taken();
    my.select(first_touch() - depth);
    const WorkingSet& set = my.candidates.set;
    Vector force, phi(at(set.size()));
    for (std::size_t k = 0; k < phi.size(); ++k) force.push_back(my.law->force(set.asperity[k], set.g0[k]));
    std::vector<int> all(phi.size());
    std::iota(all.begin(), all.end(), 0);
    my.products->set_points(set.size(), set.x.data(), set.y.data());
    my.products->set_active(all);
    my.products->inner(force.data(), phi.data());
    // Forces in proportion to those without interaction raise the surface more than the true ones do: by 1.4 to 1.8 times on the default
    // surface at any depth.
    constexpr double screened = 0.67;
    const double s =
        screened * std::inner_product(force.begin(), force.end(), phi.begin(), 0.0) / std::accumulate(force.begin(), force.end(), 0.0);
    double Z0 = first_touch() - depth - s;
    if (!std::isfinite(Z0)) return {};
    my.select(Z0);
    Vector start(set.g0);
    for (double& v : start) v -= s;
    const NewtonOutcome outcome =
        solve_candidates(set, my.newton, *my.products, {rough, my.options.max_iterations, false}, start, my.solution);
    double sum = std::accumulate(my.solution.force.begin(), my.solution.force.end(), 0.0) / my.scale();
    if (outcome.converged && sum > 0) {
        my.earlier.remember(Z0, my.candidates, my.solution.v, false, true);
        const double rise = my.force_slope(slope);
        sum += my.newton.missing_force() / my.scale();
        Z0 += std::log(N / sum) * sum / rise;
    }
    my.guessing = my.products_taken() - products_before;
    return Z0;
}

Level AsperityContact::settle(const Level& passed) {
    Impl& my = *impl_;
    if (!my.passed) return Contact::settle(passed);
    my.passed = false;
    const long products_before = my.products_taken();
    const bool unique = my.one_solution();
    int iterations = 0;
    if (!unique) {  // the solution of pass() is not proved to be unique
        my.outcome = my.solve_cold();
        iterations = my.outcome.iterations;
    }
    my.earlier.remember(passed.separation, my.candidates, my.solution.v, unique);
    Level level = my.level(passed.separation, my.outcome, unique);
    level.iterations = iterations;
    level.products = my.products_taken() - products_before;
    return level;
}

void AsperityContact::accept(Level& level) {
    Impl& my = *impl_;
    if (!my.law->path_dependent()) return;
    const WorkingSet& set = my.candidates.set;
    my.earlier.remember(my.solved.separation, my.candidates, my.solution.v, my.solved.unique);
    if (my.relaxing) {
        my.relaxing->accept(set, my.solution, *my.products);
        level.energy_lost = my.relaxing->lost();
    } else {
        my.law->commit(set.size(), set.asperity.data(), my.solution.v.data());
        level.plastic_work = my.law->work_lost();
    }
    if (my.solution.v.empty()) return;
    // Forces are unchanged; energy and stiffness now refer to unloading.
    my.products->set_points(set.size(), set.x.data(), set.y.data());
    my.newton.take(set, my.solution.v);
}

bool AsperityContact::relaxes() const { return impl_->relaxing.has_value(); }

double AsperityContact::shortest_time() const { return impl_->options.relaxation.shortest(); }

void AsperityContact::step(double dt) { impl_->relaxing->step(dt); }

std::vector<double> AsperityContact::residual_depths() const {
    std::vector<double> depths;
    if (!path_dependent() || relaxes()) return depths;
    for (std::size_t i = 0; i < impl_->asperities.size(); ++i) depths.push_back(impl_->law->residual_depth(static_cast<int>(i)));
    return depths;
}

std::optional<Level> AsperityContact::lasting_loads(const Level& level) const {
    if (!relaxes()) return {};
    return impl_->relaxing->lasting(level);
}

// Pairs of the index of a yielded asperity and its largest penetration; for relaxing bodies the time, followed by their state.
std::vector<double> AsperityContact::memory() const {
    std::vector<double> pairs;
    if (relaxes()) {
        pairs = last_accepted();
        impl_->relaxing->write(pairs);
        return pairs;
    }
    for (const int i : impl_->law->yielded()) pairs.insert(pairs.end(), {static_cast<double>(i), impl_->law->deepest(i)});
    return pairs;
}

void AsperityContact::recall(const std::vector<double>& memory, const Level* level) {
    Impl& my = *impl_;
    if (relaxes()) {
        my.relaxing->read(recall_accepted(memory));
    } else {
        std::vector<int> yielded;
        Vector deepest;
        for (std::size_t k = 0; k + 1 < memory.size(); k += 2) {
            if (!(memory[k] >= 0 && memory[k] < static_cast<double>(my.asperities.size()) && std::isfinite(memory[k + 1])))
                throw Error(Failure::bad_input, "the state does not belong to a contact of these asperities");
            yielded.push_back(static_cast<int>(memory[k])), deepest.push_back(memory[k + 1]);
        }
        my.law->forget();
        my.law->prepare(yielded);
        my.law->commit(static_cast<int>(yielded.size()), yielded.data(), deepest.data());
    }
    my.earlier = {};
    my.expect_repeats(false);
    my.candidates = {};
    my.solution.clear();
    if (!level) return;
    const double Z0 = level->separation - shift() * level->force;  // separation as defined for solve()
    if (!my.follows()) return (void)solve(Z0);
    my.select(Z0);
    Vector start(at(my.candidates.size()), -1e300);  // no contact
    const auto& known = level->asperity;
    for (std::size_t k = 0; k < start.size(); ++k) {
        const auto found = std::lower_bound(known.begin(), known.end(), my.candidates.set.asperity[k]);
        if (found != known.end() && *found == my.candidates.set.asperity[k])
            start[k] = level->u[at(static_cast<int>(found - known.begin()))];
    }
    my.solution.clear();
    if (start.empty()) return;
    my.solve_from(start, false);
    my.solved = {Z0, level->status != LevelStatus::not_unique};
    my.earlier.remember(Z0, my.candidates, my.solution.v, my.solved.unique);
}

void AsperityContact::forget_levels() {
    const Impl& my = *impl_;
    if (my.of_difference && (my.law->path_dependent() || my.indenter.x0 != my.found_x || my.indenter.y0 != my.found_y)) {
        impl_ = std::make_unique<Impl>(my.of_surface, Indenter(my.indenter), SolverOptions(my.options), my.search);
        return;
    }
    impl_->earlier = {};
    impl_->expect_repeats(false);
    impl_->proof = {};
    impl_->candidates = {};
    impl_->solution.clear();
    impl_->ranking.assign(impl_->asperities, impl_->indenter);
}

bool AsperityContact::path_dependent() const { return impl_->law->path_dependent(); }

double AsperityContact::tolerance() const { return impl_->options.tolerance * impl_->newton.share(); }

// The force without interaction, which is an upper bound.
double AsperityContact::force_at_most(double depth) {
    Impl& my = *impl_;
    const double Z0 = first_touch() - depth;
    const WorkingSet set = select_candidates(my.ranking, my.asperities, my.indenter, my.options, *my.law, Z0).set;
    double sum = 0;
    for (std::size_t k = 0; k < set.g0.size(); ++k) sum += my.law->force(set.asperity[k], set.g0[k]);
    return sum / my.scale();
}

std::optional<double> AsperityContact::likely_separation() const {
    if (impl_->solution.force.empty()) return std::nullopt;
    return impl_->earlier.likely_separation(first_touch());
}

std::size_t AsperityContact::levels_since_move() const { return impl_->earlier.size(); }

double AsperityContact::shift() const { return impl_->kernel->shift() * impl_->scale(); }

void AsperityContact::begins() { impl_->newton.begin_level(); }

// With Z0 = Z0' + c N, c the kernel's shift: dZ0/dN = 1/(dN/dZ0') + c.
double AsperityContact::slope() {
    if (shift() == 0) impl_->newton.expect_exact();
    return impl_->solution.v.empty() ? 0 : impl_->force_slope(1e-3);
}

double AsperityContact::stiffness() {
    if (impl_->solution.v.empty()) return 0;
    const double slope = impl_->newton.stiffness(1e-12) / impl_->scale();
    return slope / (1 + shift() * slope);
}

// The shift c adds c N^2/2 to F'BF/2, which is not part of the energy of the bodies.
double AsperityContact::energy() const {
    if (relaxes()) return impl_->relaxing->stored();
    if (impl_->solution.v.empty()) return 0;
    double N = 0;
    for (double f : impl_->solution.force) N += f;
    return 0.0 - impl_->newton.energy() - 0.5 * shift() * N * N;
}

Vec2 AsperityContact::lateral(const Level& level) {
    constexpr double jump = 1e-4, most = 0.1;  // difference of the slopes to both sides over N; largest change by summits
    Impl& my = *impl_;
    const Vec2 sum = lateral_force(my.indenter, level);
    if (!my.of_difference || !my.of_difference->map || my.follows() || !(level.force > 0)) return sum;
    const double Z0 = level.separation - shift() * level.force, W = energy();
    my.look_beside(level);
    const auto products = make_direct_products(my.kernel);
    std::vector<double> W_beside;
    for (Beside& to : my.beside) {
        const Asperities& a = to.found.summits;
        to.law->prepare(level.asperity);
        WorkingSet set;
        for (const int k : level.asperity) {
            const std::size_t i = at(k);
            const Vec2 place = to.indenter.image(a.x[i], a.y[i]);
            set.asperity.push_back(k), set.x.push_back(place.x), set.y.push_back(place.y);
            set.g0.push_back(to.indenter.clearance(a.x[i], a.y[i], a.z[i]) - Z0);
        }
        // At the penetrations of the present tip W is off by the square of the step, alike on both sides.
        Newton newton(*to.law);
        newton.use(*products);
        products->set_points(set.size(), set.x.data(), set.y.data());
        newton.take(set, level.u);
        W_beside.push_back(0 - newton.energy() - 0.5 * shift() * level.force * level.force);
    }
    const auto slope = [&](double low, double high, double likely) {
        const double before = (low - W) / my.step_beside(), after = (W - high) / my.step_beside();
        double best = 0.5 * (before + after);
        for (const double one : {before, after})
            if (std::abs(after - before) > jump * level.force && std::abs(one - likely) < std::abs(best - likely)) best = one;
        return std::abs(best - likely) < most * level.force ? best : likely;
    };
    return {slope(W_beside[0], W_beside[1], sum.x), slope(W_beside[2], W_beside[3], sum.y)};
}

void AsperityContact::move_tip(double x0, double y0) {
    if (!std::isfinite(x0) || !std::isfinite(y0)) throw Error(Failure::bad_input, "the tip's position must be finite");
    Impl& my = *impl_;
    if (my.of_difference && my.law->path_dependent()) return move_with_memory(x0, y0);
    my.earlier.carry(my.candidates, my.solution.v, my.asperities.size(), {my.indenter.x0, my.indenter.y0}, {x0, y0});
    const bool opens = my.indenter.repeats.finite() && !my.indenter.around.finite();
    my.indenter.move(x0, y0);
    if (my.of_difference) {
        const double moved = std::hypot(my.indenter.around.nearest_x(x0 - my.found_x), my.indenter.around.nearest_y(y0 - my.found_y));
        // With the heights at hand the summits are those of the place of the tip, as in a new contact.
        if (opens || moved > my.keeps) {
            forget();
            return;
        }
    }
    my.ranking.move(x0, y0);
    my.expect_repeats(true);
}

// The summits of the difference are those of the new place. What the bodies keep of earlier loads is known by the number of the summit.
void AsperityContact::move_with_memory(double x0, double y0) {
    const Impl& my = *impl_;
    const std::vector<double> kept = memory();
    Indenter there = my.indenter;
    there.move(x0, y0);
    auto moved = std::make_unique<Impl>(my.of_surface, there, SolverOptions(my.options), my.search);
    const bool nothing = kept.empty() || (relaxes() && my.relaxing->stored() == 0 && my.relaxing->lost() == 0);
    if (!nothing && (my.of_difference->renumbered || !moved->of_difference || moved->of_difference->renumbered))
        throw Error(Failure::bad_input,
                    "the tip cannot move over bodies that yielded or relax, where the slope of the indenter is above 0.2 of that of the "
                    "surface: use solver%model = 'elements' or asperities%law = 'hertz'");
    impl_ = std::move(moved);
    const double now = time();
    if (!nothing) recall(kept, nullptr);
    set_time(now);
}

double AsperityContact::first_touch() const { return impl_->ranking.highest() + impl_->raised(); }

const Indenter& AsperityContact::indenter() const { return impl_->indenter; }

const Asperities* AsperityContact::asperities() const { return &impl_->asperities; }

std::unique_ptr<Contact> make_asperity_contact(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options,
                                               SummitSearch search) {
    if (options.adhesion.work > 0) return make_adhesive_contact(asperities, indenter, options, std::move(search));
    return std::make_unique<AsperityContact>(asperities, indenter, options, std::move(search));
}

}  // namespace rsc
