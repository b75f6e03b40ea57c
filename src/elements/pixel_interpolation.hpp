// Interpolation between pixels and Chebyshev points of boxes, and transfers between the points of
// boxes, for pixel_tree.cpp.
#pragma once

#include "interaction/kernel.hpp"
#include "interaction/pixel_kernels.hpp"

namespace rsc {

inline constexpr int kOffsets = 49;   // offsets between boxes: -3 ... 3 in both directions
inline constexpr int kMostRows = 64;  // of a tile

// Deflection at an offset from a pixel under unit pressure, with offsets in units of the pixel's
// first side.
struct PixelAnswer {
    Substrate substrate;
    double dx, dy, shift;
    double operator()(double x, double y) const {
        return substrate.under_pixel(x * dx, y * dx, dx, dy) + dx * dy * shift;
    }
};

// Tables for q x q points a box, for all sets of pixels, in tiles of kTileColumns columns and a
// given number of rows.
class Interpolation {
public:
    // As many points as give the relative error.
    Interpolation(double error, int rows, const PixelAnswer& answer);

    int points() const { return q_; }
    int padded() const {
        return padded_;
    }                      // numbers of a box: its points, and 0 up to a multiple of kLane
    double error() const;  // measured in test_pixels.cpp

    // Adds to the points of a tile what the pressures on its pixels are there, or the points of a
    // box in a quarter of another (0 or 1: the lower or upper half): point[j*q + i] += sum
    // rows_of(r, j) columns_of(c, i) value.
    void up_from_tile(std::size_t n, const TileSource* sources, double* point) const;
    void up(int half_x, int half_y, const double* child, double* parent) const;
    // The transposed, from points to the pixels of a tile, or to the points of a quarter.
    void down_to_tile(const double* point, double* values) const;
    void down(int half_x, int half_y, const double* parent, double* child) const;

    // Transfer matrices of a generation by offset of the source box, created on first use.
    const std::vector<std::vector<double>>& matrices(std::size_t generation) {
        while (matrices_.size() <= generation) make_matrices();
        return matrices_[generation];
    }

private:
    void make_matrices();

    int q_, rows_, padded_ = 0;
    double aspect_;
    const PixelAnswer& answer_;
    std::vector<double> point_;                 // Chebyshev points
    std::vector<double> columns_of_, rows_of_;  // weights of a tile's columns and rows, by pixel
    std::vector<double> columns_at_, rows_at_;  // and by point
    std::vector<double> child_[2],
        child_at_[2];  // weights of the points of the lower and upper half
    std::vector<std::vector<std::vector<double>>> matrices_;
};

}  // namespace rsc
