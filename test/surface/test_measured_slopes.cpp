// Slopes of the surfaces made from the spectrum of a measured map (its twins), and the warning of
// its run that they are not the map's.
#include "support/height_maps.hpp"
#include "support/runs.hpp"
#include "support/temporary_folder.hpp"
#include "surface/synthesis.hpp"

namespace test_measured_slopes {

using namespace rsc;

// The screen of a run on the heights of a map.
template <class Heights>
std::string screen(const Folder& folder, int n, const Heights& heights) {
    const std::string map = folder.write("map.txt", rows_of_text(n, n, heights));
    Case settings =
        settings_of("&surface L=1 source='heights' file='" + map + "' / &indentation levels=2 /");
    settings.output.file = folder / "measured.nc";
    settings.run.threads = 1;
    std::ostringstream table;
    RunOptions options;
    options.table = &table;
    options.progress = Progress::never;
    CHECK(run_case(settings, options) == 0);
    return table.str();
}

TEST(measured_slopes) {
    const Folder folder;
    constexpr int n = 128;
    const HeightMap fine = synthesize({.L = 1, .L_lambda_l = 20, .L_lambda_s = 24, .sigma = 0.005},
                                      n, Normalise::sample, 4, 1);
    const HeightMap coarse = synthesize({.L = 1, .L_lambda_l = 6, .L_lambda_s = 8, .sigma = 0.02},
                                        n, Normalise::sample, 5, 1);
    const std::string kWarning = "\nwarning: the rms slope of the twins",
                      twins = folder / "measured_twins.nml";
    // Long waves that are highest at the borders of the map, where the window of its spectrum is
    // zero. The twins have the map's ratio of slope to height all the same, at their own points.
    const auto map_with = [&](double share, double everywhere) {
        HeightMap map = fine.copy();
        map.periodic = false;
        for (const int j : indices(n))
            for (const int i : indices(n))
                map.row(j)[i] +=
                    share * coarse(i, j) * (everywhere + std::abs(std::cos(pi * (i + 0.5) / n)));
        return map;
    };
    const auto like_twins = [&](const HeightMap& map) {
        const std::string shown = screen(folder, n, map);
        CHECK(shown.find("spectrum of the twins") != std::string::npos);
        const Case settings = settings_of(bytes(twins));
        double slope = 0, height = 0;
        for (int k = 1; k <= 8; ++k) {
            const Moments made = grid_moments(make_surface(settings, k, 1).map);
            slope += 2 * made.m2;
            height += made.m0;
        }
        const Moments of_map = grid_moments(map);
        constexpr double kEightSurfaces = 0.04;
        CHECK_RELATIVE(std::sqrt(slope / height), of_map.rms_slope() / std::sqrt(of_map.m0),
                       kEightSurfaces);
        return shown;
    };
    const std::string quiet = like_twins(map_with(0.4, 1));
    // Likewise long waves that are lowest there, which the window weighs most. A single step more
    // is none of the twins'.
    HeightMap lower = map_with(-0.4, -1);
    like_twins(lower);
    lower.row(n / 2)[1] += 20 * 0.005;
    CHECK(screen(folder, n, lower).find("spectrum of the twins") == std::string::npos);
    // Equal roughness at all heights, and tops that are worn.
    const auto worn = [&](double kept) {
        HeightMap map = fine.copy();
        map.periodic = false;
        const double top = std::sqrt(grid_moments(fine).m0);
        for (double* z = map.data.get(); z < map.row(n - 1) + n; ++z)
            *z = *z > 0.5 * top ? 0.5 * top + kept * (*z - 0.5 * top) : *z;
        return height_parameters(map).high_slope;
    };
    CHECK_RELATIVE(worn(1), 1, 0.1);  // of one surface
    CHECK(worn(0.5) < 0.8);
    const auto steeper = [&](int i, int j) { return fine(i, j) > 0 ? 3 * fine(i, j) : fine(i, j); };
    CHECK(screen(folder, n, steeper).find("times that of the whole") != std::string::npos);
    CHECK(quiet.find("times that of the whole") == std::string::npos);
    // Long waves so high that no exponent within the bounds would do.
    const std::string kCause = "this step smooths", far = screen(folder, n, map_with(1, 0));
    CHECK(far.find(kWarning) != std::string::npos && far.find(kCause) == std::string::npos);
    // Three points in the shortest wave: first differences miss a tenth of the slope, of the map as
    // of its twins.
    const HeightMap sharp = synthesize({.L = 1, .L_lambda_l = 12, .L_lambda_s = 42, .sigma = 0.005},
                                       n, Normalise::sample, 4, 1);
    CHECK(screen(folder, n, sharp).find(kCause) != std::string::npos);
}

}  // namespace test_measured_slopes
