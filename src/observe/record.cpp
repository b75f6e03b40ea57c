#include "observe/record.hpp"

#include "base/error.hpp"

namespace rsc {
namespace {

void require_finite(const Level& level, std::size_t step) {
    if (std::isnan(level.force) && level.status == LevelStatus::not_converged)
        return;  // reported by its status
    bool finite = std::isfinite(level.separation) && std::isfinite(level.force) &&
                  std::isfinite(level.area) && std::isfinite(level.residual);
    for (const auto k : indices(level.asperity))
        finite = finite && std::isfinite(level.f[k]) && std::isfinite(level.a[k]);
    if (!finite)
        throw Error(Failure::internal, "level " + std::to_string(step + 1) +
                                           " holds a value that is not a finite number");
}

// Divisor that turns the sum of a cell over realizations into its mean area fraction or pressure.
double map_divisor(const MapGrid& grid, std::int32_t converged) {
    return grid.side * grid.side * std::max(1, converged);
}

// Both by increasing number of the cell.
void add_cells(std::vector<CellSums>& sums, std::vector<CellSums> terms) {
    if (sums.empty()) return void(sums = std::move(terms));
    std::vector<CellSums> all;
    all.reserve(sums.size() + terms.size());
    auto term = terms.begin();
    for (CellSums& sum : sums) {
        for (; term != terms.end() && term->cell < sum.cell; ++term) all.push_back(*term);
        if (term != terms.end() && term->cell == sum.cell) {
            sum.area += term->area;
            sum.force += term->force;
            ++term;
        }
        all.push_back(sum);
    }
    all.insert(all.end(), term, terms.end());
    sums = std::move(all);
}

}  // namespace

std::int32_t nearest_level(const std::vector<double>& levels, double requested) {
    std::int32_t best = -1;
    double least = kInfinity;
    for (const auto k : indices(levels))
        if (const double distance = std::abs(levels[k] - requested);
            best < 0 || distance < least - 1e-9 * (least + std::abs(requested))) {
            best = std::int32_t(k);
            least = distance;
        }
    return best;
}

RealizationRecord observe(const ObserveOptions& options, std::int64_t realization,
                          const SurfaceStatistics& surface, const std::vector<Level>& levels,
                          std::vector<double> curves) {
    RealizationRecord record;
    record.realization = realization;
    record.curves = std::move(curves);
    record.surface = surface;
    for (std::size_t s = 0; s < levels.size(); ++s) {
        require_finite(levels[s], s);
        LevelValues row = levels[s];
        MapLevel map = map_level(options.map, levels[s]);
        row.outside_map = map.outside;
        row.crowded_cells = count_crowded_cells(options.map, map);
        record.levels.push_back(row);
        record.maps.push_back(row.status == LevelStatus::not_converged ? MapLevel{}
                                                                       : std::move(map));
    }
    std::vector<double> separations;
    for (const Level& level : levels) separations.push_back(level.separation);
    for (double requested : options.pdf_levels) {
        const std::int32_t step = nearest_level(separations, requested);
        if (step < 0) continue;
        const Level& level = levels[at(step)];
        Level no_contacts;
        no_contacts.separation = level.separation;
        const bool failed = level.status == LevelStatus::not_converged;
        record.distributions.push_back(
            distributions_of(options.pdf, failed ? no_contacts : level, step));
    }
    return record;
}

// Two passes over the realizations in order.
LevelStatistics Observations::statistics(
    const std::function<double(const LevelValues&)>& of) const {
    LevelStatistics s;
    s.mean.assign(steps, kNotComputed);
    s.deviation = s.error = s.mean;
    s.count.assign(steps, 0);
    for (std::size_t step = 0; step < steps; ++step) {
        const auto each = [&](auto visit) {
            for (std::size_t k = 0; k < realizations; ++k) {
                const LevelValues& level = row(k, step);
                const double value = of(level);
                if (level.status != LevelStatus::not_converged && !std::isnan(value)) visit(value);
            }
        };
        double sum = 0, squares = 0;
        each([&](double value) {
            sum += value;
            ++s.count[step];
        });
        const double M = s.count[step];
        if (M < 1) continue;
        s.mean[step] = sum / M;
        if (M < 2) continue;
        each([&](double value) { squares += (value - s.mean[step]) * (value - s.mean[step]); });
        s.deviation[step] = std::sqrt(squares / (M - 1));
        s.error[step] = s.deviation[step] / std::sqrt(M);
    }
    return s;
}

Accumulators::Accumulators(const ObserveOptions& options_, std::size_t steps_)
    : Realizations{options_, steps_, {}, {}, {}, {}} {
    maps.resize(steps);
    distributions.resize(steps > 0 ? options.pdf_levels.size() : 0);
}

void Accumulators::add(const RealizationRecord& record) {
    if (record.levels.size() != steps || record.maps.size() != steps ||
        record.curves.size() != steps * values_of(options.curves) ||
        record.distributions.size() != distributions.size())
        throw Error(Failure::internal, "realization " + std::to_string(record.realization) +
                                           " has " + std::to_string(record.levels.size()) +
                                           " levels, the others " + std::to_string(steps));
    Accumulators one(options, steps);
    one.realization = {record.realization};
    one.surface = {record.surface};
    one.rows = record.levels;
    one.curves = record.curves;
    for (std::size_t s = 0; s < steps; ++s) {
        const MapLevel& map = record.maps[s];
        for (const auto k : indices(map.cell))
            one.maps[s].push_back({map.cell[k], map.area[k], map.force[k]});
    }
    for (const auto d : indices(distributions))
        rsc::add(one.distributions[d], record.distributions[d]);
    append(one);
}

void Accumulators::append(const Accumulators& later) {
    if (later.steps != steps || later.maps.size() != maps.size() ||
        later.distributions.size() != distributions.size() ||
        (!realization.empty() && !later.realization.empty() &&
         later.realization.front() <= realization.back()))
        throw Error(Failure::internal, "sums can only be added in the order of their realizations");
    realization.insert(realization.end(), later.realization.begin(), later.realization.end());
    surface.insert(surface.end(), later.surface.begin(), later.surface.end());
    rows.insert(rows.end(), later.rows.begin(), later.rows.end());
    rsc::append(curves, later.curves);
    for (std::size_t s = 0; s < steps; ++s) add_cells(maps[s], later.maps[s]);
    for (const auto d : indices(distributions)) rsc::add(distributions[d], later.distributions[d]);
}

Observations Accumulators::finish() const {
    Observations o;
    static_cast<Realizations&>(o) = *this, o.realizations = realization.size();
    o.separation = o.statistics([](const LevelValues& r) { return r.separation; });
    o.force = o.statistics([](const LevelValues& r) { return r.force; });
    o.area = o.statistics([](const LevelValues& r) { return r.area; });

    const std::vector<std::int32_t> counts = converged();
    const auto cells = at(options.map.cells());
    const RadialMean mean(options.map, options.tip_x, options.tip_y, options.radial_bins);
    o.radii = mean.radii();
    std::vector<double> row(cells);
    const auto means_of = [&](double CellSums::*member, SparseMaps& out,
                              std::vector<double>& radial) {
        out.cells = cells;
        for (std::size_t s = 0; s < steps; ++s) {
            for (const CellSums& c : maps[s]) {
                out.cell.push_back(std::int32_t(c.cell));
                out.value.push_back(c.*member / map_divisor(options.map, counts[s]));
            }
            out.end.push_back(out.cell.size());
            if (o.radii.empty()) continue;
            out.fill(s, row);
            for (const double v : mean(row.data())) radial.push_back(v);
        }
    };
    means_of(&CellSums::area, o.map_area_fraction, o.radial_area_fraction);
    means_of(&CellSums::force, o.map_pressure, o.radial_pressure);
    for (const DistributionSums& d : distributions)
        o.distributions.push_back(shown_distributions(
            options.pdf, rounded(d, options.pdf, static_cast<std::int64_t>(o.realizations))));
    o.distribution_sums = distributions;
    return o;
}

std::vector<std::int32_t> Accumulators::converged() const {
    std::vector<std::int32_t> counts(steps, 0);
    for (const auto k : indices(rows))
        counts[k % steps] += rows[k].status != LevelStatus::not_converged;
    return counts;
}

void Accumulators::restore_map(std::size_t step, std::span<const double> area_fraction,
                               std::span<const double> pressure) {
    const double divisor = map_divisor(options.map, converged()[step]);
    maps[step].clear();
    for (const auto k : indices(area_fraction))
        if (area_fraction[k] != 0 || pressure[k] != 0)
            maps[step].push_back(
                {static_cast<std::int64_t>(k), area_fraction[k] * divisor, pressure[k] * divisor});
}

void SparseMaps::fill(std::size_t step, std::span<double> map) const {
    std::ranges::fill(map, 0.0);
    for (std::size_t k = step > 0 ? end[step - 1] : 0; k < end[step]; ++k)
        map[at(cell[k])] = value[k];
}

}  // namespace rsc
