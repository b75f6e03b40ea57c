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
    // `open(k, l)` tells whether the point k and its neighbour l, to the right or above, are
    // linked. Points without links are sets of their own.
    using Linked = std::function<bool(std::size_t, std::size_t)>;
    Openings(const GapMap& map, const Linked& open);

    // True if the set of this point winds around the cell along x, along y.
    bool winds_x(std::size_t k) { return (winds_[root(k)] & 1) != 0; }
    bool winds_y(std::size_t k) { return (winds_[root(k)] & 2) != 0; }
    bool winds(std::size_t k) { return winds_[root(k)] != 0; }
    bool any_winds_x() const { return (all_ & 1) != 0; }
    bool any_winds_y() const { return (all_ & 2) != 0; }

    // A point of the set, the same for all its points.
    std::size_t root(std::size_t k);

private:
    // Returns the ways in which the set winds, as winds_ has them.
    std::uint8_t link(std::size_t k, std::size_t l, int period_x, int period_y);

    // Each point refers to another one of its set, the root to itself, and knows in which period
    // relative to that one it lies.
    struct Node {
        std::uint32_t parent = 0;
        std::int32_t x = 0, y = 0;
    };
    std::vector<Node> node_;
    std::vector<std::uint8_t> winds_;  // of roots: 1 along x, 2 along y
    std::uint8_t all_ = 0;
};

}  // namespace rsc
