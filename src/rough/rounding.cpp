#include "rough/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rsc {
namespace {

// Share of neighbours along rows whose heights differ by no more than `same`.
double equal_share(const HeightMap& map, double same) {
    long equal = 0, pairs = 0;
    for (int j = 0; j < map.ny; ++j)
        for (int i = 1; i < map.nx; ++i) {
            const double d = std::abs(map(i, j) - map(i - 1, j));
            if (std::isnan(d)) continue;
            ++pairs;
            equal += d <= same;
        }
    return pairs > 0 ? static_cast<double>(equal) / static_cast<double>(pairs) : 0.0;
}

// 2 G - G G along a line of n values with G Gaussian: paraboloids go through unchanged. Lines are reflected at their ends, or repeat.
class Smoothing {
public:
    explicit Smoothing(double width) {
        const int reach = std::max(1, static_cast<int>(std::ceil(3 * width)));
        std::vector<double> gauss;
        double sum = 0;
        for (int k = -reach; k <= reach; ++k) gauss.push_back(std::exp(-0.5 * k * k / (width * width))), sum += gauss.back();
        for (double& g : gauss) g /= sum;
        const int n = 2 * reach;
        weight_.assign(static_cast<std::size_t>(2 * n + 1), 0.0);
        for (int k = -reach; k <= reach; ++k) {
            weight_[static_cast<std::size_t>(n + k)] += 2 * gauss[static_cast<std::size_t>(reach + k)];
            for (int l = -reach; l <= reach; ++l)
                weight_[static_cast<std::size_t>(n + k + l)] -=
                    gauss[static_cast<std::size_t>(reach + k)] * gauss[static_cast<std::size_t>(reach + l)];
        }
        reach_ = n;
    }
    // Across the rows, and along them.
    void rows(HeightMap& map) const {
        HeightMap out;
        out.allocate(map.nx, map.ny, map.nx);
        for (int j = 0; j < map.ny; ++j) {
            double* const to = out.row(j);
            std::fill(to, to + map.nx, 0.0);
            for (int k = -reach_; k <= reach_; ++k) {
                const double w = weight_[static_cast<std::size_t>(reach_ + k)];
                const double* const from = map.row(inside(j + k, map.ny, map.periodic));
                for (int i = 0; i < map.nx; ++i) to[i] += w * from[i];
            }
        }
        for (int j = 0; j < map.ny; ++j) std::copy_n(out.row(j), map.nx, map.row(j));
    }
    void columns(HeightMap& map) const {
        std::vector<double> line(static_cast<std::size_t>(map.nx + 2 * reach_));
        for (int j = 0; j < map.ny; ++j) {
            double* const row = map.row(j);
            for (int i = -reach_; i < map.nx + reach_; ++i)
                line[static_cast<std::size_t>(i + reach_)] = row[inside(i, map.nx, map.periodic)];
            std::fill(row, row + map.nx, 0.0);
            for (int k = 0; k <= 2 * reach_; ++k)
                for (int i = 0; i < map.nx; ++i) row[i] += weight_[static_cast<std::size_t>(k)] * line[static_cast<std::size_t>(i + k)];
        }
    }

private:
    static int inside(int i, int n, bool periodic) {
        if (periodic) return (i % n + n) % n;
        const int two = 2 * n;
        i = (i % two + two) % two;
        return i < n ? i : two - 1 - i;
    }
    int reach_ = 0;
    std::vector<double> weight_;
};

}  // namespace

double height_step(const HeightMap& map) {
    constexpr double few = 0.02;       // equal neighbours; fewer change nothing
    constexpr double rounding = 1e-6;  // of the step: heights are decimal numbers in a file
    double least = 0;
    for (int j = 0; j < map.ny; ++j)
        for (int i = 1; i < map.nx; ++i) {
            const double d = std::abs(map(i, j) - map(i - 1, j));
            const double noise = 1e-12 * (std::abs(map(i, j)) + std::abs(map(i - 1, j)));
            if (d > noise && (least == 0 || d < least)) least = d;
        }
    if (!(least > 0) || equal_share(map, rounding * least) < few) return 0;
    long pairs = 0, other = 0;
    for (int j = 0; j < map.ny; ++j)
        for (int i = 1; i < map.nx; ++i) {
            const double steps = std::abs(map(i, j) - map(i - 1, j)) / least;
            if (std::isnan(steps)) continue;
            ++pairs;
            other += std::abs(steps - std::round(steps)) > 1e-3 * std::max(1.0, steps);
        }
    constexpr double most_other = 1e-3;
    return static_cast<double>(other) <= most_other * static_cast<double>(pairs) ? least : 0.0;
}

void smooth_within_step(HeightMap& map, double step) {
    HeightMap rounded;
    rounded.allocate(map.nx, map.ny, map.nx);
    for (int j = 0; j < map.ny; ++j) std::copy_n(map.row(j), map.nx, rounded.row(j));
    // How long plateaus are: 1/(1 - share of equal neighbours). A form may have been taken off since they were level.
    constexpr double longest = 16, tilted = 0.25;
    const double length = std::min(longest, 1 / std::max(1e-3, 1 - equal_share(map, tilted * step)));
    constexpr int passes = 4;
    for (const double width : {0.5 * length, 0.25 * length}) {
        const Smoothing smoothing(std::max(0.5, width));
        for (int pass = 0; pass < passes; ++pass) {
            smoothing.columns(map);
            smoothing.rows(map);
            for (int j = 0; j < map.ny; ++j)
                for (int i = 0; i < map.nx; ++i)
                    map.row(j)[i] = std::clamp(map(i, j), rounded(i, j) - 0.5 * step, rounded(i, j) + 0.5 * step);
        }
    }
}

}  // namespace rsc
