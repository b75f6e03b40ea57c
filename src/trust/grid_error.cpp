#include "trust/grid_error.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "contact/make.hpp"
#include "surface/summits.hpp"

namespace rsc {
namespace {

// Expected error of N for contacts of one pixel, on synthetic surfaces and on maps, assumed to
// decrease as the third power of the contact radius in pixels: an empirical lower bound for
// contacts of few pixels.
constexpr double kOnePixel = 2, kOnePixelRead = 0.7;
double of_pixels(double pixels, bool read) {
    return (read ? kOnePixelRead : kOnePixel) * std::pow(pixels, -1.5);
}

// Error of A of pixels in whole numbers: fitted to 180 levels of random surfaces and shapes against
// 40 points in the shortest wave (test/README).
constexpr double kPixelArea = 0.5;

// Elements, sharp punches on a plane: N differs from 2 a E* d by up to this share of the ratio of
// pixel side to radius, in nine of ten cases.
constexpr double kEdgeShare = 0.17;

// Two flats: changes of N with the grid are several times larger than this tolerance, and are
// needed to one digit.
constexpr double kTolerance = 2e-5;

// Errors of N and A on ridges, fitted to 150 ridged bodies (test/README). If all crests rose above
// the points as far as they can, N would grow by a share q. The error of N is 0.35 q where contacts
// are wide (small q), and three times as much just after first touch (large q). That of A is 0.8
// sqrt(q): the width of a contact in points is proportional to 1/sqrt(q).
constexpr double kCrest = 0.35, kCrestArea = 0.8;

constexpr int kRows = 16;  // that a thread takes at a time

double edge_share(const Indenter& indenter, double side) {
    const double edge = indenter.shape->edge(side);
    return edge > 0 ? kEdgeShare * side / edge : 0;
}

// The clearance of the points of a row, z - s.
void clearances(const HeightMap& map, const Indenter& indenter, int row,
                std::vector<double>& line) {
    line.resize(std::size_t(map.nx));
    for (const int i : indices(map.nx))
        line[std::size_t(i)] = indenter.clearance(map.x(i), map.y(row), map(i, row));
}

// Column and row of the highest point under the indenter.
std::array<int, 2> highest_point(const HeightMap& map, const Indenter& indenter) {
    struct Top {
        double z;
        int column;
    };
    std::vector<Top> tops(std::size_t(map.ny));
    parallel_for(map.ny, kRows, 0, [&](int j) {
        std::vector<double> line;
        clearances(map, indenter, j, line);
        const auto top = std::ranges::max_element(line);
        tops[std::size_t(j)] = {std::isnan(*top) ? -kInfinity : *top, int(top - line.begin())};
    });
    const auto highest = std::ranges::max_element(tops, {}, &Top::z);
    return {highest->column, int(highest - tops.begin())};
}

// Along an axis that repeats the points of the coarse map are evenly spaced over the period,
// otherwise they are every second point.
HeightMap coarser_period(const HeightMap& map, const Period& period, std::array<int, 2> first) {
    struct Axis {
        int points, first, n;
        bool repeats;
        double step;
        Axis(int n_, int first_, double step_, bool repeats_)
            : first(first_), n(n_), repeats(repeats_) {
            points = (n + 1) / 2;
            step = n * step_ / points;
            if (repeats) return;
            first %= 2;
            points = (n - first + 1) / 2;
            step = 2 * step_;
        }
        int at(int k) const {
            return repeats ? wrapped(first + int(std::int64_t{k} * n / points), n) : first + 2 * k;
        }
    };
    const Axis x(map.nx, first[0], map.dx, std::isfinite(period.x)),
        y(map.ny, first[1], map.dy, std::isfinite(period.y));
    HeightMap coarse;
    coarse.allocate(x.points, y.points, x.points);
    coarse.dx = x.step;
    coarse.dy = y.step;
    coarse.x0 = map.x(x.first);
    coarse.y0 = map.y(y.first);
    coarse.periodic = map.periodic;
    parallel_for(y.points, kRows, 0, [&](int j) {
        for (const int i : indices(x.points)) coarse.row(j)[i] = map(x.at(i), y.at(j));
    });
    return coarse;
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

}  // namespace

HeightMap coarser_map(const HeightMap& map, const Indenter& indenter) {
    std::array<int, 2> first = highest_point(map, indenter);
    for (int& k : first) ++k;
    if (indenter.period.finite() || indenter.period.line())
        return coarser_period(map, indenter.period, first);
    return every_second_point_of(map, first[0] % 2, first[1] % 2);
}

SecondGrid::SecondGrid(const HeightMap& map, const Indenter& indenter, const SolverOptions& options,
                       bool read)
    : map_(coarser_map(map, indenter)), read_(read) {
    SolverOptions coarse = options;
    if (indenter.period.finite()) coarse.tolerance = std::max(coarse.tolerance, kTolerance);
    contact_ = make_element_contact(map_, indenter, coarse);
}

std::optional<GridError> SecondGrid::error(const LevelValues& level, Path& contact, bool by_force) {
    const Indenter &here = contact.indenter(), &there = contact_->indenter();
    if (here.x0 != there.x0 || here.y0 != there.y0) contact_->move_tip(here.x0, here.y0);
    contact_->set_time(contact.time());
    Level other;
    try {
        other = by_force && level.force > 0 ? contact_->at_force(level.force)
                                            : contact_->at_separation(level.separation);
    } catch (const Error& error) {  // two flats closer than this grid allows
        if (error.kind() != Failure::bad_input) throw;
        return {};
    }
    if (!other.converged || level.contacts == 0) return {};
    // Under the same force the change of the separation is one of N at the separation.
    const double change_of_N = by_force
                                   ? contact.stiffness() * (level.separation - other.separation)
                                   : level.force - other.force;
    const double part = read_ ? 0.5 : 1.0, force = part * std::abs(change_of_N / level.force),
                 area = part * std::abs(1 - other.area / level.area);
    const GridError few =
        error_of_pixels(level, contact.indenter(), 0.5 * std::max(map_.dx, map_.dy), read_);
    // Fitted to maps solved on a grid of half the step (test/README, elements on maps): nine of ten
    // are within these bounds.
    if (read_) return GridError{few.force + force + 0.04 * area, few.area + 1.4 * area + 2 * force};
    // Contacts of a few pixels may have the same error on both grids, and their areas in whole
    // pixels by chance.
    const double by_chance = of_pixels(level.pixels_per_contact, false);
    return GridError{few.force + std::max(force - by_chance, 0.0),
                     few.area + std::max(area - by_chance, 0.0)};
}

GridError error_of_pixels(const LevelValues& level, const Indenter& indenter, double side,
                          bool read) {
    const double pixels = level.pixels_per_contact,
                 force = of_pixels(pixels, read) + edge_share(indenter, side);
    return {force, force + (read ? 1.0 : kPixelArea) * std::pow(pixels, -0.75)};
}

GridError error_of_crests(const Level& level, double stiffness, const HeightMap& map,
                          const Indenter& indenter, const std::optional<Tensor>& curvature) {
    double mean = 0;
    for (const auto c : indices(level.f))
        mean += level.f[c] / level.force *
                crest_height(map, indenter, curvature, level.asperity[c] % map.nx,
                             level.asperity[c] / map.nx);
    const double share = mean * -stiffness / level.force;
    return share > 0 ? GridError{kCrest * share * (1 + 2 * share / (1 + share)),
                                 kCrestArea * std::sqrt(share)}
                     : GridError{};
}

double touch_between_points(const HeightMap& map, const Indenter& indenter) {
    const bool repeats_x = std::isfinite(indenter.period.x),
               repeats_y = std::isfinite(indenter.period.y);
    std::vector<double> below, here, above;
    clearances(map, indenter, continued(-1, map.ny, repeats_y), below);
    clearances(map, indenter, 0, here);
    double highest = -kInfinity;
    // Body 2 may lie between the points altogether.
    const double reach = indenter.shape->reach() + std::hypot(map.dx, map.dy);
    if (reach < 3 * std::hypot(map.dx, map.dy))
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
