#include "problem/job.hpp"

#include "base/error.hpp"
#include "case/registry.hpp"
#include "contact/make.hpp"
#include "io/inputs.hpp"
#include "physics/physics.hpp"
#include "surface/synthesis.hpp"

namespace rsc {
namespace {

// The times, or distances of sliding, of the levels; empty if the case has none.
std::vector<double> times_of(const Job& job, std::size_t levels) {
    const Case::Indentation& keys = job.settings.indentation;
    const std::optional<double>& whole = job.slides ? keys.sliding : keys.duration;
    if (!whole) return job.slides ? keys.distances : keys.times;
    std::vector<double> times(levels, 0.0);
    for (std::size_t k = 1; k < levels; ++k) times[k] = *whole * double(k) / double(levels - 1);
    return times;
}

// The sphere touches every map at the same position, so that all maps must have the same size;
// their origins do not matter.
void move_to(const Domain& place, HeightMap& map, std::int64_t number) {
    constexpr double kSame = 1e-6;
    if (!(std::abs(map.Lx() - place.Lx) <= kSame * place.Lx &&
          std::abs(map.Ly() - place.Ly) <= kSame * place.Ly))
        bad_input("the map of realization ", number, " is ", map.Lx(), " x ", map.Ly(),
                  ", the first is ", place.Lx, " x ", place.Ly, "; maps of one size are expected");
    map.x0 = place.x0;
    map.y0 = place.y0;
}

// As many files as realizations, and all of the size of the first. Only the sizes are read here.
void require_maps(const Case& settings, const Domain& first) {
    const auto files = std::int64_t(matching_files(settings.surface.file).size());
    const std::int64_t last =
        std::int64_t{settings.run.first_realization} + settings.run.realizations - 1;
    if (last > files)
        bad_input(settings.surface.file, ": realizations up to ", last, " are requested, but ",
                  files, " files match");
    for (std::int64_t k = settings.run.first_realization + 1; k <= last; ++k) {
        HeightMap map = read_points(settings, k);
        move_to(first, map, k);
    }
}

// The m2 for relative pressures, common to all realizations: that of the map or of the single
// synthetic surface, or the expectation over the modes of several surfaces; of two rough bodies the
// sum. Negative or NaN: not known.
double m2_of_pressures(const Job& job) {
    const double other = job.indenter.shape->keys().m2;
    if (!job.spectrum) return job.given ? job.given->statistics.m2 + other : kNotComputed;
    const Case& c = job.settings;
    if (c.run.realizations > 1) return discrete_moments(*job.spectrum).m2 + other;
    const int n = 2 * int(std::ceil(shortest_wave(*job.spectrum))) +
                  2;  // the modes are the same on every grid
    return RowSource(*job.spectrum, n, c.surface.normalise, c.run.seed, c.run.first_realization, 1)
               .sampled()
               .m2 +
           other;
}

// Jump of the heights across the border of a periodic map, relative to that between neighbouring
// points (rms).
double seam(const HeightMap& map) {
    double across = 0, within = 0;
    long n_across = 0, n_within = 0;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) {
            const double right = map((i + 1) % map.nx, j) - map(i, j),
                         up = map(i, (j + 1) % map.ny) - map(i, j);
            const bool at_end = i + 1 == map.nx, at_top = j + 1 == map.ny;
            (at_end ? across : within) += right * right;
            ++(at_end ? n_across : n_within);
            if (map.ny == 1) continue;  // constant along y
            (at_top ? across : within) += up * up;
            ++(at_top ? n_across : n_within);
        }
    return std::sqrt(across / double(n_across) / (within / double(n_within)));
}

// The key that asks for the largest pressure, as messages begin.
std::string key_of_largest(const Case::Indentation& keys) {
    return std::string("indentation%") +
           (!keys.levels.empty()     ? "levels"
            : keys.start > keys.stop ? "start"
                                     : "stop") +
           ": ";
}

// Two elastic flats by elements have no level at the separation of their mean planes, where they
// are in full contact, nor below it.
void require_open(const Job& job) {
    if (!job.indenter.period.finite() || any_physics(job.settings, &Physics::lowers) ||
        job.levels.empty())
        return;
    double mean = 0;  // that of a synthetic surface
    for (int j = 0; job.given && job.heights && j < job.heights->ny; ++j) {
        const HeightMap& map = *job.heights;
        double row = 0;
        for (const int i : indices(map.nx))
            row += job.indenter.clearance(map.x(i), map.y(j), map(i, j)) / map.nx;
        mean += row / map.ny;
    }
    constexpr double kRounding = 1e-12;
    const double least = std::ranges::min(job.levels);
    if (!(least > mean + kRounding * job.sigma))
        bad_input(
            format("indentation: a separation of %.9g %s is not above that of full contact, %.9g "
                   "%s; give larger separations, or pressures",
                   least, job.settings.run.length_unit.c_str(),
                   std::abs(mean) > kRounding * job.sigma ? mean : 0.0,
                   job.settings.run.length_unit.c_str()));
}

std::shared_ptr<const HeightMap> share(HeightMap map) {
    return std::make_shared<HeightMap>(std::move(map));
}

// Reads the surface or its spectrum. Returns sqrt(m4), as far as it is known.
double take_surface(Job& job) {
    const Case& settings = job.settings;
    const bool elements = by_elements(settings);
    if (has_spectrum(settings)) {
        job.spectrum = spectrum_of(settings);
        if (elements || settings.compare.listed())
            if (const std::string why = too_large_for_elements(settings, *job.spectrum);
                !why.empty())
                bad_input(why);
        job.domain = synthetic_domain(*job.spectrum, settings.surface.n);
        job.theory = theoretical_moments(*job.spectrum);
        return std::sqrt(job.theory->m4);
    }
    SurfaceModel model;
    if (reads_heights(settings)) {
        Surface surface = make_surface(settings, settings.run.first_realization, 1);
        model = elements ? make_bare_model(surface) : make_surface_model(surface, settings, 1);
        if (surface.map.periodic) job.seam = seam(surface.map);
        job.heights = share(std::move(surface.map));
    } else {
        model = make_surface_model(settings, 1, 1);
    }
    job.domain = model.domain;
    job.measured = model.measured;
    const double sqrt_m4 = model.statistics.m4 > 0 ? std::sqrt(model.statistics.m4)
                           : elements              ? 0.0
                                                   : typical_sqrt_m4(model.asperities);
    if (!differs_by_realization(settings) || settings.run.realizations == 1)
        job.given = std::move(model);
    if (differs_by_realization(settings)) require_maps(settings, job.domain);
    return sqrt_m4;
}

// The highest separation at which a point of the given map touches the indenter.
double highest_touch(const Job& job) {
    double highest = job.points_touch;
    if (!job.given || !job.heights) return highest;
    const HeightMap& map = *job.heights;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx))
            highest = std::max(highest, job.indenter.clearance(map.x(i), map.y(j), map(i, j)));
    return highest;
}

