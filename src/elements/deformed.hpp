// The deformed surface of a level at points of a map: deflections by its pressures, and the gap.
#pragma once

#include "base/array.hpp"
#include "contact/level.hpp"
#include "surface/surface.hpp"

namespace rsc {

// What a point carries.
struct Load {
    double pressure = 0;  // [force/length^2]
    bool touches = false;
};
// By the index of the point, row * nx + column, in its order.
using Pressures = std::vector<std::pair<std::int64_t, Load>>;

// Columns and rows first .. last.
struct PointRange {
    int first, last;
    int size() const { return last - first + 1; }
};

// A part of a map.
struct PointWindow {
    PointRange columns, rows;
    int nx;  // columns of the map

    std::size_t points() const { return at(columns.size()) * at(rows.size()); }
    std::size_t index(int i, int j) const {
        return at(j - rows.first) * at(columns.size()) + at(i - columns.first);
    }
    // Of a point of the map by its index there; nothing outside.
    std::optional<std::size_t> find(std::int64_t point) const {
        const int i = static_cast<int>(point % nx), j = static_cast<int>(point / nx);
        if (i < columns.first || i > columns.last || j < rows.first || j > rows.last) return {};
        return index(i, j);
    }
};

// The pressures of boundary elements, and their attraction.
Pressures pressures_of(const LevelPixels& pixels);

// Deflections by the pressures at the points of a window, row by row [length].
Array<double> deflections(const HeightMap& map, const Indenter& indenter,
                          const Pressures& pressures, const PointWindow& window);

// Gap between the indenter at a separation and the heights less their deflection, at the points of
// a window [length]: 0 where `touches`, and not below; NaN outside a map of the indenter.
Array<double> gaps(const HeightMap& heights, const Indenter& indenter, double separation,
                   const std::vector<char>& touches, const PointWindow& window,
                   Array<double> deflection);

// The map without what was permanently lowered.
HeightMap lowered_map(const HeightMap& map, const ResidualProfile& lowered);

}  // namespace rsc
