// Preconditioner of the conjugate gradients of boundary elements: inverse of K on every contact
// spot.
#pragma once

#include "elements/pixel_products.hpp"

namespace rsc {

// Finds sets of pixels connected by sides, for pixels sorted by row (y, then x). label[k] is the
// set of pixel k, numbered from 0 in the order of their first pixels. Returns the number of sets.
// With a period (columns, rows; 0: none) sets are joined across the edges.
int connected_sets(const std::vector<Pixel>& pixels, std::vector<int>& label, int period_x = 0,
                   int period_y = 0);

// Number of sides of each pixel without a neighbour, for pixels and a period as above.
std::vector<int> open_sides(const std::vector<Pixel>& pixels, int period_x, int period_y);

// Block Jacobi preconditioner: the inverse of K, to which a number may be added on the diagonal, on
// each connected set of pixels; sets of more than
// kMostPixels are divided along a lattice of squares. Blocks of equal shape share their inverse,
// also with earlier sets.
class SpotBlocks {
public:
    // Sets the pixels, row by row as for connected_sets(): those of `all` at the positions `which`.
    void assign(const std::vector<Pixel>& all, const std::vector<int>& which,
                const PixelProducts& products, double diagonal = 0);
    // z = M^-1 r over these pixels, at their positions in `all`; z is unchanged at others.
    void apply(const std::vector<double>& r, std::vector<double>& z) const;

    static constexpr int kMostPixels = 100;
    static constexpr int kSquare = 10;

private:
    using Shape = std::vector<Pixel>;  // relative to its first pixel
    struct Inverse {
        Shape shape;
        std::vector<float> values;
        bool wanted = true;
    };
    struct Block {
        std::size_t begin;
        const Inverse* inverse;
    };
    int threads() const { return members_.size() > 2000 ? 0 : 1; }
    std::unordered_map<std::uint64_t, Inverse> known_;  // by the numbers of their shapes
    double diagonal_ = 0;                               // of these
    std::vector<Block> blocks_;
    std::vector<int> members_;  // positions in `all` of the pixels of the blocks
};

}  // namespace rsc
