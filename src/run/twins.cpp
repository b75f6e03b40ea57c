#include "run/twins.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "case/registry.hpp"
#include "file/whole_file.hpp"

namespace rsc {
namespace {

constexpr const char* kMark = "! Written by rsc beside a measured map's result, and again with it: change a copy.\n";
const FileKind kTwins{"case of twins", [](const std::string& path) { return begins_with(path, kMark); }};
constexpr int kRealizations = 100;

std::string stem(const std::string& result) { return result.ends_with(".nc") ? result.substr(0, result.size() - 3) : result; }

}  // namespace

std::string twins_text(const Job& job, const std::string& result) {
    const Measured& m = *job.measured;
    Case twins = job.settings;
    const double L = std::max(m.nx * m.dx, m.ny * m.dy);
    twins.run.title = "Surfaces with the spectrum of " + std::filesystem::path(job.settings.surface.file).filename().string();
    twins.run.realizations = kRealizations;
    twins.run.first_realization = 1;
    const Case::Surface keys = twins.surface;
    twins.surface = {};
    twins.surface.source = Source::spectrum;
    twins.surface.file = result;
    twins.surface.L = L;
    twins.surface.n = 2 * static_cast<int>(std::ceil(m.spectrum.wavenumber.back() * L / (2 * std::numbers::pi) * (1 - 1e-12))) +
                      2;  // heights of any distribution need a point more
    twins.surface.twins = m.isotropy < kIsotropic ? Twins::directional : Twins::radial;
    twins.surface.twin_heights = m.gaussian() ? TwinHeights::gaussian : TwinHeights::measured;
    twins.surface.sigma = m.parameters.sq;
    twins.surface.normalise = Normalise::ensemble;  // the map's rms height is one sample's; that of the twins may scatter as it does
    if (keys.sigma && twins.indentation.control == Control::separation && twins.indentation.unit == LevelUnit::sigma) {
        // There sigma was a unit of length; here it is the rms height to make.
        twins.indentation.unit = LevelUnit::length;
        twins.indentation.start *= job.sigma;
        twins.indentation.stop *= job.sigma;
        for (double& level : twins.indentation.levels) level *= job.sigma;
    }
    // The square begins at 0 and is as long as the map's longer side; the tip lies as it did from the middle.
    const Domain& d = job.site.domain;
    if (auto& x = twins.indentation.centre[0]) x = std::clamp(*x - (d.x0 + 0.5 * d.Lx) + 0.5 * L, 0.0, L);
    if (auto& y = twins.indentation.centre[1]) y = std::clamp(*y - (d.y0 + 0.5 * d.Ly) + 0.5 * L, 0.0, L);
    twins.output.file = stem(result) + "_twins.nc";
    twins.output.contacts = Contacts::automatic;
    twins.output.heights = false;
    twins.solver.model = model_of(job.settings).model;  // as the map was solved, so that the two can be compared
    return kMark + effective_namelist(twins);
}

std::string write_twins(const Job& job, const std::string& result) {
    if (!job.measured || !job.measured->fit) return {};
    const std::string path = stem(result) + "_twins.nml";
    if (const std::string why = reason_to_leave(path, kTwins); !why.empty()) return "twins: " + path + ": " + why;
    write_whole(path, kTwins, twins_text(job, result));
    return "twins: " + path + " (surfaces with this spectrum: rsc < " + path + ")";
}

}  // namespace rsc
