// Maps in which everything differs from everything else (nx != ny, dx != dy, x0 != y0, heights
// without symmetry) against slow plain computations.
#include "check.hpp"
#include "support/height_maps.hpp"
#include "surface/defects.hpp"
#include "surface/measured.hpp"

namespace test_unlike_maps {

using namespace rsc;
// Waves of many directions and noise on a form.
HeightMap rough(int nx, int ny, double dx, double dy) {
    std::mt19937 random(7);
    HeightMap map = height_map(nx, ny, dx, dy, [&](int i, int j) {
        return 3 + 0.05 * i - 0.03 * j + std::sin(0.9 * i + 0.4 * j) +
               0.6 * std::cos(0.7 * i - 1.1 * j + 0.3) + 0.3 * std::sin(0.2 * i * 1.7 + 1.6 * j) +
               0.2 * (double(random()) / 4294967296.0 - 0.5);
    });
    map.x0 = -1.3;
    map.y0 = 2.1;
    return map;
}

// Without its rounding a tilted map has the slopes it had.
TEST(rounded) {
    constexpr double step = 0.2;
    HeightMap map = height_map(48, 36, 0.3, 0.2, [](int i, int j) {
        return step * std::round((0.6 * i - 0.9 * j + std::sin(0.3 * i + 0.2 * j)) / step);
    });
    HeightMap before = map.copy();
    const Form with = detrend(before, Detrend::plane);
    smooth_rounded(map, step);
    const Form without = detrend(map, Detrend::plane);
    CHECK_RELATIVE(without.slope_x, with.slope_x, 1e-3);
    CHECK_RELATIVE(without.slope_y, with.slope_y, 1e-3);
}

// Every ring of the spectrum from a sum over all points for each mode.
TEST(spectra) {
    for (const auto& [nx, ny, dx, dy] :
         {std::tuple{15, 22, 0.3, 0.2}, {18, 13, 0.1, 0.4}, {20, 12, 0.25, 0.25}})
        for (const bool periodic : {false, true}) {
            HeightMap map = rough(nx, ny, dx, dy);
            map.periodic = periodic;
            const auto w = [&](int i, int j) {
                return periodic ? 1.0
                                : std::pow(std::sin(pi * (i + 0.5) / nx), 2) *
                                      std::pow(std::sin(pi * (j + 0.5) / ny), 2);
            };
            double mean = 0, weight = 0, squares = 0;
            for (const int j : indices(ny))
                for (const int i : indices(nx)) {
                    mean += w(i, j) * map(i, j);
                    weight += w(i, j);
                    squares += w(i, j) * w(i, j);
                }
            mean /= weight;
            const double sx = 2 * pi / (nx * dx), sy = 2 * pi / (ny * dy), ring = std::min(sx, sy);
            std::vector<double> power(60, 0.0), modes(60, 0.0);
            for (int q = -((ny - 1) / 2); q <= ny / 2; ++q)
                for (int p = -((nx - 1) / 2); p <= nx / 2; ++p) {
                    std::complex<double> sum = 0;
                    for (const int j : indices(ny))
                        for (const int i : indices(nx))
                            sum += w(i, j) * (map(i, j) - mean) *
                                   std::polar(1.0,
                                              -2 * pi * (double(p * i) / nx + double(q * j) / ny));
                    const std::size_t r = std::lround(std::hypot(sx * p, sy * q) / ring);
                    if (r < power.size()) {
                        power[r] += std::norm(sum) / (nx * ny * squares * sx * sy);
                        modes[r] += 1;
                    }
                }
            const MeasuredSpectrum s = measure_spectrum(map);
            std::size_t k = 0;
            const std::size_t rings = std::lround(pi / std::max(dx, dy) / ring);
            for (std::size_t r = 1; r <= rings; ++r) {
                if (modes[r] == 0) continue;
                CHECK(k < s.psd.size());
                if (k >= s.psd.size()) return;
                CHECK_RELATIVE(s.wavenumber[k], double(r) * ring, 1e-14);
                CHECK(s.modes[k] == modes[r]);
                CHECK_RELATIVE(s.psd[k], power[r] / modes[r], 1e-9);
                ++k;
            }
            CHECK(k == s.psd.size() && s.wavenumber.size() == k && s.modes.size() == k);
            CHECK(s.independent == (periodic ? 0.5 : 0.5 * 0.514 * 0.514) &&
                  s.coupled == (periodic ? 1 : 1 / 0.514));
        }
}

// Points by their distance to the nearest measured one, which the mask counts in steps along rows
// and columns.
void depths(int nx, int ny) {
    const auto at = [nx](int i, int j) { return j * nx + i; };
    std::vector<std::uint8_t> hole(at(0, ny), 0);
    for (const int j : indices(ny))
        for (const int i : indices(nx))
            hole[at(i, j)] = std::hypot(i - 3, j - 9) < 6.5 || (i > 20 && j % 5 > 0);
    for (const int steps : {0, 1, 2, 3, 40}) {
        std::vector<std::uint8_t> kept = hole;
        keep_depths(kept, nx, ny, steps);
        long wrong = 0, deep = 0;
        for (const int j : indices(ny))
            for (const int i : indices(nx)) {
                int nearest = nx + ny;
                for (const int k : indices(ny))
                    for (const int h : indices(nx))
                        if (!hole[at(h, k)])
                            nearest = std::min(nearest, std::abs(h - i) + std::abs(k - j));
                deep += nearest > steps;
                wrong += !kept.empty() && (kept[at(i, j)] == 1) != (nearest > steps);
            }
        CHECK(wrong == 0 && kept.empty() == (deep == 0));
    }
}

TEST(unlike_maps) {
    depths(31, 22);
    depths(22, 31);
}

}  // namespace test_unlike_maps
