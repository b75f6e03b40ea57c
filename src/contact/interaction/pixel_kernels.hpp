// The two hot loops of pixel_tree.cpp, compiled for several instruction sets; the best one the machine has is chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rsc {

inline constexpr int kTileColumns = 8;  // pixels of a tile along x: one vector
inline constexpr int kLane = 8;         // doubles of a vector

// A source pixel inside its tile.
struct TileSource {
    std::int16_t column, row;
    double value;
};

// sums[row*8 + column] += sum over sources of value K(column - source column - 8 ox, row - source row - rows oy), for a tile of
// `rows` rows and sources in the tile (ox, oy) tiles away. table[(dy + reach_y)*stride + dx + reach_x] = K(dx, dy).
struct NearTable {
    const double* values;
    int stride, reach_x, reach_y;
};
using NearTile = void (*)(const NearTable& table, int rows, int ox, int oy, std::size_t n, const TileSource* sources, double* sums);

// to[k][i] += sum_j T(i, j) from[k][j], i < rows (a multiple of kLane), j < columns, for the pairs k < n. T is stored in slices of
// kSlice rows (the last one may be shorter), each by columns.
inline constexpr int kSlice = 4 * kLane;
using Translate = void (*)(int rows, int columns, const double* T, std::size_t n, const double* const* from, double* const* to);

struct PixelKernels {
    NearTile near_tile;
    Translate translate;
};

const PixelKernels& pixel_kernels();

}  // namespace rsc
