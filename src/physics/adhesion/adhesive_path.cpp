#include "physics/adhesion/adhesive_path.hpp"

#include "base/error.hpp"

namespace rsc {
namespace {

// Tolerances relative to the detachment penetration of an asperity: for the detachment point, and
// the shortest step.
constexpr double kFold = 1e-4, kShortest = 1e-9;
// Distance from touching, relative to the difference of the penetrations at attachment and
// detachment, from which a free asperity attaches within a level. The energies are extrapolated to
// the point of touching, so that the error of the loss is of second order in it.
constexpr double kNearTouching = 1e-4;
constexpr double kOnTheWay = 1e-5;  // residual of states between levels
// distance from a wanted force, relative to all forces, beyond which its side is certain
constexpr double kSure = 1e-3;
// Largest steps, relative to the expected distance to detachment: by the law of the asperity, and
// by extrapolation of its rate of change
// (far and near).
constexpr double kOwnWay = 0.7, kFarWay = 0.6, kNearWay = 0.9, kLongestWay = 0.98, kDoubt = 6;

}  // namespace

AdhesivePath::AdhesivePath(const Asperities& asperities_, const Indenter& indenter_,
                           const SolverOptions& options_)
    : ContactBodies(asperities_, indenter_, options_),
      law(make_law(options_.law, asperities, indenter_.E_star, of_difference.get())),
      sticking(*law, options_.physics.adhesion.work, options_.physics.adhesion.range),
      direct(make_direct_products(kernel)),
      solver(sticking),
      place(asperities.size(), -1) {
    const auto refuse = [](const char* what) {
        throw Error(Failure::bad_input, std::string("solids%adhesion is ") + what);
    };
    if (std::isfinite(options.physics.hardness.H0))
        refuse("not available yet with solids%hardness");
    if (!options.physics.relaxation.none())
        refuse("not available yet with solids%relaxation_share");
    if (options.method == Method::dgesv)
        refuse("not available with solver%method = 'dgesv': the paper's method excludes tension");
    if (options.selection == Selection::paper)
        refuse(
            "not available with indentation%selection = 'paper': other asperities are attracted as "
            "well");
    if (options.physics.adhesion.range > 0 && options.law == LawKind::fourth_order)
        refuse(
            "not available yet with solids%adhesion_range > 0 and asperities%law = 'fourth_order'");
    for (std::size_t i = 0; of_difference && i < asperities.size(); ++i) of_difference->shift(i);
    margin = options.physics.adhesion.range;
    ranking.assign(asperities, indenter);
}

// Includes all asperities in the set that may attach at separations down to `lowest`; attached ones
// are kept.
void AdhesivePath::cover(double lowest) {
    std::vector<int> attached;
    for (int p : active) attached.push_back(set.asperity[at(p)]);
    const Vector s = here.s;
    for (int i : set.asperity) place[at(i)] = -1;
    set = {}, clearance.clear(), trend = {};
    covered = motion ? -kInfinity : lowest - margin;
    std::vector<int> fresh;
    const std::size_t last = motion ? 0 : ranking.above(covered, fresh);
    const auto add = [&](int i, double height) {
        place[at(i)] = set.size();
        set.asperity.push_back(i);
        const Vec2 image = indenter.image(of_surface.x[at(i)], of_surface.y[at(i)]);
        set.x.push_back(image.x), set.y.push_back(image.y);
        clearance.push_back(height);
    };
    for (int i = 0; motion && i < static_cast<int>(asperities.size()); ++i) {
        // Bound of the clearance along the way, by a parabola through its ends and middle.
        const double begin = clearance_at(i, 0), middle = clearance_at(i, 0.5),
                     end = clearance_at(i, 1), bend = 2 * std::abs(middle - 0.5 * (begin + end));
        if (std::max({begin, middle, end}) + (std::isfinite(bend) ? bend : 0.0) <=
            motion->Z0 - margin)
            continue;
        motion->edge = motion->edge || !std::isfinite(bend);
        fresh.push_back(i), add(i, middle);
    }
    sticking.prepare(fresh);
    for (std::size_t r = 0; r < last; ++r) add(ranking[r].asperity, ranking[r].height);
    std::vector<int> kept = attached;
    for (const Held& held : held_before) kept.push_back(held.asperity);
    for (int i : kept)
        if (place[at(i)] < 0)
            add(i,
                indenter.clearance(asperities.x[at(i)], asperities.y[at(i)], asperities.z[at(i)]));
    set.g0.resize(clearance.size()), rate.assign(clearance.size(), -1.0);
    choose_products();
    attach(attached, s);
    left_out.clear();
    if (thin && !active.empty() && leave_out(lowest)) choose_products(), attach(attached, s);
}

// Removes from the set the asperities that the present forces keep from touching at separations
// down to `lowest`. missed() tests it afterwards.
bool AdhesivePath::leave_out(double lowest) {
    const std::vector<int>& passive = products->passive();
    Vector f, phi(passive.size());
    safety = margin;
    for (std::size_t k = 0; k < active.size(); ++k) {
        f.push_back(sticking.at(set.asperity[at(active[k])], here.s[k]).f);
        safety = std::max(safety, 2 * scale(active[k]));
    }
    products->inner_passive(f.data(), phi.data());
    const double raised =
        kernel->shift() * std::accumulate(f.begin(), f.end(), 0.0) - sticking.touches();
    std::vector<char> out(at(set.size()), 0);
    for (std::size_t p = 0; p < phi.size(); ++p)
        out[at(passive[p])] = clearance[at(passive[p])] - lowest - phi[p] + raised < -safety;
    for (const Held& held : held_before) out[at(place[at(held.asperity)])] = 0;
    std::size_t n = 0;
    for (std::size_t k = 0; k < out.size(); ++k) {
        const int i = set.asperity[k];
        if (out[k]) {
            left_out.push_back({i, clearance[k]}), place[at(i)] = -1;
            continue;
        }
        place[at(i)] = static_cast<int>(n);
        set.asperity[n] = i, set.x[n] = set.x[k], set.y[n] = set.y[k],
        clearance[n++] = clearance[k];
    }
    set.asperity.resize(n), set.x.resize(n), set.y.resize(n), clearance.resize(n), set.g0.resize(n),
        rate.resize(n);
    return !left_out.empty();
}

// True if an asperity that was left out is so near to touching that it may have touched.
bool AdhesivePath::missed() {
    constexpr double near = 0.5;  // share of the distance that it should have kept
    Vector f, x, y, phi(left_out.size(), 0.0);
    for (const auto& [i, height] : left_out) {
        const Vec2 image = indenter.image(of_surface.x[at(i)], of_surface.y[at(i)]);
        x.push_back(image.x), y.push_back(image.y);
    }
    for (const Sticking::State& state : here.states) f.push_back(state.f);
    if (!active.empty() && !left_out.empty())
        products->elsewhere(f.data(), static_cast<int>(x.size()), x.data(), y.data(), phi.data());
    const double raised = kernel->shift() * here.force - sticking.touches() - here.Z;
    for (std::size_t k = 0; k < phi.size(); ++k)
        if (left_out[k].second - phi[k] + raised > -near * safety) return true;
    return false;
}

void AdhesivePath::choose_products() {
    const bool on_mesh = choose_method(options, *kernel, set) == Method::mesh;
    if (on_mesh && !mesh)
        mesh = make_mesh_products(kernel, std::min(1e-6, 0.1 * options.tolerance), 1e-3);
    products = on_mesh ? mesh.get() : direct.get();
    goal = std::min(on_mesh ? 1e-8 : 1e-9,
                    options.tolerance);  // full products are reproducible, whatever their error
    products->set_points(set.size(), set.x.data(), set.y.data());
    solver.use(*products);
}

// Sets the attached asperities and their states.
void AdhesivePath::attach(const std::vector<int>& attached, const Vector& s) {
    std::vector<std::pair<int, double>> order;
    for (std::size_t k = 0; k < attached.size(); ++k)
        order.emplace_back(place[at(attached[k])], s[k]);
    std::sort(order.begin(), order.end());
    active.clear(), here.s.clear();
    for (const auto& [position, state] : order) active.push_back(position), here.s.push_back(state);
    products->set_active(active);
}

// Finds the equilibrium of the attached asperities at Z near s.
bool AdhesivePath::find(double Z, Vector s, Point& point, double accuracy, int least) {
    ++steps;
    set_gaps(Z);
    if (!solver.solve(set, std::max(goal, accuracy), accuracy == 0, s, least)) return false;
    point.exact = accuracy == 0;
    point.Z = Z;
    point.s = std::move(s);
    read_solution(point);
    return true;
}

void AdhesivePath::read_solution(Point& point) {
    point.states = solver.states();
    point.force = solver.force(), point.energy = solver.energy(),
    point.residual = solver.residual();
    point.u.clear();
    for (int p : products->passive())
        point.u.push_back(set.g0[at(p)] - solver.phi()[at(p)] - sticking.touches());
}

// Required margin: twice the largest height by which the forces of the last state raise any
// asperity, or 0 if the present margin is sufficient.
double AdhesivePath::raised() const {
    double most = 0;
    for (double phi : solver.phi()) most = std::max(most, -phi);
    for (std::size_t k = 0; k < solver.states().size(); ++k) {  // near contacts under tension
        const Sticking::State& state = solver.states()[k];
        most = std::max(most,
                        -solver.phi()[at(active[k])] -
                            state.f * kernel->near() / std::sqrt(state.outer / std::numbers::pi));
    }
    const double range = options.physics.adhesion.range;
    return 1.2 * most > margin - range ? 2 * most + range : 0.0;
}

double AdhesivePath::near(int position) const {
    const double width = sticking.touches() + scale(position);
    return std::max(kTouching * scale(position), kNearTouching * width);
}

// Distance from the point of detachment at which an asperity is detached. It must be small beside
// the difference of the penetrations at attachment and detachment, or the asperity would attach
// again at once.
double AdhesivePath::fold(int position) const {
    return std::max(kShortest * scale(position), kFold * (sticking.touches() + scale(position)));
}

// Computes the derivatives of the last state with respect to Z.
void AdhesivePath::complete(Point& point, double accuracy) {
    point.change = solver.change(rate, accuracy);
}

// Restores the accepted state. Returns false if nothing is attached and nothing touches before the
// target.
bool AdhesivePath::begin(double target) {
    now = accepted;
    margin = std::max(
        options.physics.adhesion.range,
        now.margin);  // sets of points, and the rounding of sums over them, depend on nothing else
    jumps = steps = 0;
    products_before = direct->count() + (mesh ? mesh->count() : 0);
    lost_way = false;
    active.clear(), held_before.clear();
    here = {};
    const double highest = ranking.highest() - sticking.touches();
    if (now.asperity.empty()) {
        if (!(target < highest)) {
            for (int i : set.asperity) place[at(i)] = -1;
            set = {}, clearance.clear(), left_out.clear(), covered = kInfinity;
            return false;
        }
        here.Z = highest;
        cover(std::nextafter(highest, -kInfinity));
        find(here.Z, {}, here);
        complete(here);
        return true;
    }
    for (int i : set.asperity) place[at(i)] = -1;
    set = {}, clearance.clear();
    // cover() keeps attached asperities, so they are put into the set first.
    for (int i : now.asperity) active.push_back(set.size()), set.asperity.push_back(i);
    here.s = now.s;
    cover(std::min(target > -kInfinity ? target : now.separation, now.separation));
    for (int k = 0; k < 2; ++k) {
        if (!find(now.separation, here.s, here)) lost_way = true;
        const double more = raised();
        if (!(more > margin)) break;
        margin = more;
        cover(std::min(target > -kInfinity ? target : now.separation, now.separation));
    }
    complete(here);
    return true;
}

// Rates of all penetrations with respect to Z at `here`, by position in the set.
AdhesivePath::Vector AdhesivePath::rates() const {
    Vector all(at(set.size()));
    for (std::size_t k = 0; k < active.size(); ++k)
        all[at(active[k])] = here.states[k].du * here.change.s[k];
    for (std::size_t p = 0; p < here.change.u.size(); ++p)
        all[at(products->passive()[p])] = here.change.u[p];
    return all;
}

// Second derivatives from `here`, with its rates, and a state with the same attached, unless they
// are known from a much longer way.
void AdhesivePath::note_bend(const Vector& now_rates, const Point& there) {
    constexpr double shorter = 0.2;
    const double length = there.Z - here.Z;
    if (std::abs(length) < shorter * trend.length) return;
    trend.length = std::abs(length), trend.bend.resize(now_rates.size());
    const auto note = [&](int position, double change) {
        trend.bend[at(position)] =
            2 * (change - length * now_rates[at(position)]) / (length * length);
    };
    for (std::size_t k = 0; k < active.size(); ++k)
        note(active[k], there.states[k].u - here.states[k].u);
    for (std::size_t p = 0; p < there.u.size(); ++p)
        note(products->passive()[p], there.u[p] - here.u[p]);
}

// States of the attached at Z by extrapolation of their penetrations; whether all would still be
// attached, but for those at the position `but`.
std::pair<AdhesivePath::Vector, bool> AdhesivePath::predict(double Z, const Vector& now_rates,
                                                            int but) const {
    constexpr double small = 0.03;  // relative change of s up to which u is linear in it
    Vector start(here.s);
    bool stands = true;
    for (std::size_t k = 0; k < start.size(); ++k) {
        const int i = set.asperity[at(active[k])];
        const double length = Z - here.Z,
                     change = length * (now_rates[at(active[k])] + 0.5 * length * bend(active[k])),
                     u = here.states[k].u + change;
        const bool hangs = u > sticking.lets_go(i);
        stands = stands && (hangs || active[k] == but);
        start[k] =
            std::max(here.s[k] + change / here.states[k].du, 0.5 * (here.s[k] + sticking.least(i)));
        if (hangs && std::abs(start[k] - here.s[k]) > small * here.states[k].du * here.s[k])
            start[k] = sticking.state_at(i, u);
    }
    return {start, stands};
}

// Follows the path from `here` to a separation, or to the first state with the wanted force.
// Returns false if everything detached before.
bool AdhesivePath::go(double target, std::optional<double> wanted) {
    const double direction = target > here.Z ? 1 : -1;
    Point before;  // previous state with the same attached asperities
    bool known = false, direct = true;
    double shorter = 1;            // reduction of the step after a failure
    double jumped_at = kInfinity;  // no way since then
    int jumps_before = 0;
    for (long guard = 0; here.Z != target; ++guard) {
        double smallest = kInfinity;
        for (int p : active) smallest = std::min(smallest, scale(p));
        if (std::abs(here.Z - jumped_at) > kShortest * smallest)
            jumped_at = here.Z, jumps_before = jumps;
        // The same asperities attach and detach for ever where none of their states is stable, or
        // it cannot be decided, because contacts overlap.
        if (lost_way || guard > 1000000 || jumps - jumps_before > 10 + set.size())
            return lost_way = true;
        if (active.empty() && direction > 0 && !motion) return false;
        // Attaches an asperity that touches.
        const auto& passive = products->passive();
        std::optional<int> touching;
        double step = std::abs(target - here.Z), ahead = 0;
        for (std::size_t p = 0; p < passive.size() && !touching; ++p) {
            const double rate = direction * here.change.u[p];
            if (rate <= 0) continue;
            if (here.u[p] >= -kTouching * scale(passive[p]) ||
                (here.u[p] >= -near(passive[p]) && -here.u[p] < rate * step))
                touching = passive[p], ahead = -direction * here.u[p] / rate;
            // Quadratic extrapolation, if the rate at the previous state is known.
            const double bend =
                known ? (rate - direction * before.change.u[p]) / std::abs(here.Z - before.Z) : 0.0;
            step = std::min(
                step, -2 * here.u[p] /
                          (rate + std::sqrt(std::max(rate * rate - 2 * bend * here.u[p], 0.0))));
        }
        if (touching) {
            attach_one(*touching, ahead);
            known = false, shorter = 1;
            continue;
        }
        if (direct && leap(target, wanted)) {
            known = false, shorter = 1;
            continue;
        }
        direct = false;
        // Limits the step to a part of the distance to the next detachment; very close to it, the
        // asperity is detached.
        double way = kInfinity;
        std::size_t weakest = 0;
        here.left.assign(active.size(), kInfinity);
        for (std::size_t k = 0; k < active.size(); ++k) {
            const Sticking::State& state = here.states[k];
            const double rate = direction * here.change.s[k];
            if (!(rate < 0)) continue;
            const double own =
                (state.u - sticking.lets_go(set.asperity[at(active[k])])) / (state.du * -rate);
            // The step may be longer if the distance predicted at the previous state was accurate.
            const auto proved_share = [&](double end) {
                here.left[k] = end;
                if (!known || !(before.left[k] < kInfinity)) return 0.0;
                const double length = std::abs(here.Z - before.Z);
                return std::min(kLongestWay, 1 - kDoubt * std::abs(before.left[k] - length - end) /
                                                     length * std::max(1.0, end / length));
            };
            if (state.df >= 0) {
                step = std::min(step, std::max(kNearWay, proved_share(own)) * own);
                continue;
            }
            double left = kInfinity, share = kFarWay;
            if (known) {  // 1/rate^2 decreases linearly to 0
                const double g = 1 / (rate * rate), g_before = 1 / std::pow(before.change.s[k], 2);
                if (g < g_before) left = g * std::abs(here.Z - before.Z) / (g_before - g);
                if (g < 0.3 * g_before) share = kNearWay;
            }
            const double end = std::min(own, left), most = proved_share(end);
            if (end < fold(active[k])) {
                if (end < way) way = end, weakest = k;
                continue;
            }
            step = std::min(step, std::max(std::min(kOwnWay * own, share * left), most * end));
        }
        if (way <= step) {
            let_go(weakest, direction * way);
            known = false, shorter = 1;
            continue;
        }
        if (wanted) {
            const double toward = (*wanted - here.force) / here.change.force * direction;
            const double reach = 0.5 * std::abs(ranking.highest() - here.Z) +
                                 (active.empty() ? 0.0 : scale(active[0]));
            step = std::min(step, toward > 0 ? std::min(1.01 * toward, 4 * reach) : reach);
        }
        step *= shorter;
        if (step < kShortest * smallest && shorter < 1 && !active.empty()) {
            std::size_t fastest = 0;
            double most = -1;
            for (std::size_t k = 0; k < active.size(); ++k) {
                const double rate = std::abs(here.change.s[k]) / here.s[k];
                if (here.states[k].df < 0 && rate > most) most = rate, fastest = k;
            }
            let_go(fastest, 0);
            known = false, shorter = 1;
            continue;
        }
        const double Z = step >= std::abs(target - here.Z) ? target : here.Z + direction * step;
        if (Z == here.Z) return lost_way = true;
        if (Z - margin < covered) {
            cover(std::min(Z, wanted ? Z - 0.1 * std::abs(ranking.highest() - Z) : target));
            // One that has just attached, within the tolerance of touching, may have no exact state
            // yet.
            if (!find(here.Z, here.s, here) && !find(here.Z, here.s, here, kOnTheWay))
                return lost_way = true;
            complete(here);
            known = false;
            continue;
        }
        const Vector now_rates = rates();
        const auto [start, stands] = predict(Z, now_rates);
        Point there;
        const auto unsure = [&] {
            double all = 0;
            for (const Sticking::State& state : there.states) all += std::abs(state.f);
            return wanted && !there.exact && std::abs(there.force - *wanted) < kSure * all;
        };
        if (!find(Z, start, there, Z == target ? 0.0 : kOnTheWay) ||
            (unsure() && !find(Z, there.s, there))) {
            shorter *= 0.3;
            continue;
        }
        if (const double more = raised(); more > margin) {
            margin = more;
            covered = kInfinity;
            continue;
        }
        // If an asperity penetrates too deeply, the step is reduced to where it touched.
        const double length = std::abs(Z - here.Z);
        double share = 1;
        for (std::size_t p = 0; p < there.u.size(); ++p) {
            if (!(there.u[p] > (Z == target ? kTouching * scale(passive[p]) : near(passive[p]))))
                continue;
            const double slope = direction * here.change.u[p] * length,
                         bend = there.u[p] - here.u[p] - slope;
            const double root = std::sqrt(std::max(slope * slope - 4 * bend * here.u[p], 0.0));
            const double x = -2 * here.u[p] / (slope + root);
            // One that is free within the tolerance of touching has no such point before this one:
            // another state was found.
            share = std::min(share, here.u[p] > 0    ? 0.3
                                    : x > 0 && x < 1 ? x
                                                     : -here.u[p] / (there.u[p] - here.u[p]));
        }
        if (share < 1) {
            shorter *= std::max(share, 1e-3) * length / step;
            continue;
        }
        complete(there);
        // An asperity that approaches and retreats within the step may have touched.
        bool between = false;
        for (std::size_t p = 0; p < there.u.size() && !between; ++p) {
            const double up = direction * here.change.u[p] * length,
                         down = -direction * there.change.u[p] * length;
            if (up <= 0 || down <= 0) continue;
            const double x = up / (up + down),
                         rest = 1 - x;  // near the maximum of the cubic through both ends
            const double value = here.u[p] * rest * rest * (1 + 2 * x) + up * x * rest * rest +
                                 there.u[p] * x * x * (1 + 2 * rest) + down * x * x * rest;
            between = value > near(passive[p]);
        }
        if (between && shorter > 1e-3) {
            shorter *= 0.5;
            continue;
        }
        shorter = 1;
        const Point &low = direction > 0 ? here : there, &high = direction > 0 ? there : here;
        if (low.change.force < 0 && high.change.force > 0) {
            // The smallest force is between both ends and at most `most` below them.
            const double most = std::max(std::abs(low.change.force), high.change.force) * length;
            const double bound = wanted ? std::max(*wanted, now.least_force) : now.least_force;
            if (std::min(low.force, high.force) - most < bound) {
                const Point least = least_between(low, high);
                now.least_force = std::min(now.least_force, least.force);
                if (wanted && here.force > *wanted && least.force <= *wanted &&
                    find_force(here, least, *wanted))
                    return true;
            }
        }
        const bool crossed = wanted && (here.force - *wanted) * (there.force - *wanted) <= 0;
        if (crossed && find_force(here, there, *wanted)) return true;
        now.least_force = std::min(now.least_force, there.force);
        note_bend(now_rates, there);
        before = std::move(here);
        here = std::move(there);
        known = direct = true;
    }
    if (here.exact) return true;
    if (!find(target, here.s, here)) return lost_way = true;
    complete(here);
    return true;
}

AdhesivePath::Past AdhesivePath::past() const {
    Past p = now;
    p.separation = here.Z, p.margin = margin;
    std::vector<std::pair<int, double>> order;
    for (std::size_t k = 0; k < active.size(); ++k)
        order.emplace_back(set.asperity[at(active[k])], here.s[k]);
    std::sort(order.begin(), order.end());
    p.asperity.clear(), p.s.clear();
    for (const auto& [asperity, s] : order) p.asperity.push_back(asperity), p.s.push_back(s);
    return p;
}

}  // namespace rsc
