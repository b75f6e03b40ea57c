#include "contact/asperity_level.hpp"

#include "contact/expected_error.hpp"
#include "contact/interaction/mesh.hpp"
#include "contact/interaction/products.hpp"
#include "contact/spots.hpp"
#include "contact/validity.hpp"

namespace rsc {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

// The contacts of a level as they lie on the surface: their long axes are those of the smaller curvature.
std::vector<Spot> spots_of(const Level& level, const Law& law, const Asperities& asperities) {
    std::vector<Spot> spots;
    for (std::size_t k = 0; k < level.asperity.size(); ++k) {
        const double root = std::sqrt(law.axes(level.asperity[k]));
        spots.push_back({level.x[k], level.y[k], level.a[k] / root, level.a[k] * root, asperities.angle[at(level.asperity[k])]});
    }
    return spots;
}

// Z0 from which on down the flank of some summit touches the indenter, slope^2/(2 curvature) before its top does.
double beside(const Asperities& asperities, const Indenter& indenter) {
    double highest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < asperities.size(); ++i) {
        const Vec2 slope = indenter.shape->gradient(asperities.x[i] - indenter.x0, asperities.y[i] - indenter.y0);
        const double nearer = 0.5 * (slope.x * slope.x + slope.y * slope.y) * asperities.radius[i];
        highest = std::fmax(highest, indenter.clearance(asperities.x[i], asperities.y[i], asperities.z[i]) + nearer);
    }
    return highest;
}

}  // namespace

// The summits of the difference between surface and indenter, or nothing where the asperities are to be taken as they are.
std::optional<Asperities> summits_of_difference(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options,
                                                const SummitSearch& search) {
    require_sound(indenter);
    if (!search || indenter.shape->flat() || !traits(options.law).between_points || !(options.rms_slope > 0)) return std::nullopt;
    double highest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < asperities.size(); ++i)
        highest = std::max(highest, indenter.clearance(asperities.x[i], asperities.y[i], asperities.z[i]));
    constexpr double kFlankSpacing = 0.4;
    constexpr double depth = 8;  // rms heights below the highest: from 4 sigma down to where the model ends
    const double steepest = steepest_above(asperities, indenter, highest - depth * options.sigma);
    if (steepest > kMostSlopeRatio * options.rms_slope || asperities.size() == 0) {
        Asperities found = search(indenter);
        add_flanks(found, asperities, kFlankSpacing * options.mean_spacing);
        return found;
    }
    return moved_summits(asperities, indenter);
}

// `auto`: direct or mesh by what a Newton solve costs, from the rates test/bench measures. The dense method is never the cheapest.
Method choose_method(const SolverOptions& options, const Kernel& kernel, const WorkingSet& candidates) {
    if (kernel.none()) return options.method == Method::dgesv ? Method::dgesv : Method::direct;
    if (options.method != Method::automatic) return options.method;
    // A solve takes some 40 inner products; the mesh also some full ones its making, and points that lie closer in the middle.
    constexpr double contacts_per_candidate = 0.4, mesh_overhead = 4;
    const double contacts = contacts_per_candidate * static_cast<double>(candidates.size());
    double scale = 1e300;  // of a smooth part, in extents of the candidates
    if (kernel.smooth() && candidates.size() > 0) {
        const auto [west, east] = std::minmax_element(candidates.x.begin(), candidates.x.end());
        const auto [south, north] = std::minmax_element(candidates.y.begin(), candidates.y.end());
        scale = kernel.smooth()->scale() / std::max({*east - *west, *north - *south, 1e-300});
    }
    const double mesh_cost = mesh_overhead * MeshPotential::estimated_cost(at(candidates.size()), 1e-3, 1, scale);
    return contacts * contacts / direct_rate(kernel) > mesh_cost ? Method::mesh : Method::direct;
}

void judge_asperities(Level& level, const Law& law, const Asperities& asperities, const Indenter& indenter, const SolverOptions& options,
                      bool of_surface) {
    if (traits(options.law).elliptic_spots)
        level.area = union_area(spots_of(level, law, asperities), &level.overlapping_pairs, indenter.period, &level.own_area);
    else
        level.overlapping_pairs = count_overlapping(level.x, level.y, level.a, indenter.period);
    if (level.overlapping_pairs > 0) level.status = LevelStatus::overlapping;
    if (options.rms_slope > 0) level.slope_ratio = steepest_contact(level, indenter) / options.rms_slope;
    if (!(options.adhesion.work > 0)) expect_error(level, asperities, indenter, options);  // fitted without adhesion
    judge_range(level, indenter, options);
    // The surface's own summits touch only where the indenter is flat beside them.
    if (of_surface && (level.slope_ratio > kMostSlopeRatio || (level.contacts == 0 && level.separation < beside(asperities, indenter))))
        level.status = graver(level.status, LevelStatus::out_of_validity);
}

}  // namespace rsc
