// Kernels of pixels: Love's solution for a rectangle, and the hot loops of pixel_tree.cpp.
#pragma once

#include "base/std.hpp"

namespace rsc {

// pi E* times the deflection at (x, y) under unit pressure on the rectangle |x| < a, |y| < b
// [length]. The four logarithms of Johnson's formula are combined to inverse hyperbolic sines to
// avoid cancellation.
double love(double x, double y, double a, double b);

// Approximation by the moments of the rectangle, 4ab [1/d + second + fourth order], with a relative
// error below (a/d)^6/20 for a >= b; for a square of side h it is h^2 [1/d + h^2/(24 d^3) + ...].
inline double love_far(double x, double y, double a, double b) {
    const double x2 = x * x, y2 = y * y, inverse2 = 1 / (x2 + y2), inverse = std::sqrt(inverse2);
    const double u = x2 * inverse2, v = y2 * inverse2;
    // With hx = 2a, hy = 2b: hx^2/24 d^2/dx^2 + hx^4/1920 d^4/dx^4 + hx^2 hy^2/576 d^4/dx^2dy^2 +
    // ... of 1/d.
    const double a2 = a * a * inverse2, b2 = b * b * inverse2;
    const double second = a2 * (2 * u - v) + b2 * (2 * v - u);
    const double fourth = (a2 * a2 * (24 * u * u - 72 * u * v + 9 * v * v) +
                           b2 * b2 * (24 * v * v - 72 * u * v + 9 * u * u)) /
                              120 +
                          a2 * b2 * (81 * u * v - 12 * u * u - 12 * v * v) / 36;
    return 4 * a * b * inverse * (1 + second / 6 + fourth);
}

// pi E* times the deflection for pixels of sides 1 and `aspect` at any offset: love() near, and
// love_far() where its relative error is below 1e-10.
inline double pixel_kernel(double x, double y, double aspect) {
    constexpr double far = 16;
    const double side = aspect > 1 ? aspect : 1;
    return x * x + y * y > far * far * side * side ? love_far(x, y, 0.5, 0.5 * aspect)
                                                   : love(x, y, 0.5, 0.5 * aspect);
}

// Inner loops of pixel_tree.cpp, compiled for several instruction sets; the best supported one is
// chosen at run time.

inline constexpr int kTileColumns = 8;  // pixels of a tile along x, one vector
inline constexpr int kLane = 8;         // doubles per vector

// A source pixel inside its tile.
struct TileSource {
    std::int16_t column, row;
    double value;
};

// sums[row*8 + column] += sum over sources of value K(column - source column - 8 ox, row - source
// row - rows oy), for a tile of
// `rows` rows and sources in the tile (ox, oy) tiles away. table[(dy + reach_y)*stride + dx +
// reach_x] = K(dx, dy).
struct NearTable {
    const double* values;
    int stride, reach_x, reach_y;
};
using NearTile = void (*)(const NearTable& table, int rows, int ox, int oy, std::size_t n,
                          const TileSource* sources, double* sums);

// to[k][i] += sum_j T(i, j) from[k][j], i < rows (a multiple of kLane), j < columns, for the pairs
// k < n. T is stored in slices of kSlice rows (the last one may be shorter), each by columns.
inline constexpr int kSlice = 2 * kLane;
using Translate = void (*)(int rows, int columns, const double* T, std::size_t n,
                           const double* const* from, double* const* to);

struct PixelKernels {
    NearTile near_tile;
    Translate translate;
};

const PixelKernels& pixel_kernels();

}  // namespace rsc
