// The state of adhesive boundary elements and the path it follows; the method and its limits:
// adhesive_elements.hpp.
#pragma once

#include "elements/cut_map.hpp"
#include "elements/elements.hpp"
#include "elements/periodic_elements.hpp"
#include "physics/adhesion/adhesive_elements.hpp"

namespace rsc {

struct AdhesivePixels : CutMap {
    // State left by accepted levels.
    struct Past {
        double separation = kInfinity, force = 0, work = 0, least_force = 0, lost = 0;
        std::int32_t jumps = 0;                // on the way of the tip since the last level
        std::vector<std::int32_t> attracting;  // increasing
    };

    const HeightMap& heights;
    Indenter indenter;
    SolverOptions options;
    double s0, z0, pixel;
    HeightMap raised;                         // periodic flats: heights for the solver
    std::unique_ptr<PeriodicElements> flats;  // between flats
    std::unique_ptr<PixelProducts> products, field;
    std::optional<ElementsSolver> spots;

    // For all points of the map: clearance under the indenter, pressure + s0, and whether the point
    // attracts.
    std::vector<double> clearance, q;
    std::vector<char> on;
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
    double energy = 0;

    AdhesivePixels(const HeightMap& heights_, const Indenter& indenter_,
                   const SolverOptions& options_);

    double resolution() const {
        return cohesive_length(indenter.E_star, options.adhesion) /
               std::max(heights.dx, heights.dy);
    }
    double pressure(std::size_t i) const { return q[i] - (on[i] ? s0 : 0.0); }
    void set_clearances();
    void forget();
    void gather(double Z);
    bool renew(double Z, Level& level);
    bool press(double Z, Level& level);
    std::int32_t count_jumps() const;
    void keep();
    void move(double x0, double y0);
    void follow();
    std::vector<double> deflections(const std::vector<double>& p);
    Level step(double Z);
    double dissipated(std::size_t i) const;
    double work_error() const;
    Level solve(double Z, bool trial);
    std::optional<Level> tried;  // the present state is that of a trial from the accepted one
};

}  // namespace rsc
