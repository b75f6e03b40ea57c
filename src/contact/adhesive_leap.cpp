// The short way on the path of adhesive asperities: directly to the next attachment or detachment.
#include "contact/adhesive_path.hpp"

namespace rsc {
namespace {

constexpr double kOnTheWay = 1e-5;  // residual of the state before the jump
// Largest distance in penetration from attachment or detachment, relative to the difference of both. The jump itself takes place exactly there,
// and the error of its energy is of second order in this.
constexpr double kNear = 1e-4;
constexpr double kFirst = 0.01;  // the same with the slope of the first try, relative to kNear
constexpr double kApart = 1e-4;  // of others_apart()

std::size_t at(int k) { return static_cast<std::size_t>(k); }

}  // namespace

// True if the k-th attached asperity lets go where it would alone. Its own deflection (layers, periodic images) and others with df/ds < 0 make
// it let go elsewhere, by a distance in du of this sum.
bool AdhesivePath::others_apart(const Point& point, std::size_t k) const {
    const int i = set.asperity[at(active[k])];
    const double own = std::abs(sticking.at(i, sticking.least(i)).df);
    double sum = own * std::abs(kernel->self() - kernel->shift());
    for (std::size_t j = 0; j < active.size(); ++j) {
        if (j == k || point.states[j].df >= 0) continue;
        const double dx = indenter.repeats.nearest_x(set.x[at(active[j])] - set.x[at(active[k])]),
                     dy = indenter.repeats.nearest_y(set.y[at(active[j])] - set.y[at(active[k])]);
        sum += own * std::abs(point.states[j].df) / point.states[j].du * std::pow(kernel->at(dx, dy) - kernel->shift(), 2);
    }
    return sum < kApart;
}

// Goes directly to the next attachment or detachment before the target and lets it happen. It is predicted, and the others are brought into
// equilibrium with this asperity in the state where it jumps. Returns false, with `here` unchanged, if there is none, or if the way has to be
// followed in the steps of go().
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
    const auto index = static_cast<std::size_t>(lets_go ? found - active.begin()
                                                        : std::lower_bound(passive.begin(), passive.end(), event) - passive.begin());
    if (lets_go && !others_apart(here, index)) return false;

    Point there;
    const double toward = lets_go ? -direction : direction;
    set_gaps(here.Z);
    // `lifts`: rate at which the forces of the others lift the surface at the event.
    double Z = here.Z + direction * way, last_Z = here.Z, last_gap = set.g0[at(event)], slope = 0, lifts = 0;
    auto [start, stands] = predict(Z, now_rates, event);
    if (!stands) return false;
    Vector last_s = here.s;
    if (lets_go) start[index] = last_s[index] = sticking.least(set.asperity[at(event)]);
    for (int tries = 0;; ++tries) {
        if (tries == 5 || !(direction * (Z - here.Z) > 0) || !(direction * (target - Z) > 0) || Z - margin < covered) return false;
        there.Z = Z, there.s = start, ++steps;
        set_gaps(Z);
        if (!solver.solve(set, kOnTheWay, false, there.s, 0, lets_go ? static_cast<int>(index) : -1, false)) return false;
        const double now_left = lets_go ? solver.residuals()[index] : set.g0[at(event)] - solver.elevation(set, event) - sticking.touches();
        slope = (now_left - left) / (Z - last_Z);
        if (!(slope * toward > 0)) return false;
        // The slope at this end of the first way, by a parabola: good enough to go on, not for the energy at a distance.
        if (const double end = 2 * slope - now_rates[at(event)]; tries == 0 && end * toward > 0) slope = end;
        lifts = (set.g0[at(event)] - last_gap) / (Z - last_Z) - slope;
        left = now_left;
        if (std::abs(left) < (tries == 0 ? kFirst : 1.0) * kNear * (sticking.touches() + scale(event))) break;
        const double next = Z - left / slope;
        for (std::size_t k = 0; k < start.size(); ++k) start[k] = there.s[k] + (there.s[k] - last_s[k]) * (next - Z) / (Z - last_Z);
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
        if (there.u[p] > near(passive[p]) || (up > 0 && 2 * rise < up && here.u[p] + 0.25 * up * up / (up - rise) > near(passive[p])))
            return false;
    }
    const double fall = std::abs(here.change.force * (Z - here.Z)), least = std::min(here.force, there.force) - fall;
    if (direction * here.change.force < 0 && least < now.least_force) return false;
    if (wanted && *wanted >= least && *wanted <= std::max(here.force, there.force) + fall) return false;

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
