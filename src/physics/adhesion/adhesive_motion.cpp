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
    constexpr double apart = 1e-4;  // share of the way for differences
    for (const auto k : indices(clearance)) {
        set.g0[k] = clearance[k] - Z;
        if (motion) {
            const int i = set.asperity[k];
            const double share = Z / motion->length;
            rate[k] = (clearance_at(i, share + apart) - clearance_at(i, share - apart)) /
                      (2 * apart * motion->length);
            set.g0[k] = clearance_at(i, share) - motion->Z0;
        }
        if (!held.empty()) set.g0[k] -= held[k];
    }
}

// The members of the set on the way of the tip, by a bound of their clearances: that of a parabola
// through the ends and the middle.
void AdhesivePath::find_members_of_motion(std::vector<int>& fresh) {
    for (int i = 0; i < int(asperities.size()); ++i) {
        const double first = clearance_at(i, 0), middle = clearance_at(i, 0.5),
                     last = clearance_at(i, 1);
        const double bend = 2 * std::abs(middle - 0.5 * (first + last));
        if (std::max({first, middle, last}) + (std::isfinite(bend) ? bend : 0.0) <=
            motion->Z0 - margin)
            continue;
        motion->edge = motion->edge || !std::isfinite(bend);
        fresh.push_back(i);
        add_member(i, middle);
    }
}

// Follows the accepted state while the tip moves on a straight line at the accepted separation.
// Returns false if the path is lost; the accepted state and the tip are then unchanged, as after an
// exception. On a surface that repeats the way is the shortest one, and is taken in pieces that are
// short against the period, so that images of asperities are the nearest ones all along.
bool AdhesivePath::move(double x0, double y0) {
    const Indenter old = indenter;
    const Past before = accepted;
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
        pieces =
            std::max(1, int(std::ceil(pieces_of_period * std::max(std::abs(way.x) / period.x,
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
    begin(accepted.separation);
    for (int k = 0; k < 3; ++k) {
        Point there = predicted(accepted.separation, true);
        const Found found = descend(there, true, 0);
        if (found == Found::jump) return false;
        if (found == Found::equilibrium) {
            here = std::move(there);
            lost_way = false;
            accepted = now = past();
            return true;
        }
        if (!cover(accepted.separation)) return false;
    }
    return false;
}

bool AdhesivePath::move_piece(Vec2 from, Vec2 to) {
    begin(accepted.separation);
    if (lost_way) return false;
    indenter.move(from.x, from.y);
    motion = Motion{from, to, accepted.separation};
    here.Z = 0;
    if (!cover(0)) return false;
    if (motion->edge)
        bad_input(
            "a body with an edge cannot be moved while asperities are attached near its "
            "edge: pull it off first");
    double length = 0;
    for (int i : set.asperity) {
        const double middle = clearance_at(i, 0.5);
        length = std::max(
            {length, std::abs(middle - clearance_at(i, 0)), std::abs(clearance_at(i, 1) - middle)});
    }
    if (length > 0) motion->length = length;
    if (!find(here, 0)) return false;
    complete(here);
    follow(motion->length);
    if (lost_way || here.Z != motion->length) return false;
    Past left = past();
    left.separation = motion->Z0;
    left.jumps += jumps;
    if (!std::isfinite(left.lost) || !std::isfinite(left.least_force)) return false;
    accepted = now = left;
    return true;
}

}  // namespace rsc
