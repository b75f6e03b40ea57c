// The pixels of a map of heights, cut open far from the tip where the surface repeats.
#pragma once

#include "contact/indentation.hpp"
#include "contact/level.hpp"
#include "elements/pixel_products.hpp"
#include "surface/surface.hpp"

namespace rsc {

struct CutMap {
    // Column turn_x and row turn_y of the map, where a periodic surface is cut open, are the first
    // ones of the frame; otherwise 0.
    int turn_x = 0, turn_y = 0;
    HeightMap frame;  // number and sides of pixels and position of pixel (0, 0), without heights

    explicit CutMap(const HeightMap& heights);

    // Column, row and index of a pixel on the map.
    int column(int i) const { return i + turn_x < frame.nx ? i + turn_x : i + turn_x - frame.nx; }
    int row(int j) const { return j + turn_y < frame.ny ? j + turn_y : j + turn_y - frame.ny; }
    std::int32_t place(const Pixel& pixel) const {
        return static_cast<std::int32_t>(row(pixel.y) * frame.nx + column(pixel.x));
    }
    // Pixel of a point of the map.
    int pixel_x(int column) const {
        return column >= turn_x ? column - turn_x : column - turn_x + frame.nx;
    }
    int pixel_y(int row) const { return row >= turn_y ? row - turn_y : row - turn_y + frame.ny; }
    Pixel pixel_at(std::int32_t place) const {
        return {pixel_x(place % frame.nx), pixel_y(place / frame.nx)};
    }

    // Position of a pixel, next to the tip.
    double x(int i) const { return frame.x0 + i * frame.dx; }
    double y(int j) const { return frame.y0 + j * frame.dy; }

    // If the surface repeats around the tip (Indenter::around) and the tip lies in the outer
    // quarters, the map is cut open half a period away, at a multiple of `block` pixels.
    void cut_open(const Indenter& indenter, int block);
    // Numbers the contacts of a level by the index of their pixel on the map and sorts them.
    void number_by_map(Level& level) const;

private:
    double map_x0_, map_y0_;
};

}  // namespace rsc
