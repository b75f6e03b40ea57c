// States of a given and of the smallest force, between two states on the path of adhesive
// asperities.
#include "physics/adhesion/adhesive_path.hpp"

namespace rsc {
namespace {

constexpr double kRates = 1e-6;  // accuracy of derivatives

}  // namespace

// Finds the state of the smallest force between a state `below` with dN/dZ0 < 0 and a state `above`
// with dN/dZ0 > 0.
AdhesivePath::Point AdhesivePath::least_between(const Point& below, const Point& above) {
    Point low = below, high = above, least = below.force < above.force ? below : above, middle;
    for (int i = 0; i < 40; ++i) {
        const double share =
            std::clamp(low.change.force / (low.change.force - high.change.force), 0.05, 0.95);
        const double Z = low.Z + share * (high.Z - low.Z);
        Vector s(low.s.size());
        for (std::size_t k = 0; k < s.size(); ++k) s[k] = low.s[k] + share * (high.s[k] - low.s[k]);
        if (!find(Z, s, middle)) break;
        complete(middle, kRates);
        const double gained = std::abs(middle.change.force * (high.Z - low.Z));
        if (middle.force < least.force) least = middle;
        (middle.change.force < 0 ? low : high) = middle;
        if (gained <= 1e-10 * std::abs(middle.force)) break;
    }
    return least;
}

// Finds the state with the wanted force between two states, one with a larger and one with a
// smaller force.
bool AdhesivePath::find_force(const Point& a, const Point& b, double wanted) {
    Point low = a, high = b, middle;
    const double precise =
        0.1 * options.tolerance *
        std::max(std::abs(wanted), 1e-3 * std::max(std::abs(a.force), std::abs(b.force)));
    for (int i = 0; i < 100; ++i) {
        const Point& nearer =
            std::abs(low.force - wanted) < std::abs(high.force - wanted) ? low : high;
        double Z = nearer.Z + (wanted - nearer.force) / nearer.change.force;
        const double first = std::min(low.Z, high.Z), last = std::max(low.Z, high.Z);
        if (!(Z > first && Z < last) || i % 8 == 7) Z = 0.5 * (low.Z + high.Z);
        const double share = (Z - low.Z) / (high.Z - low.Z);
        Vector s(low.s.size());
        for (std::size_t k = 0; k < s.size(); ++k) s[k] = low.s[k] + share * (high.s[k] - low.s[k]);
        if (Z == low.Z || Z == high.Z || !find(Z, s, middle)) return false;
        complete(middle, kRates);
        if (std::abs(middle.force - wanted) <= precise) {
            here = middle;
            return true;
        }
        ((middle.force < wanted) == (low.force < wanted) ? low : high) = middle;
    }
    return false;
}

}  // namespace rsc
