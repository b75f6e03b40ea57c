#include "interaction/pixel_kernels.hpp"

#include "base/dispatch.hpp"

namespace rsc {
namespace {

// d^2/ds dt of corner() is 1/sqrt(s^2 + t^2), so that the integral over a rectangle is an
// alternating sum over its corners.
double corner(double s, double t) {
    double sum = 0;
    if (t != 0) sum += t * std::asinh(s / std::abs(t));
    if (s != 0) sum += s * std::asinh(t / std::abs(s));
    return sum;
}

}  // namespace

double love(double x, double y, double a, double b) {
    return corner(x + a, y + b) - corner(x + a, y - b) - corner(x - a, y + b) +
           corner(x - a, y - b);
}

namespace {

// Processes `Rows` rows at a time, with their sums in registers.
template <class L, int Rows>
RSC_ALWAYS_INLINE void near_rows(const NearTable& t, const double* corner, std::size_t n,
                                 const TileSource* sources, double* sums) {
    constexpr int parts = kTileColumns / L::kCount;
    typename L::Vector sum[Rows][parts];
    for (int r = 0; r < Rows; ++r)
        for (int v = 0; v < parts; ++v)
            sum[r][v] = L::at(sums + r * kTileColumns + v * L::kCount).v;
    for (std::size_t k = 0; k < n; ++k) {
        const double* row = corner - sources[k].row * t.stride - sources[k].column;
        const double value = sources[k].value;
        for (int r = 0; r < Rows; ++r)
            for (int v = 0; v < parts; ++v)
                sum[r][v] += value * L::at(row + r * t.stride + v * L::kCount).v;
    }
    for (int r = 0; r < Rows; ++r)
        for (int v = 0; v < parts; ++v)
            L::at(sums + r * kTileColumns + v * L::kCount).v = sum[r][v];
}

template <class L, int Rows>
RSC_ALWAYS_INLINE void near_tile(const NearTable& t, int rows, int ox, int oy, std::size_t n,
                                 const TileSource* sources, double* sums) {
    const double* corner =
        t.values + (t.reach_y - rows * oy) * t.stride + t.reach_x - kTileColumns * ox;
    int r = 0;
    for (; r + Rows <= rows; r += Rows)
        near_rows<L, Rows>(t, corner + r * t.stride, n, sources, sums + r * kTileColumns);
    for (; r < rows; ++r)
        near_rows<L, 1>(t, corner + r * t.stride, n, sources, sums + r * kTileColumns);
}

template <class L, int Vectors, int Pairs>
RSC_ALWAYS_INLINE void slice(int columns, const double* T, const double* const* from,
                             double* const* to, int first) {
    typename L::Vector sum[Pairs][Vectors];
    const double* source[Pairs];
    for (int k = 0; k < Pairs; ++k) {
        source[k] = from[k];
        for (int v = 0; v < Vectors; ++v) sum[k][v] = L::at(to[k] + first + v * L::kCount).v;
    }
    for (int j = 0; j < columns; ++j, T += Vectors * L::kCount)
        for (int v = 0; v < Vectors; ++v) {
            const typename L::Vector part = L::at(T + v * L::kCount).v;
            for (int k = 0; k < Pairs; ++k) sum[k][v] += source[k][j] * part;
        }
    for (int k = 0; k < Pairs; ++k)
        for (int v = 0; v < Vectors; ++v) L::at(to[k] + first + v * L::kCount).v = sum[k][v];
}

template <class L, int Pairs>
RSC_ALWAYS_INLINE void all_slices(int rows, int columns, const double* T, const double* const* from,
                                  double* const* to) {
    for (int first = 0; first < rows; first += kSlice) {
        const int wide = std::min(rows - first, kSlice);
        if (wide == kSlice)
            slice<L, kSlice / L::kCount, Pairs>(columns, T, from, to, first);
        else
            slice<L, kLane / L::kCount, Pairs>(columns, T, from, to, first);
        T += wide * columns;
    }
}

// The order of summation for a pair does not depend on the number of pairs processed together.
template <class L, int Pairs>
RSC_ALWAYS_INLINE void translate(int rows, int columns, const double* T, std::size_t n,
                                 const double* const* from, double* const* to) {
    std::size_t k = 0;
    for (; k + Pairs <= n; k += Pairs) all_slices<L, Pairs>(rows, columns, T, from + k, to + k);
    for (; k < n; ++k) all_slices<L, 1>(rows, columns, T, from + k, to + k);
}

#define RSC_PIXEL_KERNELS(name, attribute, bytes, near_count, pair_count)                        \
    attribute void near_tile_##name(const NearTable& t, int rows, int ox, int oy, std::size_t n, \
                                    const TileSource* s, double* sums) {                         \
        near_tile<Unaligned<double, (bytes) / 8>, near_count>(t, rows, ox, oy, n, s, sums);      \
    }                                                                                            \
    attribute void translate_##name(int rows, int columns, const double* T, std::size_t n,       \
                                    const double* const* from, double* const* to) {              \
        translate<Unaligned<double, (bytes) / 8>, pair_count>(rows, columns, T, n, from, to);    \
    }                                                                                            \
    constexpr PixelKernels kernels_##name = {near_tile_##name, translate_##name};

RSC_PIXEL_KERNELS(baseline, , 16, 2, 1)
#if defined(__x86_64__) && defined(__GNUC__)
RSC_PIXEL_KERNELS(avx2, [[gnu::target("avx2,fma")]], 32, 4, 3)
RSC_PIXEL_KERNELS(avx512, [[gnu::target("avx512f,avx512dq,avx512vl,avx2,fma")]], 64, 8, 8)
#endif

}  // namespace

const PixelKernels& pixel_kernels() {
#if defined(__x86_64__) && defined(__GNUC__)
    if (instruction_set() == InstructionSet::avx512) return kernels_avx512;
    if (instruction_set() == InstructionSet::avx2) return kernels_avx2;
#endif
    return kernels_baseline;
}

}  // namespace rsc
