#include "trust/grid_error.hpp"

#include "base/parallel.hpp"
#include "surface/summits.hpp"
#include "trust/grid_error_table.hpp"

namespace rsc {
namespace {

// Elements, sharp punches on a plane: N differs from 2 a E* d by up to this share of the ratio of
// pixel side to radius, in nine of ten cases (input/trust/resolution.py, kind edge).
constexpr double kEdgeShare = 0.17;

// Errors of N and A on ridges, found by hand on 150 ridged bodies and checked by test_ridges. If
// all crests rose above the points as far as they can, N would grow by a share q. The error of N is
// 0.35 q where contacts are wide (small q), and three times as much just after first touch (large
// q). That of A is 0.8 sqrt(q): the width of a contact in points is proportional to 1/sqrt(q).
constexpr double kCrest = 0.35, kCrestArea = 0.8;
// Straight borders are known to half a pixel, often alike on many ridges.
constexpr double kHalfPixel = 0.5, kStraight = 0.25;

// Contacts whose straight borders are longer than this number of their widths lie on crests. Those
// of summits are rounder, and their errors need no crests (input/trust/resolution.py).
constexpr double kElongated = 3;
// Share of a period from which straight borders continue into the next one, and have no end.
constexpr double kEndless = 0.9;

constexpr int kRows = 16;  // that a thread takes at a time

// The clearance of the points of a row, z - s.
void clearances(const HeightMap& map, const Indenter& indenter, int row,
                std::vector<double>& line) {
    line.resize(std::size_t(map.nx));
    for (const int i : indices(map.nx))
        line[std::size_t(i)] = indenter.clearance(map.x(i), map.y(row), map(i, row));
}

// Height of a crest above points half a step beside it, as far as it is longer than wide: (k1 - k2)
// h^2/8 of the curvatures at a point.
double crest_height(const HeightMap& map, const Indenter& indenter,
                    const std::optional<Tensor>& curvature, int column, int row) {
    const bool repeats_x = std::isfinite(indenter.period.x),
               repeats_y = std::isfinite(indenter.period.y);
    double z[3][3];
    for (const int b : indices(3))
        for (const int a : indices(3)) {
            const int i = continued(column + a - 1, map.nx, repeats_x),
                      j = continued(row + b - 1, map.ny, repeats_y);
            z[b][a] = indenter.clearance(map.x(i), map.y(j), curvature ? 0.0 : map(i, j));
        }
    // Beyond the edge of the indenter, which lies somewhere between two points, the face is as
    // steep as if it rose to half-way between.
    for (const int b : indices(3))
        for (const int a : indices(3))
            if (const double opposite = z[2 - b][2 - a]; !std::isfinite(z[b][a]))
                z[b][a] = std::isfinite(opposite) ? 3 * opposite - 2 * z[1][1] : z[1][1];
    PointDifferences d = differences(z[0], z[1], z[2], 0, 1, 2);
    if (curvature) {
        const double top = map(column, row);
        d.zxx -= top * curvature->xx * map.dx * map.dx;
        d.zxy -= top * curvature->xy * map.dx * map.dy;
        d.zyy -= top * curvature->yy * map.dy * map.dy;
    }
    const double sum = -(d.zxx + d.zyy), difference = std::hypot(d.zxx - d.zyy, 2 * d.zxy);
    const double ridge = std::min(difference, 0.5 * (sum + difference)) / 8;
    return ridge > 0 && std::isfinite(ridge) ? ridge : 0.0;
}

// Errors of an area of two flats are relative to that of the contact, or of the gap if it is the
// smaller one: the area of the gap over that of the contact.
double of_smaller_area(const LevelValues& level) {
    const double f = level.area_fraction;  // NaN: not two flats
    return f > 0.5 ? (1 - f) / f : 1;
}

}  // namespace

GridBodies grid_bodies(bool measured, const Indenter& indenter) {
    return {measured, indenter.shape->edge(kInfinity) >= 0};
}

double error_of_resolution(const LevelQuantity& quantity, std::size_t component,
                           const LevelValues& level, const GridBodies& bodies) {
    if (quantity.own_error) return quantity.own_error(level, component);
    const std::string_view name = quantity.name;
    const auto found = std::ranges::find(kResolutionErrors, name, &ResolutionError::quantity);
    if (found == std::end(kResolutionErrors) || !(level.contacts > 0)) return kNotComputed;
    const double by_share = found->factor * std::pow(level.border_share, found->power) *
                            std::pow(level.contacts, -found->averaging);
    return std::hypot(by_share, found->of_runs * level.border_runs) *
           found->factors.of(level, bodies) * (found->area ? of_smaller_area(level) : 1.0);
}

void state_curve_errors(std::span<double> curves, std::span<const AskedCurves> asked, double step,
                        const Case& settings, const LevelValues& level, const GridBodies& bodies) {
    for (const AskedCurves& a : asked) {
        if (a.physics->curve_errors)
            a.physics->curve_errors(curves.first(a.values()), a.axis.values, step, settings, level,
                                    bodies);
        curves = curves.subspan(a.values());
    }
}

GridError error_of_grid(const LevelValues& level, const GridBodies& bodies, double edge,
                        double side) {
    const auto of = [&](const char* name) {
        return error_of_resolution(*find_quantity(name)->quantity, 0, level, bodies);
    };
    const double share = edge > 0 ? kEdgeShare * side / edge : 0;
    return {of("force") + share, of("contact_area") + share};
}

GridError error_of_crests(const Level& level, double stiffness, const HeightMap& map,
                          const Indenter& indenter, const std::optional<Tensor>& curvature) {
    // Mean length of the straight parts of borders, in pixels, weighted by their lengths, and the
    // width of a contact of this length.
    const double pixels = double(level.pixels.index.size()),
                 straight = level.border_runs * level.border_runs * pixels / level.border_share,
                 width = pixels / level.contacts / straight;
    const bool endless =
        indenter.period.finite() && map.ny > 1 && straight > kEndless * std::min(map.nx, map.ny);
    const double borders = endless ? kHalfPixel * level.border_share * of_smaller_area(level) : 0.0;
    if (!(straight > kElongated * width)) return {0, borders};
    double mean = 0;
    for (const auto c : indices(level.f))
        mean += level.f[c] / level.force *
                crest_height(map, indenter, curvature, level.asperity[c] % map.nx,
                             level.asperity[c] / map.nx);
    const double share = mean * -stiffness / level.force;
    if (!(share > 0)) return {};
    return {
        kCrest * share * (1 + 2 * share / (1 + share)),
        (kCrestArea * std::sqrt(share) + kStraight * level.border_share) * of_smaller_area(level)};
}

double touch_between_points(const HeightMap& map, const Indenter& indenter) {
    const bool repeats_x = std::isfinite(indenter.period.x),
               repeats_y = std::isfinite(indenter.period.y);
    std::vector<double> below, here, above;
    clearances(map, indenter, continued(-1, map.ny, repeats_y), below);
    clearances(map, indenter, 0, here);
    double highest = -kInfinity;
    // Body 2 may lie between the points altogether.
    const double diagonal = map.ny > 1 ? std::hypot(map.dx, map.dy) : map.dx,
                 reach = indenter.shape->reach() + diagonal;
    if (reach < 3 * diagonal)
        for (const int j : indices(map.ny))
            for (const int i : indices(map.nx)) {
                const Vec2 d = indenter.from_tip(map.x(i), map.y(j));
                if (std::hypot(d.x, d.y) < reach) highest = std::max(highest, map(i, j));
            }
    for (const int j : indices(map.ny)) {
        clearances(map, indenter, continued(j + 1, map.ny, repeats_y), above);
        for (const int i : indices(map.nx)) {
            const auto k = std::size_t(i);
            const double top = here[k];
            const auto rise = [&](double one, double other) {
                const double lower = std::min(one, other);
                return std::isfinite(lower) ? 0.5 * (top - lower) : 0.0;
            };
            const auto beside = [&](int way) {
                return here[std::size_t(continued(i + way, map.nx, repeats_x))];
            };
            const double left = beside(-1), right = beside(1);
            if (std::isfinite(top) && top >= left && top >= right && top >= below[k] &&
                top >= above[k])
                highest = std::max(highest, top + rise(left, right) + rise(below[k], above[k]));
        }
        std::swap(below, here);
        std::swap(here, above);
    }
    return highest;
}

}  // namespace rsc
