// The rms height that a contact of a map given through rsc.h goes by; copies of a map.
#include "check.hpp"
#include "unit/library.hpp"

namespace {

constexpr double kPi = std::numbers::pi, kInfinity = std::numeric_limits<double>::infinity();
using Values = std::vector<double>;

// A map of nx by ny points from (x0, y0) on.
struct Map {
    int nx = 24, ny = 15;
    double dx = 0.125, dy = 0.1875, x0 = -0.75, y0 = 2.0;
    double x(int i) const { return x0 + i * dx; }
    double y(int j) const { return y0 + j * dy; }
    std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
    template <class Height>
    Values heights(Height&& z) const {
        Values all;
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) all.push_back(z(i, j));
        return all;
    }
    SurfaceHandle take(const Values& z, bool periodic = false) const {
        SurfaceHandle surface;
        OK(rsc_surface_take(&surface, nx, ny, dx, dy, x0, y0, periodic ? 1 : 0, z.data()));
        return surface;
    }
    Values heights_of(const rsc_surface* surface) const {
        Values z(size());
        OK(rsc_surface_heights(surface, nx * ny, z.data()));
        return z;
    }
};

double rms(const Values& z) {
    double mean = 0, square = 0;
    for (const double v : z) mean += v / static_cast<double>(z.size());
    for (const double v : z) square += (v - mean) * (v - mean) / static_cast<double>(z.size());
    return std::sqrt(square);
}

// A copy lies where its original lies, and has the same heights.
TEST(copy_of_a_surface) {
    const Map map;
    const Values z = map.heights([&](int i, int j) { return map.x(i) * map.y(j); });
    const SurfaceHandle surface = map.take(z);
    SurfaceHandle copy;
    OK(rsc_surface_copy(&copy, surface));
    double dx = 0, dy = 0, x0 = 0, y0 = 0;
    OK(rsc_surface_grid(copy, nullptr, nullptr, &dx, &dy, &x0, &y0, nullptr));
    CHECK(dx == map.dx && dy == map.dy && x0 == map.x0 && y0 == map.y0 &&
          map.heights_of(copy) == z);
}

}  // namespace
