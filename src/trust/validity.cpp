#include "trust/validity.hpp"

#include "trust/expected_error.hpp"

namespace rsc {
namespace {

// Distance to the border, negative outside.
double inside(const Rectangle& r, double x, double y) {
    return std::min({x - r.x0, r.x0 + r.Lx - x, y - r.y0, r.y0 + r.Ly - y});
}

// Area of the smallest disc about the tip that contains all spots (or all pixels, if any), at most
// the area of the surface; for periodic flats the area of the period.
double nominal_area(const Level& level, const Indenter& indenter, const Rectangle& surface) {
    if (indenter.period.finite()) return indenter.period.area();
    double radius = 0;
    for (std::size_t k = 0; k < level.x.size() && level.pixels.index.empty(); ++k) {
        const double x = level.x[k] - indenter.x0, y = level.y[k] - indenter.y0;
        radius = std::max(radius, std::sqrt(x * x + y * y) + level.a[k]);
    }
    const LevelPixels& pixels = level.pixels;
    for (std::size_t k = 0; k < pixels.index.size(); ++k) {
        const double x = std::abs(pixels.x(k) - indenter.x0) + 0.5 * pixels.dx,
                     y = std::abs(pixels.y(k) - indenter.y0) + 0.5 * pixels.dy;
        if (x * x + y * y > 0.99 * radius * radius) radius = std::max(radius, std::hypot(x, y));
    }
    const double disc = std::numbers::pi * radius * radius;
    return surface.known() ? std::min(disc, surface.Lx * surface.Ly) : disc;
}

// Counts border points that would touch but are not represented by asperities; neighbouring points
// count once. `carried`: what they may carry, E* times the sum of their penetrations and their
// width; a paraboloid cut in halves carries 0.35 of it.
std::int32_t border_contacts(const Level& level, const Indenter& indenter, const MapMarks& marks,
                             double& carried) {
    std::vector<Vec2> touching;
    std::int32_t count = 0;
    for (const auto& point : marks.border) {
        const double x = point[0], y = point[1], z = point[2];
        double gap = indenter.clearance(x, y, z) - level.separation;
        for (std::size_t k = 0; k < level.x.size() && gap > 0; ++k) {
            const double distance =
                std::max(std::hypot(level.x[k] - x, level.y[k] - y), level.a[k]);
            gap -= level.f[k] / (std::numbers::pi * indenter.E_star * distance);
        }
        if (!(gap > 0)) continue;
        carried += indenter.E_star * gap * marks.reach;
        count += std::none_of(touching.begin(), touching.end(), [&](const Vec2& t) {
            return std::hypot(t.x - x, t.y - y) < 1.5 * marks.reach;
        });
        touching.push_back({x, y});
    }
    return count;
}

// Counts contacts whose distance from the border is less than <d> or their radius, and those with a
// pixel on it.
void count_edges(Level& level, const Indenter& indenter, const SolverOptions& options) {
    level.edge_contacts = 0;
    Rectangle surface = options.surface;
    if (!surface.known()) return;
    if (indenter.around.finite()) {  // cut open far from the tip
        const bool points = !level.pixels.index.empty();
        surface.x0 = points ? level.pixels.x0 : indenter.x0 - 0.5 * surface.Lx;
        surface.y0 = points ? level.pixels.y0 : indenter.y0 - 0.5 * surface.Ly;
    }
    std::vector<bool> cut(level.x.size(), false);
    for (std::size_t k = 0; k < cut.size(); ++k)
        cut[k] =
            inside(surface, level.x[k], level.y[k]) < std::max(options.mean_spacing, level.a[k]);
    const LevelPixels& p = level.pixels;
    // A map of the indenter ends, too, and carries no load beyond its border.
    const bool ends = indenter.shape->keys().map != nullptr;
    const auto beyond = [&](double x, double y) {
        return std::isinf(indenter.shape->height(x - indenter.x0, y - indenter.y0));
    };
    const auto rows = p.dy > 0 ? static_cast<std::int32_t>(std::lround(surface.Ly / p.dy)) : 0;
    for (std::size_t k = 0; k < p.index.size(); ++k) {
        const std::int32_t column = p.index[k] % p.columns, row = p.index[k] / p.columns;
        if (column == 0 || row == 0 || column + 1 == p.columns || row + 1 == rows ||
            (ends && (beyond(p.x(k) - p.dx, p.y(k)) || beyond(p.x(k) + p.dx, p.y(k)) ||
                      beyond(p.x(k), p.y(k) - p.dy) || beyond(p.x(k), p.y(k) + p.dy))))
            cut[static_cast<std::size_t>(p.contact[k])] = true;
    }
    level.edge_contacts = static_cast<std::int32_t>(std::count(cut.begin(), cut.end(), true));
    if (!options.marks || !p.index.empty()) return;
    double carried = 0;
    level.edge_contacts += border_contacts(level, indenter, *options.marks, carried);
    if (carried > kMuchError * level.force) level.error_cause = kBorderCause;
    if (level.force > 0 && !std::isnan(level.force_error_expected))
        level.force_error_expected += carried / level.force,
            level.area_error_expected += carried / level.force;
}

// Sets large_contacts, edge_contacts and nominal_area.
void count_contacts(Level& level, const Indenter& indenter, const SolverOptions& options) {
    const auto large = [&](double a) {
        return options.mean_spacing > 0 && a > options.mean_spacing / 4;
    };
    level.large_contacts =
        static_cast<std::int32_t>(std::count_if(level.a.begin(), level.a.end(), large));
    count_edges(level, indenter, options);
    level.nominal_area = nominal_area(level, indenter, options.surface);
}

}  // namespace

bool exceeds_nominal_area(const LevelValues& level) {
    constexpr double rounding = 1e-9;  // the area of one spot under the tip equals the nominal area
    return level.nominal_area > 0 &&
           level.area > (1 + rounding) * level.nominal_area;  // 0: not defined
}

void judge_range(Level& level, const Indenter& indenter, const SolverOptions& options) {
    count_contacts(level, indenter, options);
    if (indenter.layers.count > 0) {
        const double widest = indenter.layers.layer[0].thickness / 5;
        const auto wide =
            std::count_if(level.a.begin(), level.a.end(), [&](double a) { return a > widest; });
        level.wide_contacts =
            level.a.empty() ? 0 : static_cast<double>(wide) / static_cast<double>(level.a.size());
    }
    const bool too_deep = options.sigma > 0 && level.separation < kLowestSeparation * options.sigma;
    // The expected error, if known, includes the effect of large contacts and of those beyond the
    // law.
    const bool far_off = std::isnan(level.force_error_expected)
                             ? level.large_contacts > 0 || level.beyond_law > 0
                             : level.force_error_expected > kMuchError;
    if (far_off || level.wide_contacts > 0 || level.edge_contacts > 0 ||
        exceeds_nominal_area(level) || too_deep)
        level.status = graver(level.status, LevelStatus::out_of_validity);
}

void judge_edges(Level& level, const Indenter& indenter, const SolverOptions& options) {
    count_contacts(level, indenter, options);
    if (level.edge_contacts > 0) level.status = graver(level.status, LevelStatus::out_of_validity);
}

}  // namespace rsc
