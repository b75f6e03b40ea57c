#include "rough/defects.hpp"

#include "error.hpp"

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
    const HeightMap rounded = map.copy();
    // Mean length of plateaus, 1/(1 - share of equal neighbours). They may be tilted, because a form was subtracted.
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
