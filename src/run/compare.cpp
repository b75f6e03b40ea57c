#include "run/compare.hpp"

#include "base/error.hpp"
#include "contact/make.hpp"
#include "physics/physics.hpp"
#include "run/memory.hpp"
#include "run/screen.hpp"
#include "trust/judge.hpp"

namespace rsc {
namespace {

// The grid of elements is refined up to these numbers of points, all and under the indenter, and
// compare%levels = 'auto' compares up to these: about a minute, and two seconds.
constexpr ElementSize kRefine{1 << 28, 1 << 25}, kAuto{1 << 24, 1 << 18};

bool within(const ElementSize& size, const ElementSize& most, double times = 1) {
    return times * size.points <= most.points && times * size.under <= most.under;
}

// "A = 1.2 mm2 (itself +- 0.4 %)"
std::string itself(double error) {
    return std::isnan(error) ? " (error unknown)"
                             : format(" (itself +- %s)", percent(error).c_str());
}

void print(std::ostream& out, const Job& job, const ComparedLevel& c, const LevelValues& asperities,
           bool by_force) {
    const auto [l, f, time] = units_of(job);
    if (std::isnan(c.force)) {
        out << format("level %d: ELEMENTS DID NOT CONVERGE, raise solver%%max_iterations\n",
                      c.step + 1);
        return;
    }
    out << format(
        "level %d, Z0/sigma = %.5g: elements on %d x %d points N = %.6g %s%s, A = %.5g %s2%s, %d "
        "contacts; asperities ",
        c.step + 1, c.separation / job.sigma, c.columns, c.rows, c.force, f,
        by_force ? "" : itself(c.force_error_expected).c_str(), c.area, l,
        itself(c.area_error_expected).c_str(), c.contacts);
    if (std::isnan(asperities.force))
        out << "did not converge\n";
    else if (std::isnan(c.area_error) && c.contacts > 0)
        out << "not compared: ELEMENTS DID NOT CONVERGE, raise solver%max_iterations\n";
    else if (c.contacts == 0)
        out << format("N = %.6g %s, A = %.5g %s2, %d contacts\n", asperities.force, f,
                      asperities.area, l, asperities.contacts);
    else if (by_force)
        out << format(
            "at the same force Z0 %+.3g %s (%+.3f sigma), A %+.2f %%, contacts %+.1f %%\n",
            c.separation_error, l, c.separation_error / job.sigma, 100 * c.area_error,
            100 * c.contacts_error);
    else
        out << format("N %+.2f %%, A %+.2f %%, contacts %+.1f %%\n", 100 * c.force_error,
                      100 * c.area_error, 100 * c.contacts_error);
    if (c.force_error_expected > kMuchForceError)
        out << format(
            "  warning: a finer grid may change N of the elements by %s, so they are not a "
            "reliable reference.\n",
            percent(c.force_error_expected).c_str());
}

// The levels to compare: the nearest one to each of compare%levels. If levels depend on the levels
// before, they are in the order of the path, and of equally near levels one that is not in the list
// yet is taken, so that loading and unloading can both be compared.
std::vector<std::size_t> steps_to_compare(const Job& job, const std::vector<LevelValues>& levels,
                                          bool path_dependent) {
    if (!job.settings.compare.listed()) return {levels.size() - 1};
    const bool by_force = job.settings.indentation.control != Control::separation;
    std::vector<std::size_t> steps;
    for (const double requested : job.settings.compare.levels) {
        std::size_t step = 0;
        const auto miss = [&](std::size_t k) {
            return std::abs((by_force ? levels[k].force : levels[k].separation) -
                            requested * job.level_unit);
        };
        const auto taken = [&](std::size_t k) { return contains(steps, k); };
        for (std::size_t k = 1; k < levels.size(); ++k) {
            if (miss(k) < miss(step) ||
                (path_dependent && miss(k) == miss(step) && taken(step) && !taken(k)))
                step = k;
        }
        steps.push_back(step);
    }
    if (path_dependent) std::ranges::sort(steps);
    return steps;
}

// True if the direction of the path is reversed at a level, if it rests there, or if the path
// begins with unloading.
bool turns(const std::vector<LevelValues>& levels, std::size_t k) {
    if (k + 1 >= levels.size()) return false;
    const double on = levels[k + 1].separation - levels[k].separation;
    return k == 0 ? on >= 0 : (levels[k].separation - levels[k - 1].separation) * on <= 0;
}

// Elements on the surface of a realization, with their expected errors. Synthetic surfaces
// are refined if the error is too large, unless they yield, because the path would have to be
// repeated.
class Reference {
public:
    Reference(const Job& job, std::int64_t number, int threads)
        : job_(job), number_(number), threads_(threads) {
        points_per_wave_ = job.settings.elements.points_per_wave;
        map_ = make(points_per_wave_);
        contact_ = make_element_contact(*map_, job.indenter, job.solver);
        judge_.emplace(job.solver, judged());
    }

    Path& contact() { return *contact_; }
    const HeightMap& map() const { return *map_; }

