// Height maps, their moments, and maps on a finer grid.
#pragma once

#include "rough/spectrum.hpp"

namespace rsc {

// Aligned memory for n doubles, in huge pages where the system has them; throws Error(no_memory) with the purpose.
double* allocate_doubles(std::size_t n, const char* purpose);

// Heights on a regular rectangular grid: point (i, j) is at x = i dx, y = j dy (+ origin), value z(i, j) = data[j*stride + i].
// A point is a cell: the map covers nx*dx by ny*dy. stride >= nx leaves room for the padding of an in-place transform.
struct HeightMap {
    int nx = 0, ny = 0;
    std::ptrdiff_t stride = 0;
    double dx = 0, dy = 0;
    double x0 = 0, y0 = 0;  // coordinates of point (0, 0)
    bool periodic = false;  // synthetic surfaces wrap around, measured ones do not
    struct Free {
        void operator()(double* p) const noexcept;
    };
    std::unique_ptr<double[], Free> data;

    // Allocates (uninitialised, SIMD aligned); throws Error(no_memory) with the size asked for.
    void allocate(int nx_, int ny_, std::ptrdiff_t stride_);
    HeightMap copy() const;  // with rows next to each other
    double* row(int j) { return data.get() + j * stride; }
    const double* row(int j) const { return data.get() + j * stride; }
    double operator()(int i, int j) const { return row(j)[i]; }
    double Lx() const { return nx * dx; }
    double Ly() const { return ny * dy; }
};

enum class Normalise { sample, ensemble };
inline constexpr std::array kNormaliseNames = {"sample", "ensemble"};

// Moments from finite differences on the grid (m0 about the mean; m2, m4 isotropic averages): compared with the
// spectral ones they show how well the grid resolves lambda_s. First differences between neighbours give m20, m11, m02; second differences m40 ... m04.
// Of a map that is not periodic only differences inside it count; too small a map gives zeros. Points whose height is NaN are missing: the
// differences that need them are left out.
Moments grid_moments(const HeightMap& map);

// The map with twice as many points along each side, by its own cosine series (the map mirrored at its borders): the surface through
// the points that has no waves shorter than theirs. Every point, which is a cell, becomes four. A periodic map is taken to end at its
// borders, too. Throws Error(no_memory).
HeightMap twice_as_fine(const HeightMap& map);

}  // namespace rsc
