// Plastic residual: permanent lowering of points of a surface (boundary elements).
#pragma once

#include "rough/surface.hpp"

namespace rsc {

// Depths [length] on a map of nx x ny points, stored sparsely in square blocks, because few points of a rough surface yield.
class PressedOut {
public:
    PressedOut(int nx, int ny);

    double operator()(int i, int j) const {  // 0 for points without a residual
        const auto& square = squares_[square_of(i, j)];
        return square ? square[place_of(i, j)] : 0.0;
    }
    void add(int i, int j, double depth);

    bool none() const { return sum_ == 0; }
    double sum() const { return sum_; }  // sum of all depths

    struct Point {
        int i, j;
        double depth;
    };
    std::vector<Point> points() const;  // points with a nonzero depth, row by row

private:
    static constexpr int kSide = 16;
    std::size_t square_of(int i, int j) const {
        return static_cast<std::size_t>(j / kSide) * across_ + static_cast<std::size_t>(i / kSide);
    }
    static std::size_t place_of(int i, int j) { return static_cast<std::size_t>(j % kSide * kSide + i % kSide); }

    int nx_, ny_;
    std::size_t across_;
    std::vector<std::unique_ptr<double[]>> squares_;
    double sum_ = 0;
};

// Constructs it from triples of column, row and depth. Throws Error(bad_input) if they do not lie on the map.
PressedOut pressed_out_of(const HeightMap& map, const std::vector<double>& triples);

}  // namespace rsc
