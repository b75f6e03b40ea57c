#include "observe/map.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace rsc {

int MapGrid::cell(double px, double py) const {
    const double u = (px - x0) / side, v = (py - y0) / side;
    if (!(u >= 0 && u <= nx && v >= 0 && v <= ny)) return -1;
    // Grid points lie on the borders of cells; rounding must not move some of them to the previous
    // cell.
    const double up = 1 + 8 * std::numeric_limits<double>::epsilon();
    const int i = std::min(static_cast<int>(u * up), nx - 1),
              j = std::min(static_cast<int>(v * up), ny - 1);
    return j * nx + i;
}

MapGrid make_map_grid(double x0, double y0, double Lx, double Ly, int cells) {
    if (!(Lx > 0) || !(Ly > 0) || !std::isfinite(Lx) || !std::isfinite(Ly))
        bad_input("coarse map: the sides of the surface must be positive and finite");
    if (cells < 1)
        bad_input("coarse map: the number of cells must be at least 1, not " +
                  std::to_string(cells));
    MapGrid grid{x0, y0, Lx / cells, cells, 0};
    const double exactly = Ly / grid.side,
                 rows = std::ceil(exactly * (1 - 8 * std::numeric_limits<double>::epsilon()));
    // Ly may be a whole number of cells up to rounding.
    const bool whole = rows <= exactly * (1 + 8 * std::numeric_limits<double>::epsilon());
    grid.Ly = whole ? rows * grid.side : Ly;
    grid.last_row = whole ? 1 : exactly - (rows - 1);
    if (rows * cells > 1e8) bad_input("coarse map: more than 1e8 cells; decrease map_cells");
    grid.ny = static_cast<int>(rows);
    return grid;
}

namespace {

// Calls visit(cell, share) for the cells along one axis that [from, from + length] overlaps, in
// units of cells. Parts outside the map are added to its last cell.
template <class Visit>
void share_out(double from, double length, int cells, Visit visit) {
    const double to = from + length;
    const auto clamped = [cells](double u) {
        return std::clamp(static_cast<int>(std::floor(u)), 0, cells - 1);
    };
    const int first = clamped(from), last = clamped(std::nextafter(to, from));
    for (int c = first; c <= last; ++c) {
        const double low = c == first ? from : c, high = c == last ? to : c + 1;
        visit(c, (high - low) / length);
    }
}

}  // namespace

MapLevel map_level(const MapGrid& grid, const Level& level) {
    struct Entry {
        std::int32_t cell;
        double area, force;
    };
    MapLevel map;
    std::vector<Entry> entries;
    const LevelPixels& pixels = level.pixels;
    const LevelTractions& t = level.tractions;
    const auto add = [&](std::int32_t cell, double area, double force) {
        if (entries.empty() || entries.back().cell != cell) entries.push_back({cell, 0, 0});
        entries.back().area += area;
        entries.back().force += force;
    };
    const auto add_spot = [&](double x, double y, double area, double force) {
        if (const int cell = grid.cell(x, y); cell >= 0) add(cell, area, force);
    };
    const auto add_pixel = [&](double x, double y, double area, double pressure) {
        if (grid.cell(x, y) < 0) return;
        const double u = (x - grid.x0) / grid.side, v = (y - grid.y0) / grid.side,
                     force = pressure * pixels.dx * pixels.dy;
        share_out(v, pixels.dy / grid.side, grid.ny, [&](int j, double part_y) {
            share_out(u, pixels.dx / grid.side, grid.nx, [&](int i, double part_x) {
                add(j * grid.nx + i, part_x * part_y * area, part_x * part_y * force);
            });
        });
    };
    for (std::size_t k = 0; k < level.asperity.size(); ++k)
        map.outside += grid.cell(level.x[k], level.y[k]) < 0;
    // Each pixel has an equal share of the area of its contact. It covers the cell of the surface
    // that begins at its point.
    std::vector<double> share(level.a.size(), 0.0);
    if (pixels.index.empty()) {
        for (std::size_t k = 0; k < level.asperity.size(); ++k) {
            const double area =
                level.own_area.empty() ? pi * level.a[k] * level.a[k] : level.own_area[k];
            add_spot(level.x[k], level.y[k], area, t.x.empty() ? level.f[k] : 0);
        }
    } else {
        for (const std::int32_t contact : pixels.contact) share[at(contact)] += 1;
        for (std::size_t c = 0; c < share.size(); ++c)
            share[c] = pi * level.a[c] * level.a[c] / share[c];
    }
    pixels.each([&](std::int32_t pixel, double pressure, int contact) {
        const double area = contact < 0 ? 0 : share[at(contact)];
        add_pixel(pixels.x_of(pixel), pixels.y_of(pixel), area, pressure);
    });
    for (std::size_t k = 0; k < t.x.size(); ++k)
        add_spot(t.x[k], t.y[k], 0, t.pressed[k] + t.pulled[k]);
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.cell < b.cell; });
    for (const Entry& e : entries) {
        if (map.cell.empty() || map.cell.back() != e.cell) {
            map.cell.push_back(e.cell);
            map.area.push_back(0);
            map.force.push_back(0);
        }
        map.area.back() += e.area;
        map.force.back() += e.force;
    }
    return map;
}