// The unit of nominal pressures as forces. Refuses pressures that no contact or model can bear.
double unit_of_pressures(const Job& job) {
    const Case& settings = job.settings;
    const auto& indentation = settings.indentation;
    const bool elements = by_elements(settings);
    const double m2 = m2_of_pressures(job), full = job.indenter.E_star * std::sqrt(2 * m2);
    const bool relative = indentation.unit == LevelUnit::relative;
    if (relative && !(m2 > 0)) {
        bad_input(
            "indentation%unit = 'relative': the rms slope of the surface is not known, only its "
            "summits; use unit = 'pressure'");
    }
    const double unit = relative ? full : 1.0;
    for (double level : job.levels) {
        if (!elements && level * unit >= kClosingPressure * full)
            bad_input(key_of_largest(settings.indentation),
                      format("a pressure of %g: at E* sqrt(2 m2) = %g and above less than 5 %% of "
                             "the area is gap, too little for the asperity model; use "
                             "solver%%model = 'elements', which is valid up to full contact",
                             level * unit, full));
        for (const Physics* p : physics_asked(settings))
            if (const double most = p->largest_pressure
                                        ? p->largest_pressure(physics_of(settings), kInfinity)
                                        : kInfinity;
                !(level * unit < most))
                bad_input(key_of_largest(settings.indentation),
                          format("a nominal pressure of %.9g exceeds the %s, %.9g", level * unit,
                                 p->name, most));
    }
    return unit * job.indenter.period.area();
}

