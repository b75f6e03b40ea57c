// Summits between the points of the grid, for all laws but 'hertz'.
#pragma once

#include "rough/asperities.hpp"
#include "rough/breaks.hpp"
#include "rough/refine.hpp"
#include "rough/summits.hpp"

namespace rsc {

// Summits found in some rows, in the order of the points they were reached from.
struct RefinedSummits {
    Asperities found;
    std::vector<int> row, column;   // of the start
    std::vector<char> maximum;      // the start is a maximum of the grid
    std::vector<double> u, v;       // place in grid steps, x = x0 + u dx, y = y0 + v dy
    std::vector<double> elongated;  // biharmonic of the round profile that flattens like the elongated summit [1/length^3]
    std::vector<double> moved;      // from the start, the larger of both directions [grid steps]
    long saddles = 0;               // grid maxima without a summit in reach
    void append(const RefinedSummits& other);
};

// Climbs from grid points to the summits of the surface, row by row.
class SummitClimber {
public:
    // The map's rows as in `place` (its y is not used), ny of them; y0 is the y of row 0. One stencil for a map whose band is known; polynomials
    // of reach 1, 2, ... for others, of which the longest that reaches over no break and no border is taken.
    // With a body above: to the summits of the difference.
    SummitClimber(const std::vector<Stencil>& stencils, const RowPlace& place, int ny, double y0, Curvature curvature,
                  const BodyAbove* above = nullptr, const Breaks* breaks = nullptr);

    // Rows on either side of a row that row() must be able to give; a map that is not periodic has none beyond its edges.
    int margin() const { return stencils_.back().reach() + Patch::kTravel; }

    using Rows = std::function<const double*(int)>;
    // Appends the summits reached from row j; row(d) is the row j + d, null where there is none.
    void climb(int j, const Rows& row, RefinedSummits& to);

private:
    int clear_reach(int i, int j) const;
    void cut_out(int i, int j, const Rows& row);
    void keep_within(int i, int j, int reach);
    std::optional<RefinedSummit> summit_from(int i, int j, bool maximum, const Rows& row);
    bool seen_from_maximum(const RowPlace& place, int i, int j, const Rows& row) const;
    const double* difference_row(int j, const double* z);
    double difference(int i, int j, int di, int dj) const;
    bool smooth_around(int i, int j, const RefinedSummit& summit, double bend) const;
    double usual_bend() const;
    RefinedSummit of_grid(int i, int j, double bend, bool& broken) const;
    void append_biharmonic(const RefinedSummit& s, double lowered, RefinedSummits& to) const;

    // Rows of the difference, five of them. A periodic surface under a body that does not repeat goes on by kBeside points on either side.
    static constexpr int kBeside = 2, kRows = 5;
    struct DifferenceRow {
        int j = -1;
        bool known = false;
        std::vector<double> z;
    };

    const BodyAbove* above_;
    bool goes_on_ = false;  // a periodic surface under a body that does not repeat
    DifferenceRow differences_[kRows];
    const std::vector<Stencil>& stencils_;
    const Breaks* breaks_;
    RowPlace place_;
    int ny_;
    double y0_;
    Curvature curvature_;
    Patch patch_;
    std::vector<Start> starts_;
};

// Several starts may lead to the same summit: keeps a start that is a maximum, or else the nearest one; returns the number of maxima removed.
long drop_repeated(RefinedSummits& summits, int nx, int ny, bool periodic);

}  // namespace rsc
