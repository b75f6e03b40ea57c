// The path of adhesive asperities while the tip moves at one separation.
#include "contact/adhesive_path.hpp"

namespace rsc {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

}  // namespace

double AdhesivePath::clearance_at(int i, double share) {
    indenter.x0 = motion->from.x + share * (motion->to.x - motion->from.x);
    indenter.y0 = motion->from.y + share * (motion->to.y - motion->from.y);
    return indenter.clearance(asperities.x[at(i)], asperities.y[at(i)], asperities.z[at(i)]);
}

// Sets g0, and its rates if the tip moves.
void AdhesivePath::set_gaps(double Z) {
    if (!motion) {
        for (std::size_t k = 0; k < clearance.size(); ++k) set.g0[k] = clearance[k] - Z;
        return;
    }
    constexpr double apart = 1e-4;  // share of the way for differences
    const double share = Z / motion->length;
    for (std::size_t k = 0; k < clearance.size(); ++k) {
        const int i = set.asperity[k];
        rate[k] = (clearance_at(i, share + apart) - clearance_at(i, share - apart)) / (2 * apart * motion->length);
        set.g0[k] = clearance_at(i, share) - motion->Z0;
    }
}

void AdhesivePath::set_power(Point& point) const {
    point.power = 0;
    for (std::size_t k = 0; k < active.size(); ++k) point.power -= solver.states()[k].f * rate[at(active[k])];
}

// Follows the accepted state while the tip moves on a straight line at the accepted separation. Returns false if the path is lost; the
// accepted state is then unchanged.
bool AdhesivePath::move(double x0, double y0) {
    begin(accepted.separation);
    if (lost_way) return false;
    const Indenter old = indenter;
    indenter.move(x0, y0);
    motion = Motion{{old.x0, old.y0}, {x0, y0}, accepted.separation};
    cover(0);
    double length = 0;
    for (int i : set.asperity) {
        const double middle = clearance_at(i, 0.5);
        length = std::max({length, std::abs(middle - clearance_at(i, 0)), std::abs(clearance_at(i, 1) - middle)});
    }
    if (length > 0) motion->length = length;
    const bool done = find(0, here.s, here) && (complete(here), go(motion->length, std::nullopt), !lost_way) && here.Z == motion->length;
    if (done) now = past(), now.separation = motion->Z0, now.jumps += jumps, accepted = now;
    motion.reset();
    indenter = old;
    if (done) indenter.move(x0, y0);
    ranking.assign(asperities, indenter);
    return done;
}

}  // namespace rsc
