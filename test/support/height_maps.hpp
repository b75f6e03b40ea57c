// Height maps of formulas.
#pragma once

#include "check.hpp"
#include "surface/surface.hpp"

// nx x ny points in steps of dx, dy from (0, 0) on, with the height z(column, row). Rows have
// padding, to detect a confusion of width and stride.
template <class Height>
rsc::HeightMap height_map(int nx, int ny, double dx, double dy, Height&& z) {
    rsc::HeightMap map;
    map.allocate(nx, ny, nx + 3);
    map.dx = dx;
    map.dy = dy;
    for (const int j : indices(ny))
        for (const int i : indices(nx)) map.row(j)[i] = z(i, j);
    return map;
}
// The same as the rows of a text file, without a unit or a spacing.
template <class Height>
std::string rows_of_text(int nx, int ny, Height&& z) {
    std::ostringstream text;
    text.precision(17);
    for (int j = 0; j < ny; ++j, text << '\n')
        for (const int i : indices(nx)) text << ' ' << z(i, j);
    return text.str();
}
inline rsc::HeightMap flat_map(int nx, int ny, double dx, double dy) {
    return height_map(nx, ny, dx, dy, [](int, int) { return 0.0; });
}
