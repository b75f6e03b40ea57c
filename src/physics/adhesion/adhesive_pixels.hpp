// The state of adhesive boundary elements and the path it follows; the method and its limits:
// adhesive_elements.hpp.
#pragma once

#include "elements/cut_map.hpp"
#include "elements/elements.hpp"
#include "elements/periodic_elements.hpp"
#include "physics/adhesion/adhesive_edges.hpp"
#include "physics/adhesion/adhesive_elements.hpp"
#include "physics/adhesion/sticking.hpp"

namespace rsc {

struct AdhesivePixels : CutMap {
    // State left by accepted levels.
    struct Past {
        double separation = kInfinity, force = 0, energy = 0, least_force = 0, lost = 0;
        std::int32_t jumps = 0;                // on the way of the tip since the last level
        std::vector<std::int32_t> attracting;  // increasing
        std::vector<double> share;             // of the traction s0 on these points
    };

    const HeightMap& heights;
    Indenter indenter;
    SolverOptions options;
    double s0 = 0, z0 = 0;  // traction and range; without a range those of the edges
    double pixel;
    HeightMap raised;                         // periodic flats: heights for the solver
    std::unique_ptr<PeriodicElements> flats;  // between flats
    std::unique_ptr<PixelProducts> products, field;
    std::optional<ElementsSolver> spots;
    // Attraction without a range:
    std::unique_ptr<PixelProducts> edge_products;
    std::optional<AdhesiveEdges> edges;

    // For all points of the map: clearance under the indenter, the share of s0 that acts on the
    // point (attraction()), and the pressure without this attraction.
    std::vector<double> clearance, share, q;
    double top = -kInfinity;
    // Gaps of all points (out of reach those without deformation); of the accepted state, gaps and
    // pressures.
    std::vector<double> gap, gap_before, p_before;
    // Points within reach, row by row as cut open, with their elevation by the attraction.
    std::vector<std::int32_t> reach;
    std::vector<double> lift;
    // Largest heights by which points may be raised: by the attraction, and around pressure on a
    // layer that bulges.
    double margin = 0, bulge = 0, bulged = 0;

    Past accepted, now;
    double attracted = 0;  // of attraction()

    AdhesivePixels(const HeightMap& heights_, const Indenter& indenter_,
                   const SolverOptions& options_);

    double resolution() const {
        if (edges) return kNotComputed;
        return cohesive_length(indenter.E_star, options.physics.of<Adhesion>()) /
               std::max(heights.dx, heights.dy);
    }
    double pressure(std::size_t i) const { return q[i] - s0 * share[i]; }
    void set_clearances();
    void forget();
    void gather(double Z);
    double attraction(std::vector<double>& shares) const;
    bool renew(double Z, Level& level);
    bool touch(double Z, Level& level);
    bool join(double Z);
    void select_edges(bool more);
    bool balance_edges(double Z, Level& level);
    bool touches(std::size_t i) const {
        return edges ? share[i] >= 0.5 && pressure(i) > -s0 : q[i] > 0;
    }
    double stiffness();
    bool press(double Z, double tolerance, Level& level);
    std::int32_t count_jumps() const;
    void keep();
    void restore(const Past& past);
    void move(double x0, double y0);
    void follow();
    std::vector<double> deflections(const std::vector<double>& p, double tolerance);
    Level step(double Z, const Past* start = nullptr);
    double negligible() const;
    double work_of_step() const;
    void divide(Level& level, double shortest);
    double lost_in_step() const;
    Level solve(double Z, bool trial);
    std::optional<Past> tried;  // the state of the last trial since a level was accepted
};

}  // namespace rsc
