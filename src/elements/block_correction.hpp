// The far part of a preconditioner for pressures on some pixels of a periodic plane.
//
// A stencil M approximates K^-1 between pixels within its reach. Contacts farther apart interact
// through a smooth field, which is represented on square blocks of pixels: K = M^-1 + P F P', where
// P gives all pixels of a block the value of the block, and the modes of F are those of K less
// those of M^-1. Its inverse is (Woodbury)
//     K^-1 = M - M P (F^-1 + P' M P)^-1 P' M,
// where M P is approximated by diag(m) P with m = M 1, and P' M P by the sums of m over the blocks.
// The iterations then need about as many steps for many contacts as for one.
#pragma once

#include "elements/sparse_plane.hpp"

namespace rsc {

class BlockCorrection {
public:
    using Share = std::function<double(double)>;  // as for PeriodicPixels
    // `inverse` is M for K of PeriodicPixels with dx = 1. Planes that are too small, or cannot be
    // divided into blocks, get no correction.
    BlockCorrection(int nx, int ny, double aspect, const PixelStencil& inverse, const Share& share);
    bool exists() const { return far_ != nullptr; }

    // Sets m over the pixels of the set, which must outlive following calls; negative values count
    // as 0. `free` is 1 where a pixel is free and 0 elsewhere, where r is 0, too.
    void set(const PixelSet& set, std::span<const float> m, std::span<const float> free,
             int threads);
    // Subtracts M P (F^-1 + P' M P)^-1 P' M r from y over the free pixels, and something from the
    // others.
    void subtract(const PixelSet& set, const float* r, float* y, int threads);

private:
    std::vector<float> sums(const PixelSet& set, const float* r,
                            int threads) const;                          // of m r over the blocks
    void multiply(const std::vector<float>& x, std::vector<float>& Fx);  // Fx = D^1/2 F D^1/2 x

    int side_ = 0, mx_ = 0, my_ = 0;  // pixels along a side of a block; blocks
    std::unique_ptr<PeriodicPixels<float>> far_;
    std::span<const float> m_;
    float m(std::size_t k) const { return std::max(m_[k], 0.0f); }
    std::vector<float> root_;  // D^1/2, roots of the sums of m over the blocks
};

}  // namespace rsc
