// Summits against brute force and against the theory of Gaussian surfaces.
#include "surface/detection.hpp"
#include "surface/synthesis.hpp"

#include "check.hpp"

namespace test_asperities {

using namespace rsc;

HeightMap make_map(int nx, int ny, bool periodic, int stride) {
    HeightMap map;
    map.allocate(nx, ny, stride);
    map.dx = 0.5;
    map.dy = 0.25;
    map.x0 = -1;
    map.y0 = 2;
    map.periodic = periodic;
    return map;
}

TEST(against_brute_force) {
    std::mt19937 random(12345);
    for (const bool periodic : {true, false})
        for (const auto [nx, ny] : {std::array{41, 29}, {8, 8}, {9, 5}, {3, 3}, {2, 7}, {300, 6}}) {
            HeightMap map = make_map(nx, ny, periodic, nx + 3);
            // Few different heights: neighbours are often equal, and an equal neighbour makes no
            // summit. The right half has rounded ridges along the diagonals, whose grid maxima are
            // saddles.
            const double ridge[] = {0, -1, -8, -9, -8, -1};
            for (const int j : indices(ny))
                for (const int i : indices(nx)) {
                    const double noise = double(random() % 40);
                    map.row(j)[i] = i < nx / 2 ? noise : 100 * ridge[(i - j + 6 * ny) % 6] + noise;
                }
            const auto z = [&](int i, int j) { return map((i + nx) % nx, (j + ny) % ny); };
            std::vector<std::array<int, 2>> summits;
            std::vector<double> k1, k2, kg;
            long saddles = 0;
            for (const int j : indices(ny))
                for (const int i : indices(nx)) {
                    if (!periodic && (i == 0 || j == 0 || i == nx - 1 || j == ny - 1)) continue;
                    bool top = true;
                    for (int b = -1; b <= 1; ++b)
                        for (int a = -1; a <= 1; ++a)
                            top = top && ((a == 0 && b == 0) || z(i, j) > z(i + a, j + b));
                    if (!top) continue;
                    // Eigenvalues of the Hessian by trace and determinant.
                    const double xx = (z(i - 1, j) - 2 * z(i, j) + z(i + 1, j)) / 0.25,
                                 yy = (z(i, j - 1) - 2 * z(i, j) + z(i, j + 1)) / 0.0625;
                    const double xy =
                        (z(i + 1, j + 1) - z(i - 1, j + 1) - z(i + 1, j - 1) + z(i - 1, j - 1)) /
                        (4 * 0.5 * 0.25);
                    const double trace = xx + yy, determinant = xx * yy - xy * xy;
                    if (determinant <= 0) {
                        ++saddles;
                        continue;
                    }
                    const double root = std::sqrt(trace * trace / 4 - determinant);
                    summits.push_back({i, j});
                    k1.push_back(-trace / 2 + root);
                    k2.push_back(-trace / 2 - root);
                    kg.push_back(std::sqrt(determinant));
                }
            SummitCount count;
            const Asperities found = find_asperities(map, Curvature::geometric, &count);
            CHECK(found.size() == summits.size());
            CHECK(count.saddles == saddles);
            CHECK(count.summits == long(summits.size()));
            if (nx == 41) CHECK(saddles > 10 && summits.size() > 30);
            double worst = 0, sum_g = 0, sum_a = 0;
            for (std::size_t s = 0; s < std::min(found.size(), summits.size()); ++s) {
                const auto [i, j] = summits[s];
                worst = check::worse(
                    worst,
                    {std::abs(found.x[s] - (-1 + i * 0.5)), std::abs(found.y[s] - (2 + j * 0.25)),
                     std::abs(found.z[s] - z(i, j)), std::abs(found.kappa1[s] / k1[s] - 1),
                     std::abs(found.kappa2[s] - k2[s]) / k1[s],
                     std::abs(found.radius[s] * kg[s] - 1)});
                sum_g += kg[s];
                sum_a += (k1[s] + k2[s]) / 2;
            }
            CHECK_CLOSE(worst, 0, 1e-12);
            if (!summits.empty()) {
                CHECK_RELATIVE(count.mean_kappa_g, sum_g / double(summits.size()), 1e-12);
                CHECK_RELATIVE(count.mean_kappa_a, sum_a / double(summits.size()), 1e-12);
            }
            const Asperities algebraic = find_asperities(map, Curvature::algebraic, &count);
            for (std::size_t s = 0; s < std::min(algebraic.size(), k1.size()); ++s)
                CHECK_RELATIVE(1 / algebraic.radius[s], (k1[s] + k2[s]) / 2, 1e-12);
        }
}

bool same(const Asperities& a, const Asperities& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.radius == b.radius && a.kappa1 == b.kappa1 &&
           a.kappa2 == b.kappa2 && a.angle == b.angle;
}

TEST(made_and_found_are_the_same) {
    const Spectrum s{.L = 1.3, .L_lambda_l = 6, .L_lambda_s = 50};
    for (const int n : {100, 102, 128, 250}) {
        SummitCount found_count, made_count;
        Moments found_moments, made_moments;
        const HeightMap map = synthesize(s, n, Normalise::sample, 3, 4, &found_moments);
        const Asperities found = find_asperities(map, Curvature::algebraic, &found_count);
        CHECK(found.size() > 100);
        for (const int threads : {1, 2, 3, 200}) {
            CHECK(same(found, find_asperities(map, Curvature::algebraic, &made_count, threads)));
            CHECK(made_count.mean_kappa_g == found_count.mean_kappa_g &&
                  made_count.saddles == found_count.saddles);
            CHECK(same(found, make_asperities(s, n, Normalise::sample, 3, 4, Curvature::algebraic,
                                              &made_count, &made_moments, threads)));
            CHECK(made_count.mean_kappa_g == found_count.mean_kappa_g &&
                  made_count.saddles == found_count.saddles);
            CHECK(std::memcmp(&made_moments, &found_moments, sizeof made_moments) == 0);
        }
    }
}

}  // namespace test_asperities
