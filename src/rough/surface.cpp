#include "rough/surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "error.hpp"
#include "rough/synthesis.hpp"

namespace rsc {
namespace {

// A sum over the rows of a map of sums over a row: short partial sums lose little to rounding.
template <class RowSum>
double sum_rows(int first, int last, RowSum row_sum) {
    double total = 0;
    for (int j = first; j < last; ++j) total += row_sum(j);
    return total;
}

double mean(const HeightMap& map) {
    const double total = sum_rows(0, map.ny, [&](int j) {
        const double* const z = map.row(j);
        double s = 0;
        for (int i = 0; i < map.nx; ++i) s += z[i];
        return s;
    });
    return total / (static_cast<double>(map.nx) * map.ny);
}

}  // namespace

void HeightMap::Free::operator()(double* p) const noexcept { std::free(p); }

void HeightMap::allocate(int nx_, int ny_, std::ptrdiff_t stride_) {
    if (nx_ < 1 || ny_ < 1 || stride_ < nx_)
        throw Error(Failure::bad_input, "height map: " + std::to_string(nx_) + " x " + std::to_string(ny_) + " points with " +
                                            std::to_string(stride_) + " a row");
    if (stride_ > (std::ptrdiff_t{1} << 44) / ny_)
        throw Error(Failure::no_memory, "no memory for a height map of " + std::to_string(nx_) + " x " + std::to_string(ny_) + " points");
    data.reset(allocate_doubles(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(ny_), "a height map"));
    nx = nx_;
    ny = ny_;
    stride = stride_;
}

HeightMap synthesize(const Spectrum& spectrum, int n, Normalise normalise, std::int64_t seed, std::int64_t realization, Moments* sampled,
                     int threads) {
    threads = std::max(threads, 1);
    const RowSource source(spectrum, n, normalise, seed, realization, threads);
    HeightMap map;
    map.allocate(n, n, (n + 7) / 8 * 8 + 8);  // rows aligned to 64 bytes, and not a power of two apart
    map.dx = map.dy = spectrum.L / n;
    map.periodic = true;
    std::vector<RowSource::Scratch> scratch;
    for (int t = 0; t < threads; ++t) scratch.emplace_back(source);
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int t = 0; t < threads; ++t) {
        const auto bound = [&](int k) { return static_cast<int>(static_cast<std::int64_t>(n) * k / threads); };
        const int first = bound(t), last = bound(t + 1);
        if (first < last) source.rows(first, last - first, map.row(first), map.stride, scratch[static_cast<std::size_t>(t)]);
    }
    if (sampled) *sampled = source.sampled();
    return map;
}

Moments grid_moments(const HeightMap& map) {
    Moments m;
    if (map.nx < 1 || map.ny < 1) return m;
    const double level = mean(map);
    m.m0 = sum_rows(0, map.ny,
                    [&](int j) {
                        const double* const z = map.row(j);
                        double s = 0;
                        for (int i = 0; i < map.nx; ++i) s += (z[i] - level) * (z[i] - level);
                        return s;
                    }) /
           (static_cast<double>(map.nx) * map.ny);
    if (map.nx < 3 || map.ny < 3) return m;

    const int edge = map.periodic ? 0 : 1;
    double g2 = 0, m40 = 0, m04 = 0, m22 = 0;
    for (int j = edge; j < map.ny - edge; ++j) {
        const double* const below = map.row(j > 0 ? j - 1 : map.ny - 1);
        const double* const z = map.row(j);
        const double* const above = map.row(j + 1 < map.ny ? j + 1 : 0);
        double row_g2 = 0, row_40 = 0, row_04 = 0, row_22 = 0;
        for (int i = edge; i < map.nx - edge; ++i) {
            const int l = i > 0 ? i - 1 : map.nx - 1, r = i + 1 < map.nx ? i + 1 : 0;
            const double zx = (z[r] - z[i]) / map.dx, zy = (above[i] - z[i]) / map.dy;
            const double zxx = (z[l] - 2.0 * z[i] + z[r]) / (map.dx * map.dx);
            const double zyy = (below[i] - 2.0 * z[i] + above[i]) / (map.dy * map.dy);
            const double zxy = (above[r] - above[i] - z[r] + z[i]) / (map.dx * map.dy);
            row_g2 += zx * zx + zy * zy;
            row_40 += zxx * zxx;
            row_04 += zyy * zyy;
            row_22 += zxy * zxy;
        }
        g2 += row_g2, m40 += row_40, m04 += row_04, m22 += row_22;
    }
    const double points = static_cast<double>(map.nx - 2 * edge) * (map.ny - 2 * edge);
    m.m2 = g2 / (2.0 * points);
    m.m4 = (m40 + m04 + 3.0 * m22) / (3.0 * points);
    return m;
}

double detrend(HeightMap& map, Detrend how) {
    double level = 0, slope_x = 0, slope_y = 0;  // slopes a grid step
    const double mid_x = 0.5 * (map.nx - 1), mid_y = 0.5 * (map.ny - 1);
    double remaining = 0;  // the mean that stays
    (how == Detrend::none ? remaining : level) = mean(map);
    if (how == Detrend::plane) {
        // Measured from the middle of a full grid, 1, x and y are orthogonal: the least-squares plane is three projections.
        double zx = 0, zy = 0;
        for (int j = 0; j < map.ny; ++j) {
            const double* const z = map.row(j);
            double row = 0, row_x = 0;
            for (int i = 0; i < map.nx; ++i) {
                row += z[i] - level;
                row_x += (z[i] - level) * (i - mid_x);
            }
            zx += row_x;
            zy += row * (j - mid_y);
        }
        // sum of (i - mid)^2 over i = 0 ... n-1 is n (n^2 - 1)/12.
        const auto second = [](double n) { return n * (n * n - 1.0) / 12.0; };
        if (map.nx > 1) slope_x = zx / (second(map.nx) * map.ny);
        if (map.ny > 1) slope_y = zy / (second(map.ny) * map.nx);
    }
    const double total = sum_rows(0, map.ny, [&](int j) {
        double* const z = map.row(j);
        double s = 0;
        for (int i = 0; i < map.nx; ++i) {
            z[i] -= level + slope_x * (i - mid_x) + slope_y * (j - mid_y);
            s += (z[i] - remaining) * (z[i] - remaining);
        }
        return s;
    });
    return std::sqrt(total / (static_cast<double>(map.nx) * map.ny));
}

}  // namespace rsc
