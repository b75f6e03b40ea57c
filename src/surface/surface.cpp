#include "surface/surface.hpp"

#include "base/array.hpp"
#include "base/error.hpp"
#include "base/library_lock.hpp"
#include "base/parallel.hpp"

namespace rsc {
namespace {

// Mean over points of a map, without NaN. It adds up the sums of rows, because short partial sums
// keep rounding errors small.
class Mean {
public:
    void add(double value) {
        if (std::isnan(value)) return;
        row_ += value;
        ++row_points_;
    }
    void add_row(const Mean& row) {
        total_ += row.row_;
        points_ += row.row_points_;
    }
    double value() const { return points_ > 0 ? total_ / double(points_) : 0.0; }

private:
    double row_ = 0, total_ = 0;
    long row_points_ = 0, points_ = 0;
};

// `count` means over rows first ... end - 1, whose sums rows(j, sums) adds on several threads. They
// are added in the order of the rows.
template <std::size_t count, class Rows>
std::array<Mean, count> mean_of_rows(int first, int end, const Rows& rows) {
    constexpr int grain = 64;
    std::vector<std::array<Mean, count>> sums(at(end - first));
    parallel_for(end - first, grain, 0, [&](int k) {
        std::array<Mean, count> own;
        rows(first + k, own);
        sums[at(k)] = own;
    });
    std::array<Mean, count> means;
    for (const auto& row : sums)
        for (const auto m : indices(count)) means[m].add_row(row[m]);
    return means;
}

}  // namespace

double* allocate_doubles(std::size_t n, const char* purpose, bool zeros) {
    return allocate_numbers<double>(n, purpose, zeros);
}

void HeightMap::Free::operator()(double* p) const noexcept { std::free(p); }

void HeightMap::allocate(int nx_, int ny_, std::ptrdiff_t stride_, bool zeros) {
    if (nx_ < 1 || ny_ < 1 || stride_ < nx_)
        bad_input("height map: " + std::to_string(nx_) + " x " + std::to_string(ny_) +
                  " points with " + std::to_string(stride_) + " a row");
    if (stride_ > (std::ptrdiff_t{1} << 44) / ny_)
        throw Error(Failure::no_memory, "no memory for a height map of " + std::to_string(nx_) +
                                            " x " + std::to_string(ny_) + " points");
    data.reset(allocate_doubles(at(stride_) * at(ny_), "a height map", zeros));
    nx = nx_;
    ny = ny_;
    stride = stride_;
}

HeightMap HeightMap::copy() const {
    HeightMap made;
    made.allocate(nx, ny, nx);
    static_cast<PointGrid&>(made) = *this;
    made.periodic = periodic;
    for (const int j : indices(ny))
        for (const int i : indices(nx)) made.row(j)[i] = (*this)(i, j);
    return made;
}

Moments grid_moments(const HeightMap& map) {
    Moments m;
    if (map.nx < 1 || map.ny < 1) return m;
    const auto level = mean_of_rows<1>(0, map.ny, [&](int j, auto& sums) {
        for (const int i : indices(map.nx)) sums[0].add(map(i, j));
    });
    const auto m0 = mean_of_rows<1>(0, map.ny, [&, mean = level[0].value()](int j, auto& sums) {
        for (const int i : indices(map.nx)) sums[0].add((map(i, j) - mean) * (map(i, j) - mean));
    });
    m.m0 = m0[0].value();
    const bool profile = map.ny == 1;  // constant along y
    if (map.nx < 3 || (map.ny < 3 && !profile)) return m;

    const int edge = map.periodic ? 0 : 1, edge_y = profile ? 0 : edge;
    const auto means = mean_of_rows<8>(edge_y, map.ny - edge_y, [&](int j, auto& sums) {
        auto& [g2, m20, m11, m40, m31, m22, m13, m04] = sums;
        const double* const below = map.row(j > 0 ? j - 1 : map.ny - 1);
        const double* const z = map.row(j);
        const double* const above = map.row(j + 1 < map.ny ? j + 1 : 0);
        for (int i = edge; i < map.nx - edge; ++i) {
            const int l = i > 0 ? i - 1 : map.nx - 1, r = i + 1 < map.nx ? i + 1 : 0;
            const double zx = (z[r] - z[i]) / map.dx, zy = (above[i] - z[i]) / map.dy;
            const double zxx = (z[l] - 2.0 * z[i] + z[r]) / (map.dx * map.dx);
            const double zyy = (below[i] - 2.0 * z[i] + above[i]) / (map.dy * map.dy);
            const double zxy = (above[r] - above[i] - z[r] + z[i]) / (map.dx * map.dy);
            g2.add(zx * zx + zy * zy);
            m20.add(zx * zx);
            m11.add(zx * zy);
            m31.add(zxx * zxy);
            m13.add(zyy * zxy);
            m40.add(zxx * zxx);
            m04.add(zyy * zyy);
            m22.add(zxy * zxy);
        }
    });
    const auto& [g2, m20, m11, m40, m31, m22, m13, m04] = means;
    m.tensor = {m20.value(), m11.value(), g2.value() - m20.value(),
                m40.value(), m31.value(), m22.value(),
                m13.value(), m04.value()};
    m.m2 = g2.value() / 2.0;
    m.m4 = (m40.value() + m04.value() + 3.0 * m22.value()) / 3.0;
    return m;
}

}  // namespace rsc
