#include "observe/fields.hpp"

#include "contact/interaction/kernel.hpp"
#include "contact/interaction/periodic_pixels.hpp"
#include "contact/interaction/pixel_products.hpp"
#include "error.hpp"

namespace rsc {
namespace {

// Pressures by point index, row * nx + column.
using Pressures = std::map<std::int64_t, double>;

// Columns and rows first .. last.
struct Range {
    int first, last;
    int size() const { return last - first + 1; }
};

std::size_t at(std::int64_t k) { return static_cast<std::size_t>(k); }

// Indices of the points within [low, high] along one axis.
Range points_within(double origin, double step, int n, double low, double high) {
    const auto number = [&](double x) { return std::clamp((x - origin) / step, -1.0, static_cast<double>(n)); };
    return {std::max(0, static_cast<int>(std::ceil(number(low)))), std::min(n - 1, static_cast<int>(std::floor(number(high))))};
}

int wrapped(int i, int n) { return (i % n + n) % n; }

void add_spot(Pressures& all, const HeightMap& map, bool repeats, const Level& level, std::size_t k) {
    const double x = level.x[k], y = level.y[k], a = level.a[k];
    const bool uniform = k < level.yields.size() && level.yields[k];
    const auto range = [&](double origin, double step, int n, double centre) {
        const Range r{static_cast<int>(std::ceil((centre - a - origin) / step)),
                      static_cast<int>(std::floor((centre + a - origin) / step))};
        return repeats ? r : Range{std::max(r.first, 0), std::min(r.last, n - 1)};
    };
    const Range columns = range(map.x0, map.dx, map.nx, x), rows = range(map.y0, map.dy, map.ny, y);
    Pressures spot;
    double sum = 0;
    for (int j = rows.first; j <= rows.last; ++j)
        for (int i = columns.first; i <= columns.last; ++i) {
            const double t = 1 - (std::pow(map.x0 + i * map.dx - x, 2) + std::pow(map.y0 + j * map.dy - y, 2)) / (a * a);
            if (!(t > 0)) continue;
            const double p = uniform ? 1 : std::sqrt(t);
            spot[std::int64_t{wrapped(j, map.ny)} * map.nx + wrapped(i, map.nx)] += p;
            sum += p;
        }
    if (!(sum > 0)) {
        const auto nearest = [&](double origin, double step, int n, double centre) {
            const int i = static_cast<int>(std::round((centre - origin) / step));
            return repeats ? wrapped(i, n) : std::clamp(i, 0, n - 1);
        };
        spot = {{std::int64_t{nearest(map.y0, map.dy, map.ny, y)} * map.nx + nearest(map.x0, map.dx, map.nx, x), sum = 1.0}};
    }
    for (const auto& [point, p] : spot) all[point] += level.f[k] * p / (sum * map.dx * map.dy);
}

Pressures pressures_of(const HeightMap& map, bool repeats, const Level& level) {
    Pressures all;
    for (std::size_t k = 0; k < level.pixels.index.size(); ++k) all[level.pixels.index[k]] = level.pixels.pressure[k];
    if (!all.empty()) return all;
    for (std::size_t k = 0; k < level.f.size(); ++k) add_spot(all, map, repeats, level, k);
    return all;
}

// Deflections caused by the pressures at the points of a window, row by row.
std::vector<double> deflections(const HeightMap& map, const Indenter& indenter, const Pressures& pressures, Range columns, Range rows) {
    std::vector<double> u(at(columns.size()) * at(rows.size()), 0.0);
    if (pressures.empty()) return u;
    const Substrate body = substrate_of(indenter);
    if (indenter.period.finite()) {
        std::function<double(double)> share;
        if (body.smooth()) share = [&](double k) { return body.smooth()->share(k / map.dx); };
        PeriodicPixels<double> whole(map.nx, map.ny, map.dx, map.dy, share);
        whole.apply(
            [&](int j, double* row) {
                std::fill_n(row, map.nx, 0.0);
                const std::int64_t begin = std::int64_t{j} * map.nx;
                for (auto k = pressures.lower_bound(begin); k != pressures.end() && k->first < begin + map.nx; ++k)
                    row[k->first - begin] = k->second / body.modulus();
            },
            [&](int j, const double* row) {
                if (j < rows.first || j > rows.last) return;
                for (int i = columns.first; i <= columns.last; ++i)
                    u[at(j - rows.first) * at(columns.size()) + at(i - columns.first)] = whole.unit() * row[i];
            });
        return u;
    }
    constexpr double kError = 1e-6;
    const auto products = make_tree_products(body, map.dx, map.dy, kError, kError);
    std::vector<Pixel> sources, where;
    std::vector<double> p;
    double raised = 0;
    for (const auto& [point, value] : pressures) {
        sources.push_back({static_cast<int>(point % map.nx), static_cast<int>(point / map.nx)});
        p.push_back(value);
        raised += body.bulge() * value * map.dx * map.dy;  // uniform offset included in the products, subtracted below
    }
    for (int j = rows.first; j <= rows.last; ++j)
        for (int i = columns.first; i <= columns.last; ++i) where.push_back({i, j});
    products->set_pixels(sources);
    products->elsewhere(p.data(), where, u.data());
    for (double& value : u) value -= raised;
    return u;
}

// Sets the columns and rows to those of all points under pressure with a margin, or to the whole map if there are none.
void about_contact(const HeightMap& map, const std::vector<Pressures>& levels, Range& columns, Range& rows) {
    columns = {map.nx, -1}, rows = {map.ny, -1};
    for (const Pressures& pressures : levels)
        for (const auto& [point, p] : pressures) {
            const int i = static_cast<int>(point % map.nx), j = static_cast<int>(point / map.nx);
            columns = {std::min(columns.first, i), std::max(columns.last, i)}, rows = {std::min(rows.first, j), std::max(rows.last, j)};
        }
    const auto widened = [](Range r, int n, double margin) {
        const int more = std::max(4, static_cast<int>(std::ceil(std::min(margin, static_cast<double>(n)))));
        return r.last < 0 ? Range{0, n - 1} : Range{std::max(0, r.first - more), std::min(n - 1, r.last + more)};
    };
    const double margin = 0.15 * std::max(columns.size() * map.dx, rows.size() * map.dy);
    columns = widened(columns, map.nx, margin / map.dx), rows = widened(rows, map.ny, margin / map.dy);
}

}  // namespace

Fields fields_of(const HeightMap& map, const Indenter& indenter, Interaction interaction, const std::vector<FieldLevel>& levels,
                 const FieldsAsked& asked) {
    Fields f;
    if (!asked.any()) return f;
    const bool repeats = indenter.period.finite();
    std::vector<Pressures> pressures;
    for (const FieldLevel& level : levels) {
        f.step.push_back(level.step);
        pressures.push_back(pressures_of(map, repeats, *level.level));
    }
    Range columns{0, map.nx - 1}, rows{0, map.ny - 1};
    if (asked.window) {
        const auto& w = *asked.window;
        columns = points_within(map.x0, map.dx, map.nx, w[0], w[1]), rows = points_within(map.y0, map.dy, map.ny, w[2], w[3]);
        if (columns.size() < 1 || rows.size() < 1) bad_input("output%field_window contains no point of the surface");
    } else if (!repeats) {
        about_contact(map, pressures, columns, rows);
    }
    for (int i = columns.first; i <= columns.last; ++i) f.x.push_back(map.x0 + i * map.dx);
    for (int j = rows.first; j <= rows.last; ++j) f.y.push_back(map.y0 + j * map.dy);
    const std::size_t points = f.x.size() * f.y.size();
    if (asked.heights)
        for (int j = rows.first; j <= rows.last; ++j)
            f.heights.insert(f.heights.end(), map.row(j) + columns.first, map.row(j) + columns.last + 1);
    for (std::size_t s = 0; s < levels.size(); ++s) {
        const Level& level = *levels[s].level;
        std::vector<double> p(points, 0.0);
        for (const auto& [point, value] : pressures[s]) {
            const int i = static_cast<int>(point % map.nx) - columns.first, j = static_cast<int>(point / map.nx) - rows.first;
            if (i >= 0 && i < columns.size() && j >= 0 && j < rows.size()) p[at(j) * f.x.size() + at(i)] = value;
        }
        if (asked.contact)
            for (const double value : p) f.contact.push_back(value > 0);
        if (asked.gap) {
            std::vector<double> gap(points, 0.0);
            if (interaction != Interaction::none) gap = deflections(map, indenter, pressures[s], columns, rows);
            const ResidualProfile& lowered = levels[s].lowered;
            for (std::size_t k = 0; k < lowered.depth.size(); ++k) {
                const int i = static_cast<int>(std::round((lowered.x[k] - map.x0) / map.dx)) - columns.first;
                const int j = static_cast<int>(std::round((lowered.y[k] - map.y0) / map.dy)) - rows.first;
                if (i >= 0 && i < columns.size() && j >= 0 && j < rows.size()) gap[at(j) * f.x.size() + at(i)] += lowered.depth[k];
            }
            for (std::size_t k = 0; k < points; ++k) {
                const std::size_t i = k % f.x.size(), j = k / f.x.size();
                const double z = map(columns.first + static_cast<int>(i), rows.first + static_cast<int>(j));
                gap[k] += level.separation - indenter.clearance(f.x[i], f.y[j], z);
                gap[k] = p[k] > 0 ? 0 : std::isfinite(gap[k]) ? std::max(gap[k], 0.0) : kNotComputed;  // NaN outside a map of the indenter
            }
            f.gap.insert(f.gap.end(), gap.begin(), gap.end());
        }
        if (asked.pressure) f.pressure.insert(f.pressure.end(), p.begin(), p.end());
    }
    return f;
}

}  // namespace rsc
