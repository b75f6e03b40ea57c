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

RadialMean::RadialMean(const MapGrid& grid, double x0, double y0, int bins) : start_{0} {
    const double largest = std::min({x0 - grid.x0, grid.x0 + grid.Lx() - x0, y0 - grid.y0, grid.y0 + grid.Ly() - y0});
    if (!(largest > 0) || bins < 1) return;
    ring_width_ = largest / bins;
    std::vector<double> row(static_cast<std::size_t>(grid.cells()));
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
        for (int c = 0; c < grid.cells(); ++c) {
            if (row[static_cast<std::size_t>(c)] == 0) continue;
            cell_.push_back(c);
            weight_.push_back(row[static_cast<std::size_t>(c)]);
        }
        start_.push_back(cell_.size());
    }
}

std::vector<double> RadialMean::operator()(const double* values) const {
    std::vector<double> mean(radii_.size());
    for (std::size_t b = 0; b < mean.size(); ++b)
        for (std::size_t k = start_[b]; k < start_[b + 1]; ++k) mean[b] += weight_[k] * values[cell_[k]];
    return mean;
}

}  // namespace rsc
