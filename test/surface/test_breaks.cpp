// Pits, spikes and steps of a map: found where they are, none where there are none; pits raised to
// the surface around.
#include "check.hpp"
#include "surface/defects.hpp"
#include "surface/synthesis.hpp"

namespace test_breaks {

using namespace rsc;

TEST(all_breaks) {
    constexpr int n = 128;
    constexpr double sigma = 1e-3;
    const Spectrum s{.L = 1, .L_lambda_l = 4, .L_lambda_s = 16, .sigma = sigma};
    const auto smooth = [&] {
        HeightMap map = synthesize(s, n, Normalise::sample, 3, 1);
        map.periodic = false;
        return map;
    };
    const HeightMap clean = smooth();
    for (const auto& found : find_breaks(clean, 0).found) CHECK(found.points == 0);

    {
        HeightMap map = smooth();
        const int at[4][2] = {{20, 30}, {60, 61}, {90, 1}, {100, 100}};
        for (const auto& [i, j] : at) map.row(j)[i] -= 10 * sigma;
        map.row(50)[70] -= 20 * sigma;
        for (const int k : indices(n)) {  // grooves that cross
            map.row(k)[40] -= 8 * sigma;
            map.row(110)[k] -= 8 * sigma;
        }
        const Breaks breaks = find_breaks(map, 0);
        CHECK(breaks.found[Breaks::pit].points == 5 + 2 * n - 1 &&
              breaks.found[Breaks::spike].points == 0);
        CHECK(breaks.found[Breaks::step].points == 0 && breaks.clear.empty());
        CHECK(breaks.found[Breaks::pit].largest.i == 70 &&
              breaks.found[Breaks::pit].largest.j == 50);
        CHECK_RELATIVE(breaks.found[Breaks::pit].size, 20 * sigma, 0.02);
        raise_pits(map, breaks);
        double worst = 0;
        for (int j = 1; j < n - 1; ++j)
            for (int i = 1; i < n - 1; ++i)
                worst = check::worse(worst, std::abs(map(i, j) - clean(i, j)));
        CHECK_CLOSE(
            worst, 0,
            0.05 *
                // a polynomial through two points where a groove ends, through six elsewhere
                sigma);
    }
    {
        // A smooth hill is none, however flat the map around it is.
        HeightMap map = smooth();
        for (const int j : indices(n))
            for (const int i : indices(n))
                map.row(j)[i] =
                    1e-2 * map(i, j) +
                    50 * sigma * std::exp(-(std::pow(i - 60, 2) + std::pow(j - 70, 2)) / 50);
        const Breaks breaks = find_breaks(map, 0);
        CHECK(breaks.found[Breaks::spike].points == 0 && breaks.pits.empty() &&
              breaks.clear.empty());
    }
    {
        HeightMap map = smooth();
        map.row(33)[44] += 10 * sigma;
        for (const int j : indices(n))
            for (int i = 80; i < n; ++i) map.row(j)[i] -= 5 * sigma;
        const Breaks breaks = find_breaks(map, 0);
        CHECK(breaks.found[Breaks::spike].points == 1 &&
              breaks.found[Breaks::spike].largest.i == 44);
        CHECK_RELATIVE(breaks.found[Breaks::spike].size, 10 * sigma, 0.02);
        CHECK(breaks.found[Breaks::step].points == 2 * n && breaks.pits.empty());

        const auto clear = [&](int i, int j) { return breaks.clear[j * n + i]; };
        CHECK(clear(79, 5) == 0 && clear(80, 5) == 0 && clear(76, 5) == 3 && clear(44, 33) == 0 &&
              clear(10, 100) == Breaks::kMostClear);
    }
}

}  // namespace test_breaks
