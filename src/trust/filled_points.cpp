#include "trust/filled_points.hpp"

namespace rsc {

bool FilledPoints::at(double x, double y) const {
    const auto nearest = [&](double from, double step, int n) {
        const int k = int(std::lround(from / step));
        return periodic ? wrapped(k, n) : k;
    };
    const int i = nearest(x - x0, dx, nx), j = nearest(y - y0, dy, ny);
    return i >= 0 && j >= 0 && i < nx && j < ny && (*filled)[index(i, j)];
}

std::vector<FilledPoints> filled_points(const Measured* measured, double x0, double y0,
                                        const Indenter& indenter) {
    std::vector<FilledPoints> maps;
    if (measured && !measured->filled.empty())
        maps.push_back({{measured->nx, measured->ny, measured->dx, measured->dy, x0, y0},
                        &measured->filled,
                        indenter.period.finite(),
                        false});
    if (const ShapeKeys& body = indenter.shape->keys(); !body.filled.empty()) {
        const HeightMap& m = *body.map;
        const double west = indenter.x0 - 0.5 * (m.nx - 1) * m.dx,
                     south = indenter.y0 - 0.5 * (m.ny - 1) * m.dy;
        maps.push_back({{m.nx, m.ny, m.dx, m.dy, west, south}, &body.filled, m.periodic, true});
    }
    return maps;
}

namespace {

// Share of the filled points in the area where the heights reach the indenter, for Gaussian heights
// of rms sigma. The points in a hole of body 2, whose face is smooth there, count like the others
// in their cell.
double expected_share(double Z0, std::span<const FilledPoints> maps, const Indenter& indenter,
                      double sigma) {
    struct Cell {
        double points = 0, reached = 0;  // outside the holes of body 2
        double filled = 0;               // part of `reached` in those of body 1
        // points in holes of body 2, and their part of the area that is reached as they are
        double missing = 0, smooth = 0;
    };
    const FilledPoints& grid = maps.front();
    const int side = indenter.period.finite() ? 1 : 8;  // cells along a side; two flats: one
    std::vector<Cell> cells(std::size_t(side) * std::size_t(side));
    constexpr int most = 128;  // points along a side, enough for a share
    const int step_x = (grid.nx + most - 1) / most, step_y = (grid.ny + most - 1) / most;
    for (int j = 0; j < grid.ny; j += step_y)
        for (int i = 0; i < grid.nx; i += step_x) {
            Cell& cell = cells[std::size_t(j * side / grid.ny * side + i * side / grid.nx)];
            const double x = grid.x(i), y = grid.y(j);
            const double reached =
                std::erfc((Z0 - indenter.clearance(x, y, 0)) / (std::numbers::sqrt2 * sigma));
            const auto in = [&](bool second) {
                return std::ranges::any_of(
                    maps, [&](const auto& map) { return map.second == second && map.at(x, y); });
            };
            if (in(true)) {
                cell.missing += 1;
                cell.smooth += reached;
            } else {
                cell.points += 1;
                cell.reached += reached;
                if (in(false)) cell.filled += reached;
            }
        }
    double filled = 0, all = 0;
    for (const Cell& c : cells) {
        const double there =
            std::max(c.points > 0 ? c.reached * c.missing / c.points : 0.0, c.smooth);
        filled += c.filled + there;
        all += c.reached + there;
    }
    return all > 0 ? filled / all : 0;
}

}  // namespace

double share_on_filled(const Level& level, std::span<const FilledPoints> maps,
                       const Indenter& indenter, double sigma) {
    double filled = 0, all = 0;
    const auto count = [&](double x, double y) {
        all += 1;
        filled += std::ranges::any_of(maps, [&](const FilledPoints& map) { return map.at(x, y); });
    };
    const LevelPixels& pixels = level.pixels;
    for (const auto k : indices(pixels.index)) count(pixels.x(k), pixels.y(k));
    const FilledPoints& grid = maps.front();
    for (std::size_t c = 0; c < level.a.size() && pixels.index.empty(); ++c) {
        const double x = level.x[c] - grid.x0, y = level.y[c] - grid.y0, a = level.a[c];
        const auto first = [&](double from) {
            return grid.periodic ? std::ceil(from) : std::max(std::ceil(from), 0.0);
        };
        const auto last = [&](double to, int n) {
            return grid.periodic ? to : std::min(to, n - 1.0);
        };
        for (double j = first((y - a) / grid.dy); j <= last((y + a) / grid.dy, grid.ny); ++j)
            for (double i = first((x - a) / grid.dx); i <= last((x + a) / grid.dx, grid.nx); ++i)
                if (std::hypot(i * grid.dx - x, j * grid.dy - y) <= a)
                    count(grid.x0 + i * grid.dx, grid.y0 + j * grid.dy);
    }
    return std::max(all > 0 ? filled / all : 0.0,
                    expected_share(level.separation, maps, indenter, sigma));
}

}  // namespace rsc
