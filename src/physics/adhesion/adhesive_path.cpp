#include "physics/adhesion/adhesive_path.hpp"

#include "base/error.hpp"
#include "contact/force_search.hpp"
#include "physics/adhesion/sticking.hpp"

namespace rsc {
namespace {

// Tolerance for touching, relative to the penetration of detachment.
constexpr double kTouching = 1e-8;
// Length of the step of a jump, relative to the difference of the penetrations at attachment and
// detachment. The place of the jump within it is known, so that the error of its loss is of second
// order in this.
constexpr double kNear = 1e-5;
// Own loss of an asperity that may attach or detach within a long step, relative to the energy.
constexpr double kNegligible = 1e-7;
constexpr double kOnTheWay = 1e-7;  // residual of states between levels
constexpr double kInJump = 1e-9;    // residual of states after a jump
// Error of the products of the state before a jump; it does not change in the jump.
constexpr double kNoiseBeforeJump = 3e-7;
// Share by which an expected distance is shortened: without a second derivative, and relative to
// what this changes.
constexpr double kFirstDoubt = 0.05, kDoubt = 0.2;
constexpr long kMostSteps = 1000000;

}  // namespace

AdhesivePath::AdhesivePath(const Asperities& asperities_, const Indenter& indenter_,
                           const SolverOptions& options_)
    : ContactBodies(asperities_, indenter_, options_),
      law(make_law(options_.law, asperities, indenter_.E_star, of_difference.get())),
      sticking(*law, options_.physics.of<Adhesion>().work, options_.physics.of<Adhesion>().range),
      direct(make_direct_products(kernel)),
      solver(sticking) {
    for (std::size_t i = 0; of_difference && i < asperities.size(); ++i)
        of_difference->shift_and_prepare(i);
    margin = options.physics.of<Adhesion>().range;
    ranking.assign(asperities, indenter);
}

void AdhesivePath::add_member(int i, double height) {
    set.asperity.push_back(i);
    const Vec2 image = indenter.image(of_surface.x[at(i)], of_surface.y[at(i)]);
    set.x.push_back(image.x);
    set.y.push_back(image.y);
    clearance.push_back(height);
}

// Makes the set of all asperities that may attach at separations down to `lowest`, and the attached
// ones.
void AdhesivePath::find_members(double lowest, const std::vector<int>& attached) {
    set.clear();
    clearance.clear();
    trend = {};
    std::vector<int> fresh;
    covered = motion ? -kInfinity : lowest - margin;
    if (motion) {
        find_members_of_motion(fresh);
    } else {
        const std::size_t last = ranking.above(covered, fresh);
        for (const auto r : indices(last)) add_member(ranking[r].asperity, ranking[r].height);
    }
    std::vector<char> member(asperities.size(), 0);
    for (const int i : set.asperity) member[at(i)] = 1;
    for (const int i : attached) {
        if (member[at(i)]) continue;
        fresh.push_back(i);
        add_member(
            i, indenter.clearance(asperities.x[at(i)], asperities.y[at(i)], asperities.z[at(i)]));
    }
    sticking.prepare(fresh);
    set.g0.resize(clearance.size());
    rate.assign(clearance.size(), -1.0);
    choose_products();
}

// Makes the set for separations down to `lowest`, and `here` the state at here.Z of these attached
// asperities near s. Returns false if they have no equilibrium there.
bool AdhesivePath::cover(double lowest, const std::vector<int>& attached, const Vector& s) {
    for (int k = 0; k < 3; ++k) {
        find_members(lowest, attached);
        std::vector<std::pair<int, double>> order;
        for (const auto j : indices(attached)) {
            const auto found = std::ranges::find(set.asperity, attached[j]);
            order.emplace_back(int(found - set.asperity.begin()), s[j]);
        }
        std::ranges::sort(order);
        here.active.clear();
        here.s.clear();
        for (const auto& [position, state] : order) {
            here.active.push_back(position);
            here.s.push_back(state);
        }
        // One that has just attached, within the tolerance of touching, may have no exact state.
        if (!find(here, 0) && !find(here, kOnTheWay)) return false;
        const double more = raised();
        if (!(more > margin)) break;
        margin = more;
    }
    complete(here);
    return true;
}

bool AdhesivePath::cover(double lowest) {
    std::vector<int> attached;
    for (const int position : here.active) attached.push_back(at_place(position));
    return cover(lowest, attached, Vector(here.s));
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

// Finds the equilibrium of the attached asperities at point.Z near point.s; accuracy 0: an exact
// one.
bool AdhesivePath::find(Point& point, double accuracy, int least) {
    ++steps;
    set_gaps(point.Z);
    products->set_active(point.active);
    Vector s = point.s;  // of no meaning where none is found
    if (!solver.solve(set, std::max(goal, accuracy), accuracy == 0, s, least)) return false;
    point.s = std::move(s);
    point.exact = accuracy == 0;
    read_solution(point);
    return true;
}

void AdhesivePath::read_solution(Point& point) {
    point.states = solver.states();
    point.residuals = solver.residuals();
    point.force = solver.force();
    point.energy = solver.energy();
    point.residual = solver.residual();
    point.u.resize(at(set.size()));
    for (const auto k : indices(point.u)) point.u[k] = set.g0[k] - solver.phi()[k];
    point.power = 0;
    for (const auto k : indices(point.active)) {
        point.u[at(point.active[k])] = point.states[k].u;
        point.power += point.states[k].f * rate[at(point.active[k])];
    }
}

// Required margin: twice the largest height by which the forces of the last state raise any
// asperity, or 0 if the present margin is sufficient.
double AdhesivePath::raised() const {
    double most = 0;
    for (const double phi : solver.phi()) most = std::max(most, -phi);
    for (const auto k : indices(solver.states())) {  // near contacts under tension
        const Sticking::State& state = solver.states()[k];
        most = std::max(most,
                        -solver.phi()[at(products->active()[k])] -
                            state.f * kernel->near() / std::sqrt(state.outer / std::numbers::pi));
    }
    const double range = options.physics.of<Adhesion>().range;
    return 1.2 * most > margin - range ? 2 * most + range : 0.0;
}

// Computes the derivatives of the last state with respect to Z.
void AdhesivePath::complete(Point& point, double accuracy) {
    const AttachedSolver::Change change = solver.change(rate, accuracy);
    point.dforce = change.force;
    point.dpower = -change.power;
    point.ds = change.s;
    point.du.resize(point.u.size());
    for (const auto k : indices(point.active))
        point.du[at(point.active[k])] = point.states[k].du * change.s[k];
    for (const auto p : indices(change.u)) point.du[at(products->passive()[p])] = change.u[p];
}

// Restores the accepted state. Returns false if nothing is attached and nothing touches before the
// target.
bool AdhesivePath::begin(double target) {
    now = accepted;
    // Sets of points, and the rounding of sums over them, depend on nothing else.
    margin = std::max(options.physics.of<Adhesion>().range, now.margin);
    jumps = steps = 0;
    products_before = direct->count() + (mesh ? mesh->count() : 0);
    lost_way = false;
    requested.reset();
    held.clear();
    last = {};
    here = {};
    here.Z = now.separation;
    double lowest = std::min(target, now.separation);
    if (now.asperity.empty()) {
        here.Z = ranking.highest() - sticking.touches();
        lowest = std::nextafter(here.Z, -kInfinity);
        if (!(target < here.Z)) {
            set.clear();
            clearance.clear();
            covered = kInfinity;
            return false;
        }
    }
    lost_way = !cover(lowest, now.asperity, now.s);
    return true;
}

bool AdhesivePath::small(int position) const {
    const int i = at_place(position);
    return std::max(sticking.loss(i, true), sticking.loss(i, false)) <=
           kNegligible * now.most_energy;
}

double AdhesivePath::near(int position) const {
    return std::max(2 * kTouching * scale(position),
                    kNear * (sticking.touches() + scale(position)));
}

// The next step of at most `rest`: to the target, or nearly to where an asperity is expected to
// attach or detach, or, near it, over this place. A step as long as `blocked` would be one too
// many.
AdhesivePath::Step AdhesivePath::next_step(double rest, double direction, double blocked) const {
    double event = kInfinity, doubt = 0, width = kInfinity, least = kInfinity;
    std::size_t next = 0;
    for (int k = 0; k < set.size(); ++k) {
        const bool attached = next < here.active.size() && here.active[next] == k;
        next += attached;
        least = std::min(least, 2 * kTouching * scale(k));
        if (small(k)) continue;
        width = std::min(width, near(k));
        const double sign = attached ? -direction : direction,
                     left =
                         attached ? here.u[at(k)] + scale(k) : sticking.touches() - here.u[at(k)],
                     slope = sign * here.du[at(k)],
                     bend = trend.bend.empty() ? 0.0 : (attached ? -1 : 1) * trend.bend[at(k)];
        const double root = slope * slope + 2 * bend * std::max(left, 0.0);
        const double distance =
            root > 0 ? 2 * std::max(left, 0.0) / (slope + std::sqrt(root)) : kInfinity;
        if (!(distance >= 0) || distance >= event) continue;
        event = distance;
        doubt = trend.bend.empty() ? kFirstDoubt * event
                                   : kDoubt * std::min(std::abs(event - left / slope), event);
    }
    const double fold = fold_ahead(direction);
    if (fold > 0 && fold < event) {
        event = fold;
        doubt = kFirstDoubt * fold;
    }
    if (width == kInfinity) width = least;
    const double most = std::min(rest, blocked);
    if (event < most && event <= width) return {std::min(event + width, rest), true, event};
    if (blocked <= width) return {std::min(blocked, rest), true, fold > 0 ? fold : 0.5 * blocked};
    if (event < most)
        return {event - std::max(0.5 * width, std::min(doubt, 0.5 * event)), false, 0};
    return {blocked < kInfinity ? std::min(rest, 0.5 * blocked) : rest, false, 0};
}

// The state at Z by extrapolation of the penetrations, without asperities that would detach: all in
// a jump, otherwise those of negligible loss.
AdhesivePath::Point AdhesivePath::predicted(double Z, bool jump) const {
    constexpr double linear = 0.03;  // relative change of s up to which u is linear in it
    Point there;
    there.Z = Z;
    const double length = Z - here.Z;
    for (const auto k : indices(here.active)) {
        const int position = here.active[k], i = at_place(position);
        const double bend = trend.bend.empty() ? 0.0 : trend.bend[at(position)],
                     change = length * (here.du[at(position)] + 0.5 * length * bend),
                     u = here.states[k].u + change;
        const double slope = here.states[k].du;
        const bool attached = u > sticking.lets_go(i);
        if (!attached && (jump || small(position))) continue;
        double s = std::max(here.s[k] + change / slope, 0.5 * (here.s[k] + sticking.least(i)));
        if (attached && std::abs(s - here.s[k]) > linear * slope * here.s[k])
            s = sticking.state_at(i, u);
        there.active.push_back(position);
        there.s.push_back(s);
    }
    return there;
}

// Second derivatives from `here` and another state with the same attached asperities, unless they
// are known from a much longer way.
void AdhesivePath::note_bend(const Point& there) {
    constexpr double shorter = 0.2;
    const double length = there.Z - here.Z;
    if (std::abs(length) < shorter * trend.length) return;
    trend.length = std::abs(length);
    trend.bend.resize(here.u.size());
    for (const auto k : indices(trend.bend))
        trend.bend[k] = 2 * (there.u[k] - here.u[k] - length * here.du[k]) / (length * length);
}

// Attaches asperities that touch: in a jump the one that penetrates most, otherwise those that
// penetrate at least a tenth of that, if the loss of all is negligible, or else it refuses. Returns
// false if none touches.
bool AdhesivePath::attach_touching(Point& there, bool jump, bool& refused) {
    double deepest = 0;
    std::vector<std::pair<int, double>> touching;
    for (const int position : products->passive()) {
        const double depth = there.u[at(position)] - sticking.touches();
        if (!(depth > kTouching * scale(position))) continue;
        touching.emplace_back(position, depth);
        refused = refused || (!jump && !small(position));
        deepest = std::max(deepest, depth / scale(position));
    }
    if (refused) return true;
    const double least = jump ? deepest : 0.1 * deepest;
    for (const auto& [position, depth] : touching) {
        if (depth / scale(position) < least) continue;
        const auto k = std::ranges::lower_bound(there.active, position) - there.active.begin();
        there.active.insert(there.active.begin() + k, position);
        there.s.insert(there.s.begin() + k,
                       sticking.state_at(at_place(position), there.u[at(position)]));
    }
    return !touching.empty();
}

// The attached asperity that shrinks fastest, relative to its size. Where the equilibrium ceases to
// be stable, this is the one that detaches: the derivatives tend to the direction in which it
// becomes unstable.
std::size_t AdhesivePath::fastest(double direction) const {
    std::size_t found = 0;
    double most = -kInfinity;
    for (const auto k : indices(here.s)) {
        const double rate = -direction * here.ds[k] / here.s[k];
        if (here.states[k].df >= 0 || !(rate > most)) continue;
        most = rate;
        found = k;
    }
    return found;
}

// Distance to where the equilibrium ceases to be stable. Near it 1/rate^2 of the asperity that
// shrinks fastest decreases linearly to 0. 0: not known.
double AdhesivePath::fold_ahead(double direction) const {
    if (last.ds.size() != here.ds.size() || here.ds.empty()) return 0;
    const std::size_t k = fastest(direction);
    const double g = 1 / (here.ds[k] * here.ds[k]), fall = 1 / (last.ds[k] * last.ds[k]) - g;
    return fall > 0 ? g * std::abs(here.Z - last.Z) / fall : 0.0;
}

// Finds the equilibrium at there.Z that is reached from the states there.s: in a jump, asperities
// that shrink to nothing are detached one by one, or, where that cannot be followed, the one
// nearest to its own detachment.
AdhesivePath::Found AdhesivePath::descend(Point& there, bool jump, double accuracy) {
    const int most = 100 + 4 * set.size();
    bool stalled = false;
    for (int k = 0; k < most; ++k) {
        if (!find(there, jump ? kInJump : accuracy, jump)) {
            std::size_t weakest = solver.weakest();
            if (!jump && !small(there.active[weakest])) return Found::jump;
            if (jump && there.active == here.active) {
                weakest = fastest(there.Z > here.Z ? 1 : -1);
            } else if (jump) {
                Vector calm = there.s;
                const auto relaxed = stalled ? std::nullopt : solver.relax(set, goal, calm);
                stalled = !relaxed;
                if (relaxed) there.s = std::move(calm);
                if (relaxed && !relaxed->gone) continue;
                if (relaxed) weakest = *relaxed->gone;
            }
            there.active.erase(there.active.begin() + std::ptrdiff_t(weakest));
            there.s.erase(there.s.begin() + std::ptrdiff_t(weakest));
            continue;
        }
        if (const double more = raised(); more > margin) {
            margin = more;
            return Found::raised;
        }
        bool refused = false;
        if (!attach_touching(there, jump, refused)) {
            complete(there);
            return Found::equilibrium;
        }
        if (refused) return Found::jump;
    }
    return Found::jump;
}

// True if an asperity that approaches and retreats within the step may have touched: near the
// largest value of the cubic through both ends.
bool AdhesivePath::touches_between(const Point& there) const {
    const double length = there.Z - here.Z;
    for (const int p : products->passive()) {
        const double up = length * here.du[at(p)], down = -length * there.du[at(p)];
        if (up <= 0 || down <= 0 || small(p)) continue;
        const double x = up / (up + down), rest = 1 - x,
                     u = here.u[at(p)] * rest * rest * (1 + 2 * x) + up * x * rest * rest +
                         there.u[at(p)] * x * x * (1 + 2 * rest) + down * x * x * rest;
        if (u - sticking.touches() > near(p)) return true;
    }
    return false;
}

// True if the smallest force so far may lie between `here` and a state with other asperities.
bool AdhesivePath::hides_least_force(const Point& there) const {
    constexpr double negligible = 1e-6;
    const Point &low = here.Z < there.Z ? here : there, &high = here.Z < there.Z ? there : here;
    const double most = std::min(-low.dforce, high.dforce) * (high.Z - low.Z);
    return most > negligible * std::abs(now.least_force) &&
           std::min(low.force, high.force) - most < now.least_force;
}

// Keeps the residuals of the state before a jump, with products whose error the jump does not
// change.
void AdhesivePath::hold() {
    set_gaps(here.Z);
    products->set_active(here.active);
    solver.rest_on(set, kNoiseBeforeJump, here.s);
    read_solution(here);
    held.assign(here.u.size(), 0.0);
    for (const auto k : indices(here.active)) held[at(here.active[k])] = here.residuals[k];
}

// The length of the next step under force control: about that to the requested force, as far as it
// can be foreseen.
double AdhesivePath::reach(double direction) const {
    const double toward = direction * (*requested - here.force) / here.dforce,
                 far = 0.5 * std::abs(ranking.highest() - here.Z) +
                       scale(here.active.empty() ? 0 : here.active[0]);
    return toward > 0 ? std::min(1.01 * toward, 4 * far) : far;
}

// Follows the path from `here` to a separation, or to the first state with the requested force.
// Where it cannot be followed, lost_way is set. Returns false if everything detached before.
bool AdhesivePath::follow(double target) {
    double blocked_at = kNotComputed;  // where the last step that failed would have ended
    const double direction = target > here.Z ? 1 : -1;
    for (long guard = 0; here.Z != target && !lost_way; ++guard) {
        if (here.active.empty() && direction > 0 && !motion) return false;
        const double rest = std::abs(target - here.Z), most = requested ? reach(direction) : rest;
        const Step step = next_step(
            most, direction, std::isnan(blocked_at) ? kInfinity : std::abs(blocked_at - here.Z));
        const double Z = step.length >= rest ? target : here.Z + direction * step.length;
        if (Z == here.Z || guard > kMostSteps) return lost_way = true;
        if (Z - margin < covered) {
            lost_way = !cover(requested ? Z - most : std::min(Z, target));
            continue;
        }
        if (step.jump) hold();
        Point there = predicted(Z, step.jump);
        const double accuracy = Z == target                            ? 0.0
                                : std::isnan(blocked_at) && !requested ? kOnTheWay
                                                                       : kInJump;
        const Found found = descend(there, step.jump, accuracy);
        held.clear();
        if (found == Found::raised) {
            covered = kInfinity;
            products->set_active(here.active);
            continue;
        }
        const bool same = there.active == here.active;
        if (found == Found::equilibrium && (step.jump || !hides(there))) {
            if (same && find_requested(there)) return true;
            accept(std::move(there), step);
            if (step.jump || !(direction * (blocked_at - here.Z) > 0)) blocked_at = kNotComputed;
            continue;
        }
        if (step.jump) return lost_way = true;
        if (same && there.u.size() == here.u.size()) note_bend(there);
        blocked_at = Z;
        products->set_active(here.active);
    }
    if (lost_way || here.exact) return true;
    lost_way = !find(here, 0);
    if (!lost_way) complete(here);
    return true;
}

// Follows the path from the accepted state to the first state with the force N. Returns false if
// there is none before everything has detached.
bool AdhesivePath::follow_to_force(double N) {
    constexpr double far = 1e300;
    (void)begin(accepted.asperity.empty() ? -far : accepted.separation);
    if (lost_way || std::abs(here.force - N) <= 0.1 * options.tolerance * std::abs(N)) return true;
    const bool down = here.force < N && !(here.active.empty() && N < 0);
    requested = N;
    return follow(down ? -far : far);
}

// True if a step must be divided, because it may pass over something: an attachment, if the same
// asperities are attached as before, otherwise the smallest force so far or the requested one.
bool AdhesivePath::hides(const Point& there) const {
    if (there.active == here.active) return touches_between(there);
    return hides_least_force(there) ||
           (requested && (here.force - *requested) * (there.force - *requested) <= 0);
}

// Goes on from the next state, with the energy lost on the way to it.
void AdhesivePath::accept(Point there, const Step& step) {
    std::vector<int> changed;
    std::set_symmetric_difference(here.active.begin(), here.active.end(), there.active.begin(),
                                  there.active.end(), std::back_inserter(changed));
    const auto attaches = [&](int position) {
        return !std::binary_search(here.active.begin(), here.active.end(), position);
    };
    if (changed.empty()) {
        if (!step.jump) note_bend(there);
        last = {here.Z, here.ds};
    } else if (step.jump) {
        ++jumps;
        const bool detaches = std::ranges::none_of(changed, attaches);
        now.lost += dissipated(there, step.ahead, detaches);
    } else {
        jumps += int(changed.size());
        for (const int position : changed)
            now.lost += sticking.loss(at_place(position), attaches(position));
    }
    if (!changed.empty()) last = {};
    here = std::move(there);
    double energy = 0;
    for (const Sticking::State& state : here.states) energy += std::abs(state.energy);
    now.most_energy = std::max(now.most_energy, energy);
    now.least_force = std::min(now.least_force, here.force);
}

// The work of the step from `here` to `there`, in which asperities attach or detach at the distance
// `ahead`, minus the change of the energy. Because B is symmetric and the penetrations change by -B
// times the change of the forces, this is a sum over the asperities: for those that stay attached
// it is of third order, so that no small difference of large energies is formed. The terms with
// residuals make errors of the state after the jump of second order. Before a detachment the power
// changes like the root of the distance.
double AdhesivePath::dissipated(const Point& there, double ahead, bool detaches) const {
    constexpr double small_change = 1e-3, far_from_detachment = 0.1;
    std::vector<Sticking::State> before(here.u.size()), after(here.u.size());
    for (const auto k : indices(here.active)) before[at(here.active[k])] = here.states[k];
    for (const auto k : indices(there.active)) after[at(there.active[k])] = there.states[k];
    double sum = 0;
    for (const auto k : indices(before)) {
        const Sticking::State &old = before[k], &now_ = after[k];
        const double change = there.u[k] - here.u[k];
        if (old.area + old.outer > 0 && now_.area + now_.outer > 0 &&
            std::min(now_.du, old.du) > far_from_detachment &&
            std::abs(now_.f - old.f) < small_change * std::abs(now_.f))  // Euler and Maclaurin
            sum += (now_.df / now_.du - old.df / old.du) * change * change / 12;
        else
            sum -= now_.energy - old.energy - 0.5 * (now_.f + old.f) * change;
    }
    for (const auto k : indices(there.active))
        sum -= 0.5 * (there.states[k].f - before[at(there.active[k])].f) * there.residuals[k];
    // The work, less that of forces which change linearly.
    const double way = there.Z - here.Z, first = std::copysign(ahead, way), last = way - first,
                 bend = detaches ? 4.0 / 3 : 1.0;
    return sum + first * (here.power + 0.5 * bend * here.dpower * first) +
           last * (there.power - 0.5 * there.dpower * last) -
           0.5 * way * (here.power + there.power);
}

// A state between two with the same attached asperities, at this share of the way. Returns false
// if none is found.
bool AdhesivePath::find_between(const Point& a, const Point& b, double share, Point& middle) {
    constexpr double accurate = 1e-6;  // of derivatives
    middle.Z = a.Z + share * (b.Z - a.Z);
    middle.active = a.active;
    middle.s.clear();
    for (const auto k : indices(a.s)) middle.s.push_back(a.s[k] + share * (b.s[k] - a.s[k]));
    if (middle.Z == a.Z || middle.Z == b.Z || !find(middle, 0)) return false;
    complete(middle, accurate);
    return true;
}

// The state of the smallest force between `here` and a state with the same attached asperities, if
// the slopes allow one below `bound`; otherwise that of the smaller force.
AdhesivePath::Point AdhesivePath::least_between(const Point& there, double bound) {
    Point low = here.Z < there.Z ? here : there, high = here.Z < there.Z ? there : here,
          least = low.force < high.force ? low : high, middle;
    const double most = std::max(-low.dforce, high.dforce) * (high.Z - low.Z);
    if (!(low.dforce < 0 && high.dforce > 0) || least.force - most >= bound) return least;
    for (int i = 0; i < 40; ++i) {
        // Near detachment the slope is so large that the secant hardly moves.
        const double secant = low.dforce / (low.dforce - high.dforce),
                     share = i % 2 == 1 ? 0.5 : std::clamp(secant, 0.05, 0.95);
        if (!find_between(low, high, share, middle)) break;
        const double gained = std::abs(middle.dforce * (high.Z - low.Z));
        if (middle.force < least.force) least = middle;
        (middle.dforce < 0 ? low : high) = middle;
        if (gained <= 1e-10 * std::abs(middle.force)) break;
    }
    return least;
}

// Notes the smallest force between `here` and a state with the same attached asperities, and goes
// to the requested force if it is there.
bool AdhesivePath::find_requested(const Point& there) {
    const double bound = requested ? std::max(*requested, now.least_force) : now.least_force;
    const Point least = least_between(there, bound);
    const auto within = [&](const Point& end) {
        return requested && (here.force - *requested) * (end.force - *requested) <= 0;
    };
    if (within(least) && find_force(least)) return true;
    now.least_force = std::min(now.least_force, least.force);
    return within(there) && find_force(there);
}

// Goes to the state with the requested force between `here` and another one on its other side.
bool AdhesivePath::find_force(const Point& there) {
    const double precise = 0.1 * options.tolerance *
                           std::max(std::abs(*requested),
                                    1e-3 * std::max(std::abs(here.force), std::abs(there.force)));
    const bool down = there.Z < here.Z;
    Point low = down ? there : here, high = down ? here : there, middle;
    const auto next = [&](const Point& p) { return p.Z + (*requested - p.force) / p.dforce; };
    bool found = false;
    const auto evaluate = [&](double Z, Bracket& bracket, int i) {
        if (!find_between(low, high, (Z - low.Z) / (high.Z - low.Z), middle))
            return bracket.close(Z);
        found = std::abs(middle.force - *requested) <= precise;
        if (found) return bracket.close(Z);
        ((middle.force < *requested) == (low.force < *requested) ? low : high) = middle;
        bracket = {low.Z, high.Z};
        return i % 8 == 7 ? kNotComputed : next(middle);
    };
    (void)search_force(next(here), {low.Z, high.Z}, 100, evaluate);
    if (!found) return false;
    now.least_force = std::min(now.least_force, middle.force);
    here = std::move(middle);
    return true;
}

AdhesivePath::Past AdhesivePath::past() const {
    Past p = now;
    p.separation = here.Z;
    p.margin = margin;
    std::vector<std::pair<int, double>> order;
    for (const auto k : indices(here.active))
        order.emplace_back(at_place(here.active[k]), here.s[k]);
    std::ranges::sort(order);
    p.asperity.clear();
    p.s.clear();
    for (const auto& [asperity, s] : order) {
        p.asperity.push_back(asperity);
        p.s.push_back(s);
    }
    return p;
}

}  // namespace rsc
