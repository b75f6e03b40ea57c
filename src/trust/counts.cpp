#include "trust/counts.hpp"

namespace rsc {
namespace {

// Distance to the border, negative outside.
double inside(const Rectangle& r, double x, double y) {
    return std::min({x - r.x0, r.x0 + r.Lx - x, y - r.y0, r.y0 + r.Ly - y});
}

// Area of the smallest disc about the tip that contains all spots (or all pixels, if any), at most
// the area of the surface; for periodic flats the area of the period, for line contact that of the
// narrowest strip about the axis.
double nominal_area(const Level& level, const Indenter& indenter, const Rectangle& surface) {
    const Period& period = indenter.period;
    if (period.finite()) return period.area();
    double radius = 0;
    for (std::size_t k = 0; k < level.x.size() && level.pixels.index.empty(); ++k) {
        const double x = level.x[k] - indenter.x0, y = level.y[k] - indenter.y0;
        radius = std::max(radius, std::sqrt(x * x + y * y) + level.a[k]);
    }
    const LevelPixels& pixels = level.pixels;
    for (const auto k : indices(pixels.index)) {
        // Of line contact half the width of a strip.
        const double x = period.along_x() ? 0
                                          : std::abs(pixels.x(k) - indenter.x0) + 0.5 * pixels.dx,
                     y = period.along_y() ? 0
                                          : std::abs(pixels.y(k) - indenter.y0) + 0.5 * pixels.dy;
        if (x * x + y * y > 0.99 * radius * radius) radius = std::max(radius, std::hypot(x, y));
    }
    const double disc = period.line() ? 2 * radius * period.length() : pi * radius * radius;
    return surface.known() ? std::min(disc, surface.Lx * surface.Ly) : disc;
}

// Counts border points that touch but are not represented by asperities; neighbouring points count
// once.
std::int32_t border_contacts(const Level& level, const Indenter& indenter, const MapMarks& marks) {
    std::vector<Vec2> touching;
    std::int32_t count = 0;
    for (const std::array<double, 3>& point : marks.border) {
        const double x = point[0], y = point[1], z = point[2];
        double gap = indenter.clearance(x, y, z) - level.separation;
        for (std::size_t k = 0; k < level.x.size() && gap > 0; ++k) {
            const double distance =
                std::max(std::hypot(level.x[k] - x, level.y[k] - y), level.a[k]);
            gap -= level.f[k] / (pi * indenter.E_star * distance);
        }
        if (!(gap > 0)) continue;
        const bool counted = std::ranges::any_of(touching, [&](const Vec2& t) {
            return std::hypot(t.x - x, t.y - y) < 1.5 * marks.reach;
        });
        count += !counted;
        touching.push_back({x, y});
    }
    return count;
}

// The contacts of the pixels that are, or attract, at the border of the surface, or of a map of the
// indenter, beyond which there is no load; -1: pixels that only attract.
void mark_border_pixels(const Level& level, const Indenter& indenter, double Ly,
                        const std::function<void(std::int32_t)>& mark) {
    const LevelPixels& p = level.pixels;
    const bool ends = indenter.shape->keys().map != nullptr;
    const auto rows = std::int32_t(std::lround(Ly / p.dy));
    const auto at_border = [&](std::int32_t pixel) {
        const std::int32_t column = pixel % p.columns, row = pixel / p.columns;
        const Period& period = indenter.period;
        if (!period.along_x() && (column == 0 || column + 1 == p.columns)) return true;
        if (!period.along_y() && (row == 0 || row + 1 == rows)) return true;
        const double x = p.x_of(pixel) - indenter.x0, y = p.y_of(pixel) - indenter.y0;
        const auto beyond = [&](double dx, double dy) {
            return std::isinf(indenter.shape->height(x + dx, y + dy));
        };
        return ends && (beyond(-p.dx, 0) || beyond(p.dx, 0) || beyond(0, -p.dy) || beyond(0, p.dy));
    };
    p.each([&](std::int32_t pixel, double, int contact) {
        if (at_border(pixel)) mark(contact);
    });
}

// Counts contacts whose distance from the border is less than <d> or their radius, and those with a
// pixel on it.
void count_edges(Level& level, const Indenter& indenter, const SolverOptions& options) {
    level.edge_contacts = 0;
    Rectangle surface = options.surface.extent;
    if (!surface.known() || indenter.period.finite()) return;
    const LevelPixels& pixels = level.pixels;
    if (indenter.around.finite()) {  // cut open far from the tip
        const bool points = pixels.dx > 0;
        surface.x0 = points ? pixels.x0 : indenter.x0 - 0.5 * surface.Lx;
        surface.y0 = points ? pixels.y0 : indenter.y0 - 0.5 * surface.Ly;
    }
    const double everywhere = std::numeric_limits<double>::max() / 4;
    Rectangle within = surface;
    if (indenter.period.along_x()) {
        within.x0 = -everywhere;
        within.Lx = 2 * everywhere;
    }
    if (indenter.period.along_y()) {
        within.y0 = -everywhere;
        within.Ly = 2 * everywhere;
    }
    const std::size_t n = level.x.size();
    std::vector<bool> cut(n + 1, false);  // the last: what attracts without contact
    for (const auto k : indices(n))
        cut[k] = inside(within, level.x[k], level.y[k]) <
                 std::max(options.surface.mean_spacing, level.a[k]);
    if (pixels.dx > 0)
        mark_border_pixels(level, indenter, surface.Ly, [&](std::int32_t contact) {
            cut[contact < 0 ? n : at(contact)] = true;
        });
    level.edge_contacts =
        std::max(std::int32_t(std::count(cut.begin(), cut.end() - 1, true)), std::int32_t(cut[n]));
    if (options.surface.marks && !(pixels.dx > 0))
        level.edge_contacts += border_contacts(level, indenter, *options.surface.marks);
}

double rms_slope_at_contacts(const Level& level, const Indenter& indenter) {
    double squares = 0, forces = 0;
    const auto add = [&](double x, double y, double force) {
        const Vec2 d = indenter.from_tip(x, y);
        const Vec2 slope = indenter.shape->gradient(d.x, d.y);
        squares += std::abs(force) * (slope.x * slope.x + slope.y * slope.y);
        forces += std::abs(force);
    };
    const LevelPixels& pixels = level.pixels;
    for (const auto k : indices(pixels.index)) add(pixels.x(k), pixels.y(k), pixels.pressure[k]);
    if (pixels.index.empty())
        for (const auto k : indices(level.f)) add(level.x[k], level.y[k], level.f[k]);
    return forces > 0 ? std::sqrt(squares / forces) : kNotComputed;
}

}  // namespace

void count_contacts(Level& level, const Indenter& indenter, const SolverOptions& options) {
    const auto larger_than = [&](double most) {
        return std::int32_t(std::ranges::count_if(level.a, [&](double a) { return a > most; }));
    };
    if (options.surface.mean_spacing > 0)
        level.large_contacts = larger_than(options.surface.mean_spacing / 4);
    if (indenter.layers.count > 0 && level.pixels.dx == 0)
        level.wide_contacts = larger_than(indenter.layers.layer[0].thickness / 5) /
                              std::max(double(level.a.size()), 1.0);
    count_edges(level, indenter, options);
    if (!indenter.shape->flat()) level.indenter_slope = rms_slope_at_contacts(level, indenter);
    level.nominal_area = nominal_area(level, indenter, options.surface.extent);
}

bool exceeds_nominal_area(const LevelValues& level) {
    constexpr double rounding = 1e-9;  // the area of one spot under the tip equals the nominal area
    return level.nominal_area > 0 && level.area > (1 + rounding) * level.nominal_area;
}

}  // namespace rsc
