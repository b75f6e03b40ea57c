#include "observe/record.hpp"

#include <cmath>
#include <string>

#include "error.hpp"
#include "observe/radial.hpp"

namespace rsc {
namespace {

void require_finite(const Level& level, std::size_t step) {
    bool finite =
        std::isfinite(level.separation) && std::isfinite(level.force) && std::isfinite(level.area) && std::isfinite(level.residual);
    for (std::size_t k = 0; k < level.asperity.size(); ++k) finite = finite && std::isfinite(level.f[k]) && std::isfinite(level.a[k]);
    if (!finite) throw Error(Failure::internal, "level " + std::to_string(step + 1) + " holds a value that is not a finite number");
}

}  // namespace

std::int32_t nearest_level(const std::vector<Level>& levels, double separation) {
    std::int32_t best = -1;
    for (std::size_t s = 0; s < levels.size(); ++s)
        if (best < 0 ||
            std::abs(levels[s].separation - separation) < std::abs(levels[static_cast<std::size_t>(best)].separation - separation))
            best = static_cast<std::int32_t>(s);
    return best;
}

RealizationRecord observe(const ObserveOptions& options, std::int64_t realization, const SurfaceStatistics& surface,
                          const std::vector<Level>& levels) {
    RealizationRecord record;
    record.realization = realization;
    record.surface = surface;
    for (std::size_t s = 0; s < levels.size(); ++s) {
        require_finite(levels[s], s);
        LevelValues row = levels[s];
        record.maps.push_back(map_level(options.map, levels[s]));
        row.outside_map = record.maps.back().outside;
        row.crowded_cells = count_crowded_cells(options.map, record.maps.back());
        record.levels.push_back(row);
    }
    for (double wanted : options.pdf_levels) {
        const std::int32_t step = nearest_level(levels, wanted);
        if (step >= 0) record.distributions.push_back(distributions_of(options.pdf, levels[static_cast<std::size_t>(step)], step));
    }
    return record;
}

// Two passes in the order of the realizations.
LevelStatistics Observations::statistics(const std::function<double(const LevelValues&)>& of) const {
    LevelStatistics s;
    const auto M = static_cast<double>(realizations);
    s.mean.assign(steps, kAbsent);
    s.deviation.assign(steps, kAbsent);
    for (std::size_t step = 0; step < steps && realizations > 0; ++step) {
        double sum = 0, squares = 0;
        for (std::size_t k = 0; k < realizations; ++k) sum += of(row(k, step));
        s.mean[step] = sum / M;
        if (realizations < 2) continue;
        for (std::size_t k = 0; k < realizations; ++k) {
            const double off = of(row(k, step)) - s.mean[step];
            squares += off * off;
        }
        s.deviation[step] = std::sqrt(squares / (M - 1));
    }
    return s;
}

Accumulators::Accumulators(const ObserveOptions& options_, std::size_t steps_) : options(options_), steps(steps_) {
    map_area.assign(steps * static_cast<std::size_t>(options.map.cells()), 0.0);
    map_force = map_area;
    distributions.resize(steps > 0 ? options.pdf_levels.size() : 0);
}

void Accumulators::add(const RealizationRecord& record) {
    if (record.levels.size() != steps || record.maps.size() != steps || record.distributions.size() != distributions.size())
        throw Error(Failure::internal, "realization " + std::to_string(record.realization) + " has " +
                                           std::to_string(record.levels.size()) + " levels, the others " + std::to_string(steps));
    if (!realization.empty() && record.realization <= realization.back())
        throw Error(Failure::internal,
                    "realization " + std::to_string(record.realization) + " added after realization " + std::to_string(realization.back()));
    realization.push_back(record.realization);
    surface.push_back(record.surface);
    rows.insert(rows.end(), record.levels.begin(), record.levels.end());
    const auto cells = static_cast<std::size_t>(options.map.cells());
    for (std::size_t s = 0; s < steps; ++s) {
        const MapLevel& map = record.maps[s];
        for (std::size_t k = 0; k < map.cell.size(); ++k) {
            map_area[s * cells + static_cast<std::size_t>(map.cell[k])] += map.area[k];
            map_force[s * cells + static_cast<std::size_t>(map.cell[k])] += map.force[k];
        }
    }
    for (std::size_t d = 0; d < distributions.size(); ++d) rsc::add(distributions[d], record.distributions[d]);
}

Observations Accumulators::finish() const {
    Observations o;
    o.options = options;
    o.realizations = realization.size();
    o.steps = steps;
    o.realization = realization;
    o.surface = surface;
    o.rows = rows;
    o.separation = o.statistics([](const LevelValues& r) { return r.separation; });
    o.force = o.statistics([](const LevelValues& r) { return r.force; });
    o.area = o.statistics([](const LevelValues& r) { return r.area; });

    const double divisor = options.map.side * options.map.side * static_cast<double>(o.realizations > 0 ? o.realizations : 1);
    o.map_area_fraction = map_area;
    o.map_pressure = map_force;
    for (double& v : o.map_area_fraction) v /= divisor;
    for (double& v : o.map_pressure) v /= divisor;

    const RadialMean mean(options.map, options.tip_x, options.tip_y, options.radial_bins);
    o.radii = mean.radii();
    const auto cells = static_cast<std::size_t>(options.map.cells());
    for (std::size_t s = 0; s < steps && !o.radii.empty(); ++s) {
        for (double v : mean(o.map_area_fraction.data() + s * cells)) o.radial_area_fraction.push_back(v);
        for (double v : mean(o.map_pressure.data() + s * cells)) o.radial_pressure.push_back(v);
    }
    for (const Distributions& d : distributions) o.distributions.push_back(fit_distributions(options.pdf, d));
    return o;
}

}  // namespace rsc
