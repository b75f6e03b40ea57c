#include "contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>

#include "contact/interaction/mesh.hpp"
#include "contact/interaction/pairs.hpp"
#include "contact/ranking.hpp"
#include "contact/solver/dgesv.hpp"
#include "contact/solver/uniqueness.hpp"
#include "contact/spots.hpp"
#include "error.hpp"

namespace rsc {
namespace {

using Vector = std::vector<double>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::size_t at(int k) { return static_cast<std::size_t>(k); }

}  // namespace

struct Contact::Impl {
    const Asperities& asperities;
    Indenter indenter;
    SolverOptions options;
    std::unique_ptr<Law> law;

    Ranking ranking;

    // The candidates of the level at hand, and the answer.
    WorkingSet candidates;
    std::vector<std::size_t> rank;  // of each candidate
    Vector v, force, slope;

    std::unique_ptr<Products> direct, mesh;  // mesh: made when first wanted
    Products* products = nullptr;            // the one in use
    Method method = Method::direct;          // the level's
    Newton newton;
    WorkingSet working;
    Vector working_v;

    // Earlier levels: B F by rank, from which the next is predicted.
    struct Past {
        double separation;
        Vector phi;
    };
    std::deque<Past> past;
    bool past_unique = true;

    // The last level before the tip moved: B F by asperity (NaN: not known), the start of the first level after the move.
    struct Carried {
        double separation = 0;
        Vector phi;  // empty: none
    } carried;

    Impl(const Asperities& asperities_, const Indenter& indenter_, const SolverOptions& options_)
        : asperities(asperities_),
          indenter(indenter_),
          options(options_),
          law(make_law(options_.law, asperities_, indenter_.E_star)),
          direct(make_direct_products(options_.interaction == Interaction::none ? kInfinity : indenter_.E_star)),
          newton(*law) {
        use(Method::direct);
        if (!(indenter.E_star > 0) || std::isinf(indenter.E_star)) {
            throw Error(Failure::bad_input, "E* must be positive and finite");
        }
        if (!(indenter.R > 0)) throw Error(Failure::bad_input, "the sphere's radius must be positive (Infinity: flat)");
        ranking.assign(asperities, indenter);
    }

    double E_star() const { return direct->modulus(); }
    long products_taken() const { return direct->count() + (mesh ? mesh->count() : 0); }
    void use(Method how);
    Method choose() const;

