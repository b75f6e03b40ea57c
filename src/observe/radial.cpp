#include "observe/radial.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rsc {

BezierWeights bezier_weights(int n, double s) {
    BezierWeights w;
    if (n == 1) return {0, 1, {1, 0, 0, 0}};
    const int i = std::clamp(static_cast<int>(std::floor(s)), 0, n - 2);
    const double t = s - i, q = 1 - t;
    if (n == 2) return {0, 2, {q, t, 0, 0}};

    const double b0 = q * q * q, b1 = 3 * q * q * t, b2 = 3 * q * t * t, b3 = t * t * t;  // Bernstein polynomials
    w.first = std::clamp(i - 1, 0, std::max(n - 4, 0));
    w.count = std::min(n, 4);
    const auto at = [&w](int node) -> double& { return w.weight[static_cast<std::size_t>(node - w.first)]; };
    at(i) += b0 + b1;
    at(i + 1) += b2 + b3;
    const auto add_tangent = [&](int node, double factor) {
        if (node == 0) {
            at(0) += -1.5 * factor, at(1) += 2 * factor, at(2) += -0.5 * factor;
        } else if (node == n - 1) {
            at(n - 1) += 1.5 * factor, at(n - 2) += -2 * factor, at(n - 3) += 0.5 * factor;
        } else {
            at(node + 1) += 0.5 * factor, at(node - 1) += -0.5 * factor;
        }
    };
    add_tangent(i, b1 / 3);
    add_tangent(i + 1, -b2 / 3);
    return w;
}

namespace {

// Calls use(cell, weight) for each cell that the value at a point of the map is made of.
template <class Use>
void for_each_weight(const MapGrid& grid, double px, double py, Use use) {
    const BezierWeights wx = bezier_weights(grid.nx, (px - grid.x0) / grid.side - 0.5);
    const BezierWeights wy = bezier_weights(grid.ny, (py - grid.y0) / grid.side - 0.5);
    for (int j = 0; j < wy.count; ++j)
        for (int i = 0; i < wx.count; ++i)
            use(static_cast<std::size_t>((wy.first + j) * grid.nx + wx.first + i),
                wy.weight[static_cast<std::size_t>(j)] * wx.weight[static_cast<std::size_t>(i)]);
}

}  // namespace

double interpolate(const MapGrid& grid, const std::vector<double>& values, double px, double py) {
    double sum = 0;
    for_each_weight(grid, px, py, [&](std::size_t cell, double weight) { sum += weight * values[cell]; });
    return sum;
}

RadialMean::RadialMean(const MapGrid& grid, double x0, double y0, int bins) {
    const double largest = std::min({x0 - grid.x0, grid.x0 + grid.Lx() - x0, y0 - grid.y0, grid.y0 + grid.Ly() - y0});
    if (!(largest > 0) || bins < 1) return;
    ring_width_ = largest / bins;
    const auto cells = static_cast<std::size_t>(grid.cells());
    std::vector<double> row(cells);
    struct Part {
        std::size_t cell;
        int circle;
        double weight;
    };
    std::vector<Part> parts;
    for (int b = 0; b < bins; ++b) {
        const double r = (b + 0.5) * ring_width_;
        radii_.push_back(r);
        // A multiple of 4 keeps the symmetry of the square about a tip in its middle.
        const int angles = 4 * std::max(16, static_cast<int>(std::ceil(4 * std::numbers::pi * r / grid.side)));
        std::fill(row.begin(), row.end(), 0.0);
        for (int k = 0; k < angles; ++k) {
            const double phi = 2 * std::numbers::pi * (k + 0.5) / angles;
            for_each_weight(grid, x0 + r * std::cos(phi), y0 + r * std::sin(phi),
                            [&](std::size_t cell, double weight) { row[cell] += weight / angles; });
        }
        for (std::size_t c = 0; c < cells; ++c)
            if (row[c] != 0) parts.push_back({c, b, row[c]});
    }
    start_.assign(cells + 1, 0);
    for (const Part& part : parts) ++start_[part.cell + 1];
    for (std::size_t c = 0; c < cells; ++c) start_[c + 1] += start_[c];
    circle_.resize(parts.size());
    weight_.resize(parts.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (const Part& part : parts) {
        const std::size_t k = next[part.cell]++;
        circle_[k] = part.circle;
        weight_[k] = part.weight;
    }
}

std::vector<double> RadialMean::operator()(const double* values) const {
    std::vector<double> mean(radii_.size());
    for (std::size_t c = 0; c + 1 < start_.size(); ++c) {
        if (values[c] == 0) continue;
        for (std::size_t k = start_[c]; k < start_[c + 1]; ++k) mean[static_cast<std::size_t>(circle_[k])] += weight_[k] * values[c];
    }
    return mean;
}

}  // namespace rsc
