#include "rough/missing.hpp"

#include <algorithm>
#include <cmath>

#include "error.hpp"
#include "rough/detection.hpp"

namespace rsc {
namespace {

// The missing points as unknowns of (sum of weights) z - sum over missing neighbours w z = sum over present neighbours w z.
class HoleProblem {
public:
    explicit HoleProblem(const HeightMap& map) : map_(map) {
        // Relative weights: the larger is 1.
        const double least = std::min(map.dx, map.dy);
        wx_ = (least / map.dx) * (least / map.dx);
        wy_ = (least / map.dy) * (least / map.dy);
        std::vector<int> number(static_cast<std::size_t>(map.nx) * static_cast<std::size_t>(map.ny), -1);
        const auto at = [&](int i, int j) -> int& {
            return number[static_cast<std::size_t>(j) * static_cast<std::size_t>(map.nx) + static_cast<std::size_t>(i)];
        };
        for (int j = 0; j < map.ny; ++j)
            for (int i = 0; i < map.nx; ++i)
                if (std::isnan(map(i, j))) {
                    at(i, j) = static_cast<int>(points_.size());
                    points_.push_back({i, j});
                }
        const std::size_t n = points_.size();
        left_.resize(n, -1), below_.resize(n, -1), right_.resize(n, -1), above_.resize(n, -1);
        diagonal_.resize(n), source_.resize(n), solution_.resize(n);
        // Unknowns are measured from one level, that large offsets cost no digits.
        double sum = 0, weight = 0;
        const auto visit = [&](std::size_t k, int i, int j, double w, int& neighbour) {
            if (i < 0 || j < 0 || i >= map.nx || j >= map.ny) return;
            diagonal_[k] += w;
            neighbour = at(i, j);
            if (neighbour < 0) sum += w * map(i, j), weight += w, source_[k] += w * map(i, j), present_[k] += w;
        };
        present_.resize(n);
        for (std::size_t k = 0; k < n; ++k) {
            const auto [i, j] = points_[k];
            visit(k, i - 1, j, wx_, left_[k]), visit(k, i + 1, j, wx_, right_[k]);
            visit(k, i, j - 1, wy_, below_[k]), visit(k, i, j + 1, wy_, above_[k]);
        }
        level_ = weight > 0 ? sum / weight : 0;
        for (std::size_t k = 0; k < n; ++k) source_[k] -= present_[k] * level_;
        factorise();
    }

    std::size_t size() const { return points_.size(); }

    // Preconditioned conjugate gradients.
    void solve() {
        const std::size_t n = size();
        std::vector<double> r = source_, y(n), p, q(n);
        precondition(r, y);
        p = y;
        double rho = dot(r, y);
        const double wanted = kTolerance * std::sqrt(dot(source_, source_));
        for (std::size_t step = 0; step < 20 * n + 100 && std::sqrt(dot(r, r)) > wanted; ++step) {
            apply(p, q);
            const double length = rho / dot(p, q);
            for (std::size_t k = 0; k < n; ++k) solution_[k] += length * p[k], r[k] -= length * q[k];
            precondition(r, y);
            const double next = dot(r, y), share = next / rho;
            rho = next;
            for (std::size_t k = 0; k < n; ++k) p[k] = y[k] + share * p[k];
        }
    }

    void store(HeightMap& map) const {
        for (std::size_t k = 0; k < size(); ++k) map.row(points_[k].j)[points_[k].i] = level_ + solution_[k];
    }
    void mark(std::vector<std::uint8_t>& filled) const {
        filled.assign(static_cast<std::size_t>(map_.nx) * static_cast<std::size_t>(map_.ny), 0);
        for (const auto [i, j] : points_)
            filled[static_cast<std::size_t>(j) * static_cast<std::size_t>(map_.nx) + static_cast<std::size_t>(i)] = 1;
    }

private:
    static constexpr double kTolerance = 1e-12;
    struct Point {
        int i, j;
    };

    static double dot(const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0;
        for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
        return sum;
    }
    static double value(const std::vector<double>& x, int k) { return k >= 0 ? x[static_cast<std::size_t>(k)] : 0.0; }

    void apply(const std::vector<double>& x, std::vector<double>& y) const {
        for (std::size_t k = 0; k < x.size(); ++k)
            y[k] =
                diagonal_[k] * x[k] - wx_ * (value(x, left_[k]) + value(x, right_[k])) - wy_ * (value(x, below_[k]) + value(x, above_[k]));
    }

