#include "run/compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact/element_contact.hpp"
#include "error.hpp"
#include "format.hpp"

namespace rsc {
namespace {

void print(std::ostream& out, const Job& job, const ComparedLevels& c, const LevelValues& asperities) {
    const std::size_t k = c.step.size() - 1;
    const char *l = job.settings.run.length_unit.c_str(), *f = job.settings.run.force_unit.c_str();
    char line[400];
    std::snprintf(line, sizeof line, "level %d, Z0/sigma %.5g: elements N = %.6g %s, A = %.5g %s2, %d contacts; asperities ", c.step[k] + 1,
                  c.separation[k] / job.sigma, c.force[k], f, c.area[k], l, c.contacts[k]);
    out << line;
    if (std::isnan(c.force_error[k]) && c.contacts[k] > 0)
        std::snprintf(line, sizeof line, "not compared: ELEMENTS DID NOT CONVERGE, raise solver%%max_iterations\n");
    else if (c.contacts[k] > 0)
        std::snprintf(line, sizeof line, "N %+.2f %%, A %+.2f %%, contacts %+.1f %%\n", 100 * c.force_error[k], 100 * c.area_error[k],
                      100 * c.contacts_error[k]);
    else
        std::snprintf(line, sizeof line, "N = %.6g %s, A = %.5g %s2, %d contacts\n", asperities.force, f, asperities.area, l,
                      asperities.contacts);
    out << line;
}

// The levels to compare: the nearest one to each of &compare levels. Where a level depends on those before it, in the order of the path,
// and of levels as near as each other one that is not yet taken, so that loading and unloading can be compared both.
std::vector<std::size_t> steps_to_compare(const Job& job, const std::vector<LevelValues>& levels, bool path_dependent) {
    const bool by_force = job.settings.indentation.control != Control::separation;
    std::vector<std::size_t> steps;
    for (const double wanted : job.settings.compare.levels) {
        std::size_t step = 0;
        const auto miss = [&](std::size_t k) {
            return std::abs((by_force ? levels[k].force : levels[k].separation) - wanted * job.level_unit);
        };
        const auto taken = [&](std::size_t k) { return std::find(steps.begin(), steps.end(), k) != steps.end(); };
        for (std::size_t k = 1; k < levels.size(); ++k) {
            if (miss(k) < miss(step) || (path_dependent && miss(k) == miss(step) && taken(step) && !taken(k))) step = k;
        }
        steps.push_back(step);
    }
    if (path_dependent) std::sort(steps.begin(), steps.end());
    return steps;
}

// Whether the sphere turns round at a level, or goes up from the first one.
bool turns(const std::vector<LevelValues>& levels, std::size_t k) {
    if (k + 1 >= levels.size()) return false;
    const double on = levels[k + 1].separation - levels[k].separation;
    return k == 0 ? on > 0 : (levels[k].separation - levels[k - 1].separation) * on < 0;
}

}  // namespace

ComparedLevels compare_levels(const Job& job, std::int64_t number, int threads, const std::vector<LevelValues>& levels, std::ostream* table,
                              const std::function<bool()>& stop) {
    ComparedLevels c;
    if (job.settings.compare.levels.empty() || levels.empty()) return c;
    Surface surface = make_element_surface(job.settings, number, threads);
    HeightMap& map = surface.map;
    map.x0 = job.site.domain.x0;  // of several measured maps the first one says where they lie
    map.y0 = job.site.domain.y0;
    const std::unique_ptr<Contact> elements = make_element_contact(map, job.indenter, job.solver);
    Contact& contact = *elements;
    if (table) *table << "\ncompared with elements on " << map.nx << " x " << map.ny << " points (asperities over elements - 1):\n";
    std::size_t next = 0;
    bool on_path = true;  // elements have gone through all levels that matter
    for (const std::size_t step : steps_to_compare(job, levels, contact.path_dependent())) {
        const LevelValues& level = levels[step];
        Level truth;
        try {
            for (; contact.path_dependent() && next < step; ++next)
                if (turns(levels, next))
                    on_path = contact.at_separation(levels[next].separation).status != LevelStatus::not_converged && on_path;
            truth = contact.at_separation(level.separation);
        } catch (const Error& error) {  // two flats nearer than the mean planes: only asperities can be
            if (error.kind() != Failure::bad_input) throw;
            if (table)
                *table << format("level %zu, Z0/sigma %.5g: not compared: %s\n", step + 1, level.separation / job.sigma, error.what());
            continue;
        }
        const bool found = truth.status != LevelStatus::not_converged && on_path;
        c.failed += !found;
        const auto error = [&](double model, double elements) { return found && elements > 0 ? model / elements - 1 : kNotComputed; };
        c.step.push_back(static_cast<std::int32_t>(step));
        c.contacts.push_back(truth.contacts);
        c.separation.push_back(truth.separation);
        c.force.push_back(truth.force);
        c.area.push_back(truth.area);
        c.area_pixels.push_back(truth.area_pixels);
        c.residual.push_back(truth.residual);
        c.force_error.push_back(error(level.force, truth.force));
        c.area_error.push_back(error(level.area, truth.area));
        c.contacts_error.push_back(error(level.contacts, truth.contacts));
        c.pixels = std::move(truth.pixels);
        if (table) print(*table, job, c, level);
        if (stop()) break;
    }
    return c;
}

}  // namespace rsc
