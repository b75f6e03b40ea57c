// Jumps of adhesive asperities: the short way directly to the next attachment or detachment, the
// next equilibrium at the same separation, and the energy that the jump dissipates.
#include "physics/adhesion/adhesive_path.hpp"

namespace rsc {
namespace {

constexpr double kInJump = 1e-9;    // residual of states after a jump
constexpr double kOnTheWay = 1e-5;  // residual of the state before the jump
// Largest distance in penetration from attachment or detachment, relative to the difference of
// both. The jump itself takes place exactly there, and the error of its energy is of second order
// in this.
constexpr double kNear = 1e-4;
constexpr double kFirst = 0.01;  // the same with the slope of the first try, relative to kNear
constexpr double kApart = 1e-4;  // of others_apart()

}  // namespace

// Finds an equilibrium at Z from states that are not in equilibrium: one by one, touching
// asperities are attached and those that shrink to nothing are detached, or, where that cannot be
// followed, the one nearest to its own detachment.
bool AdhesivePath::settle(double Z, Vector s) {
    const std::size_t most = 100 + 4 * clearance.size();
    bool stalled = false;
    for (std::size_t k = 0; k < most; ++k) {
        if (!find(Z, s, here, kInJump, 1)) {
            std::size_t weakest = solver.weakest();
            Vector calm = s;
            const auto relaxed = stalled ? std::nullopt : solver.relax(set, goal, calm);
            stalled = !relaxed;
            if (relaxed) {
                s = std::move(calm);
                if (!relaxed->gone) continue;
                weakest = *relaxed->gone;
            }
            detach(weakest, s);
            continue;
        }
        if (const double more = raised(); more > margin) {
            const double lowest = std::min(Z, covered + margin);
            margin = more;
            cover(lowest);
            hold_more(Z);
            s = here.s;
            continue;
        }
        s = here.s;
        int touching = -1;
        double deepest = kTouching;
        for (std::size_t p = 0; p < here.u.size(); ++p) {
            const int position = products->passive()[p];
            if (const double u = here.u[p] / scale(position); u > deepest)
                deepest = u, touching = position;
        }
        if (touching < 0) {
            complete(here);
            return true;
        }
        attach_at(touching, sticking.touches() + deepest * scale(touching), s);
    }
    return false;
}

// Remembers the state before a jump. Until the end of the jump the gaps are changed by its
// residuals, so that it is an exact equilibrium.
void AdhesivePath::hold() {
    set_gaps(here.Z);
    solver.rest_on(set, kNoiseBeforeJump, here.s);
    read_solution(here);
    keep();
}

void AdhesivePath::keep() {
    held_before.clear(), free_before.resize(asperities.size());
    for (std::size_t k = 0; k < active.size(); ++k)
        held_before.push_back({set.asperity[at(active[k])], here.states[k], solver.residuals()[k]});
    for (std::size_t p = 0; p < here.u.size(); ++p)
        free_before[at(set.asperity[at(products->passive()[p])])] = here.u[p] + sticking.touches();
}

// The same for asperities that have come into the set during the jump.
void AdhesivePath::hold_more(double Z) {
    std::vector<std::pair<int, double>> before;
    double force = 0;
    for (const Held& held : held_before)
        before.emplace_back(place[at(held.asperity)], held.state.f), force += held.state.f;
    std::sort(before.begin(), before.end());
    std::vector<int> positions;
    Vector f, phi(at(set.size()), 0.0);
    for (const auto& [position, own] : before) positions.push_back(position), f.push_back(own);
    if (!f.empty()) {
        products->set_active(positions);
        products->full(f.data(), phi.data());
        products->set_active(active);
    }
    set_gaps(Z);
    for (std::size_t p = 0; p < phi.size(); ++p)
        free_before[at(set.asperity[p])] = set.g0[p] - phi[p] + kernel->shift() * force;
}

// Energy after a jump minus energy before it at the same separation. Because B is symmetric and the
// penetrations change by -B times the change of the forces, this is the sum over all asperities of
// the change of their own energy minus (f + f')/2 times the change of u. It is of third order for
// those that stay attached, so that no small difference of large energies is formed. The terms with
// residuals make errors of the state after the jump of second order.
double AdhesivePath::energy_gained() const {
    constexpr double small = 1e-3, far_from_detachment = 0.1;
    std::vector<const Held*> was(clearance.size(), nullptr);
    for (const Held& held : held_before) was[at(place[at(held.asperity)])] = &held;
    double sum = 0;
    for (std::size_t k = 0; k < active.size(); ++k) {
        const Sticking::State& now = here.states[k];
        const Held* held = std::exchange(was[at(active[k])], nullptr);
        const double residual = solver.residuals()[k];
        if (!held) {
            const double change = now.u - free_before[at(set.asperity[at(active[k])])];
            sum += now.energy + 0.5 * now.f * (residual - change);
            continue;
        }
        const Sticking::State& old = held->state;
        const double change = now.u - old.u;
        if (std::min(now.du, old.du) > far_from_detachment &&
            std::abs(now.f - old.f) < small * std::abs(now.f))  // Euler and Maclaurin
            sum -= (now.df / now.du - old.df / old.du) * change * change / 12;
        else
            sum += now.energy - old.energy - 0.5 * (now.f + old.f) * change;
        sum += 0.5 * (now.f - old.f) * residual;
    }
    for (std::size_t p = 0; p < here.u.size(); ++p)
        if (const Held* held = was[at(products->passive()[p])]) {
            const double change = here.u[p] + sticking.touches() - held->state.u;
            sum -= held->state.energy + 0.5 * held->state.f * change;
        }
    return sum;
}

void AdhesivePath::attach_one(int position, double ahead) {
    hold();
    Vector s = here.s;
    attach_at(position, sticking.touches(), s);
    jump(std::move(s), ahead, 1);
}

// `ahead`: distance to the point of detachment, before which the power changes like the root of the
// distance.
void AdhesivePath::let_go(std::size_t weakest, double ahead) {
    hold();
    Vector s = here.s;
    detach(weakest, s);
    jump(std::move(s), ahead, 4.0 / 3);
}

void AdhesivePath::attach_at(int position, double u, Vector& s) {
    const auto k = std::lower_bound(active.begin(), active.end(), position) - active.begin();
    const int i = set.asperity[at(position)];
    const double state = sticking.state_at(i, u);
    solver.take_in(set, static_cast<std::size_t>(k), position, sticking.at(i, state).f);
    active.insert(active.begin() + k, position);
    s.insert(s.begin() + k, state);
    products->set_active(active);
}

void AdhesivePath::detach(std::size_t k, Vector& s) {
    solver.release(set, k);
    active.erase(active.begin() + static_cast<std::ptrdiff_t>(k));
    s.erase(s.begin() + static_cast<std::ptrdiff_t>(k));
    products->set_active(active);
}

// From hold() to the equilibrium of the attached asperities near s. The jump takes place at Z +
// ahead, where the energy before it is W - power ahead - bend/2 change.power ahead^2, and is
// computed at Z. An asperity `event` has been put exactly where it jumps by a change of its gap;
// then only the others change along `ahead`, and they lift the surface there at the rate `lifts`.
void AdhesivePath::jump(Vector s, double ahead, double bend, int event, double lifts) {
    double power = 0;  // after the jump less before it, minus dW/dZ
    const double rate_of_power = bend * here.change.power;
    const auto add = [&](int asperity, double f) {
        power -= f * (asperity == event ? lifts : rate[at(place[at(asperity)])]);
    };
    for (const Held& held : held_before) add(held.asperity, -held.state.f);
    now.least_force = std::min(now.least_force, here.force);
    ++jumps;
    if (!settle(here.Z, std::move(s))) {
        lost_way = true;
        return held_before.clear();
    }
    for (std::size_t k = 0; k < active.size(); ++k)
        add(set.asperity[at(active[k])], here.states[k].f);
    now.lost +=
        ahead * (power + (bend > 0 ? 0.5 * ahead * (here.change.power - rate_of_power) : 0.0)) -
        energy_gained();
    now.least_force = std::min(now.least_force, here.force);
    held_before.clear();
}

// True if the k-th attached asperity lets go where it would alone. Its own deflection (layers,
// periodic images) and others with df/ds < 0 make it let go elsewhere, by a distance in du of this
// sum.
bool AdhesivePath::others_apart(const Point& point, std::size_t k) const {
    const int i = set.asperity[at(active[k])];
    const double own = std::abs(sticking.at(i, sticking.least(i)).df);
    double sum = own * std::abs(kernel->self() - kernel->shift());
    for (std::size_t j = 0; j < active.size(); ++j) {
        if (j == k || point.states[j].df >= 0) continue;
        const double dx = indenter.repeats.nearest_x(set.x[at(active[j])] - set.x[at(active[k])]),
                     dy = indenter.repeats.nearest_y(set.y[at(active[j])] - set.y[at(active[k])]);
        sum += own * std::abs(point.states[j].df) / point.states[j].du *
               std::pow(kernel->at(dx, dy) - kernel->shift(), 2);
    }
    return sum < kApart;
}

// Goes directly to the next attachment or detachment before the target and lets it happen. It is
// predicted, and the others are brought into equilibrium with this asperity in the state where it
// jumps. Returns false, with `here` unchanged, if there is none, or if the way has to be followed
// in the steps of go().
bool AdhesivePath::leap(double target, std::optional<double> wanted) {
    const double direction = target > here.Z ? 1 : -1;
    const std::vector<int>& passive = products->passive();
    const Vector now_rates = rates();
    double way = std::abs(target - here.Z), left = 0;
    int event = -1;
    const auto consider = [&](int position, double toward, double distance) {
        const double rate = toward * direction * now_rates[at(position)];
        if (!(rate > 0) || distance > 2 * rate * way) return;
        const double root = rate * rate + 2 * toward * bend(position) * distance;
        const double x = root > 0 ? 2 * distance / (rate + std::sqrt(root)) : way;
        if (x < way) way = x, event = position, left = -toward * distance;
    };
    for (std::size_t p = 0; p < passive.size(); ++p) consider(passive[p], 1, -here.u[p]);
    for (std::size_t k = 0; k < active.size(); ++k)
        consider(active[k], -1, here.states[k].u - sticking.lets_go(set.asperity[at(active[k])]));
    if (event < 0) return false;
    const auto found = std::lower_bound(active.begin(), active.end(), event);
    const bool lets_go = found != active.end() && *found == event;
    const auto index = static_cast<std::size_t>(
        lets_go ? found - active.begin()
                : std::lower_bound(passive.begin(), passive.end(), event) - passive.begin());
    if (lets_go && !others_apart(here, index)) return false;

    Point there;
    const double toward = lets_go ? -direction : direction;
    set_gaps(here.Z);
    // `lifts`: rate at which the forces of the others lift the surface at the event.
    double Z = here.Z + direction * way, last_Z = here.Z, last_gap = set.g0[at(event)], slope = 0,
           lifts = 0;
    auto [start, stands] = predict(Z, now_rates, event);
    if (!stands) return false;
    Vector last_s = here.s;
    if (lets_go) start[index] = last_s[index] = sticking.least(set.asperity[at(event)]);
    for (int tries = 0;; ++tries) {
        if (tries == 5 || !(direction * (Z - here.Z) > 0) || !(direction * (target - Z) > 0) ||
            Z - margin < covered)
            return false;
        there.Z = Z, there.s = start, ++steps;
        set_gaps(Z);
        if (!solver.solve(set, kOnTheWay, false, there.s, 0, lets_go ? static_cast<int>(index) : -1,
                          false))
            return false;
        const double now_left =
            lets_go ? solver.residuals()[index]
                    : set.g0[at(event)] - solver.elevation(set, event) - sticking.touches();
        slope = (now_left - left) / (Z - last_Z);
        if (!(slope * toward > 0)) return false;
        // The slope at this end of the first way, by a parabola: good enough to go on, not for the
        // energy at a distance.
        if (const double end = 2 * slope - now_rates[at(event)]; tries == 0 && end * toward > 0)
            slope = end;
        lifts = (set.g0[at(event)] - last_gap) / (Z - last_Z) - slope;
        left = now_left;
        if (std::abs(left) <
            (tries == 0 ? kFirst : 1.0) * kNear * (sticking.touches() + scale(event)))
            break;
        const double next = Z - left / slope;
        for (std::size_t k = 0; k < start.size(); ++k)
            start[k] = there.s[k] + (there.s[k] - last_s[k]) * (next - Z) / (Z - last_Z);
        last_Z = Z, last_gap = set.g0[at(event)], last_s = there.s, Z = next;
    }
    if (!solver.stable(set)) return false;
    solver.rest_on(set, kNoiseBeforeJump, there.s, true);
    read_solution(there);
    left = lets_go ? solver.residuals()[index] : there.u[index];
    if (raised() > margin || (lets_go && !others_apart(there, index))) return false;
    // Another asperity may have touched on the way, and the force may have been smaller.
    for (std::size_t p = 0; p < there.u.size(); ++p) {
        if (passive[p] == event) continue;
        const double up = (Z - here.Z) * here.change.u[p], rise = there.u[p] - here.u[p];
        if (there.u[p] > near(passive[p]) ||
            (up > 0 && 2 * rise < up &&
             here.u[p] + 0.25 * up * up / (up - rise) > near(passive[p])))
            return false;
    }
    const double fall = std::abs(here.change.force * (Z - here.Z)),
                 least = std::min(here.force, there.force) - fall;
    if (direction * here.change.force < 0 && least < now.least_force) return false;
    if (wanted && *wanted >= least && *wanted <= std::max(here.force, there.force) + fall)
        return false;

    now.least_force = std::min(now.least_force, there.force);
    note_bend(now_rates, there);
    here = std::move(there);
    keep();
    Vector s = here.s;
    if (lets_go) {
        detach(index, s);
    } else {
        held_before.push_back({set.asperity[at(event)], {.u = sticking.touches()}, left});
        attach_at(event, sticking.touches(), s);
    }
    jump(std::move(s), -left / slope, 0, set.asperity[at(event)], lifts);
    return true;
}

}  // namespace rsc
