// Summits between grid points, for all laws except 'hertz'.
#pragma once

#include "surface/asperities.hpp"
#include "surface/defects.hpp"
#include "surface/detection.hpp"
#include "surface/stencil.hpp"
#include "surface/summits.hpp"

namespace rsc {

// Heights around a grid point, the middle of the patch.
struct Patch {
    // largest distance of a summit from the grid maximum [grid steps]
    static constexpr int kTravel = 3;
    static constexpr int kMargin = Stencil::kMostReach + kTravel;
    static constexpr int kSide = 2 * kMargin + 2;
    // a stencil's padding reads beyond the last point
    static constexpr int kStride = 2 * kMargin + Stencil::kTaps;
    alignas(64) double z[kSide][kStride] = {};
    // Range of grid points, counted from the middle, at which the stencil may be centred.
    int first_x = -kTravel, last_x = kTravel, first_y = -kTravel, last_y = kTravel;
};

// A summit and its derivatives, in units of grid steps; (x, y) is counted from the middle of the
// patch.
struct RefinedSummit {
    double x = 0, y = 0, z = 0;
    double zxx = 0, zxy = 0, zyy = 0;
    double zxxxx = 0, zxxxy = 0, zxxyy = 0, zxyyy = 0, zyyyy = 0;
};

// Climbs from the middle of the patch to the summit by Newton's method on grad z = 0, with steps of
// at most one grid step, uphill where the surface is not concave. Returns nothing if there is no
// summit within `travel` grid steps.
std::optional<RefinedSummit> refine(const Stencil& stencil, const Patch& patch,
                                    int travel = Patch::kTravel);

// Summits found from starts in a range of rows, in the order of the starts.
struct RefinedSummits {
    struct From {
        int row, column;  // of the start
        bool maximum;     // the start is a maximum of the grid
        double u, v;      // position of the summit in grid steps, x = x0 + u dx, y = y0 + v dy
        double moved;     // distance from the start, the larger of both directions [grid steps]
        // Biharmonic of the round profile that flattens like the elongated summit [1/length^3].
        double elongated;
    };
    Asperities found;
    std::vector<From> from;
    long saddles = 0;  // grid maxima without a summit in reach
};

// Climbs from grid points to the summits of the surface, row by row.
class SummitClimber {
public:
    // The map has ny rows as described by `place` (its y is not used); y0 is the y of row 0.
    // `stencils` is one stencil if the band of the map is known, otherwise polynomials of reach 1,
    // 2, ..., of which the longest that crosses no break or border is used.
    SummitClimber(const std::vector<Stencil>& stencils, const RowPlace& place, int ny, double y0,
                  Curvature curvature, const Breaks* breaks = nullptr);

    // Number of rows on either side that climb() may request; a map that is not periodic has none
    // beyond its edges.
    int margin() const { return stencils_.back().reach() + Patch::kTravel; }

    using Rows = std::function<const double*(int)>;
    // Appends the summits reached from row j. row(d) returns row j + d, or null if there is none.
    void climb(int j, const Rows& row, RefinedSummits& to);
    // Appends the summit reached from the point (i, j), a maximum or another start, if there is
    // one.
    void climb_from(int i, int j, bool maximum, const Rows& row, RefinedSummits& to);

private:
    int clear_reach(int i, int j) const;
    void cut_out(int i, int j, const Rows& row);
    void keep_within(int i, int j, int reach);
    std::optional<RefinedSummit> summit_from(int i, int j, bool maximum, const Rows& row);
    bool seen_from_maximum(int i, int j, const Rows& row) const;
    // Height of the patch at an offset from its middle [grid steps].
    double height(int di, int dj) const {
        return patch_.z[Patch::kMargin + dj][Patch::kMargin + di];
    }
    bool smooth_around(const RefinedSummit& summit, double bend) const;
    double usual_bend() const;
    RefinedSummit of_grid(double bend, bool& broken) const;
    double append_biharmonic(const RefinedSummit& s, Asperities& a) const;

    const std::vector<Stencil>& stencils_;
    const Breaks* breaks_;
    RowPlace place_;
    int ny_;
    double y0_;
    Curvature curvature_;
    Patch patch_;
    std::vector<Start> starts_;
};

// If several starts lead to the same summit, keeps one that is a maximum, else the nearest one.
// Returns the number of maxima removed.
long drop_repeated(RefinedSummits& summits, int nx, int ny, bool periodic);

// Counts and means of asperities with curvatures, summed in order, so that they do not depend on
// how the search was divided.
SummitCount counted(const Asperities& all, long saddles, long repeated);

}  // namespace rsc
