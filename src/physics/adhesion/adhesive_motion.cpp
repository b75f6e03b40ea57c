// The path of adhesive asperities while the tip moves at one separation.
#include "base/error.hpp"
#include "physics/adhesion/adhesive_path.hpp"

namespace rsc {
double AdhesivePath::clearance_at(int i, double share) {
    indenter.x0 = motion->from.x + share * (motion->to.x - motion->from.x);
    indenter.y0 = motion->from.y + share * (motion->to.y - motion->from.y);
    return indenter.clearance(asperities.x[at(i)], asperities.y[at(i)], asperities.z[at(i)]);
}

// Sets g0, and its rates if the tip moves.
void AdhesivePath::set_gaps(double Z) {
    if (!motion) {
        for (std::size_t k = 0; k < clearance.size(); ++k) set.g0[k] = clearance[k] - Z;
        return hold_gaps();
    }
    constexpr double apart = 1e-4;  // share of the way for differences
    const double share = Z / motion->length;
    for (std::size_t k = 0; k < clearance.size(); ++k) {
        const int i = set.asperity[k];
        rate[k] = (clearance_at(i, share + apart) - clearance_at(i, share - apart)) /
                  (2 * apart * motion->length);
        set.g0[k] = clearance_at(i, share) - motion->Z0;
    }
    hold_gaps();
}

void AdhesivePath::hold_gaps() {
    for (const Held& held : held_before) set.g0[at(place[at(held.asperity)])] -= held.residual;
}

// Follows the accepted state while the tip moves on a straight line at the accepted separation.
// Returns false if the path is lost; the accepted state and the tip are then unchanged, as after an
// exception. On a surface that repeats the way is the shortest one, and is taken in pieces that are
// short against the period, so that images of asperities are the nearest ones all along.
bool AdhesivePath::move(double x0, double y0) {
    const Indenter old = indenter;
    const Past before = accepted;
    thin = false;
    const auto place_tip = [&](const Indenter& tip) {
        motion.reset();
        indenter = tip;
        ranking.assign(asperities, indenter);
    };
    Vec2 way{x0 - old.x0, y0 - old.y0};
    int pieces = 1;
    if (const Period& period = old.repeats; period.finite()) {
        constexpr double pieces_of_period = 8;
        way = {period.nearest_x(way.x), period.nearest_y(way.y)};
        pieces = std::max(1, static_cast<int>(std::ceil(pieces_of_period *
                                                        std::max(std::abs(way.x) / period.x,
                                                                 std::abs(way.y) / period.y))));
    }
    const auto position = [&](int k) {
        return Vec2{old.x0 + way.x * k / pieces, old.y0 + way.y * k / pieces};
    };
    bool done = true;
    try {
        for (int k = 0; k < pieces && done; ++k) {
            Indenter tip = old;
            done = move_piece(position(k), position(k + 1));
            if (!done)
                accepted = before;
            else if (k + 1 < pieces)
                tip.move(position(k + 1).x, position(k + 1).y);
            else
                tip.move(x0, y0);
            place_tip(tip);
        }
    } catch (...) {
        accepted = before;
        place_tip(old);
        throw;
    }
    return done;
}

// Takes the accepted state, which is that of summits at another place of the tip, to the
// equilibrium of these. Returns false if none is found.
// The difference is of second order in the slope of the indenter; its energy does not count as
// lost.
bool AdhesivePath::stand() {
    if (accepted.asperity.empty()) return true;
    sticking.prepare(accepted.asperity);
    begin(accepted.separation);
    free_before.resize(asperities.size());
    if (!settle(accepted.separation, here.s)) return false;
    lost_way = false;
    accepted = now = past();
    return true;
}

bool AdhesivePath::move_piece(Vec2 from, Vec2 to) {
    begin(accepted.separation);
    if (lost_way) return false;
    indenter.move(from.x, from.y);
    motion = Motion{from, to, accepted.separation};
    cover(0);
    if (motion->edge)
        throw Error(Failure::bad_input,
                    "a body with an edge cannot be moved while asperities are attached near its "
                    "edge: pull it off first");
    double length = 0;
    for (int i : set.asperity) {
        const double middle = clearance_at(i, 0.5);
        length = std::max(
            {length, std::abs(middle - clearance_at(i, 0)), std::abs(clearance_at(i, 1) - middle)});
    }
    if (length > 0) motion->length = length;
    const bool done = find(0, here.s, here) &&
                      (complete(here), go(motion->length, std::nullopt), !lost_way) &&
                      here.Z == motion->length;
    Past left = past();
    left.separation = motion->Z0, left.jumps += jumps;
    if (!done || !std::isfinite(left.lost) || !std::isfinite(left.least_force)) return false;
    accepted = now = left;
    return true;
}

}  // namespace rsc