    void carry();
    void select(double Z0);
    NewtonOutcome solve_from(const Vector& start, bool rough_start);
    bool predict(double Z0, Vector& start) const;
    Vector cold_start();
    bool one_solution() const { return has_one_solution(*law, E_star(), candidates.asperity, candidates.x, candidates.y, v, force, slope); }
    void remember(double Z0, bool unique);
    Level report(double Z0) const;
    std::vector<Spot> spots(const Level& level) const;
};

// Ranks lose their meaning when the tip moves: the last level is kept by asperity.
void Contact::Impl::carry() {
    if (past.empty()) return;  // moved twice in a row: what was carried stays
    carried.phi.clear();
    if (past_unique && v.size() == at(candidates.size())) {
        carried.separation = past.front().separation;
        carried.phi.assign(asperities.size(), std::numeric_limits<double>::quiet_NaN());
        for (std::size_t k = 0; k < v.size(); ++k) carried.phi[at(candidates.asperity[k])] = candidates.g0[k] - v[k];
    }
    past.clear();
    past_unique = true;
}

// Candidates: g0 > 0; B F >= 0 only lowers the surface, so nothing else can touch. The paper's selection drops also those outside
// r0 = 1.5 sqrt(2 (4 sigma - Z0) R).
void Contact::Impl::select(double Z0) {
    std::vector<int> fresh;
    const std::size_t last = ranking.above(Z0, fresh);
    law->prepare(fresh);
    double r0_squared = kInfinity;
    if (options.selection == Selection::paper) {
        const double depth = std::max(0.0, 4 * options.sigma - Z0);
        r0_squared = options.selection_factor * options.selection_factor * 2 * depth * indenter.R;
    }
    candidates = {};
    rank.clear();
    for (std::size_t r = 0; r < last; ++r) {
        const auto i = at(ranking[r].asperity);
        const double dx = asperities.x[i] - indenter.x0, dy = asperities.y[i] - indenter.y0;
        if (dx * dx + dy * dy > r0_squared) continue;
        rank.push_back(r);
        candidates.asperity.push_back(ranking[r].asperity);
        candidates.x.push_back(asperities.x[i]);
        candidates.y.push_back(asperities.y[i]);
        candidates.g0.push_back(ranking[r].height - Z0);
    }
}

void Contact::Impl::use(Method how) {
    method = how;
    if (how == Method::mesh && !mesh) {
        // Full products judge the residual and must be finer than the tolerance; inner ones only make steps.
        mesh = make_mesh_products(E_star(), std::min(1e-4, 0.1 * options.tolerance), 1e-3);
    }
    products = how == Method::mesh ? mesh.get() : direct.get();
    newton.use(*products);
}

// `auto`: direct or mesh by what a Newton solve costs, from the rates test/bench measures. The dense method is never the cheapest.
Method Contact::Impl::choose() const {
    if (std::isinf(E_star())) return options.method == Method::dgesv ? Method::dgesv : Method::direct;
    if (options.method != Method::automatic) return options.method;
    // A solve takes some 40 inner products; the mesh also some full ones its making, and points that lie closer in the middle.
    constexpr double contacts_per_candidate = 0.4, pairs_per_second = 6e9, mesh_overhead = 4;
    const double contacts = contacts_per_candidate * static_cast<double>(candidates.size());
    const double mesh_cost = mesh_overhead * MeshPotential::estimated_cost(at(candidates.size()), 1e-3);
    return contacts * contacts / pairs_per_second > mesh_cost ? Method::mesh : Method::direct;
}

// The no-interaction forces F = f(<g0 - s>) of a sphere held higher by s, where s is the mean of B F over those forces: the mean field
// of the interaction. Found by bisection, with a fixed number of products.
Vector Contact::Impl::cold_start() {
    const int n = candidates.size();
    Vector start(at(n)), F(at(n)), D(at(n)), W(at(n)), active_F, phi(at(n));
    std::vector<int> active;
    products->set_points(n, candidates.x.data(), candidates.y.data());
    double low = 0, high = candidates.g0.front();
    for (double g : candidates.g0) high = std::max(high, g);
    constexpr int bisections = 6;
    for (int i = 0; i < bisections; ++i) {
        const double s = 0.5 * (low + high);
        for (std::size_t k = 0; k < at(n); ++k) start[k] = candidates.g0[k] - s;
        law->respond(n, candidates.asperity.data(), start.data(), F.data(), D.data(), W.data());
        active.clear();
        active_F.clear();
        double total = 0, weighted = 0;
        for (int k = 0; k < n; ++k) {
            if (!(F[at(k)] > 0)) continue;
            active.push_back(k);
            active_F.push_back(F[at(k)]);
            total += F[at(k)];
        }
        products->set_active(active);
        products->inner(active_F.data(), phi.data());
        for (std::size_t k = 0; k < active.size(); ++k) weighted += active_F[k] * phi[k];
        (weighted > s * total ? low : high) = s;
    }
    for (std::size_t k = 0; k < at(n); ++k) start[k] = candidates.g0[k] - low;
    return start;
}

// From a start over the candidates to the solution v, force, slope over the candidates. Candidates far from touching are left out
// of the working set, checked at the end, and taken in where they do touch after all. After a rough start the set is drawn anew as
// soon as the solution is known to some ten per cent, and what is found is a minimum; after another start only uniqueness tells.
NewtonOutcome Contact::Impl::solve_from(const Vector& start, bool rough_start) {
    const std::size_t n = at(candidates.size());
    std::vector<char> in(n);
    const auto draw = [&](const Vector& penetration) {
        const double highest = *std::max_element(penetration.begin(), penetration.end());
        for (std::size_t k = 0; k < n; ++k) in[k] = method == Method::mesh || penetration[k] > -0.03 * highest;
    };
    draw(start);
    bool settle = !rough_start || method == Method::mesh;
    v = start;
    NewtonOutcome total;
    std::vector<std::size_t> inside, outside;
    Vector xo, yo, phi;
    for (;;) {
        inside.clear();
        outside.clear();
        working = {};
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
        products->set_points(working.size(), working.x.data(), working.y.data());
        const double tolerance = settle ? options.tolerance : std::max(options.tolerance, 0.1);
        const auto outcome = newton.solve(working, tolerance, options.max_iterations - total.iterations, working_v, settle && rough_start);
        total.iterations += outcome.iterations;
        total.converged = outcome.converged;
        total.minimum = outcome.minimum;
        total.residual = outcome.residual;
        force.assign(n, 0.0);
        slope.assign(n, 0.0);
        for (std::size_t k = 0; k < inside.size(); ++k) {
            force[inside[k]] = newton.force()[k];
            slope[inside[k]] = newton.slope()[k];
            v[inside[k]] = working_v[k] > 0 ? working_v[k] : candidates.g0[inside[k]] - newton.phi()[k];
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
        for (std::size_t k = 0; k < outside.size(); ++k) v[outside[k]] = candidates.g0[outside[k]] - phi[k];
        if (!settle) {
            settle = true;
            draw(v);
            continue;
        }
        bool complete = true;
        for (std::size_t k = 0; k < outside.size(); ++k) {
            // Single precision decides only what it can: within its error of touching, the point joins the working set.
            if (v[outside[k]] > -1e-4 * phi[k]) {
                in[outside[k]] = 1;
                complete = false;
            }
        }
        if (complete || !total.converged) break;
    }
    return total;
}

// B F extrapolated through earlier levels, rank by rank; candidates without a past are taken not to touch (they are checked).
bool Contact::Impl::predict(double Z0, Vector& start) const {
    if (past.empty() && !carried.phi.empty()) {
        start.resize(rank.size());
        bool any = false;
        for (std::size_t k = 0; k < rank.size(); ++k) {
            const double phi = carried.phi[at(candidates.asperity[k])];
            start[k] = std::isfinite(phi) ? candidates.g0[k] - phi : -kInfinity;
            any = any || start[k] > 0;
        }
        return any;
    }
    if (past.empty() || !past_unique) return false;
    std::size_t used = 1;
    while (used < past.size() && used < 4) {
        const double gap = std::abs(past[used - 1].separation - past[used].separation);
        if (!(gap > 0) || std::abs(Z0 - past[0].separation) > 2.5 * gap) break;
        ++used;
    }
    double weight[4];
    for (std::size_t a = 0; a < used; ++a) {
        weight[a] = 1;
        for (std::size_t b = 0; b < used; ++b) {
            if (b != a) weight[a] *= (Z0 - past[b].separation) / (past[a].separation - past[b].separation);
        }
    }
    start.resize(rank.size());
    bool any = false;
    for (std::size_t k = 0; k < rank.size(); ++k) {
        double phi = 0;
        bool known = true;
        for (std::size_t a = 0; a < used && known; ++a) {
            known = rank[k] < past[a].phi.size();
            if (known) phi += weight[a] * past[a].phi[rank[k]];
        }
        if (!known && rank[k] < past[0].phi.size()) {
            phi = past[0].phi[rank[k]];
            known = true;
        }
        start[k] = known && std::isfinite(phi) ? candidates.g0[k] - phi : -kInfinity;
        any = any || start[k] > 0;
    }
    return any;
}

void Contact::Impl::remember(double Z0, bool unique) {
    past_unique = unique;
    Past level{Z0, Vector(rank.empty() ? 0 : rank.back() + 1, std::numeric_limits<double>::quiet_NaN())};
    for (std::size_t k = 0; k < rank.size(); ++k) level.phi[rank[k]] = candidates.g0[k] - v[k];
    past.push_front(std::move(level));
    if (past.size() > 4) past.pop_back();
}

// The contacts of a level as they lie on the surface: their long axes are those of the smaller curvature.
std::vector<Spot> Contact::Impl::spots(const Level& level) const {
    std::vector<Spot> spots;
    for (std::size_t k = 0; k < level.asperity.size(); ++k) {
        const std::size_t i = at(level.asperity[k]);
        const double root = std::sqrt(law->axes(level.asperity[k]));
        spots.push_back({asperities.x[i], asperities.y[i], level.a[k] / root, level.a[k] * root, asperities.angle[i]});
    }
    return spots;
}

Level Contact::Impl::report(double Z0) const {
    Level level;
    level.separation = Z0;
    level.candidates = candidates.size();
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < force.size(); ++k) {
        if (force[k] > 0) order.push_back(k);
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return candidates.asperity[a] < candidates.asperity[b]; });
    Vector x, y;
    for (std::size_t k : order) {
        const double area = law->area(candidates.asperity[k], v[k]);
        level.asperity.push_back(candidates.asperity[k]);
        level.f.push_back(force[k]);
        level.a.push_back(std::sqrt(area / std::numbers::pi));
        level.u.push_back(v[k]);
        level.force += force[k];
        level.area += area;
        level.beyond_law += law->beyond(candidates.asperity[k], v[k]);
        level.large_contacts += options.mean_spacing > 0 && level.a.back() > options.mean_spacing / 4;
        x.push_back(candidates.x[k]);
        y.push_back(candidates.y[k]);
    }
    if (options.law == LawKind::hertz)
        level.overlapping_pairs = count_overlapping(x, y, level.a);
    else
        level.area = union_area(spots(level), &level.overlapping_pairs);
    if (level.large_contacts > 0 || level.beyond_law > 0) level.status = LevelStatus::out_of_validity;
    if (level.overlapping_pairs > 0) level.status = LevelStatus::overlapping;
    return level;
}

