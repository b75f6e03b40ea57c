// Connected openings of the gap between two flats, and whether they wind around the periodic cell.
#pragma once

#include "base/std.hpp"

namespace rsc {

// Gap at the points of a periodic cell, row by row [length]; 0: closed. The numbers must outlive
// their users.
struct GapMap {
    int nx = 0, ny = 0;
    double dx = 0, dy = 0;  // sides of a pixel [length]
    std::span<const double> gap;

    std::size_t points() const { return at(nx) * at(ny); }
    std::size_t right_of(std::size_t k) const {
        const auto n = at(nx);
        return k % n + 1 == n ? k + 1 - n : k + 1;
    }
    std::size_t above(std::size_t k) const {
        const auto n = at(nx);
        return k + n < points() ? k + n : k + n - points();
    }
};

// Sets of points connected by links between neighbours along x and y. A set winds around the cell
// if a closed path in it ends in another period than it begins; then fluid can cross any number of
// periods.
class Openings {
public:
    // `linked(k, l)` tells whether the open point k and its neighbour l, to the right or above, are
    // linked; closed points never are.
    template <class Linked>
    Openings(const GapMap& map, const Linked& linked);

    // True if the set of this point winds around the cell along x, along y.
    bool winds_x(std::size_t k) { return (ways(k) & 1) != 0; }
    bool winds_y(std::size_t k) { return (ways(k) & 2) != 0; }
    bool winds(std::size_t k) { return ways(k) != 0; }
    bool any_winds_x() const { return (all_ & 1) != 0; }
    bool any_winds_y() const { return (all_ & 2) != 0; }

    // A point of the set, the same for all its points.
    std::size_t root(std::size_t k);

private:
    // Points of a row linked one after the other, first ... end - 1. Each run refers to another one
    // of its set, the root to itself, and has its period relative to that one's.
    struct Run {
        std::uint32_t first = 0, end = 0, parent = 0;
        std::int32_t x = 0, y = 0;
        std::uint8_t winds = 0;  // of roots: 1 along x, 2 along y
    };
    template <class Linked>
    void find_runs(const GapMap& map, std::size_t j, const Linked& linked);
    template <class Linked>
    void link_rows(std::size_t below, std::size_t above, int period, const Linked& linked);
    void link(std::size_t r, std::size_t s, int period_x, int period_y);
    std::size_t root_of_run(std::size_t r);
    std::optional<std::size_t> run_of(std::size_t k) const;
    std::uint8_t ways(std::size_t k);

    std::size_t nx_;
    std::vector<Run> run_;
    std::vector<std::size_t> rows_ = {0};  // where the runs of each row begin
    std::uint8_t all_ = 0;
};

template <class Linked>
Openings::Openings(const GapMap& map, const Linked& linked) : nx_(at(map.nx)) {
    for (const auto j : indices(at(map.ny))) {
        find_runs(map, j, linked);
        if (j > 0) link_rows(j - 1, j, 0, linked);
    }
    link_rows(at(map.ny) - 1, 0, 1, linked);
}

template <class Linked>
void Openings::find_runs(const GapMap& map, std::size_t j, const Linked& linked) {
    const std::size_t begin = j * nx_, end = begin + nx_;
    for (std::size_t k = begin; k < end; ++k) {
        if (!(map.gap[k] > 0)) continue;
        const std::size_t first = k;
        while (k + 1 < end && linked(k, k + 1)) ++k;
        run_.push_back({std::uint32_t(first), std::uint32_t(k + 1), std::uint32_t(run_.size())});
    }
    rows_.push_back(run_.size());
    if (rows_[j] == run_.size()) return;
    const bool meet = run_[rows_[j]].first == begin && run_.back().end == end;
    if (meet && linked(end - 1, begin)) link(run_.size() - 1, rows_[j], 1, 0);
}

// The row above lies `period` periods beyond its place in the cell.
template <class Linked>
void Openings::link_rows(std::size_t below, std::size_t above, int period, const Linked& linked) {
    const std::size_t from = below * nx_, to = above * nx_;
    std::size_t r = rows_[below], s = rows_[above];
    while (r < rows_[below + 1] && s < rows_[above + 1]) {
        const std::size_t r_end = run_[r].end - from, s_end = run_[s].end - to,
                          end = std::min(r_end, s_end);
        std::size_t i = std::max(run_[r].first - from, run_[s].first - to);
        while (i < end && !linked(from + i, to + i)) ++i;
        if (i < end) link(r, s, 0, period);
        (r_end <= s_end ? r : s) += 1;
    }
}

}  // namespace rsc
