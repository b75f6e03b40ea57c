// Starting points for the solution of a level: predicted from earlier levels if that is safe,
// otherwise the default start, which defines the solution.
#pragma once

#include "asperities/candidates.hpp"
#include "interaction/products.hpp"

namespace rsc {

// Earlier levels, from which B F of the next level is extrapolated.
class EarlierLevels {
public:
    // Stores the level at Z0 with penetrations v over the candidates.
    void remember(double Z0, const Candidates& candidates, const std::vector<double>& v);

    // Sets dphi/dZ0 of the last level stored, over its candidates, which serves until there is
    // another level.
    void bend(const Candidates& candidates, const std::vector<double>& slope);

    // To be called when the tip moves from one place to another and ranks become invalid: stores
    // the last level by asperity as the start of the next level. If the tip keeps its direction,
    // the start is extrapolated linearly from the levels at its last two places.
    void carry(const Candidates& candidates, const std::vector<double>& v, std::size_t asperities,
               Vec2 from, Vec2 to);

    // Predicts penetrations at Z0 from the last level and its slope, or at a new place of the tip
    // from the levels of the last two places. Candidates that are not in earlier levels are assumed
    // not to touch (which is checked later). Returns false without a prediction.
    bool predict(double Z0, const Candidates& candidates, std::vector<double>& start) const;

    // Whether archived levels are of this many asperities.
    bool fits(std::size_t asperities) const {
        return last_place_.fits(asperities) && place_before_.fits(asperities);
    }
    template <class Archive, class Self>
    static void archive(Archive& a, Self& my) {
        a(my.past_, my.last_place_, my.place_before_, my.step_ratio_);
    }

private:
    struct Past {
        double separation = 0;
        std::vector<double> phi;         // B F by rank; NaN: unknown
        std::vector<double> slope = {};  // d phi/dZ0; empty: unknown
        template <class Archive, class Self>
        static void archive(Archive& a, Self& my) {
            a(my.separation, my.phi, my.slope);
        }
    };
    std::optional<Past> past_;  // the last level at this place of the tip

    struct AtPlace {
        double separation = 0;
        Vec2 place{};
        std::vector<double> phi;  // B F by asperity; NaN: unknown
        std::vector<int> known;   // asperities with known B F
        // Without the many that are unknown.
        template <class Archive, class Self>
        static void archive(Archive& a, Self& my) {
            std::uint64_t size = my.phi.size();
            std::vector<double> values;
            if constexpr (Archive::writing)
                for (const int i : my.known) values.push_back(my.phi[at(i)]);
            a(my.separation, my.place.x, my.place.y, my.known, values, size);
            if constexpr (!Archive::writing) my.spread(values, at(size));
        }
        void spread(const std::vector<double>& values, std::size_t size) {
            phi.assign(size, std::numeric_limits<double>::quiet_NaN());
            if (values.size() != known.size() || !fits(size)) return;
            for (const auto k : indices(values)) phi[at(known[k])] = values[k];
        }
        bool fits(std::size_t asperities) const {
            return (phi.empty() || phi.size() == asperities) &&
                   std::ranges::all_of(known, [&](int i) { return i >= 0 && at(i) < phi.size(); });
        }
    } last_place_, place_before_;  // of the last place of the tip, and of the one before
    // Length of the last move of the tip over that of the one before; 0: it turned.
    double step_ratio_ = 0;
};

// Mean-field start: penetrations g0 - s of the no-interaction forces F = f(<g0 - s>), where s is
// the mean of B F weighted with F. s is found by bisection with a fixed number of products.
std::vector<double> cold_start(const Law& law, Products& products, const WorkingSet& candidates);

}  // namespace rsc
