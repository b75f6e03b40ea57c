// Height maps, their moments, and maps on a coarser grid.
#pragma once

#include "surface/spectrum.hpp"

namespace rsc {

// Allocates aligned memory for n doubles, in huge pages if available. Throws Error(no_memory) with
// the purpose.
// `zeros`: set to 0, in small pages that take memory only when they are written.
double* allocate_doubles(std::size_t n, const char* purpose, bool zeros = false);

// A regular rectangular grid. Every point represents a cell: the grid covers nx*dx by ny*dy.
struct PointGrid {
    int nx = 0, ny = 0;
    double dx = 0, dy = 0;
    double x0 = 0, y0 = 0;  // coordinates of point (0, 0)
    double x(int i) const { return x0 + i * dx; }
    double y(int j) const { return y0 + j * dy; }
    // The longer step; a surface of one row is constant along y, whatever its side.
    double step() const { return ny > 1 ? std::max(dx, dy) : dx; }
    double Lx() const { return nx * dx; }
    double Ly() const { return ny * dy; }
    std::size_t points() const { return at(nx) * at(ny); }
    // Number of point (i, j), row by row.
    std::size_t index(int i, int j) const { return at(j) * at(nx) + at(i); }
};

// The index of a point on a periodic line of n points.
constexpr int wrapped(int i, int n) { return (i % n + n) % n; }
// The same on a line that repeats or, otherwise, beyond whose ends the points are mirrored.
constexpr int continued(int i, int n, bool repeats) {
    return repeats ? wrapped(i, n) : std::clamp(i < 0 ? -i : i < n ? i : 2 * n - 2 - i, 0, n - 1);
}

// Heights on a grid, z(i, j) = data[j*stride + i]. stride >= nx allows for the padding of in-place
// transforms.
struct HeightMap : PointGrid {
    std::ptrdiff_t stride = 0;
    bool periodic = false;  // true for synthetic surfaces, false for measured ones
    struct Free {
        void operator()(double* p) const noexcept;
    };
    std::unique_ptr<double[], Free> data;

    // Allocates (uninitialised, SIMD aligned); throws Error(no_memory) with the requested size.
    // `zeros`: heights are 0, and pages take memory only when they are written.
    void allocate(int nx_, int ny_, std::ptrdiff_t stride_, bool zeros = false);
    HeightMap copy() const;  // without padding between rows
    double* row(int j) { return data.get() + j * stride; }
    const double* row(int j) const { return data.get() + j * stride; }
    double operator()(int i, int j) const { return row(j)[i]; }
};

// Mean of value(z, i, j) over the points of a map that are not missing (NaN), summed row by row,
// because short partial sums keep rounding errors small; NaN if there are none.
template <class Value>
double mean_present(const HeightMap& map, Value value) {
    double total = 0, points = 0;
    for (const int j : indices(map.ny)) {
        double row = 0;
        for (const int i : indices(map.nx))
            if (const double z = map(i, j); !std::isnan(z)) {
                row += value(z, i, j);
                ++points;
            }
        total += row;
    }
    return total / points;
}
inline double mean_height(const HeightMap& map) {
    return mean_present(map, [](double z, int, int) { return z; });
}

enum class Normalise { sample, ensemble };
inline constexpr std::array kNormaliseNames = {"sample", "ensemble"};

// Moments from finite differences on the grid (m0 about the mean; m2, m4 isotropic averages): a
// comparison with the spectral moments shows how well the grid resolves lambda_s. m20, m11, m02
// follow from first differences, m40 to m04 from second differences. If the map is not periodic,
// only differences inside it are used; all moments of a too small map are zero. Differences that
// contain missing points (NaN) are left out.
Moments grid_moments(const HeightMap& map);

}  // namespace rsc
