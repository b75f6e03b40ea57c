#include "run/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "contact/equivalent.hpp"
#include "contact/law/law.hpp"
#include "error.hpp"
#include "read/file_list.hpp"
#include "read/input_spectrum.hpp"
#include "read/inputs.hpp"
#include "rough/detection.hpp"
#include "rough/missing.hpp"
#include "rough/synthesis.hpp"

namespace rsc {
namespace {

// Hertz asperities are the paper's, on the grid; the laws that look closer want the summits themselves.
Detail detail_of(const Case& settings) { return traits(settings.asperities.law).between_points ? Detail::subgrid : Detail::grid; }

double rms(const std::vector<double>& values) {
    double mean = 0, square = 0;
    for (double v : values) mean += v;
    mean /= static_cast<double>(values.size());
    for (double v : values) square += (v - mean) * (v - mean);
    return std::sqrt(square / static_cast<double>(values.size()));
}

void count_summits(const SummitCount& count, SurfaceStatistics& s) {
    s.mean_kappa_g = count.mean_kappa_g;
    s.mean_kappa_a = count.mean_kappa_a;
    s.summits = count.summits;
    s.saddles = count.saddles + count.repeated;
}

void require_summits(const Ground& ground, const std::string& name, const std::string& where) {
    if (ground.asperities.size() > 0) return;
    throw Error(Failure::bad_input, name + ": no summit" + where + ": no point lies strictly above its 8 neighbours");
}

// The file of realization `number`.
std::string map_file(const std::string& name, std::int64_t number) {
    if (!is_pattern(name)) return name;
    const std::vector<std::string> files = matching_files(name);
    if (number < 1 || number > static_cast<std::int64_t>(files.size()))
        throw Error(Failure::bad_input, name + ": realization " + std::to_string(number) + " is asked for, and " +
                                            std::to_string(files.size()) + " files match");
    return files[static_cast<std::size_t>(number - 1)];
}

Surface read_map(const Case& settings, const std::string& path) {
    const auto& keys = settings.surface;
    Surface surface;
    surface.map = read_heights(path, keys.L, settings.run.length_unit, keys.channel, keys.missing);
    surface.origin.name = path;
    try {
        surface.origin.measured = std::make_shared<const Measured>(measure(surface.map, {keys.missing, keys.detrend, keys.filter_cutoff}));
    } catch (const Error& error) {
        throw Error(error.kind(), path + ": " + error.what());
    }
    surface.origin.sigma = surface.origin.measured->parameters.sq;
    return surface;
}

Ground read_list(const Case& settings) {
    const auto& keys = settings.surface;
    Ground ground;
    ground.asperities = read_asperities(keys.file, settings.run.length_unit);
    make_law(settings.asperities.law, ground.asperities, 1);  // refuses asperities that lack what the law needs
    ground.site = list_site(ground.asperities, keys.L, "the asperities in " + keys.file);
    ground.statistics.summits = static_cast<std::int64_t>(ground.asperities.size());
    ground.statistics.sigma = ground.site.sigma;
    ground.list = true;
    return ground;
}

}  // namespace

Spectrum spectrum_of(const Case& settings) {
    const auto& keys = settings.surface;
    if (keys.source == Source::spectrum) {
        const auto table = read_spectrum(keys.file, settings.run.length_unit);
        return tabulated_spectrum(table, keys.L.value_or(2 * std::numbers::pi / table->lowest()), keys.sigma.value_or(table->sigma()));
    }
    return {keys.L.value_or(1.0), keys.hurst, keys.L_lambda_l, keys.L_lambda_s, keys.plateau, keys.sigma.value_or(0.01)};
}

bool differs_by_realization(const Case& settings) {
    return has_spectrum(settings) || (settings.surface.source == Source::heights && is_pattern(settings.surface.file));
}

bool has_spectrum(const Case& settings) {
    return settings.surface.source == Source::synthetic || settings.surface.source == Source::spectrum;
}

Surface make_surface(const Case& settings, const Spectrum& spectrum, std::int64_t number, int threads) {
    const auto& keys = settings.surface;
    Surface surface;
    surface.origin.sigma = spectrum.sigma;
    surface.origin.points_per_wave = keys.n / spectrum.L_lambda_s;
    surface.origin.theory = theoretical_moments(spectrum);
    surface.map = synthesize(spectrum, keys.n, keys.normalise, settings.run.seed, number, nullptr, threads);
    return surface;
}

Surface make_surface(const Case& settings, std::int64_t number, int threads) {
    if (has_spectrum(settings)) return make_surface(settings, spectrum_of(settings), number, threads);
    if (settings.surface.source == Source::heights) return read_map(settings, map_file(settings.surface.file, number));
    throw Error(Failure::bad_input, "&surface: source = 'asperities' has no heights, only summits");
}

Site synthetic_site(const Spectrum& spectrum) {
    return {{0, 0, spectrum.L, spectrum.L}, spectrum.sigma, theoretical_moments(spectrum).mean_spacing()};
}

Site list_site(const Asperities& asperities, std::optional<double> L, const std::string& whose) {
    const Extent box = extent(asperities);
    const double extent = std::max(box.x_max - box.x_min, box.y_max - box.y_min);
    if (L && extent > *L) {
        throw Error(Failure::bad_input,
                    "surface%L = " + std::to_string(*L) + " is less than the extent of " + whose + ", " + std::to_string(extent));
    }
    Site site;
    site.sigma = rms(asperities.z);
    if (L && std::min(box.x_min, box.y_min) >= 0 && std::max(box.x_max, box.y_max) <= *L) {
        site.domain = {0, 0, *L, *L};
    } else {
        const double side = L.value_or(extent > 0 ? extent : 1.0);
        site.domain = {0.5 * (box.x_min + box.x_max) - 0.5 * side, 0.5 * (box.y_min + box.y_max) - 0.5 * side, side, side};
    }
    if (L || extent > 0) site.mean_spacing = std::sqrt(site.domain.Lx * site.domain.Ly / static_cast<double>(asperities.size()));
    return site;
}

Ground make_ground(const Surface& surface, const Case& settings, int threads) {
    const HeightMap& map = surface.map;
    Ground ground;
    SummitCount count;
    ground.asperities =
        find_asperities(map, settings.asperities.curvature, &count, threads, detail_of(settings), surface.origin.points_per_wave);
    if (const auto& measured = surface.origin.measured) {
        ground.measured = measured;
        drop_near_filled(ground.asperities, count, map, measured->filled, measured->shortest_wave());
    }
    require_summits(ground, surface.origin.name,
                    map.periodic                          ? ""
                    : detail_of(settings) == Detail::grid ? " inside the map"
                                                          : " " + std::to_string(kMeasuredReach) + " or more points inside the map");
    ground.site.domain = {map.x0, map.y0, map.Lx(), map.Ly()};
    ground.site.sigma = surface.origin.sigma;
    if (surface.origin.theory)
        ground.site.mean_spacing = surface.origin.theory->mean_spacing();
    else
        ground.site.mean_spacing = std::sqrt(map.Lx() * map.Ly() / static_cast<double>(ground.asperities.size()));
    auto& s = ground.statistics;
    const Moments grid = grid_moments(map);
    s.sigma = surface.origin.sigma;
    s.m2 = s.m2_grid = grid.m2;
    s.m4 = s.m4_grid = grid.m4;
    count_summits(count, s);
    return ground;
}

Ground make_ground(const Case& settings, const Spectrum& spectrum, std::int64_t number, int threads) {
    const auto& keys = settings.surface;
    Ground ground;
    ground.site = synthetic_site(spectrum);
    SummitCount count;
    Moments sampled, differences;
    ground.asperities = make_asperities(spectrum, keys.n, keys.normalise, settings.run.seed, number, settings.asperities.curvature, &count,
                                        &sampled, threads, detail_of(settings), &differences);
    require_summits(ground, "the surface", "");
    auto& s = ground.statistics;
    s.sigma = std::sqrt(sampled.m0);
    s.m2 = sampled.m2;
    s.m4 = sampled.m4;
    s.m2_grid = differences.m2;
    s.m4_grid = differences.m4;
    count_summits(count, s);
    return ground;
}

Ground make_ground(const Case& settings, std::int64_t number, int threads) {
    switch (settings.surface.source) {
        case Source::synthetic:
        case Source::spectrum: return make_ground(settings, spectrum_of(settings), number, threads);
        case Source::heights: return make_ground(make_surface(settings, number, threads), settings, threads);
        case Source::asperities: return read_list(settings);
    }
    throw Error(Failure::internal, "a source of asperities that nobody knows");
}

Indenter indenter_of(const Case& settings, const Site& site) {
    const auto& centre = settings.indentation.centre;
    const Domain& d = site.domain;
    return {equivalent_modulus(settings.solids.E, settings.solids.nu), equivalent_radius(settings.solids.R),
            centre[0].value_or(d.x0 + 0.5 * d.Lx), centre[1].value_or(d.y0 + 0.5 * d.Ly)};
}

double sigma_of(const Case& settings, const Site& site) { return settings.surface.sigma.value_or(site.sigma); }

SolverOptions solver_of(const Case& settings, const Site& site) {
    SolverOptions options;
    options.method = settings.solver.method;
    options.law = settings.asperities.law;
    options.interaction = settings.solver.interaction;
    options.selection = settings.indentation.selection;
    options.selection_factor = settings.indentation.selection_factor;
    options.sigma = sigma_of(settings, site);
    options.tolerance = settings.solver.tolerance;
    options.max_iterations = settings.solver.max_iterations;
    options.delta0 = settings.solver.delta0;
    options.mean_spacing = site.mean_spacing;
    if (!(options.sigma > 0) && (options.method == Method::dgesv || options.selection == Selection::paper)) {
        throw Error(Failure::bad_input,
                    "surface%sigma: needed by solver%method = 'dgesv' and indentation%selection = 'paper', and the "
                    "asperities, all of one height, give none");
    }
    return options;
}

}  // namespace rsc
