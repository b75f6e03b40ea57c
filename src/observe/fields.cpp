#include "observe/fields.hpp"

#include "base/error.hpp"
#include "elements/deformed.hpp"

namespace rsc {
namespace {

using PressureMap = std::map<std::int64_t, Load>;

// Indices of the points within [low, high] along one axis.
PointRange points_within(double origin, double step, int n, double low, double high) {
    const auto number = [&](double x) {
        return std::clamp((x - origin) / step, -1.0, static_cast<double>(n));
    };
    return {std::max(0, static_cast<int>(std::ceil(number(low)))),
            std::min(n - 1, static_cast<int>(std::floor(number(high))))};
}

// Adds a force over the points within a spot, or the nearest point, in proportion to shape(t), t
// being 1 at the centre and 0 at the rim (Spot::inside). Points with t above `threshold` touch. If
// `whole`, the integral of the shape over the spot, is positive, points with t < edge share equally
// what the others leave of it.
template <class Shape>
void add_spot(PressureMap& all, const HeightMap& map, bool repeats, const Spot& s, double force,
              double threshold, Shape&& shape, double whole = 0, double edge = 0) {
    const auto range = [&](double origin, double step, int n, double centre, double along,
                           double across) {
        const double half = std::hypot(s.major * along, s.minor * across);
        const PointRange r{static_cast<int>(std::ceil((centre - half - origin) / step)),
                           static_cast<int>(std::floor((centre + half - origin) / step))};
        return repeats ? r : PointRange{std::max(r.first, 0), std::min(r.last, n - 1)};
    };
    const double cosine = std::cos(s.angle), sine = std::sin(s.angle);
    const PointRange columns = range(map.x0, map.dx, map.nx, s.x, cosine, sine),
                     rows = range(map.y0, map.dy, map.ny, s.y, sine, cosine);
    PressureMap spot;
    double sum = 0;
    std::vector<Load*> outermost;
    for (int j = rows.first; j <= rows.last; ++j)
        for (int i = columns.first; i <= columns.last; ++i) {
            const double t = s.inside(map.x(i), map.y(j));
            if (!(t > 0)) continue;
            const double p = whole > 0 && t < edge ? 0 : shape(t);
            Load& here = spot[std::int64_t{wrapped(j, map.ny)} * map.nx + wrapped(i, map.nx)];
            here.pressure += p;
            here.touches = here.touches || t > threshold;
            sum += p;
            if (whole > 0 && t < edge) outermost.push_back(&here);
        }
    const double rest = std::max(whole / (map.dx * map.dy) - sum, 0.0);
    for (Load* load : outermost) load->pressure += rest / static_cast<double>(outermost.size());
    if (!outermost.empty()) sum += rest;
    if (!(sum > 0)) {
        const auto nearest = [&](double origin, double step, int n, double centre) {
            const int i = static_cast<int>(std::round((centre - origin) / step));
            return repeats ? wrapped(i, n) : std::clamp(i, 0, n - 1);
        };
        sum = 1;
        spot = {{std::int64_t{nearest(map.y0, map.dy, map.ny, s.y)} * map.nx +
                     nearest(map.x0, map.dx, map.nx, s.x),
                 {1.0, threshold < 1}}};
    }
    for (const auto& [point, load] : spot) {
        Load& here = all[point];
        here.pressure += force * load.pressure / (sum * map.dx * map.dy);
        here.touches = here.touches || load.touches;
    }
}

PressureMap pressures_of_spots(const HeightMap& map, bool repeats, const Level& level) {
    PressureMap all;
    const auto hertz = [](double t) { return std::sqrt(t); };
    const LevelTractions& at = level.tractions;
    for (std::size_t k = 0; k < at.x.size(); ++k) {
        const double a = at.a[k], c = at.c[k];
        if (a > 0)
            add_spot(all, map, repeats, {at.x[k], at.y[k], a, a, 0}, at.pressed[k], 0, hertz);
        const auto tension = [&](double t) {
            if (c == a) return 1 / std::sqrt(t);
            return 2 / pi *
                   std::atan2(std::sqrt(c * c - a * a),
                              std::sqrt(std::max(a * a - (1 - t) * c * c, 0.0)));
        };
        // The tension of JKR is infinite at the edge: points within a step of it have the mean
        // there.
        add_spot(all, map, repeats, {at.x[k], at.y[k], c, c, 0}, at.pulled[k], 1 - a * a / (c * c),
                 tension, c == a ? 2 * pi * a * a : 0, 2 * std::max(map.dx, map.dy) / c);
    }
    if (!at.x.empty()) return all;
    for (std::size_t k = 0; k < level.f.size(); ++k) {
        const bool uniform = k < level.yields.size() && level.yields[k];
        const Spot spot = level.spots.empty()
                              ? Spot{level.x[k], level.y[k], level.a[k], level.a[k], 0}
                              : level.spots[k];
        add_spot(all, map, repeats, spot, level.f[k], 0,
                 [&](double t) { return uniform ? 1.0 : std::sqrt(t); });
    }
    return all;
}

Pressures pressures_of(const HeightMap& map, bool repeats, const Level& level) {
    if (!level.pixels.empty()) return pressures_of(level.pixels);
    const PressureMap all = pressures_of_spots(map, repeats, level);
    return {all.begin(), all.end()};
}

// The columns and rows of all points under pressure with a margin, or the whole map if there are
// none.
PointWindow about_contact(const HeightMap& map, const std::vector<Pressures>& levels) {
    PointRange columns{map.nx, -1}, rows{map.ny, -1};
    for (const Pressures& pressures : levels)
        for (const auto& [point, p] : pressures) {
            const int i = static_cast<int>(point % map.nx), j = static_cast<int>(point / map.nx);
            columns = {std::min(columns.first, i), std::max(columns.last, i)};
            rows = {std::min(rows.first, j), std::max(rows.last, j)};
        }
    const auto widened = [](PointRange r, int n, double margin) {
        const int more =
            std::max(4, static_cast<int>(std::ceil(std::min(margin, static_cast<double>(n)))));
        return r.last < 0 ? PointRange{0, n - 1}
                          : PointRange{std::max(0, r.first - more), std::min(n - 1, r.last + more)};
    };
    const double margin = 0.15 * std::max(columns.size() * map.dx, rows.size() * map.dy);
    return {widened(columns, map.nx, margin / map.dx), widened(rows, map.ny, margin / map.dy),
            map.nx};
}

// The window whose fields are requested.
PointWindow asked_window(const HeightMap& map, bool repeats, const std::vector<Pressures>& levels,
                         const FieldsAsked& asked) {
    if (!asked.window)
        return repeats ? PointWindow{{0, map.nx - 1}, {0, map.ny - 1}, map.nx}
                       : about_contact(map, levels);
    const auto& w = *asked.window;
    const PointWindow window{points_within(map.x0, map.dx, map.nx, w[0], w[1]),
                             points_within(map.y0, map.dy, map.ny, w[2], w[3]), map.nx};
    if (window.columns.size() < 1 || window.rows.size() < 1)
        bad_input("output%field_window contains no point of the surface");
    return window;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& values) {
    to.insert(to.end(), values.begin(), values.end());
}

// Appends the part of a row of the map in the window.
void append_row(std::vector<double>& to, const double* row, const PointWindow& window) {
    to.insert(to.end(), row + window.columns.first, row + window.columns.last + 1);
}

// Adds the fields of the physics at a level.
void add_physics(Fields& f, const HeightMap& map, const FieldLevel& level,
                 const Pressures& pressures, const PointWindow& window, const FieldsAsked& asked) {
    LevelPixels pixels;
    pixels.columns = map.nx;
    for (const auto& [point, load] : pressures) {
        pixels.index.push_back(static_cast<std::int32_t>(point));
        pixels.pressure.push_back(load.pressure);
    }
    auto to = f.physics.begin();
    for (const auto i : indices(asked.physics)) {
        const FieldsAsked::OfPhysics& one = asked.physics[i];
        const FieldValues below = one.recorder->fields_below({map, pixels, window});
        for (const std::size_t row : one.rows) {
            std::vector<double>& values = (to++)->values;
            if (!below.empty())
                append(values, below[row]);
            else
                for (int j = window.rows.first; j <= window.rows.last; ++j)
                    append_row(values, &level.physics[i][row][at(j) * at(map.nx)], window);
        }
    }
}

}  // namespace

ResidualProfile lowered_summits(const HeightMap& map, bool repeats, const Asperities& asperities,
                                const std::vector<double>& depths) {
    ResidualProfile lowered;
    for (std::size_t k = 0; k < depths.size(); ++k) {
        if (!(depths[k] > 0)) continue;
        const double radius = std::sqrt(2 * asperities.radius[k] * depths[k]),
                     top = asperities.z[k] - depths[k];
        const double x = asperities.x[k], y = asperities.y[k];
        const auto range = [radius](double centre, double step) {
            return PointRange{static_cast<int>(std::ceil((centre - radius) / step)),
                              static_cast<int>(std::floor((centre + radius) / step))};
        };
        const PointRange columns = range(x - map.x0, map.dx), rows = range(y - map.y0, map.dy);
        for (int j = rows.first; j <= rows.last; ++j)
            for (int i = columns.first; i <= columns.last; ++i) {
                if (!repeats && (i < 0 || j < 0 || i >= map.nx || j >= map.ny)) continue;
                const int column = wrapped(i, map.nx), row = wrapped(j, map.ny);
                if (!(map(column, row) > top) || std::hypot(map.x(i) - x, map.y(j) - y) > radius)
                    continue;
                lowered.x.push_back(map.x(column));
                lowered.y.push_back(map.y(row));
                lowered.depth.push_back(map(column, row) - top);
            }
    }
    return lowered;
}

Fields fields_of(const HeightMap& map, const Indenter& indenter, Interaction interaction,
                 const std::vector<FieldLevel>& levels, const FieldsAsked& asked) {
    Fields f;
    if (!asked.any()) return f;
    const bool repeats = indenter.period.finite();
    std::vector<Pressures> pressures;
    for (const FieldLevel& level : levels) {
        f.step.push_back(level.step);
        pressures.push_back(pressures_of(map, repeats, *level.level));
    }
    const PointWindow window = asked_window(map, repeats, pressures, asked);
    const PointRange &columns = window.columns, &rows = window.rows;
    for (int i = columns.first; i <= columns.last; ++i) f.x.push_back(map.x(i));
    for (int j = rows.first; j <= rows.last; ++j) f.y.push_back(map.y(j));
    for (const FieldsAsked::OfPhysics& one : asked.physics)
        for (const std::size_t row : one.rows)
            f.physics.push_back({&one.of->physics->fields[row], one.of->axis.name, {}});
    const auto add_heights = [&](const HeightMap& of) {
        for (int j = rows.first; j <= rows.last && asked.heights; ++j)
            append_row(f.heights, of.row(j), window);
    };
    if (!asked.worn) add_heights(map);
    for (std::size_t s = 0; s < levels.size(); ++s) {
        const Level& level = *levels[s].level;
        const ResidualProfile& depths = levels[s].lowered;
        const HeightMap changed = depths.depth.empty() ? HeightMap{} : lowered_map(map, depths);
        const HeightMap& lowered = changed.data ? changed : map;
        if (asked.worn) add_heights(lowered);
        std::vector<double> p(window.points(), 0.0);
        std::vector<char> touches(p.size(), 0);
        for (const auto& [point, load] : pressures[s])
            if (const auto inside = window.find(point)) {
                p[*inside] = load.pressure;
                touches[*inside] = load.touches;
            }
        if (asked.contact) append(f.contact, touches);
        if (asked.pressure) append(f.pressure, p);
        if (asked.gap) {
            const std::optional<Level>& lasting = levels[s].lasting;
            Array<double> deflection =
                interaction == Interaction::none
                    ? Array<double>(p.size(), 0.0)
                    : deflections(map, indenter,
                                  lasting ? pressures_of(map, repeats, *lasting) : pressures[s],
                                  window);
            append(f.gap, gaps(lowered, indenter, level.separation, touches, window,
                               std::move(deflection)));
        }
        add_physics(f, map, levels[s], pressures[s], window, asked);
    }
    return f;
}

}  // namespace rsc