PreparedFacts facts_of(const Job& job) {
    const bool elements = by_elements(job.settings);
    double side = 0, points = 0;
    if (job.heights) {
        side = job.heights->step();
        points = double(job.heights->nx) * job.heights->ny;
    } else if (elements && job.spectrum) {
        const double n = element_points(job.settings, *job.spectrum);
        side = job.spectrum->L / n;
        points = n * n;
    }
    return {job.settings,
            job.indenter,
            job.theory,
            job.sigma,
            side,
            points,
            side > 0 ? side : job.domain.grid_step,
            std::min(job.domain.Lx, job.domain.Ly),
            elements};
}

// Refuses what asperities or elements cannot resolve or hold in memory.
void require_feasible(const Job& job, const PreparedFacts& facts) {
    if (facts.elements && job.settings.indentation.control == Control::separation &&
        (job.heights || (job.spectrum && job.indenter.shape->flat())))
        require_open(job);
    for (const Physics* p : physics_asked(job.settings))
        if (p->require_feasible) p->require_feasible(facts);
}

}  // namespace

Job prepare(const Case& settings) {
    Job job;
    job.settings = settings;
    const double sqrt_m4 = take_surface(job);
    job.sigma = sigma_of(settings, job.domain);
    if (!(job.sigma > 0)) {
        bad_input(
            "surface%sigma: the rms height of the data read is 0; give a sigma > 0 (it scales "
            "unit='sigma' and solver%delta0), and unit='length' if the levels are lengths");
    }
    job.solver = solver_of(settings, job.domain);
    job.indenter = indenter_of(settings, job.domain);

    job.points_touch = highest_touch(job);

    const auto& indentation = settings.indentation;
    job.levels = spaced(indentation);
    job.slides = indentation.slides();
    job.times = times_of(job, job.levels.size());
    if (indentation.control == Control::separation && indentation.unit == LevelUnit::sigma)
        job.level_unit = job.sigma;
    if (indentation.control == Control::pressure) job.level_unit = unit_of_pressures(job);
    for (double& level : job.levels) level *= job.level_unit;
    const PreparedFacts facts = facts_of(job);
    require_feasible(job, facts);
    job.observe = observe_options(settings, job.domain, job.indenter, job.sigma, sqrt_m4);
    for (const Physics* p : physics_asked(settings))
        if (p->recorder) job.observe.curves.push_back({p, p->axis ? p->axis(facts) : CurveAxis{}});
    return job;
}

RoughBody rough_body(const Job& job, std::int64_t number, int threads) {
    const Case& settings = job.settings;
    RoughBody body;
    body.heights = job.given ? job.heights : nullptr;
    body.measured = job.given ? job.measured : nullptr;
    body.solver = job.solver;
    SurfaceModel model;
    if (job.given) {
        model = *job.given;
    } else if (job.spectrum && !by_elements(settings)) {
        model = make_surface_model(settings, *job.spectrum, number, threads);
        if (settings.output.heights || !settings.output.fields.empty())
            body.heights = share(make_surface(settings, *job.spectrum, number, threads).map);
    } else {
        const bool elements = by_elements(settings);
        Surface surface =
            elements ? make_element_surface(settings, number, threads, &job.indenter, job.levels)
                     : make_surface(settings, number, threads);
        if (!job.spectrum) move_to(job.domain, surface.map, number);  // one of several maps
        model =
            elements ? make_bare_model(surface) : make_surface_model(surface, settings, threads);
        body.measured = surface.measured;
        body.heights = share(std::move(surface.map));
    }
    body.asperities = std::move(model.asperities);
    body.statistics = model.statistics;
    if (by_elements(settings)) {
        body.map = body.heights.get();
        if (job.theory) body.curvature = curvature_at_unit_height(*job.theory);
    } else {
        body.solver.surface.gentlest_slope = model.domain.gentlest_slope;
    }
    return body;
}

std::unique_ptr<Path> make_contact(const Job& job, const RoughBody& body) {
    return body.map ? make_element_contact(*body.map, job.indenter, body.solver)
                    : make_asperity_contact(body.asperities, job.indenter, body.solver);
}

Judge make_judge(const Job& job, const RoughBody& body) {
    return {body.solver, JudgedSurface{body.map, body.curvature, body.measured.get(), job.domain.x0,
                                       job.domain.y0}};
}

}  // namespace rsc
