#include "run/realize.hpp"

#include "base/parallel.hpp"
#include "elements/deformed.hpp"
#include "physics/physics.hpp"

namespace rsc {
namespace {

// Levels of elements that do not depend on each other are solved in groups of this many, if there
// are at least kFewestGroups of them; groups whose levels have at most kFewPoints candidates side
// by side, by a contact for each thread.
constexpr std::size_t kGroup = 8, kFewestGroups = 4;
constexpr std::int32_t kFewPoints = 200000;

// The levels whose fields are requested, in ascending order: the nearest to each of
// output%field_levels.
std::vector<std::int32_t> steps_of_fields(const Job& job) {
    const auto& keys = job.settings.output;
    if (keys.fields.empty()) return {};
    std::vector<std::int32_t> steps;
    for (const double requested : keys.field_levels)
        steps.push_back(job.slides ? nearest_level(job.times, requested)
                                   : nearest_level(job.levels, requested * job.level_unit));
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
            if (points <= kFewPoints) begin_[g] = first_.contact->state();
            if (g == 0) take_(taken_++, std::move(level));
        }
        if (points > kFewPoints) {
            begin_.clear();
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
        // The second level starts from those between which it lies: the last two of this state.
        if (!begin_.empty()) pressed.contact->restore(begin_[std::min(g + 1, groups_ - 1)]);
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

// The state of a level of which fields are requested.
FieldLevel field_level(const RoughBody& body, Path& contact, std::size_t k, Level& level) {
    const auto yielding = contact.asperities();
    auto [depths, profile, loads] = contact.remains(level);
    if (yielding)
        profile =
            lowered_summits(*body.heights, contact.indenter().period.finite(), *yielding, depths);
    return {std::int32_t(k), &level, std::move(profile), std::move(loads), std::move(level.fields)};
}

}  // namespace

Realization realize(const Job& job, std::int64_t number, int threads,
                    const std::function<void(std::size_t, const Level&)>& on_level) {
    Realization r;
    const auto& settings = job.settings;
    RoughBody body = rough_body(job, number, threads);
    const HeightMap* const map = body.map;
    r.statistics = body.statistics;
    Recorders recorders;
    for (const AskedCurves& of : job.observe.curves)
        recorders.push_back(of.physics->recorder({settings, job.indenter, map, of.axis.values,
                                                  [&] { return make_contact(job, body); }}));
    r.levels.reserve(job.levels.size());
    const std::vector<std::int32_t> field_steps = steps_of_fields(job);
    const MakePressed make = [&] {
        return Pressed{make_contact(job, body), make_judge(job, body), map, &recorders};
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
            fields.push_back(field_level(body, *contact, k, level));
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
    if (contact->level()) r.remains = contact->remains(*contact->level());
    r.remains.lasting_loads.reset();
    if (!fields.empty())
        r.fields = fields_of(*body.heights, job.indenter, job.solver.interaction, fields,
                             fields_asked(job, recorders));
    const auto touched = contact->asperities();
    const bool shifted = touched && touched.get() != &body.asperities;
    r.asperities = shifted ? *touched : std::move(body.asperities);
    if (settings.output.heights) r.heights = body.heights;
    if (any_physics(settings, &Physics::reshapes)) {
        if (r.heights)
            r.heights = std::make_shared<HeightMap>(lowered_map(*map, r.remains.residual_profile));
        r.remains = {};
    }
    return r;
}

}  // namespace rsc
