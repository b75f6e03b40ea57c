#include "run/job.hpp"

#include "asperities/ranking.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "case/registry.hpp"
#include "contact/make.hpp"
#include "elements/deformed.hpp"
#include "io/inputs.hpp"
#include "physics/physics.hpp"
#include "surface/synthesis.hpp"
#include "trust/grid_error.hpp"
#include "trust/judge.hpp"

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
    if (!job.spectrum) return job.given ? job.given->statistics.m2 + other : kAbsent;
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
    for (int j = 0; job.given && job.given_heights && j < job.given_heights->ny; ++j) {
        const HeightMap& map = *job.given_heights;
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

// The levels whose fields are requested, in ascending order: the nearest to each of
// output%field_levels.
std::vector<std::int32_t> steps_of_fields(const Job& job) {
    const auto& keys = job.settings.output;
    if (keys.fields.empty()) return {};
    std::vector<std::int32_t> steps;
    for (const double wanted : keys.field_levels)
        steps.push_back(job.slides ? nearest_level(job.times, wanted)
                                   : nearest_level(job.levels, wanted * job.level_unit));
    if (steps.empty()) steps.push_back(std::int32_t(job.levels.size()) - 1);
    return steps;
}

// In the order of ObserveOptions::curves.
using Recorders = std::vector<std::unique_ptr<LevelRecorder>>;

// Numbers of the fields of a physics that the case asks for.
std::vector<std::size_t> rows_asked(const Job& job, const Physics& physics) {
    std::vector<std::size_t> rows;
    for (const auto k : indices(physics.fields))
        if (has_field(job.settings, physics.fields[k].name)) rows.push_back(k);
    return rows;
}

FieldsAsked fields_asked(const Job& job, const Recorders& recorders) {
    const Case& settings = job.settings;
    const auto& w = settings.output.field_window;
    FieldsAsked asked;
    asked.pressure = has_field(settings, "pressure");
    asked.gap = has_field(settings, "gap");
    asked.contact = has_field(settings, "contact");
    asked.heights = has_field(settings, "heights");
    asked.worn = any_physics(settings, &Physics::reshapes);
    for (const auto k : indices(recorders))
        if (const AskedCurves& of = job.observe.curves[k]; true)
            if (std::vector<std::size_t> rows = rows_asked(job, *of.physics); !rows.empty())
                asked.physics.push_back({&of, recorders[k].get(), std::move(rows)});
    if (w[0]) asked.window = {*w[0], *w[1], *w[2], *w[3]};
    return asked;
}

// A contact and the judge of its levels.
struct Pressed {
    std::unique_ptr<Path> contact;
    Judge judge;
    const HeightMap* map;  // of elements
    const Recorders* recorders;
};
using MakePressed = std::function<Pressed()>;

// Solves level k of the case. `complete` adds what its status depends on.
Level press(const Job& job, std::size_t k, Pressed& pressed,
            const std::function<void(Level&)>& complete) {
    const bool by_force = job.settings.indentation.control != Control::separation;
    Path& contact = *pressed.contact;
    if (!job.times.empty()) contact.set_time(job.times[k]);
    Level level = by_force ? contact.at_force(job.levels[k]) : contact.at_separation(job.levels[k]);
    if (!job.times.empty()) (job.slides ? level.distance : level.time) = job.times[k];
    const auto& resistivity = job.settings.solids.resistivity;
    const FieldsAsked fields = fields_asked(job, *pressed.recorders);
    LevelSource source{
        .contact = contact,
        .level = level,
        .resistivity = {resistivity[0], resistivity[1]},
        .physics = &job.solver.physics,
        .map = pressed.map,
        .for_fields = !fields.physics.empty() && contains(steps_of_fields(job), std::int32_t(k)),
        .gap_bins = job.observe.pdf.gap_max > 0 ? job.observe.pdf.bins : 0,
        .gap_bin = job.observe.pdf.gap_width()};
    compute_quantities(source, &job.settings);
    complete(level);
    if (source.for_fields && !std::isnan(level.force))
        for (const FieldsAsked::OfPhysics& one : fields.physics)
            level.fields.push_back(one.recorder->fields_at(source));
    pressed.judge.judge(level, contact, by_force);
    return level;
}

// Whether levels are solved in groups: first the first ones of all groups, one from another, then
// the others, which begin with the first of their group. The loops of levels with few points are
// too short to be shared by many threads. The groups, and with them the results, are the same for
// any number of threads.
bool independent_levels(const Job& job, const Pressed& first) {
    return by_elements(job.settings) && job.times.empty() && !first.contact->path_dependent() &&
           job.levels.size() >= kFewestGroups * kGroup &&
           std::ranges::none_of(*first.recorders, [](const auto& r) { return r->in_order(); });
}

class LevelGroups {
public:
    // Calls take(k, level) for all levels in their order, on this thread, soon after they are
    // known.
    LevelGroups(const Job& job, Pressed& first, const MakePressed& make,
                std::function<void(std::size_t, Level)> take)
        : job_(job), first_(first), make_(make), take_(std::move(take)) {}

    void press_all(int threads) {
        std::int32_t points = 0;
        for (const auto g : indices(groups_)) {
            Level& level = levels_[g * kGroup].emplace(press(job_, g * kGroup, first_, none));
            points = std::max(points, level.candidates);
            begin_[g] = first_.contact->state();
            // The others start from levels of several groups, not from earlier solutions.
            begin_[g].solution.clear();
            if (g == 0) take_(taken_++, std::move(level));
        }
        if (points > kFewPoints) {
            for (const auto g : indices(groups_)) {
                press_group(g, first_);
                take_solved();
            }
            return;
        }
        std::vector<std::optional<Pressed>> of_worker(most_threads(threads));
        parallel_pieces(groups_, threads, [&](std::size_t g, std::size_t worker) {
            if (worker > 0 && !of_worker[worker]) of_worker[worker].emplace(make_());
            press_group(g, worker > 0 ? *of_worker[worker] : first_);
            if (worker == 0) take_solved();
        });
        take_solved();
    }

private:
    static void none(Level&) {}

    void press_group(std::size_t g, Pressed& pressed) {
        pressed.contact->forget();
        pressed.contact->restore(begin_[g]);
        // The second level starts from those between which it lies.
        for (std::size_t from = std::min(g + 2, groups_); from-- > g;)
            if (const auto& level = begin_[from].level) pressed.contact->start_from(*level);
        for (std::size_t k = g * kGroup + 1; k < std::min(levels_.size(), (g + 1) * kGroup); ++k)
            levels_[k] = press(job_, k, pressed, none);
        const std::lock_guard lock(mutex_);
        solved_[g] = 1;
    }

    void take_solved() {
        const auto next_is_solved = [&] {
            const std::lock_guard lock(mutex_);
            return taken_ < levels_.size() && solved_[taken_ / kGroup];
        };
        for (; next_is_solved(); ++taken_) {
            take_(taken_, std::move(*levels_[taken_]));
            levels_[taken_].reset();
        }
    }

    const Job& job_;
    Pressed& first_;
    const MakePressed& make_;
    std::function<void(std::size_t, Level)> take_;
    std::vector<std::optional<Level>> levels_ =
        std::vector<std::optional<Level>>(job_.levels.size());
    std::size_t groups_ = (levels_.size() + kGroup - 1) / kGroup, taken_ = 0;
    std::vector<Path::State> begin_ = std::vector<Path::State>(groups_);
    std::vector<char> solved_ = std::vector<char>(groups_, 0);
    std::mutex mutex_;
};

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
        job.given_heights = std::move(surface.map);
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
    if (!job.given || !job.given_heights) return highest;
    const HeightMap& map = *job.given_heights;
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
    if (job.given_heights) {
        side = job.given_heights->step();
        points = double(job.given_heights->nx) * job.given_heights->ny;
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
        (job.given_heights || (job.spectrum && job.indenter.shape->flat())))
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

namespace {

// The surface of a realization, and what is needed to solve and judge its levels.
struct Prepared {
    JudgedSurface judged;
    const HeightMap* map = nullptr;  // of elements
    std::shared_ptr<const Measured> measured;
    SolverOptions solver;
};

void prepare_elements(const Job& job, std::int64_t number, int threads, Realization& r,
                      Prepared& s) {
    const auto& settings = job.settings;
    if (job.given) {
        r.statistics = job.given->statistics;
    } else {
        Surface surface =
            make_element_surface(settings, number, threads, &job.indenter, job.levels);
        if (!job.spectrum) move_to(job.domain, surface.map, number);  // one of several maps
        r.statistics = make_bare_model(surface).statistics;
        s.measured = surface.measured;
        r.heights = std::move(surface.map);
    }
    s.map = job.given ? &*job.given_heights : &*r.heights;
    s.judged.map = s.map;
    if (job.theory) s.judged.curvature = curvature_at_unit_height(*job.theory);
}

void prepare_asperities(const Job& job, std::int64_t number, int threads, Realization& r,
                        Prepared& s) {
    const auto& settings = job.settings;
    if ((settings.output.heights || !settings.output.fields.empty()) && job.spectrum)
        r.heights = make_surface(settings, *job.spectrum, number, threads).map;
    SurfaceModel model;
    if (job.spectrum) {
        model = make_surface_model(settings, *job.spectrum, number, threads);
    } else if (job.given) {
        model = *job.given;
    } else {  // one of several maps
        Surface surface = make_surface(settings, number, threads);
        move_to(job.domain, surface.map, number);
        model = make_surface_model(surface, settings, threads);
        s.measured = surface.measured;
    }
    r.asperities = std::move(model.asperities);
    r.statistics = model.statistics;
    s.solver.surface.gentlest_slope = model.domain.gentlest_slope;
}

Prepared prepared_surface(const Job& job, std::int64_t number, int threads, Realization& r) {
    Prepared s;
    s.measured = job.given ? job.measured : nullptr;
    s.solver = job.solver;
    (by_elements(job.settings) ? prepare_elements : prepare_asperities)(job, number, threads, r, s);
    s.judged.measured = s.measured.get();
    s.judged.x0 = job.domain.x0;
    s.judged.y0 = job.domain.y0;
    return s;
}

const HeightMap& heights_of(const Job& job, const Realization& r) {
    return job.given_heights ? *job.given_heights : *r.heights;
}

// The state of a level of which fields are requested.
FieldLevel field_level(const Job& job, const Realization& r, Path& contact, std::size_t k,
                       Level& level) {
    const auto yielding = contact.asperities();
    return {std::int32_t(k), &level,
            yielding ? lowered_summits(heights_of(job, r), job.indenter.period.finite(), *yielding,
                                       contact.residual_depths())
                     : contact.residual_profile(),
            contact.lasting_loads(level), std::move(level.fields)};
}

}  // namespace

Realization realize(const Job& job, std::int64_t number, int threads,
                    const std::function<void(std::size_t, const Level&)>& on_level) {
    Realization r;
    const auto& settings = job.settings;
    const Prepared surface = prepared_surface(job, number, threads, r);
    const HeightMap* const map = surface.map;
    const SolverOptions& solver = surface.solver;
    const auto make_contact = [&] {
        return map ? make_element_contact(*map, job.indenter, job.solver)
                   : make_asperity_contact(r.asperities, job.indenter, solver);
    };
    Recorders recorders;
    for (const AskedCurves& of : job.observe.curves)
        recorders.push_back(
            of.physics->recorder({settings, job.indenter, map, of.axis.values, make_contact}));
    r.levels.reserve(job.levels.size());
    const std::vector<std::int32_t> field_steps = steps_of_fields(job);
    const MakePressed make = [&] {
        return Pressed{make_contact(), Judge(solver, surface.judged), map, &recorders};
    };
    Pressed pressed = make();
    std::unique_ptr<Path>& contact = pressed.contact;
    std::vector<FieldLevel> fields;
    const std::size_t each = values_of(job.observe.curves);
    const auto record = [&](const Level& level) {
        bool solved = true;
        for (const auto& recorder : recorders) solved = recorder->record(level, r.curves) && solved;
        return solved;
    };
    const bool grouped = independent_levels(job, pressed);
    const auto take = [&](std::size_t k, Level solved) {
        Level& level = r.levels.emplace_back(std::move(solved));
        const bool field = contains(field_steps, std::int32_t(k));
        if (field && !std::isnan(level.force))  // a level without a state has none
            fields.push_back(field_level(job, r, *contact, k, level));
        if (grouped) record(level);
        if (map)
            state_curve_errors(std::span(r.curves).last(each), job.observe.curves, map->step(),
                               settings, level,
                               grid_bodies(job.spectrum ? job.indenter.shape->keys().map != nullptr
                                                        : job.solver.surface.measured,
                                           job.indenter));
        if (on_level) on_level(k, level);
    };
    if (grouped)
        LevelGroups(job, pressed, make, take).press_all(threads);
    else
        for (const auto k : indices(job.levels))
            take(k, press(job, k, pressed, [&](Level& level) {
                     if (!record(level)) level.converged = false;
                 }));
    r.residual_depth = contact->residual_depths();
    r.residual_profile = contact->residual_profile();
    if (!fields.empty())
        r.fields = fields_of(heights_of(job, r), job.indenter, job.solver.interaction, fields,
                             fields_asked(job, recorders));
    if (const auto touched = contact->asperities(); touched && touched.get() != &r.asperities) {
        Asperities used = *touched;
        recorders.clear();
        contact.reset();
        r.asperities = std::move(used);
    }
    contact.reset();
    if (!settings.output.heights) r.heights.reset();
    if (any_physics(settings, &Physics::reshapes)) {
        if (settings.output.heights) r.heights = lowered_map(*map, r.residual_profile);
        r.residual_profile = {};
    }
    return r;
}

}  // namespace rsc