    // Modified incomplete Cholesky factors (Gustafsson 1978): row sums are kept, so that long waves in a large hole converge fast.
    void factorise() {
        constexpr double kModified = 0.97;
        const std::size_t n = size();
        inverse_.resize(n);
        for (std::size_t k = 0; k < n; ++k) {
            double e = diagonal_[k];
            const auto eliminate = [&](int m, double w, int sideways, double w_sideways) {
                if (m < 0) return;
                const double d = inverse_[static_cast<std::size_t>(m)];
                e -= w * w * d;
                if (sideways >= 0) e -= kModified * w * w_sideways * d;
            };
            if (left_[k] >= 0) eliminate(left_[k], wx_, above_[static_cast<std::size_t>(left_[k])], wy_);
            if (below_[k] >= 0) eliminate(below_[k], wy_, right_[static_cast<std::size_t>(below_[k])], wx_);
            inverse_[k] = 1 / (e > 0.1 * diagonal_[k] ? e : diagonal_[k]);
        }
    }

    // Points are numbered row by row: left and below come before.
    void precondition(const std::vector<double>& r, std::vector<double>& y) const {
        for (std::size_t k = 0; k < r.size(); ++k) y[k] = (r[k] + wx_ * value(y, left_[k]) + wy_ * value(y, below_[k])) * inverse_[k];
        for (std::size_t k = r.size(); k-- > 0;) y[k] += (wx_ * value(y, right_[k]) + wy_ * value(y, above_[k])) * inverse_[k];
    }

    const HeightMap& map_;
    double wx_ = 1, wy_ = 1, level_ = 0;
    std::vector<Point> points_;
    std::vector<int> left_, below_, right_, above_;  // neighbours that are missing, or -1
    std::vector<double> diagonal_, present_, source_, solution_, inverse_;
};

}  // namespace

long count_missing(const HeightMap& map) {
    long missing = 0;
    for (int j = 0; j < map.ny; ++j)
        for (int i = 0; i < map.nx; ++i) missing += std::isnan(map(i, j));
    return missing;
}

std::vector<std::uint8_t> fill_missing(HeightMap& map) {
    const long missing = count_missing(map);
    if (missing == 0) return {};
    if (missing == static_cast<long>(map.nx) * map.ny) throw Error(Failure::bad_input, "all points of the map are missing");
    HoleProblem hole(map);
    hole.solve();
    std::vector<std::uint8_t> filled;
    hole.mark(filled);
    hole.store(map);
    return filled;
}

void drop_near_filled(Asperities& a, SummitCount& count, const HeightMap& map, const std::vector<std::uint8_t>& filled, double distance) {
    if (filled.empty()) return;
    // Columns to the nearest filled point of the same row; a large number where there is none.
    constexpr int kNone = 1 << 30;
    const auto nx = static_cast<std::size_t>(map.nx);
    std::vector<int> along(filled.size(), kNone);
    for (int j = 0; j < map.ny; ++j) {
        const std::size_t row = static_cast<std::size_t>(j) * nx;
        int gone = kNone;
        const auto step = [&](std::size_t at) {
            gone = filled[at] ? 0 : std::min(gone + 1, kNone);
            along[at] = std::min(along[at], gone);
        };
        for (std::size_t i = 0; i < nx; ++i) step(row + i);
        gone = kNone;
        for (std::size_t i = nx; i-- > 0;) step(row + i);
    }
    const int reach = static_cast<int>(std::min(std::ceil(distance / map.dy), static_cast<double>(map.ny)));
    const auto near = [&](double x, double y) {
        const double u = (x - map.x0) / map.dx, v = (y - map.y0) / map.dy;
        const int i = std::clamp(static_cast<int>(std::lround(u)), 0, map.nx - 1),
                  j = std::clamp(static_cast<int>(std::lround(v)), 0, map.ny - 1);
        for (int d = std::max(-reach, -j); d <= std::min(reach, map.ny - 1 - j); ++d) {
            const int columns = along[static_cast<std::size_t>(j + d) * nx + static_cast<std::size_t>(i)];
            if (columns < kNone && std::hypot(columns * map.dx, d * map.dy) < distance) return true;
        }
        return false;
    };
    std::size_t kept = 0;
    double sum_g = 0, sum_a = 0;
    const auto move = [&](std::vector<double>& values, std::size_t k) {
        if (!values.empty()) values[kept] = values[k];
    };
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (near(a.x[k], a.y[k])) continue;
        sum_g += std::sqrt(a.kappa1[k] * a.kappa2[k]);
        sum_a += 0.5 * (a.kappa1[k] + a.kappa2[k]);
        for (const AsperityColumn& column : kAsperityColumns) move(a.*column.values, k);
        ++kept;
    }
    for (const AsperityColumn& column : kAsperityColumns)
        if (!(a.*column.values).empty()) (a.*column.values).resize(kept);
    const double n = kept > 0 ? static_cast<double>(kept) : 1.0;
    count.summits = static_cast<long>(kept);
    count.mean_kappa_g = sum_g / n;
    count.mean_kappa_a = sum_a / n;
}

}  // namespace rsc