Contact::Contact(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options)
    : impl_(std::make_unique<Impl>(asperities, indenter, options)) {}
Contact::~Contact() = default;
Contact::Contact(Contact&&) noexcept = default;

Level Contact::at_separation(double Z0) {
    Impl& my = *impl_;
    if (!std::isfinite(Z0)) throw Error(Failure::bad_input, "the separation must be finite");
    my.select(Z0);
    if (my.candidates.size() == 0) {
        my.v.clear();
        my.force.clear();
        my.slope.clear();
        my.remember(Z0, true);
        return my.report(Z0);
    }
    const long products_before = my.products_taken();
    NewtonOutcome outcome;
    int iterations = 0;
    bool unique = false;
    const Method method = my.choose();
    const bool dense = method == Method::dgesv;
    my.use(dense ? Method::direct : method);
    if (dense) {
        const PaperMethod method{my.options.delta0 * my.options.sigma, my.options.delta_cut, my.options.tolerance,
                                 my.options.max_iterations};
        const auto paper = solve_by_dgesv(*my.law, my.E_star(), my.candidates, method, my.v, my.force);
        iterations = paper.iterations;
        outcome.converged = paper.converged;
        outcome.residual = paper.residual;
        my.slope.resize(my.v.size());
        Vector target(my.v.size()), work(my.v.size());
        my.law->respond(my.candidates.size(), my.candidates.asperity.data(), my.v.data(), target.data(), my.slope.data(), work.data());
        unique = paper.converged && my.one_solution();
        my.products->set_points(my.candidates.size(), my.candidates.x.data(), my.candidates.y.data());
        my.newton.take(my.candidates, my.v);
    } else {
        Vector start;
        if (my.predict(Z0, start)) {
            outcome = my.solve_from(start, false);
            iterations = outcome.iterations;
            unique = outcome.converged && my.one_solution();
        }
    }
    if (!unique) {  // the rule that defines the answer: from the no-interaction start, downhill to a minimum
        outcome = my.solve_from(my.cold_start(), true);
        iterations += outcome.iterations;
        unique = outcome.converged && my.one_solution();
    }
    my.remember(Z0, unique);
    Level level = my.report(Z0);
    level.iterations = iterations;
    level.products = my.products_taken() - products_before;
    level.residual = outcome.residual;
    level.method = method;
    if (!unique) level.status = LevelStatus::not_unique;
    if (!outcome.converged) level.status = LevelStatus::not_converged;
    return level;
}