std::int32_t count_crowded_cells(const MapGrid& grid, const MapLevel& map) {
    const double limit = kCrowdedFraction * grid.side * grid.side;
    return static_cast<std::int32_t>(
        std::count_if(map.area.begin(), map.area.end(), [&](double area) { return area > limit; }));
}

BezierWeights bezier_weights(int n, double s) {
    BezierWeights w;
    if (n == 1) return {0, 1, {1, 0, 0, 0}};
    const int i = std::clamp(static_cast<int>(std::floor(s)), 0, n - 2);
    const double t = s - i, q = 1 - t;
    if (n == 2) return {0, 2, {q, t, 0, 0}};

    const double b0 = q * q * q, b1 = 3 * q * q * t, b2 = 3 * q * t * t,
                 b3 = t * t * t;  // Bernstein polynomials
    w.first = std::clamp(i - 1, 0, std::max(n - 4, 0));
    w.count = std::min(n, 4);
    const auto at = [&w](int node) -> double& {
        return w.weight[static_cast<std::size_t>(node - w.first)];
    };
    at(i) += b0 + b1;
    at(i + 1) += b2 + b3;
    const auto add_tangent = [&](int node, double factor) {
        if (node == 0) {
            at(0) += -1.5 * factor;
            at(1) += 2 * factor;
            at(2) += -0.5 * factor;
        } else if (node == n - 1) {
            at(n - 1) += 1.5 * factor;
            at(n - 2) += -2 * factor;
            at(n - 3) += 0.5 * factor;
        } else {
            at(node + 1) += 0.5 * factor;
            at(node - 1) += -0.5 * factor;
        }
    };
    add_tangent(i, b1 / 3);
    add_tangent(i + 1, -b2 / 3);
    return w;
}

namespace {

// Calls use(cell, weight) for each cell that contributes to the interpolated value at a point.
template <class Use>
void for_each_weight(const MapGrid& grid, double px, double py, Use use) {
    const BezierWeights wx = bezier_weights(grid.nx, (px - grid.x0) / grid.side - 0.5);
    const BezierWeights wy = bezier_weights(grid.ny, (py - grid.y0) / grid.side - 0.5);
    for (int j = 0; j < wy.count; ++j)
        for (int i = 0; i < wx.count; ++i) {
            const double covered = wy.first + j == grid.ny - 1 ? grid.last_row : 1;
            use(static_cast<std::size_t>((wy.first + j) * grid.nx + wx.first + i),
                wy.weight[static_cast<std::size_t>(j)] * wx.weight[static_cast<std::size_t>(i)] /
                    covered);
        }
}

}  // namespace

RadialMean::RadialMean(const MapGrid& grid, double x0, double y0, int bins) {
    const double largest =
        std::min({x0 - grid.x0, grid.x0 + grid.Lx() - x0, y0 - grid.y0, grid.y0 + grid.Ly - y0});
    if (!(largest > 0) || bins < 1) return;
    const double ring_width = largest / bins;
    std::vector<double> row(static_cast<std::size_t>(grid.cells()));
    std::vector<std::size_t> touched;  // cells of the circle
    for (int b = 0; b < bins; ++b) {
        stopping_point();
        const double r = (b + 0.5) * ring_width;
        radii_.push_back(r);
        // A multiple of 4 preserves the symmetry of a square with the tip at its centre.
        const int angles = 4 * std::max(16, static_cast<int>(std::ceil(4 * pi * r / grid.side)));
        touched.clear();
        for (int k = 0; k < angles; ++k) {
            const double phi = 2 * pi * (k + 0.5) / angles;
            for_each_weight(grid, x0 + r * std::cos(phi), y0 + r * std::sin(phi),
                            [&](std::size_t cell, double weight) {
                                if (row[cell] == 0) touched.push_back(cell);
                                row[cell] += weight / angles;
                            });
        }
        for (const std::size_t c : touched)
            if (const double weight = std::exchange(row[c], 0.0); weight != 0)
                parts_.push_back(
                    {static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(b), weight});
    }
    std::ranges::stable_sort(parts_, {}, &Part::cell);
    for (std::size_t k = 0; k < parts_.size(); ++k)
        if (k == 0 || parts_[k].cell != parts_[k - 1].cell) first_.push_back(k);
    first_.push_back(parts_.size());
}

std::vector<double> RadialMean::operator()(const double* values) const {
    std::vector<double> mean(radii_.size());
    for (std::size_t c = 0; c + 1 < first_.size(); ++c)
        if (const double value = values[parts_[first_[c]].cell]; value != 0)
            for (std::size_t k = first_[c]; k < first_[c + 1]; ++k)
                mean[parts_[k].circle] += parts_[k].weight * value;
    return mean;
}

}  // namespace rsc
