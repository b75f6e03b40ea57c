#include "physics/flow/openings.hpp"

#include "base/parallel.hpp"

namespace rsc {

// Rows are linked in bands that share no points, then the bands with each other.

Openings::Openings(const GapMap& map, const Linked& open)
    : node_(map.points()), winds_(map.points(), 0) {
    constexpr int kBand = 64;
    const auto nx = at(map.nx);
    const int bands = (map.ny + kBand - 1) / kBand;
    std::vector<std::uint8_t> winding(at(bands), 0);
    const auto link_above = [&](std::size_t k) -> std::uint8_t {
        const std::size_t above = map.above(k);
        return open(k, above) ? link(k, above, 0, above <= k ? 1 : 0) : 0;
    };
    parallel_for(bands, 1, 0, [&](int band) {
        const std::size_t first = at(band) * kBand * nx,
                          end = std::min(first + kBand * nx, node_.size());
        std::uint8_t& all = winding[at(band)];
        for (std::size_t k = first; k < end; ++k) node_[k].parent = std::uint32_t(k);
        for (std::size_t k = first; k < end; ++k) {
            const std::size_t right = map.right_of(k);
            if (open(k, right)) all |= link(k, right, right <= k ? 1 : 0, 0);
            if (k + nx < end) all |= link_above(k);
        }
    });
    for (const std::uint8_t ways : winding) all_ |= ways;
    for (const int band : indices(bands)) {
        const std::size_t end = std::min(at(band + 1) * kBand * nx, node_.size());
        for (std::size_t k = end - nx; k < end; ++k) all_ |= link_above(k);
    }
}

std::size_t Openings::root(std::size_t k) {
    // The first pass adds up the periods from k to the root, the second refers every point on the
    // way to the root directly.
    std::size_t top = k;
    std::int32_t x = 0, y = 0;
    while (node_[top].parent != top) {
        x += node_[top].x;
        y += node_[top].y;
        top = node_[top].parent;
    }
    while (node_[k].parent != top && k != top) {
        Node& node = node_[k];
        const std::size_t next = node.parent;
        const std::int32_t step_x = node.x, step_y = node.y;
        node = {std::uint32_t(top), x, y};
        x -= step_x;
        y -= step_y;
        k = next;
    }
    return top;
}

// The point l lies `period_x`, `period_y` periods beyond its place in the cell if it is reached
// from k.
std::uint8_t Openings::link(std::size_t k, std::size_t l, int period_x, int period_y) {
    const std::size_t a = root(k), b = root(l);
    const std::int32_t x = (a == k ? 0 : node_[k].x) + period_x - (b == l ? 0 : node_[l].x);
    const std::int32_t y = (a == k ? 0 : node_[k].y) + period_y - (b == l ? 0 : node_[l].y);
    const std::size_t into = std::min(a, b);
    if (a == b) {
        winds_[a] |= std::uint8_t((x != 0 ? 1 : 0) | (y != 0 ? 2 : 0));
    } else {
        const std::size_t from = std::max(a, b);
        const std::int32_t sign = from == b ? 1 : -1;
        node_[from] = {std::uint32_t(into), sign * x, sign * y};
        winds_[into] |= winds_[from];
    }
    return winds_[into];
}

}  // namespace rsc
