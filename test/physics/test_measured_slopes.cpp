// The warning of a measured map's run that the surfaces made from its spectrum (its twins) have other slopes than the map.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <sstream>

#include "case/read_case.hpp"
#include "check.hpp"
#include "rough/synthesis.hpp"
#include "run/job.hpp"
#include "run/run.hpp"
#include "unit/temporary_folder.hpp"

using namespace rsc;

namespace {

// The screen of a run on the surface plus half a wave of the amplitude `bow`, which is longer than the map and so not in its spectrum.
std::string screen(const Folder& folder, const HeightMap& surface, double bow) {
    std::ofstream file(folder / "map.txt");
    file.precision(12);
    for (int j = 0; j < surface.ny; ++j, file << "\n")
        for (int i = 0; i < surface.nx; ++i) file << surface(i, j) + bow * std::cos(std::numbers::pi * (i + 0.5) / surface.nx) << " ";
    file.close();
    Case settings =
        read_case_text("&surface L=1 source='heights' file='" + folder / "map.txt" + "' / &indentation levels=2 /", "case.nml").settings;
    settings.output.file = folder / "measured.nc", settings.run.threads = 1;
    std::ostringstream table;
    RunOptions options;
    options.table = &table, options.progress = Progress::never;
    CHECK(run_case(settings, options) == 0);
    return table.str();
}

}  // namespace

TESTS {
    const Folder folder;
    const Spectrum s{.L = 1, .L_lambda_l = 8, .L_lambda_s = 24, .sigma = 0.005};
    const HeightMap surface = synthesize(s, 128, Normalise::sample, 4, 1);
    const std::string kWarning = "\nwarning: the rms slope of the twins";
    CHECK(screen(folder, surface, 0).find(kWarning) == std::string::npos);
    const std::string told = screen(folder, surface, 0.03);
    const std::size_t twins = told.find("twins: "), at = told.find(kWarning);
    CHECK(twins != std::string::npos && at != std::string::npos && at > twins);
    if (at == std::string::npos) return;
    // The first number is the slope of a surface that is made by the file of the twins.
    double of_twins = 0;
    CHECK(std::sscanf(told.c_str() + at + kWarning.size(), " is %lf", &of_twins) == 1);
    const std::string path = folder / "measured_twins.nml";
    const Surface twin = make_surface(read_case_text(bytes(path), path).settings, 1, 1);
    constexpr double kOneSurface = 0.15;  // scatter of a single surface, and differences between points
    CHECK_RELATIVE(of_twins, grid_moments(twin.map).rms_slope(), kOneSurface);
}
