#include "asperities/asperity_level.hpp"

#include "contact/spots.hpp"
#include "interaction/mesh.hpp"
#include "interaction/products.hpp"

namespace rsc {
namespace {

// Contact spots of a level on the surface; their long axes are in the direction of the smaller
// curvature.
std::vector<Spot> spots_of(const Level& level, const Law& law, const Asperities& asperities) {
    std::vector<Spot> spots;
    for (const auto k : indices(level.asperity)) {
        const double root = std::sqrt(law.footprint(level.asperity[k], 0).axes);
        spots.push_back({level.x[k], level.y[k], level.a[k] / root, level.a[k] * root,
                         asperities.angle[at(level.asperity[k])]});
    }
    return spots;
}

// True if the summits of the difference between surface and indenter differ from those of the
// surface.
bool shifts_summits(const Indenter& indenter, const SolverOptions& options) {
    require_sound(indenter);
    return !indenter.shape->flat() && traits(options.law).between_points &&
           options.surface.gentlest_slope > 0;
}

// With the spacing of summits of the finer of two rough bodies: contacts are as close as its waves.
SolverOptions of_both(SolverOptions options, const Indenter& indenter) {
    const ShapeKeys& second = indenter.shape->keys();
    if (second.spacing > 0 && options.surface.mean_spacing > 0)
        options.surface.mean_spacing = std::min(options.surface.mean_spacing, second.spacing);
    return options;
}

}  // namespace

ContactBodies::ContactBodies(const Asperities& given, const Indenter& indenter_,
                             const SolverOptions& options_)
    : of_surface(given),
      options(of_both(options_, indenter_)),
      indenter(indenter_),
      of_difference(shifts_summits(indenter, options)
                        // beyond half the mean distance of summits lies the range of others
                        ? std::make_unique<ShiftedSummits>(of_surface, indenter,
                                                           0.5 * options.surface.mean_spacing)
                        : nullptr),
      asperities(of_difference ? of_difference->summits() : of_surface),
      kernel(make_kernel(options_.interaction, substrate_of(indenter_), indenter_.period)) {}

// `auto`: direct or mesh by the estimated cost of a Newton solve, with rates measured by
// test/bench. The dense method is never the cheapest.
Method choose_method(const SolverOptions& options, const Kernel& kernel,
                     const WorkingSet& candidates) {
    if (kernel.none()) return options.method == Method::dgesv ? Method::dgesv : Method::direct;
    if (options.method != Method::automatic) return options.method;
    // A solve takes about 40 inner products. The overhead of the mesh includes its setup and denser
    // points near the middle.
    constexpr double contacts_per_candidate = 0.4, mesh_overhead = 4;
    const double contacts = contacts_per_candidate * double(candidates.size());
    // The length over which a smooth part changes, relative to the extent of the candidates.
    // Between flats the finer mesh is left out: direct sums are slower by the same factor.
    double scale = 1e300;
    if (kernel.smooth() && !kernel.lattice() && candidates.size() > 0) {
        const auto [west, east] = std::minmax_element(candidates.x.begin(), candidates.x.end());
        const auto [south, north] = std::minmax_element(candidates.y.begin(), candidates.y.end());
        scale = kernel.smooth()->scale() / std::max({*east - *west, *north - *south, 1e-300});
    }
    const double mesh_cost =
        mesh_overhead * MeshPotential::estimated_cost(at(candidates.size()), 1e-3, 1, scale);
    return contacts * contacts / direct_rate(kernel, at(candidates.size())) > mesh_cost
               ? Method::mesh
               : Method::direct;
}

void complete_level(Level& level, const Law& law, const ContactBodies& bodies) {
    const Indenter& indenter = bodies.indenter;
    const SolverOptions& options = bodies.options;
    if (traits(options.law).elliptic_spots) {
        level.spots = spots_of(level, law, bodies.asperities);
        level.area =
            union_area(level.spots, &level.overlapping_pairs, indenter.period, &level.own_area);
    } else {
        level.overlapping_pairs = count_overlapping(level.x, level.y, level.a, indenter.period);
    }
    if (options.surface.gentlest_slope > 0)
        level.slope_ratio = steepest_contact(level, indenter) / options.surface.gentlest_slope;
}

}  // namespace rsc
