#include "asperities/asperity_level.hpp"

#include "asperities/spots.hpp"
#include "interaction/close_pairs.hpp"
#include "interaction/mesh.hpp"
#include "interaction/products.hpp"

namespace rsc {
namespace {

// Contact spots of a level on the surface; their long axes are in the direction of the smaller
// curvature.
std::vector<Spot> spots_of(const Level& level, const Law& law, const Asperities& asperities) {
    std::vector<Spot> spots;
    for (std::size_t k = 0; k < level.asperity.size(); ++k) {
        if (const auto spot = law.spot(level.asperity[k], level.u[k])) {
            spots.push_back(*spot);
            spots.back().x += level.x[k], spots.back().y += level.y[k];
            continue;
        }
        const double root = std::sqrt(law.axes(level.asperity[k]));
        spots.push_back({level.x[k], level.y[k], level.a[k] / root, level.a[k] * root,
                         asperities.angle[at(level.asperity[k])]});
    }
    return spots;
}

// The spot of a summit that lies in that of a larger one is part of it (law/ellipse_law.hpp): the
// index of the largest such spot for each spot, its own if there is none.
std::vector<std::size_t> wholes_of(const std::vector<Spot>& spots, const Level& level,
                                   const Law& law) {
    std::vector<double> reach(spots.size(), 0.0);
    for (std::size_t k = 0; k < spots.size(); ++k)
        if (law.spot(level.asperity[k], level.u[k]))
            reach[k] =
                spots[k].major + std::hypot(spots[k].x - level.x[k], spots[k].y - level.y[k]);
    std::vector<std::size_t> whole(spots.size());
    std::iota(whole.begin(), whole.end(), std::size_t{0});
    const auto smaller = [&](std::size_t i, std::size_t j) {
        return spots[i].major * spots[i].minor < spots[j].major * spots[j].minor;
    };
    for_close_pairs(level.x, level.y, reach, [&](std::size_t i, std::size_t j, double) {
        const std::size_t large = smaller(i, j) ? j : i, small = i + j - large;
        if (spots[large].contains(level.x[small], level.y[small]) && smaller(whole[small], large))
            whole[small] = large;
    });
    for (std::size_t& k : whole)
        while (whole[k] != k) k = whole[k];
    return whole;
}

// Summits of the difference between surface and indenter; absent if the given asperities are to be
// used.
std::optional<FoundSummits> summits_of_difference(const Asperities& asperities,
                                                  const Indenter& indenter,
                                                  const SolverOptions& options,
                                                  const SummitSearch& search) {
    require_sound(indenter);
    if (!search || indenter.shape->flat() || !traits(options.law).between_points ||
        !(options.rms_slope > 0))
        return std::nullopt;
    double highest = -kInfinity;
    for (std::size_t i = 0; i < asperities.size(); ++i)
        highest = std::max(highest,
                           indenter.clearance(asperities.x[i], asperities.y[i], asperities.z[i]));
    constexpr double kFlankSpacing = 0.4;
    const double steepest =
        steepest_above(asperities, indenter, highest - kDeepest * options.sigma);
    // Beside a corner at the tip the curvature of the face is not that above a summit some way off,
    // and a flank may touch.
    const bool corner = indenter.shape->edge(0) == 0 && !std::isfinite(options.hardness.H0) &&
                        options.relaxation.none() && options.adhesion.work == 0;
    if (steepest > kMostSlopeRatio * options.rms_slope || corner || !std::isfinite(highest)) {
        FoundSummits found = search(indenter);
        add_flanks(found.summits, asperities, kFlankSpacing * options.mean_spacing,
                   indenter.around);
        found.renumbered = true;
        return found;
    }
    FoundSummits moved;
    moved.summits = moved_summits(asperities, indenter);
    return moved;
}

// With the spacing of summits and the points per wave of the finer of two rough bodies: contacts
// are as small and as close as its waves.
SolverOptions of_both(SolverOptions options, const Indenter& indenter) {
    const ShapeKeys& second = indenter.shape->keys();
    if (second.spacing > 0 && options.mean_spacing > 0)
        options.mean_spacing = std::min(options.mean_spacing, second.spacing);
    if (second.shortest_wave > 0 && options.points_per_wave > 0 && options.grid_step > 0)
        options.points_per_wave =
            std::min(options.points_per_wave, second.shortest_wave / options.grid_step);
    return options;
}

}  // namespace

ContactBodies::ContactBodies(const Asperities& given, const Indenter& indenter_,
                             const SolverOptions& options_, SummitSearch search_)
    : of_surface(given),
      options(of_both(options_, indenter_)),
      blunt(std::accumulate(given.radius.begin(), given.radius.end(), 0.0) /
            static_cast<double>(given.size())),
      search(std::move(search_)),
      of_difference(summits_of_difference(of_surface, indenter_, options_, search)),
      asperities(of_difference ? of_difference->summits : of_surface),
      indenter(indenter_),
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
    const double contacts = contacts_per_candidate * static_cast<double>(candidates.size());
    // length scale of a smooth part, relative to the extent of the candidates Between flats the
    // finer mesh is left out: direct sums are slower by the same factor.
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
    if (options.rms_slope > 0)
        level.slope_ratio = steepest_contact(level, indenter) / options.rms_slope;
}

}  // namespace rsc