// Newton on ln N(Z0), whose slope the stiffness gives, kept inside a bracket that shrinks at every level.
Level Contact::at_force(double N) {
    Impl& my = *impl_;
    if (!(N > 0) || !std::isfinite(N)) throw Error(Failure::bad_input, "the force must be positive and finite");
    double above = my.ranking.highest();  // separations that carry less
    if (!std::isfinite(above)) throw Error(Failure::bad_input, "no asperity lies under the sphere: no force can be carried");
    double below = -kInfinity;  // separations that carry more
    // A first depth: what the highest asperity alone would need.
    const int highest = my.ranking.highest_asperity();
    my.law->prepare({&highest, 1});
    double depth = std::numeric_limits<double>::epsilon() * std::max(std::abs(above), std::numeric_limits<double>::min());
    while (my.law->force(highest, depth) < N) depth *= 2;
    double Z0 = above - 0.25 * depth;
    if (!my.force.empty()) {
        if (!my.past.empty())
            Z0 = my.past.front().separation;
        else if (!my.carried.phi.empty() && my.carried.separation < above)
            Z0 = my.carried.separation;
    }
    Level level;
    int iterations = 0;
    long products = 0;
    constexpr int most = 200;
    for (int i = 0; i < most; ++i) {
        level = at_separation(Z0);
        iterations += level.iterations;
        products += level.products;
        const double miss = level.force / N - 1;
        if (std::abs(miss) <= my.options.tolerance || level.status == LevelStatus::not_converged) break;
        (miss < 0 ? above : below) = Z0;
        double next = level.force > 0 ? Z0 - std::log1p(miss) * level.force / stiffness() : -kInfinity;
        if (std::isinf(below)) {
            const double furthest = above - std::max(2 * (my.past.size() > 1 ? above - Z0 : 0.0) + depth, 0.0);
            next = std::isfinite(next) ? std::max(next, furthest) : furthest;
            depth *= 2;
        }
        if (!(next < above) || !(next > below)) next = std::isinf(below) ? above - depth : 0.5 * (above + below);
        if (next == Z0 || next >= above || next <= below) {
            // Nearer than neighbouring numbers Z0 nobody comes; what is missing beyond that is a jump of N(Z0): no separation carries N.
            const double ulp = std::nextafter(std::abs(Z0), kInfinity) - std::abs(Z0);
            const double resolved = 2 * ulp * std::abs(stiffness()) + my.law->force(highest, 2 * ulp);
            if (std::abs(level.force - N) > resolved) level.status = LevelStatus::not_converged;
            break;
        }
        Z0 = next;
        if (i + 1 == most) level.status = LevelStatus::not_converged;
    }
    level.iterations = iterations;
    level.products = products;
    return level;
}

double Contact::stiffness() { return impl_->v.empty() ? 0.0 : impl_->newton.stiffness(1e-10); }

double Contact::energy() const { return impl_->v.empty() ? 0.0 : 0.0 - impl_->newton.energy(); }

void Contact::move_tip(double x0, double y0) {
    if (!std::isfinite(x0) || !std::isfinite(y0)) throw Error(Failure::bad_input, "the tip's position must be finite");
    impl_->carry();
    impl_->indenter.x0 = x0;
    impl_->indenter.y0 = y0;
    impl_->ranking.move(x0, y0);
}

double Contact::first_touch() const { return impl_->ranking.highest(); }

const Indenter& Contact::indenter() const { return impl_->indenter; }

}  // namespace rsc
