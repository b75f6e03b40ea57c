#include "problem/bodies.hpp"

#include "asperities/law.hpp"
#include "base/error.hpp"
#include "base/library_lock.hpp"
#include "base/parallel.hpp"
#include "contact/equivalent.hpp"
#include "io/inputs.hpp"
#include "physics/indenter/shapes.hpp"
#include "physics/physics.hpp"
#include "surface/defects.hpp"
#include "surface/detection.hpp"
#include "trust/judge.hpp"

namespace rsc {
namespace {

// Hertz asperities are at grid points, as in the paper; the other laws need the summits between the
// points.
Detail detail_of(const Case& settings) {
    return traits(settings.asperities.law).between_points ? Detail::subgrid : Detail::grid;
}

double rms(const std::vector<double>& values) {
    double mean = 0, square = 0;
    for (double v : values) mean += v;
    mean /= double(values.size());
    for (double v : values) square += (v - mean) * (v - mean);
    return std::sqrt(square / double(values.size()));
}

void count_summits(const SummitCount& count, SurfaceStatistics& s) {
    s.mean_kappa_g = count.mean_kappa_g;
    s.mean_kappa_a = count.mean_kappa_a;
    s.summits = count.summits;
    s.saddles = count.saddles + count.repeated;
}

// Of a synthetic surface, from its modes. Skewness and kurtosis are stored only for heights that
// are not Gaussian.
void set_sampled(const Moments& sampled, SurfaceStatistics& s) {
    s.sigma = std::sqrt(sampled.m0);
    s.m2 = sampled.m2;
    s.m4 = sampled.m4;
    s.tensor = sampled.tensor;
    if (sampled.heights.skewness == 0 && sampled.heights.kurtosis == 3) return;
    s.skewness = sampled.heights.skewness;
    s.kurtosis = sampled.heights.kurtosis;
}

void require_summits(const SurfaceModel& model, const std::string& name, const std::string& where) {
    if (model.asperities.size() > 0) return;
    bad_input(name, ": no summit", where, ": no point lies strictly above its 8 neighbours");
}

// The file of realization `number`.
std::string map_file(const std::string& name, std::int64_t number) {
    if (!is_pattern(name)) return name;
    const std::vector<std::string> files = matching_files(name);
    if (number < 1 || number > std::int64_t(files.size()))
        bad_input(name, ": realization ", number, " is requested, but only ", files.size(),
                  " files match");
    return files[at(number - 1)];
}

// The points of a map within x0, x1, y0, y1.
HeightMap part_of(const HeightMap& map, const std::optional<double> (&window)[4],
                  const std::string& path) {
    // points on the border of the window belong to it, however they are rounded
    constexpr double slack = 1e-6;
    const auto range = [](double from, double to, double origin, double step, int n) {
        const auto place = [&](double x) { return std::clamp((x - origin) / step, -1.0, n + 0.0); };
        return std::pair(std::max(0, int(std::ceil(place(from) - slack))),
                         std::min(n - 1, int(std::floor(place(to) + slack))));
    };
    const auto [i0, i1] = range(*window[0], *window[1], map.x0, map.dx, map.nx);
    const auto [j0, j1] = range(*window[2], *window[3], map.y0, map.dy, map.ny);
    if (i1 - i0 < 2 || j1 - j0 < 2)
        bad_input(
            format("%s: fewer than 3 x 3 of its points lie in surface%%window; they go from %.6g "
                   "to %.6g in x and from "
                   "%.6g to %.6g in y",
                   path.c_str(), map.x0, map.x(map.nx - 1), map.y0, map.y(map.ny - 1)));
    HeightMap part;
    part.allocate(i1 - i0 + 1, j1 - j0 + 1, i1 - i0 + 1);
    part.dx = map.dx;
    part.dy = map.dy;
    part.x0 = map.x(i0);
    part.y0 = map.y(j0);
    for (int j = j0; j <= j1; ++j) std::copy_n(map.row(j) + i0, part.nx, part.row(j - j0));
    return part;
}

// The heights of a map as the file has them, and of body 1 only those in surface%window.
HeightMap read_raw_map(const Case& settings, const std::string& path, std::optional<double> L,
                       const std::string& channel, bool windowed, MapOrigin* origin) {
    const auto& keys = settings.surface;
    const bool part = windowed && keys.window[0];
    // Of two maps one may have no units, to which alone these keys apply.
    const std::string other = windowed                  ? settings.indenter.file
                              : reads_heights(settings) ? map_file(keys.file, 1)
                                                        : "";
    MapKeys given{keys.height_unit, keys.pixel, keys.missing_value, keys.coordinate_unit};
    if (!other.empty() && lacks_units(other, windowed ? settings.indenter.channel : keys.channel) &&
        !lacks_units(path, channel))
        given = {"", {}, keys.missing_value};
    if (windowed && keys.source == Source::profile)
        return read_profile(path, L, settings.run.length_unit, channel, keys.missing, given,
                            keys.thickness, origin);
    HeightMap map = read_heights(path, L, settings.run.length_unit, channel,
                                 part ? Missing::fill : keys.missing, given, origin);
    return part ? part_of(map, keys.window, path) : std::move(map);
}

Surface read_map(const Case& settings, const std::string& path, std::optional<double> L,
                 const std::string& channel, bool windowed = false) {
    const auto& keys = settings.surface;
    Surface surface;
    MapOrigin origin;
    surface.map = read_raw_map(settings, path, L, channel, windowed, &origin);
    surface.name = path;
    try {
        auto measured = std::make_shared<Measured>(measure(
            surface.map,
            {keys.missing, keys.detrend, keys.filter_cutoff, keys.outliers, keys.cutoff_long,
             keys.profile_surface == ProfileSurface::inversion, keys.aspect, keys.direction}));
        measured->channel = origin.channel;
        measured->code = origin.code;
        measured->coded = origin.coded;
        surface.measured = std::move(measured);
    } catch (const Error& error) {
        throw Error(error.kind(), path, ": ", error.what());
    }
    surface.sigma = surface.measured->parameters.sq;
    return surface;
}

SurfaceModel read_list(const Case& settings) {
    const auto& keys = settings.surface;
    SurfaceModel model;
    model.asperities = read_asperities(keys.file, settings.run.length_unit);
    model.domain = list_domain(model.asperities, keys.L, "the asperities in " + keys.file);
    make_law(law_of(settings, model.domain), model.asperities,
             1);  // refuses asperities without the properties that the law needs
    model.statistics.summits = std::int64_t(model.asperities.size());
    model.statistics.sigma = model.domain.sigma;
    model.list = true;
    return model;
}

}  // namespace

Spectrum spectrum_of(const Case& settings) {
    const auto& keys = settings.surface;
    if (keys.source == Source::spectrum) {
        const auto found =
            read_spectrum(keys.file, settings.run.length_unit, keys.twins == Twins::directional,
                          keys.twin_heights == TwinHeights::measured);
        Spectrum spectrum =
            tabulated_spectrum(found.table, keys.L.value_or(2 * pi / found.table->lowest()),
                               keys.sigma.value_or(found.sigma));
        spectrum.aspect = keys.aspect;
        spectrum.direction = keys.direction;
        spectrum.shape = {keys.skewness, keys.kurtosis};
        spectrum.heights = found.heights;
        return spectrum;
    }
    return self_affine_spectrum(settings);
}

bool differs_by_realization(const Case& settings) {
    return has_spectrum(settings) || (reads_heights(settings) && is_pattern(settings.surface.file));
}

HeightMap read_points(const Case& settings, std::int64_t number) {
    return read_raw_map(settings, map_file(settings.surface.file, number), settings.surface.L,
                        settings.surface.channel, true, nullptr);
}

bool has_spectrum(const Case& settings) {
    return settings.surface.source == Source::synthetic ||
           settings.surface.source == Source::spectrum;
}

Surface make_surface(const Case& settings, const Spectrum& spectrum, std::int64_t number,
                     int threads, const RowSource::Filter& filter) {
    const auto& keys = settings.surface;
    Surface surface;
    surface.sigma = spectrum.sigma;
    surface.points_per_wave = keys.n / shortest_wave(spectrum);
    surface.theory = theoretical_moments(spectrum);
    surface.irregular = spectrum.directional() || !spectrum.gaussian();
    const RowSource source(spectrum, keys.n, keys.normalise, settings.run.seed, number, threads);
    surface.sampled = source.sampled();
    surface.differences = source.differences();
    surface.map = source.all(threads, filter);
    return surface;
}

Surface make_surface(const Case& settings, std::int64_t number, int threads) {
    if (has_spectrum(settings))
        return make_surface(settings, spectrum_of(settings), number, threads);
    if (reads_heights(settings)) {
        Surface surface = read_map(settings, map_file(settings.surface.file, number),
                                   settings.surface.L, settings.surface.channel, true);
        surface.map.periodic = settings.indentation.boundary == Boundary::periodic;
        return surface;
    }
    bad_input("&surface: source = 'asperities' has no heights, only summits");
}

int element_points(const Case& settings, const Spectrum& spectrum) {
    return fast_size(int(std::ceil(settings.elements.points_per_wave * shortest_wave(spectrum))),
                     2);
}

std::string too_large_for_elements(const Case& settings, const Spectrum& spectrum) {
    const double points_per_wave = settings.elements.points_per_wave,
                 requested = points_per_wave * shortest_wave(spectrum);
    constexpr double most = 32768;
    if (requested > most)
        return format(
            "&elements points_per_wave = %g: gives a grid of %.0f points a side; the maximum is "
            "%.0f",
            points_per_wave, requested, most);
    const int n = element_points(settings, spectrum);
    // Memory for two flats: heights, the pressures on some pixels, transforms in single and double
    // precision.
    const bool periodic = settings.indentation.boundary == Boundary::periodic;
    const double elastic = reads_high_points(settings) ? 3.0 : 8.0,
                 bytes = (periodic ? 28.0 : elastic) * n * n;
    const double memory = machine_memory();
    constexpr double beside = 1.5;  // first the modes during synthesis, later the pixels in contact
    if (beside * bytes <= memory) return {};
    return format(
        "&elements points_per_wave = %g: %s, %d x %d points, need %.3g GB, but the machine has "
        "%.3g GB of memory; use fewer points per wave "
        "or a smaller surface%%L_lambda_s",
        points_per_wave, periodic ? "heights and their transforms" : "the heights", n, n,
        1e-9 * bytes, 1e-9 * memory);
}

// Values between start and stop, both included.
std::vector<double> spaced(const Case::Indentation& keys) {
    if (!keys.levels.empty()) return keys.levels;
    std::vector<double> values(at(keys.steps));
    for (const auto k : indices(values)) {
        const double t = keys.steps > 1 ? double(k) / (keys.steps - 1) : 0.0;
        values[k] = keys.spacing == Spacing::log ? keys.start * std::pow(keys.stop / keys.start, t)
                                                 : keys.start + t * (keys.stop - keys.start);
    }
    if (keys.steps > 1) values.back() = keys.stop;  // exactly
    return values;
}

bool reads_high_points(const Case& c) {
    const std::vector<double> levels = spaced(c.indentation);
    return has_spectrum(c) && !levels.empty() && c.indentation.boundary == Boundary::free &&
           c.indentation.control == Control::separation &&
           std::ranges::all_of(levels, [](double level) { return level > 0; }) &&
           c.indenter.file.empty() && !path_dependent(c) && !c.output.heights &&
           c.output.fields.empty();
}

Surface make_element_surface(const Case& settings, std::int64_t number, int threads,
                             const Indenter* indenter, std::span<const double> levels) {
    if (!has_spectrum(settings)) return make_surface(settings, number, threads);
    const Spectrum spectrum = spectrum_of(settings);
    if (const std::string why = too_large_for_elements(settings, spectrum); !why.empty())
        bad_input(why);
    Case finer = settings;
    finer.surface.n = element_points(settings, spectrum);
    if (!indenter || !reads_high_points(settings))
        return make_surface(finer, spectrum, number, threads);
    // Faces are nowhere below 0, so that a height of 0 lies below the indenter at every separation
    // above 0. The highest point is kept.
    const double step = spectrum.L / finer.surface.n, least = std::ranges::min(levels) * (1 - 1e-9);
    std::atomic<double> top = -kInfinity;
    Surface surface = make_surface(
        finer, spectrum, number, threads, [&](int row, int first, int count, const double* z) {
            double before = top, highest = -kInfinity;
            const double from = std::min(least, before);
            for (const int k : indices(count))
                if (z[k] > from)
                    highest = std::max(highest,
                                       indenter->clearance((first + k) * step, row * step, z[k]));
            while (highest > before && !top.compare_exchange_weak(before, highest)) {
            }
            return highest > from;
        });
    const bool complete = top == -kInfinity;  // made in another order, with all heights
    return complete || top > 0 ? std::move(surface)
                               : make_surface(finer, spectrum, number, threads);
}

SurfaceDomain synthetic_domain(const Spectrum& spectrum, int n) {
    const Moments theory = theoretical_moments(spectrum);
    SurfaceDomain domain{{0, 0, spectrum.L, spectrum.L}, {}};
    domain.sigma = spectrum.sigma;
    domain.mean_spacing = theory.mean_spacing();
    domain.points_per_wave = n / spectrum.L_lambda_s;
    domain.grid_step = spectrum.L / n;
    domain.gentlest_slope = theory.tensor.gentlest_slope();
    domain.repeats = true;
    domain.measured = spectrum.directional() || !spectrum.gaussian();
    return domain;
}

SurfaceDomain list_domain(const Asperities& asperities, std::optional<double> L,
                          const std::string& whose) {
    const auto [left, right] = std::ranges::minmax(asperities.x);
    const auto [below, above] = std::ranges::minmax(asperities.y);
    const double extent = std::max(right - left, above - below);
    if (L && extent > *L)
        bad_input("surface%L = ", *L, " is less than the extent of ", whose, ", ", extent);
    SurfaceDomain domain;
    if (L && std::min(left, below) >= 0 && std::max(right, above) <= *L) {
        domain = {{0, 0, *L, *L}, {}};
    } else {
        const double side = L.value_or(extent > 0 ? extent : 1.0);
        domain = {
            {0.5 * (left + right) - 0.5 * side, 0.5 * (below + above) - 0.5 * side, side, side},
            {}};
    }
    domain.sigma = rms(asperities.z);
    domain.guessed = !L;
    domain.richest_law = asperities.kappa1.empty()       ? LawKind::hertz
                         : asperities.biharmonic.empty() ? LawKind::elliptic
                                                         : LawKind::fourth_order;
    if (L || extent > 0)
        domain.mean_spacing = std::sqrt(domain.Lx * domain.Ly / double(asperities.size()));
    return domain;
}

std::shared_ptr<const MapMarks> marks_of(const HeightMap& map, const Breaks& breaks) {
    auto marks = std::make_shared<MapMarks>();
    const auto border = [&](int i, int j) {
        marks->border.push_back({map.x(i), map.y(j), map(i, j)});
    };
    for (const int i : indices(map.nx)) {
        border(i, 0);
        border(i, map.ny - 1);
    }
    for (int j = 1; j < map.ny - 1; ++j) {
        border(0, j);
        border(map.nx - 1, j);
    }
    for (const Breaks::Place& spike : breaks.spikes)
        marks->spikes.push_back({map.x(spike.i), map.y(spike.j)});
    marks->reach = map.step();
    return marks;
}

SurfaceModel make_surface_model(const Surface& surface, const Case& settings, int threads) {
    const HeightMap& map = surface.map;
    SurfaceModel model = make_bare_model(surface);
    if (by_elements(settings)) {
        model.points = std::make_shared<HeightMap>(map.copy());
        return model;
    }
    SummitCount count;
    const auto& measured = surface.measured;
    // Rounded heights have plateaus, so that summits are found on a smoothed surface.
    const double step = surface.theory ? 0 : measured ? measured->height_step : height_step(map);
    auto breaks = std::make_shared<Breaks>();
    if (!surface.theory) *breaks = measured ? measured->breaks : find_breaks(map, step);
    auto seen = std::make_shared<HeightMap>(map.copy());
    if (!breaks->pits.empty()) raise_pits(*seen, *breaks);
    if (step > 0) smooth_rounded(*seen, step);
    model.asperities = find_asperities(*seen, settings.asperities.curvature, &count, threads,
                                       detail_of(settings), surface.points_per_wave, breaks.get());
    require_summits(model, surface.name, map.periodic ? "" : " inside the map");
    if (!surface.theory)
        model.domain.mean_spacing =
            std::sqrt(map.Lx() * map.Ly() / double(model.asperities.size()));
    if (!map.periodic) model.domain.marks = marks_of(map, *breaks);
    count_summits(count, model.statistics);
    return model;
}

SurfaceModel make_bare_model(const Surface& surface) {
    const HeightMap& map = surface.map;
    SurfaceModel model;
    model.measured = surface.measured;
    model.domain = {{map.x0, map.y0, map.Lx(), map.Ly()}, {}};
    model.domain.measured = surface.irregular;
    if (!surface.theory) {
        model.domain.half_step_x = 0.5 * map.dx;
        model.domain.half_step_y = 0.5 * map.dy;
    }
    model.domain.repeats = map.periodic;
    model.domain.sigma = surface.sigma;
    model.domain.points_per_wave =
        model.measured ? model.measured->points_per_wave() : surface.points_per_wave;
    model.domain.grid_step = map.step();
    if (surface.theory) {
        model.domain.mean_spacing = surface.theory->mean_spacing();
        model.curvature = curvature_at_unit_height(*surface.theory);
    }
    auto& s = model.statistics;
    const Moments grid = surface.differences ? *surface.differences
                         : surface.measured  ? surface.measured->moments
                                             : grid_moments(map);
    s.sigma = surface.sigma;
    s.m2 = s.m2_grid = grid.m2;
    s.m4 = s.m4_grid = grid.m4;
    s.tensor = grid.tensor;
    if (surface.sampled) set_sampled(*surface.sampled, s);
    model.domain.gentlest_slope = s.tensor.gentlest_slope();
    return model;
}

SurfaceModel make_surface_model(const Case& settings, const Spectrum& spectrum, std::int64_t number,
                                int threads) {
    const auto& keys = settings.surface;
    SurfaceModel model;
    model.domain = synthetic_domain(spectrum, keys.n);
    SummitCount count;
    Moments sampled, differences;
    model.asperities = make_asperities(spectrum, keys.n, keys.normalise, settings.run.seed, number,
                                       settings.asperities.curvature, &count, &sampled, threads,
                                       detail_of(settings), &differences);
    require_summits(model, "the surface", "");
    auto& s = model.statistics;
    set_sampled(sampled, s);
    s.m2_grid = differences.m2;
    s.m4_grid = differences.m4;
    count_summits(count, s);
    model.domain.gentlest_slope = s.tensor.gentlest_slope();
    return model;
}

SurfaceModel make_surface_model(const Case& settings, std::int64_t number, int threads) {
    if (by_elements(settings)) {
        Surface surface = make_element_surface(settings, number, threads);
        SurfaceModel model = make_bare_model(surface);
        if (has_spectrum(settings))
            model.domain = synthetic_domain(spectrum_of(settings), settings.surface.n);
        model.points = std::make_shared<HeightMap>(std::move(surface.map));
        return model;
    }
    if (has_spectrum(settings))
        return make_surface_model(settings, spectrum_of(settings), number, threads);
    if (settings.surface.source == Source::asperities) return read_list(settings);
    return make_surface_model(make_surface(settings, number, threads), settings, threads);
}

Shape shape_of(const Case& settings) {
    const Case::IndenterKeys& keys = settings.indenter;
    ShapeKeys made;
    made.R = settings.solids.R[1];
    made.R_rough = settings.solids.R[0];
    const GapRadii gap = gap_radii(settings);
    if (kShapes[at(keys.shape)].make == make_paraboloid)
        for (const int k : indices(2)) made.radii[k] = equivalent_radius(gap.R[k]);
    made.angle = gap.angle * pi / 180;
    made.slope = keys.slope.value_or(0);
    made.radius = keys.radius.value_or(0);
    made.rim_radius = keys.rim_radius;
    if (!keys.file.empty()) {
        Surface second = read_map(settings, keys.file, std::nullopt, keys.channel);
        made.report = report(*second.measured, settings.run.length_unit);
        made.filled = second.measured->filled;
        made.m2 = second.measured->moments.m2;
        SummitCount count;
        if (!by_elements(settings))
            (void)find_asperities(second.map, settings.asperities.curvature, &count, 1);
        if (count.summits > 0)
            made.spacing = std::sqrt(second.map.Lx() * second.map.Ly() / double(count.summits));
        made.shortest_wave =
            second.measured->points_per_wave() * std::max(second.map.dx, second.map.dy);
        auto map = std::make_shared<HeightMap>(std::move(second.map));
        map->periodic = settings.indentation.boundary != Boundary::free;
        made.map = std::move(map);
    }
    return make_shape(keys.shape, made);
}

}  // namespace rsc
