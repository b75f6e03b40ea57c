#include "elements/deformed.hpp"

#include "base/array.hpp"
#include "base/parallel.hpp"
#include "elements/periodic_pixels.hpp"
#include "elements/pixel_products.hpp"
#include "interaction/kernel.hpp"

namespace rsc {
namespace {

constexpr int kRows = 16;  // that a thread takes at a time

}  // namespace

Pressures pressures_of(const LevelPixels& pixels) {
    Pressures all = zeros_on_huge_pages<Pressures::value_type>(pixels.index.size());
    parallel_for(all.size(), 4096, 0, [&](std::size_t k) {
        all[k] = {pixels.index[k], {pixels.pressure[k], true}};
    });
    if (pixels.cohesive.empty()) return all;
    std::map<std::int64_t, Load> with_tension(all.begin(), all.end());
    for (std::size_t k = 0; k < pixels.cohesive.size(); ++k)
        with_tension[pixels.cohesive[k]] = {pixels.attraction[k], false};
    return {with_tension.begin(), with_tension.end()};
}

Array<double> deflections(const HeightMap& map, const Indenter& indenter,
                          const Pressures& pressures, const PointWindow& window) {
    const PointRange &columns = window.columns, &rows = window.rows;
    if (pressures.empty()) return Array<double>(window.points(), 0.0);
    const Substrate body = substrate_of(indenter);
    if (indenter.period.finite()) {
        std::function<double(double)> share;
        if (body.smooth()) share = [&](double k) { return body.smooth()->share(k); };
        Array<double> plane;
        PeriodicPixels<double> whole(map.nx, map.ny, map.dx, map.dy, share, &plane);
        whole.apply(
            [&](int j, double* row) {
                std::fill_n(row, map.nx, 0.0);
                const std::int64_t begin = std::int64_t{j} * map.nx;
                for (auto k = std::ranges::lower_bound(pressures, begin, {},
                                                       [](const auto& p) { return p.first; });
                     k != pressures.end() && k->first < begin + map.nx; ++k)
                    row[k->first - begin] = k->second.pressure / body.modulus();
            },
            [&](int j, const double*) {
                for (int i = columns.first; i <= columns.last; ++i) whole.row(j)[i] *= whole.unit();
            });
        // The rows of the plane are longer than those of the window, and move to smaller addresses.
        for (int j = rows.first; j <= rows.last; ++j)
            std::copy_n(whole.row(j) + columns.first, columns.size(),
                        plane.data() + window.index(columns.first, j));
        plane.resize(window.points());
        return plane;
    }
    constexpr double kError = 1e-6;
    const auto products = make_products(body, indenter.period, map, kError, kError, false);
    std::vector<Pixel> pixels;  // of the window, then others under pressure
    std::vector<double> p(window.points(), 0.0);
    for (int j = rows.first; j <= rows.last; ++j)
        for (int i = columns.first; i <= columns.last; ++i) pixels.push_back({i, j});
    for (const auto& [point, load] : pressures) {
        if (const auto inside = window.find(point)) {
            p[*inside] = load.pressure;
            continue;
        }
        pixels.push_back({static_cast<int>(point % map.nx), static_cast<int>(point / map.nx)});
        p.push_back(load.pressure);
    }
    std::vector<double> w(p.size());
    products->elsewhere(p.data(), pixels, w.data());
    return Array<double>(w.begin(), w.begin() + static_cast<std::ptrdiff_t>(window.points()));
}

Array<double> gaps(const HeightMap& heights, const Indenter& indenter, double separation,
                   const std::vector<char>& touches, const PointWindow& window,
                   Array<double> deflection) {
    const PointRange &columns = window.columns, &rows = window.rows;
    parallel_for(rows.size(), kRows, 0, [&](int j) {
        for (int i = 0; i < columns.size(); ++i) {
            const int column = columns.first + i, row = rows.first + j;
            const std::size_t k = window.index(column, row);
            double& gap = deflection[k];
            gap += separation -
                   indenter.clearance(heights.x(column), heights.y(row), heights(column, row));
            gap = touches[k] ? 0 : std::isfinite(gap) ? std::max(gap, 0.0) : kNotComputed;
        }
    });
    return deflection;
}

HeightMap lowered_map(const HeightMap& map, const ResidualProfile& lowered) {
    HeightMap now = map.copy();
    const auto index = [](double x, double first, double step, int n) {
        const int k = static_cast<int>(std::round((x - first) / step));
        return (k % n + n) % n;
    };
    for (std::size_t k = 0; k < lowered.depth.size(); ++k)
        now.row(index(lowered.y[k], map.y0, map.dy,
                      map.ny))[index(lowered.x[k], map.x0, map.dx, map.nx)] -= lowered.depth[k];
    return now;
}

}  // namespace rsc