    // The level at a separation, or under the force of `level`, with its own expected errors.
    Level solve(const LevelValues& level, bool by_force) {
        for (;;) {
            by_force = by_force && level.force > 0;
            Level truth = by_force ? contact_->at_force(level.force)
                                   : contact_->at_separation(level.separation);
            truth.stiffness = truth.converged ? contact_->stiffness() : kNotComputed;
            judge_->judge(truth, *contact_, by_force);
            const bool unresolved = truth.doubts & (bit(Cause::grid) | bit(Cause::missed_contact));
            if (!unresolved || !refine(truth)) return truth;
        }
    }

private:
    JudgedSurface judged() const {
        JudgedSurface surface{map_.get()};
        if (job_.theory) surface.curvature = curvature_at_unit_height(*job_.theory);
        return surface;
    }

    std::unique_ptr<HeightMap> make(double points_per_wave) const {
        Case settings = job_.settings;
        settings.elements.points_per_wave = points_per_wave;
        auto map =
            std::make_unique<HeightMap>(make_element_surface(settings, number_, threads_).map);
        map->x0 = job_.domain.x0;  // the position of several measured maps is that of the first
        map->y0 = job_.domain.y0;
        return map;
    }

    // Doubles the points a side; false if that is impossible or would take too long.
    bool refine(const Level& level) {
        if (!job_.spectrum || contact_->path_dependent() || !level.converged) return false;
        const double finer = 2 * points_per_wave_;
        if (finer * job_.spectrum->L_lambda_s > kMostElementPoints ||
            points_per_wave_ >= kMostPointsPerWave ||
            !within(element_size(job_, level.separation, finer), kRefine))
            return false;
        std::unique_ptr<HeightMap> map = make(finer);
        std::unique_ptr<Path> contact = make_element_contact(*map, job_.indenter, job_.solver);
        judge_.reset();
        contact_ = std::move(contact);
        map_ = std::move(map);
        judge_.emplace(job_.solver, judged());
        points_per_wave_ = finer;
        return true;
    }

    static constexpr double kMostElementPoints = 8192, kMostPointsPerWave = 128;
    const Job& job_;
    std::int64_t number_;
    int threads_;
    double points_per_wave_;
    std::unique_ptr<HeightMap> map_;  // on which the contact stands
    std::unique_ptr<Path> contact_;
    std::optional<Judge> judge_;
};

}  // namespace

bool compares(const Job& job, bool automatically) {
    const Case& c = job.settings;
    if (c.compare.listed()) return true;
    if (c.compare.what == CompareWhat::none || !automatically || by_elements(c) ||
        c.run.realizations > 1)
        return false;
    const bool possible = c.surface.source != Source::asperities &&
                          c.solver.interaction == Interaction::point &&
                          std::ranges::all_of(physics_asked(c), [&](const Physics* p) {
                              return !p->compares_itself || p->compares_itself(c);
                          });
    if (!possible || (job.spectrum && !too_large_for_elements(c, *job.spectrum).empty()))
        return false;
    if (job.levels.empty()) return false;
    // separations tried for a force
    const double tries = c.indentation.control == Control::separation ? 1 : 6;
    return within(
        element_size(job, likely_separation(job, job.levels.back()), c.elements.points_per_wave),
        kAuto, tries);
}

ComparedLevels compare_levels(const Job& job, std::int64_t number, int threads,
                              const std::vector<LevelValues>& levels, std::ostream* table,
                              const std::function<bool()>& stop) {
    ComparedLevels c;
    if (levels.empty()) return c;
    Reference reference(job, number, threads);
    const bool by_force = job.settings.indentation.control != Control::separation &&
                          !reference.contact().path_dependent();
    if (table)
        *table << "\ncompared with elements (asperities over elements - 1"
               << (by_force ? ", at equal force" : "") << "):\n";
    std::size_t next = 0;
    bool on_path = true;  // all reversals of the path converged
    for (const std::size_t step :
         steps_to_compare(job, levels, reference.contact().path_dependent())) {
        const LevelValues& level = levels[step];
        Level truth;
        try {
            for (; reference.contact().path_dependent() && next < step; ++next)
                if (turns(levels, next))
                    on_path = reference.solve(levels[next], false).converged && on_path;
            truth = reference.solve(level, by_force);
        } catch (const Error& error) {
            // Two flats closer than their mean planes, which only the asperity model allows.
            if (error.kind() != Failure::bad_input) throw;
            if (table)
                *table << format("level %zu, Z0/sigma = %.5g: not compared: %s\n", step + 1,
                                 level.separation / job.sigma, error.what());
            continue;
        }
        const bool found = truth.converged && on_path;
        c.failed += !found;
        const auto error = [&](double model, double elements) {
            return found && elements != 0 ? model / elements - 1 : kNotComputed;
        };
        ComparedLevel row{std::int32_t(step), truth.separation,  truth.force,
                          truth.area,         truth.area_pixels, truth.residual};
        row.force_error_expected = truth.force_error_expected;
        row.area_error_expected = truth.area_error_expected;
        row.contacts = truth.contacts;
        row.columns = reference.map().nx;
        row.rows = reference.map().ny;
        if (!by_force) row.force_error = error(level.force, truth.force);
        if (by_force && found) row.separation_error = level.separation - truth.separation;
        row.area_error = error(level.area, truth.area);
        row.contacts_error = error(level.contacts, truth.contacts);
        c.levels.push_back(row);
        c.pixels = std::move(truth.pixels);
        if (table) print(*table, job, row, level, by_force);
        if (stop()) break;
    }
    return c;
}

}  // namespace rsc
