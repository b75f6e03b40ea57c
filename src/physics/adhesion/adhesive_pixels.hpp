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
        double conjugate = 0;  // of attraction(): sum of the shares times z0 - gap, minus its value
        std::int32_t jumps = 0;                // on the way of the tip since the last level
        std::vector<std::int32_t> attracting;  // increasing
        std::vector<double> share;             // of the traction s0 on these points
        std::vector<double> gap;               // of the tracked points
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
    // Gaps of all points (out of reach those without deformation); pressures of the accepted state.
    std::vector<double> gap, p_before;
    // Points within reach, row by row as cut open, with their elevation by the attraction.
    std::vector<std::int32_t> reach;
    std::vector<double> lift;
    // On the way to a level: the points that attract at either end.
    std::vector<std::int32_t> tracked;
    // Largest heights by which points may be raised: by the attraction, and around pressure on a
    // layer that bulges.
    double margin = 0, bulge = 0, bulged = 0;

    Past accepted, now;

    // A part of the way between two levels: its loss, by how much it may be wrong, and whether
    // what the change of the attraction releases is positive all along.
    struct Part {
        Past from, to;
        double lost = 0, doubt = 0;
        bool proved = false;
        std::int32_t jumps = 0;
    };
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
    bool renew(double Z, double aim, Level& level);
    bool load(double Z, double tolerance, Level& level);
    void open(Past& state);
    double released(const Past& one, const Past& other);
    bool touch(double Z, Level& level);
    bool join(double Z);
    void select_edges(bool more);
    bool balance_edges(double Z, double tolerance, Level& level);
    bool touches(std::size_t i) const {
        return edges ? share[i] >= 0.5 && pressure(i) > -s0 : q[i] > 0;
    }
    double stiffness();
    bool press(double Z, double tolerance, Level& level);
    std::int32_t count_jumps(const Past& from, const Past& to) const;
    void keep();
    void restore(const Past& past);
    void move(double x0, double y0);
    void follow();
    std::vector<double> deflections(const std::vector<double>& p, double tolerance);
    Level step(double Z, const Past* start = nullptr, double tolerance = 0);
    double negligible(const Past& from, const Past& to) const;
    Part between(const Past& from, const Past& to, Level& effort);
    std::vector<Part> divide(Level& effort);
    Level follow_range(double Z);
    bool may_pull_harder();
    void divide_edges(Level& level, double way);
    Level follow_edges(double Z);
    Level solve(double Z, bool trial);
    std::optional<Past> tried;  // the state of the last trial since a level was accepted
};

}  // namespace rsc
