// Products over some pixels of a periodic plane at a cost proportional to their number:
// convolutions with small stencils, and approximate products with K of PeriodicPixels for the inner
// steps of iterations.
#pragma once

#include "elements/periodic_pixels.hpp"
#include "interaction/kernel.hpp"

namespace rsc {

// Sorted pixels: those of row j have the columns column[rows[j]] ... column[rows[j + 1] - 1].
struct PixelSet {
    const std::vector<std::size_t>& rows;
    std::span<const std::int32_t> column;
};

// A function of the offset (a, b) with |a| <= reach and |b| <= rows, even in a and in b, without
// unit.
class PixelStencil {
public:
    PixelStencil() = default;
    // The function with the transform `mode`(kx, ky), kx and ky in (0, pi), multiplied by
    // `window`(a) window(b).
    PixelStencil(int reach, int rows, const std::function<double(double, double)>& mode,
                 const std::function<double(int)>& window);
    int reach() const { return reach_; }
    double transform(double k) const;  // at the wavenumber (k, 0)

private:
    friend class SparsePlane;
    int reach_ = 0, rows_ = 0;
    std::vector<float> taps_;  // of the offsets a, b >= 0
};

// The share of a substrate (PeriodicPixels), by the wavenumber times dx; empty for a homogeneous
// half-space.
std::function<double(double)> share_of_modes(const Substrate& substrate, double dx);
// The share of K with `diagonal` added on its diagonal, for PeriodicPixels with dx = 1.
std::function<double(double)> with_diagonal(const std::function<double(double)>& share,
                                            double diagonal);

// Preconditioner: K^-1 of PeriodicPixels with dx = 1, of modes |k|/2/(1 + share), between pixels at
// most six apart, along a single row 15; positive semidefinite. Pixels of a surface of one row,
// which is constant along y, have the aspect kEndless: its waves run along x.
inline constexpr double kEndless = 1e6;
PixelStencil inverse_stencil(double aspect, const std::function<double(double)>& share = {});

class SparsePlane {
public:
    static constexpr int kMostReach = 16;
    SparsePlane(int nx, int ny);
    // y = stencil * x for x on the pixels of the set and y on the same pixels. Results do not
    // depend on the number of threads. The memory is allocated by the first call.
    void convolve(const PixelStencil& stencil, const PixelSet& set, const float* x, float* y,
                  int threads);

private:
    static constexpr int kMargin = kMostReach + 8;
    static constexpr int kBand = 32;
    template <class F>
    void place(float* row, int j, const PixelSet& set, F&& value) const;

    int nx_, ny_;
    std::size_t stride_;
    // Some rows for each thread, zero between calls; margins repeat the columns of the other side.
    std::vector<std::vector<float>> bands_;
};

// K of PeriodicPixels with dx = 1, to 0.3 % of the largest product (2 % with an aspect of 1.2, 3 %
// with layers): the part of each mode with erfc(s k) is computed on a grid four times coarser with
// cubic B-splines, the rest, which decays as erfc(d/(2 s))/d, by a stencil (Ewald). Symmetric.
class SplitPixels {
public:
    using Share = std::function<double(double)>;  // as for PeriodicPixels
    // True if the grid has a coarser one and pixels that are nearly square, and long waves are not
    // much softer than short ones.
    static bool suits(int nx, int ny, double aspect, const Share& share = {});
    SplitPixels(int nx, int ny, double aspect, const Share& share = {});
    void multiply(SparsePlane& plane, const PixelSet& set, const Array<float>& x, Array<float>& Kx,
                  int threads);

private:
    void spread(const PixelSet& set, const Array<float>& x, int threads);
    void gather(const PixelSet& set, float uniform, Array<float>& Kx, int threads);

    int nx_, ny_;
    PeriodicPixels<float> coarse_;
    PixelStencil near_;
    Array<float> lines_;
};

}  // namespace rsc
