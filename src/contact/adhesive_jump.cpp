// A jump of adhesive asperities: from the state before it to the next equilibrium at the same separation, and the energy that it dissipates.
#include "contact/adhesive_path.hpp"

namespace rsc {
namespace {

constexpr double kInJump = 1e-9;  // residual of states after a jump

std::size_t at(int k) { return static_cast<std::size_t>(k); }

}  // namespace

// Finds an equilibrium at Z from states that are not in equilibrium: one by one, touching asperities are attached and those that shrink to
// nothing are detached, or, where that cannot be followed, the one nearest to its own detachment.
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
            if (const double u = here.u[p] / scale(position); u > deepest) deepest = u, touching = position;
        }
        if (touching < 0) {
            complete(here);
            return true;
        }
        attach_at(touching, sticking.touches() + deepest * scale(touching), s);
    }
    return false;
}

// Remembers the state before a jump. Until the end of the jump the gaps are changed by its residuals, so that it is an exact equilibrium.
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
    for (const Held& held : held_before) before.emplace_back(place[at(held.asperity)], held.state.f), force += held.state.f;
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
    for (std::size_t p = 0; p < phi.size(); ++p) free_before[at(set.asperity[p])] = set.g0[p] - phi[p] + kernel->shift() * force;
}

// Energy after a jump minus energy before it at the same separation. Because B is symmetric and the penetrations change by -B times the change
// of the forces, this is the sum over all asperities of the change of their own energy minus (f + f')/2 times the change of u. It is of
// third order for those that stay attached, so that no small difference of large energies is formed. The terms with residuals make
// errors of the state after the jump of second order.
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
        if (std::min(now.du, old.du) > far_from_detachment && std::abs(now.f - old.f) < small * std::abs(now.f))  // Euler and Maclaurin
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

// `ahead`: distance to the point of detachment, before which the power changes like the root of the distance.
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

// From hold() to the equilibrium of the attached asperities near s. The jump takes place at Z + ahead, where the energy before it is
// W - power ahead - bend/2 change.power ahead^2, and is computed at Z. An asperity `event` has been put exactly where it jumps by a change of its
// gap; then only the others change along `ahead`, and they lift the surface there at the rate `lifts`.
void AdhesivePath::jump(Vector s, double ahead, double bend, int event, double lifts) {
    double power = 0;  // after the jump less before it, minus dW/dZ
    const double rate_of_power = bend * here.change.power;
    const auto add = [&](int asperity, double f) { power -= f * (asperity == event ? lifts : rate[at(place[at(asperity)])]); };
    for (const Held& held : held_before) add(held.asperity, -held.state.f);
    now.least_force = std::min(now.least_force, here.force);
    ++jumps;
    if (!settle(here.Z, std::move(s))) {
        lost_way = true;
        return held_before.clear();
    }
    for (std::size_t k = 0; k < active.size(); ++k) add(set.asperity[at(active[k])], here.states[k].f);
    now.lost += ahead * (power + (bend > 0 ? 0.5 * ahead * (here.change.power - rate_of_power) : 0.0)) - energy_gained();
    now.least_force = std::min(now.least_force, here.force);
    held_before.clear();
}

}  // namespace rsc
