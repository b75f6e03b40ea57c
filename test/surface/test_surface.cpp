// Synthetic surfaces against a slow sum of cosines, and their normalisation. Moments:
// test_every_value; grids and threads: test_made.
#include "surface/surface.hpp"
#include "surface/synthesis.hpp"

#include "check.hpp"
#include "support/height_maps.hpp"
#include "surface/modes.hpp"

namespace test_surface {

using namespace rsc;

double rms(const HeightMap& map) {
    double sum = 0;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) sum += map(i, j) * map(i, j);
    return std::sqrt(sum / (double(map.nx) * map.ny));
}

// z = sum over the half plane of 2 Re[c exp(i K.x)], mode by mode and point by point.
std::vector<double> by_cosines(const Spectrum& s, int n, NoiseKey key) {
    struct Mode {
        int kx, ky;
        std::complex<double> c;
    };
    std::vector<Mode> modes;
    double expected = 0;
    const int top = int(s.L_lambda_s);
    for (int kx = 0; kx <= top; ++kx)
        for (int ky = kx > 0 ? -top : 1; ky <= top; ++ky) {
            const double psd = relative_psd(s, kx, ky);
            if (!(psd > 0)) continue;
            modes.push_back({kx, ky, std::sqrt(psd) * mode_noise(key, kx, ky)});
            expected += 2 * psd;
        }
    std::vector<double> z;
    for (const int j : indices(n))
        for (const int i : indices(n)) {
            double h = 0;
            for (const Mode& m : modes)
                h += 2 * (m.c * std::polar(1.0, 2 * pi * (m.kx * i + m.ky * j) / n)).real();
            z.push_back(h * s.sigma / std::sqrt(expected));
        }
    return z;
}

TEST(against_cosines) {
    // n = 30 has n = 2 L_lambda_s modes at the limit of the grid; 32 and 36 do not. All must follow
    // the definition.
    for (const bool plateau : {false, true})
        for (const int n : {30, 32, 36}) {
            const Spectrum s{.L = 2.0,
                             .hurst = 0.6,
                             .L_lambda_l = 3.0,
                             .L_lambda_s = 15.0,
                             .plateau = plateau,
                             .sigma = 0.1};
            const HeightMap map = synthesize(s, n, Normalise::ensemble, 11, 5);
            const std::vector<double> z = by_cosines(s, n, {11, 5});
            double worst = 0;
            for (const int j : indices(n))
                for (const int i : indices(n))
                    worst = check::worse(worst, std::abs(map(i, j) - z[j * n + i]));
            CHECK_CLOSE(worst, 0.0,
                        1e-13 * 0.1 * 10);  // rounding of the slow sum over some 700 modes
            CHECK(map.periodic && map.nx == n && map.ny == n && map.x0 == 0 && map.y0 == 0);
            CHECK_RELATIVE(map.dx * n, 2.0, 1e-15);
            CHECK(map.dy == map.dx);
        }
    // A table with a gap in it, on another square, at the grid's limit and not; and the smallest
    // surface of all: one wave on two points.
    const auto table = std::make_shared<const SpectrumTable>(std::vector{2.0, 3.1, 5.0, 6.0, 9.9},
                                                             std::vector{0.4, 0.9, 0.0, 0.3, 0.05});
    const Spectrum tabulated = tabulated_spectrum(table, 7.0, 0.3),
                   smallest{.L = 3, .L_lambda_l = 1, .L_lambda_s = 1, .plateau = true};
    for (const auto& [s, n] : {std::pair{tabulated, 22}, {tabulated, 26}, {smallest, 2}}) {
        const HeightMap map = synthesize(s, n, Normalise::ensemble, 4, 2, nullptr, 3);
        const std::vector<double> z = by_cosines(s, n, {4, 2});
        for (const int j : indices(n))
            for (const int i : indices(n)) CHECK_CLOSE(map(i, j), z[j * n + i], 1e-13);
    }
}

TEST(normalisation) {
    const Spectrum s{.L_lambda_l = 3, .L_lambda_s = 32, .sigma = 0.02};
    Moments sampled;
    for (const int n : {64, 128}) {  // 64: with modes at the limit of the grid
        const HeightMap map = synthesize(s, n, Normalise::sample, 9, 4, &sampled);
        CHECK_RELATIVE(rms(map), s.sigma, 1e-13);
        double mean = 0;
        for (const int j : indices(n))
            for (const int i : indices(n)) mean += map(i, j);
        CHECK_CLOSE(mean / (n * n), 0.0, 1e-15);
    }
    CHECK_RELATIVE(sampled.m0, s.sigma * s.sigma, 1e-13);
    // In expectation: the mean square over surfaces, whose own scatter gives the bound (five
    // standard errors).
    double sum = 0, square = 0;
    const int surfaces = 400;
    for (int k = 1; k <= surfaces; ++k) {
        const HeightMap map = synthesize(s, 64, Normalise::ensemble, 9, k, &sampled);
        const double m0 = rms(map) * rms(map) / (s.sigma * s.sigma);
        sum += m0;
        square += m0 * m0;
    }
    const double mean = sum / surfaces,
                 error = std::sqrt((square / surfaces - mean * mean) / surfaces);
    CHECK_CLOSE(mean, 1.0, 5 * error);
    CHECK(error > 1e-3);  // the surfaces do differ
}

}  // namespace test_surface
