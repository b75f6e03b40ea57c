#include "rough/defects.hpp"

#include "error.hpp"
#include "rough/library_lock.hpp"

namespace rsc {
namespace {

// Linear system for the missing points: (sum of weights) z - sum over missing neighbours w z = sum over present neighbours w z.
class HoleProblem {
public:
    explicit HoleProblem(const HeightMap& map) : map_(map) {
        // Weights, scaled so that the larger is 1.
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
        // The mean level is subtracted, so that a large offset does not cause cancellation.
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

    // Modified incomplete Cholesky factors (Gustafsson 1978): they preserve row sums, so that long waves in large holes converge fast.
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

    // Points are numbered row by row, so the left and lower neighbours have lower numbers.
    void precondition(const std::vector<double>& r, std::vector<double>& y) const {
        for (std::size_t k = 0; k < r.size(); ++k) y[k] = (r[k] + wx_ * value(y, left_[k]) + wy_ * value(y, below_[k])) * inverse_[k];
        for (std::size_t k = r.size(); k-- > 0;) y[k] += (wx_ * value(y, right_[k]) + wy_ * value(y, above_[k])) * inverse_[k];
    }

    const HeightMap& map_;
    double wx_ = 1, wy_ = 1, level_ = 0;
    std::vector<Point> points_;
    std::vector<int> left_, below_, right_, above_;  // indices of missing neighbours, or -1
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
    // Distance in columns to the nearest filled point of the same row; kNone if there is none.
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

// Least-squares plane of a map, in coordinates from its middle.
struct Plane {
    double mean = 0, along_x = 0, along_y = 0;
    explicit Plane(const HeightMap& map) : mid_x(0.5 * (map.nx - 1)), mid_y(0.5 * (map.ny - 1)) {
        double xx = 0, yy = 0;
        for (int j = 0; j < map.ny; ++j)
            for (int i = 0; i < map.nx; ++i) {
                const double x = i - mid_x, y = j - mid_y;
                mean += map(i, j), along_x += x * map(i, j), along_y += y * map(i, j);
                xx += x * x, yy += y * y;
            }
        mean /= static_cast<double>(map.nx) * map.ny;
        along_x /= std::max(xx, 1.0), along_y /= std::max(yy, 1.0);
    }
    double operator()(int i, int j) const { return mean + along_x * (i - mid_x) + along_y * (j - mid_y); }
    double mid_x, mid_y;
};

}  // namespace

double height_step(const HeightMap& map) {
    constexpr double few = 0.02;       // share of equal neighbours; with a smaller one rounding does not matter
    constexpr double rounding = 1e-6;  // relative to the step: files store heights as decimal numbers
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

void smooth_rounded(HeightMap& map, double step) {
    const auto nx = static_cast<std::size_t>(map.nx), ny = static_cast<std::size_t>(map.ny);
    const std::unique_ptr<double[], HeightMap::Free> series(allocate_doubles(nx * ny, "the cosine series of a map"));
    FftwPlan forward, back;
    {
        const auto lock = fftw_planning();
        forward.reset(fftw_plan_r2r_2d(map.ny, map.nx, series.get(), series.get(), FFTW_REDFT10, FFTW_REDFT10, FFTW_ESTIMATE));
        back.reset(fftw_plan_r2r_2d(map.ny, map.nx, series.get(), series.get(), FFTW_REDFT01, FFTW_REDFT01, FFTW_ESTIMATE));
    }
    if (!forward || !back) throw Error(Failure::internal, "smoothing of a rounded map: FFTW made no plan");
    const Plane plane(map);  // subtracted, because its cosine series would hide the rounding
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i) {
            const int column = static_cast<int>(i), row = static_cast<int>(j);
            series[j * nx + i] = map(column, row) - plane(column, row);
        }
    fftw_execute(forward.get());
    // Mean power on rings of one wavenumber each; the power of the rounding is the same on all rings.
    const double points = static_cast<double>(nx * ny), shorter = static_cast<double>(std::min(nx, ny));
    const auto ring = [&](std::size_t i, std::size_t j) {
        return static_cast<std::size_t>(std::lround(
            shorter * std::hypot(static_cast<double>(i) / static_cast<double>(nx), static_cast<double>(j) / static_cast<double>(ny))));
    };
    std::vector<double> power(ring(nx, ny) + 1), modes(power.size()), gain(power.size(), 0.0);
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i) power[ring(i, j)] += series[j * nx + i] * series[j * nx + i], ++modes[ring(i, j)];
    constexpr double safety = 1.5;  // the power of the rounding on one ring scatters
    const double rounding = safety * 4 * points * step * step / 12;
    constexpr std::size_t beside = 2;  // neighbouring rings on either side included in the mean
    for (std::size_t k = 0; k < power.size(); ++k) {
        double sum = 0, count = 0;
        for (std::size_t l = k - std::min(k, beside); l <= std::min(k + beside, power.size() - 1); ++l) sum += power[l], count += modes[l];
        gain[k] = std::max(0.0, 1 - rounding * count / std::max(sum, 1e-300));
        if (k > 0 && gain[k] == 0) break;  // all shorter waves are rounding noise
    }
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i) series[j * nx + i] *= gain[ring(i, j)] / (4 * points);
    fftw_execute(back.get());
    for (int j = 0; j < map.ny; ++j)
        for (int i = 0; i < map.nx; ++i)
            map.row(j)[i] = plane(i, j) + series[static_cast<std::size_t>(j) * nx + static_cast<std::size_t>(i)];
}

}  // namespace rsc
