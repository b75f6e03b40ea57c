#include "surface/defects.hpp"

#include "base/error.hpp"
#include "base/library_lock.hpp"
#include "surface/form.hpp"

namespace rsc {
namespace {

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Linear system for the missing points: (sum of weights) z - sum over missing neighbours w z = sum
// over present neighbours w z.
class HoleProblem {
public:
    explicit HoleProblem(const HeightMap& map) {
        std::vector<int> number(map.points(), -1);
        for (const int j : indices(map.ny))
            for (const int i : indices(map.nx))
                if (std::isnan(map(i, j))) {
                    number[map.index(i, j)] = int(points_.size());
                    points_.push_back({i, j});
                }
        // Weights, scaled so that the larger is 1, of the neighbours to the left, below, to the
        // right and above.
        const double least = std::min(map.dx, map.dy);
        weight_[0] = weight_[2] = std::pow(least / map.dx, 2);
        weight_[1] = weight_[3] = std::pow(least / map.dy, 2);
        double sum = 0, weight = 0;
        for (Point& p : points_)
            for (std::size_t k = 0; k < 4; ++k) {
                constexpr int di[] = {-1, 0, 1, 0}, dj[] = {0, -1, 0, 1};
                const int i = p.i + di[k], j = p.j + dj[k];
                if (i < 0 || j < 0 || i >= map.nx || j >= map.ny) continue;
                const double w = weight_[k];
                p.diagonal += w;
                p.neighbour[k] = number[map.index(i, j)];
                if (p.neighbour[k] < 0) {
                    sum += w * map(i, j);
                    weight += w;
                    p.source += w * map(i, j);
                    p.present += w;
                }
            }
        // The mean level is subtracted, so that a large offset does not cause cancellation.
        level_ = weight > 0 ? sum / weight : 0;
        for (Point& p : points_) p.source -= p.present * level_;
    }

    // Points without a missing neighbour within kReach steps along their row and column: the mean
    // of the polynomials through these. Curvatures, and for the law 'fourth_order' the fourth
    // derivatives, remain those of the surface.
    void refine(const HeightMap& map) {
        for (std::size_t k = 0; k < points_.size(); ++k)
            if (const auto value = alone(map, points_[k].i, points_[k].j))
                solution_[k] = *value - level_;
    }

    // Conjugate gradients, preconditioned by symmetric overrelaxation.
    void solve() {
        constexpr double kTolerance = 1e-12;
        const std::size_t n = points_.size();
        std::vector<double> r(n), y(n), p, q(n);
        for (const auto k : indices(n)) r[k] = points_[k].source;
        const double goal = kTolerance * std::sqrt(dot(r, r));
        precondition(r, y);
        p = y;
        solution_.assign(n, 0.0);
        double rho = dot(r, y);
        for (std::size_t step = 0; step < 20 * n + 100 && std::sqrt(dot(r, r)) > goal; ++step) {
            for (const auto k : indices(n)) q[k] = points_[k].diagonal * p[k] - around(k, p, 0, 4);
            const double length = rho / dot(p, q);
            for (const auto k : indices(n)) {
                solution_[k] += length * p[k];
                r[k] -= length * q[k];
            }
            precondition(r, y);
            const double next = dot(r, y), share = next / rho;
            rho = next;
            for (const auto k : indices(n)) p[k] = y[k] + share * p[k];
        }
    }

    void store(HeightMap& map, std::vector<std::uint8_t>& filled) const {
        filled.assign(map.points(), 0);
        for (std::size_t k = 0; k < points_.size(); ++k) {
            map.row(points_[k].j)[points_[k].i] = level_ + solution_[k];
            filled[map.index(points_[k].i, points_[k].j)] = 1;
        }
    }

private:
    // Lagrange's weights of the points 1 ... kReach steps on either side, for the middle.
    static constexpr int kReach = 4;
    static constexpr std::array kWeights = {28.0 / 35, -14.0 / 35, 4.0 / 35, -0.5 / 35};

    // The polynomial overshoots beside steps. Above all four neighbours it must lie below the
    // straight line through two points on each side, as a summit does, and likewise below them.
    static std::optional<double> alone(const HeightMap& map, int i, int j) {
        if (i < kReach || j < kReach || i >= map.nx - kReach || j >= map.ny - kReach) return {};
        double sum = 0, high = -kInfinity, low = kInfinity, least = kInfinity, most = -kInfinity;
        for (const auto& [a, b] :
             {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
            for (int d = 1; d <= kReach; ++d)
                sum += 0.5 * kWeights[static_cast<std::size_t>(d - 1)] * map(i + d * a, j + d * b);
            const double next = map(i + a, j + b), line = 2 * next - map(i + 2 * a, j + 2 * b);
            high = std::max(high, next);
            low = std::min(low, next);
            least = std::min(least, line);
            most = std::max(most, line);
        }
        if (std::isnan(sum)) return {};
        return std::clamp(sum, std::min(low, most), std::max(high, least));
    }

    struct Point {
        int i, j;
        // numbers of the neighbours that are missing, or -1
        std::array<int, 4> neighbour{-1, -1, -1, -1};
        double diagonal = 0, source = 0, present = 0;
    };

    static double dot(const std::vector<double>& a, const std::vector<double>& b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    }

    // Weighted sum of x over the missing neighbours first ... end - 1 of point k.
    double around(std::size_t k, const std::vector<double>& x, std::size_t first,
                  std::size_t end) const {
        double sum = 0;
        for (std::size_t s = first; s < end; ++s)
            if (const int m = points_[k].neighbour[s]; m >= 0)
                sum += weight_[s] * x[static_cast<std::size_t>(m)];
        return sum;
    }

    // Points are numbered row by row, so the left and lower neighbours have lower numbers.
    void precondition(const std::vector<double>& r, std::vector<double>& y) const {
        constexpr double kOver = 1.9;
        for (const auto k : indices(r))
            y[k] = kOver * (r[k] + around(k, y, 0, 2)) / points_[k].diagonal;
        for (std::size_t k = r.size(); k-- > 0;)
            y[k] += kOver * around(k, y, 2, 4) / points_[k].diagonal - (kOver - 1) * y[k];
    }

    std::array<double, 4> weight_{};
    double level_ = 0;
    std::vector<Point> points_;
    std::vector<double> solution_;
};

}  // namespace

long count_missing(const HeightMap& map) {
    long missing = 0;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) missing += std::isnan(map(i, j));
    return missing;
}

namespace {

// Indices of the points of small groups, half of 5 x 5, that have only missing points around them.
std::vector<std::size_t> small_islands(const HeightMap& map) {
    constexpr std::size_t kMost = 12;
    std::vector<std::uint8_t> seen(map.points(), 0);
    std::vector<std::size_t> group, islands;
    const auto visit = [&](int i, int j) {
        if (i < 0 || j < 0 || i >= map.nx || j >= map.ny || std::isnan(map(i, j))) return;
        std::uint8_t& known = seen[map.index(i, j)];
        if (!known) group.push_back(map.index(i, j));
        known = 1;
    };
    const auto width = static_cast<std::size_t>(map.nx);
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) {
            if (seen[map.index(i, j)]) continue;
            group.clear();
            visit(i, j);
            for (std::size_t k = 0; k < group.size(); ++k)
                for (int b = -1; b <= 1; ++b)
                    for (int a = -1; a <= 1; ++a)
                        visit(int(group[k] % width) + a, int(group[k] / width) + b);
            if (group.size() <= kMost) islands.insert(islands.end(), group.begin(), group.end());
        }
    return islands;
}

// Sets the points of small islands to NaN that differ by more than `threshold` from the filling of
// the hole without them. Returns their number.
long remove_islands(HeightMap& map, double threshold) {
    const std::vector<std::size_t> islands =
        count_missing(map) > 0 ? small_islands(map) : std::vector<std::size_t>{};
    HeightMap filled = map.copy();
    const auto width = static_cast<std::size_t>(map.nx);
    const auto at = [width](HeightMap& of, std::size_t k) -> double& {
        return of.row(int(k / width))[k % width];
    };
    for (const std::size_t k : islands) at(filled, k) = std::nan("");
    if (islands.empty() || count_missing(filled) == static_cast<long>(map.points())) return 0;
    fill_missing(filled);
    long removed = 0;
    for (const std::size_t k : islands) {
        if (!(std::abs(at(map, k) - at(filled, k)) > threshold)) continue;
        at(map, k) = std::nan("");
        ++removed;
    }
    return removed;
}

}  // namespace

Outliers remove_outliers(HeightMap& map, double times) {
    constexpr int kReach = 2;
    std::vector<double> distance(map.points()), around, present;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) {
            const double z = map(i, j);
            if (std::isnan(z)) continue;
            double& d = distance[map.index(i, j)];
            const int up = std::min({kReach, j, map.ny - 1 - j}),
                      across = std::min({kReach, i, map.nx - 1 - i});
            if (up > 0 && across > 0) {
                around.clear();
                for (int b = 0; b <= up; ++b)
                    for (int a = b > 0 ? -across : 1; a <= across; ++a)
                        if (const double mean = 0.5 * (map(i + a, j + b) + map(i - a, j - b));
                            !std::isnan(mean))
                            around.push_back(mean);
                // in a hole, where no pair is whole: the points that are there
                const bool island = around.empty();
                for (int b = -up; b <= up && island; ++b)
                    for (int a = -across; a <= across; ++a)
                        if (const double other = map(i + a, j + b);
                            !std::isnan(other) && (a != 0 || b != 0))
                            around.push_back(other);
                if (!around.empty()) d = std::abs(z - median(around));
            } else {
                // On the border: from the straight line through two points in the direction that
                // fits best.
                double best = HUGE_VAL;
                for (int b = -1; b <= 1; ++b)
                    for (int a = -1; a <= 1; ++a)
                        if ((a != 0 || b != 0) && i + 2 * a >= 0 && i + 2 * a < map.nx &&
                            j + 2 * b >= 0 && j + 2 * b < map.ny)
                            best = std::fmin(best, std::abs(z - 2 * map(i + a, j + b) +
                                                            map(i + 2 * a, j + 2 * b)));
                if (best < HUGE_VAL) d = best;
            }
            present.push_back(d);
        }
    if (present.empty()) return {};
    // Of normal differences 90 % are below 1.645 standard deviations; rounding has 12^(-1/2) of its
    // step.
    const auto ninth =
        present.begin() + static_cast<std::ptrdiff_t>(0.9 * double(present.size() - 1));
    std::nth_element(present.begin(), ninth, present.end());
    Outliers found{0, 0, times * std::max(*ninth / 1.645, height_step(map) / std::sqrt(12.0))};
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) {
            if (std::isnan(map(i, j)) || !(distance[map.index(i, j)] > found.threshold)) continue;
            map.row(j)[i] = std::numeric_limits<double>::quiet_NaN();
            ++found.count;
        }
    found.islands = remove_islands(map, found.threshold);
    found.count += found.islands;
    return found;
}

std::vector<std::uint8_t> fill_missing(HeightMap& map) {
    const long missing = count_missing(map);
    if (missing == 0) return {};
    if (missing == static_cast<long>(map.points())) bad_input("all points of the map are missing");
    HoleProblem hole(map);
    hole.solve();
    hole.refine(map);
    std::vector<std::uint8_t> filled;
    hole.store(map, filled);
    return filled;
}

void keep_depths(std::vector<std::uint8_t>& filled, int nx, int ny, int steps) {
    const auto width = static_cast<std::size_t>(nx);
    for (int step = 0; step < steps && !filled.empty(); ++step) {
        const std::vector<std::uint8_t> all = filled;
        for (const int j : indices(ny))
            for (const int i : indices(nx)) {
                const std::size_t at =
                    static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i);
                if ((i > 0 && !all[at - 1]) || (i < nx - 1 && !all[at + 1]) ||
                    (j > 0 && !all[at - width]) || (j < ny - 1 && !all[at + width]))
                    filled[at] = 0;
            }
    }
    if (std::find(filled.begin(), filled.end(), 1) == filled.end()) filled.clear();
}

namespace {

// The step of the differences of each height from that di columns and dj rows before; 0 if they
// have none.
double step_of_pairs(const HeightMap& map, int di, int dj) {
    const auto visit_pairs = [&](auto visit) {
        for (int j = dj; j < map.ny; ++j)
            for (int i = di; i < map.nx; ++i) visit(map(i - di, j - dj), map(i, j));
    };
    // share of equal neighbours; with a smaller one rounding does not matter
    constexpr double few = 0.02;
    // relative to the step: files store heights as decimal numbers
    constexpr double rounding = 1e-6;
    double least = 0;
    visit_pairs([&](double a, double b) {
        const double d = std::abs(b - a), noise = 1e-12 * (std::abs(a) + std::abs(b));
        if (d > noise && (least == 0 || d < least)) least = d;
    });
    if (!(least > 0)) return 0;
    long pairs = 0, equal = 0, other = 0;
    visit_pairs([&](double a, double b) {
        const double steps = std::abs(b - a) / least;
        if (std::isnan(steps)) return;
        ++pairs;
        equal += steps <= rounding;
        other += std::abs(steps - std::round(steps)) > 1e-3 * std::max(1.0, steps);
    });
    constexpr double most_other = 1e-3;
    const auto share = [&](long of) { return double(of) / double(std::max(pairs, 1L)); };
    return share(equal) >= few && share(other) <= most_other ? least : 0.0;
}

}  // namespace

// In one of the two directions there may be no step: rows of a scan may be levelled one by one, and
// across a lay few neighbours are equal.
double height_step(const HeightMap& map) {
    const double row = step_of_pairs(map, 1, 0), column = step_of_pairs(map, 0, 1);
    return row > 0 && column > 0 ? std::min(row, column) : row + column;
}

void damp_waves(HeightMap& map, bool periodic, const char* purpose,
                const std::function<void(double*, double)>& damp) {
    const auto nx = static_cast<std::size_t>(map.nx), ny = static_cast<std::size_t>(map.ny);
    const std::unique_ptr<double[], HeightMap::Free> buffer(allocate_doubles(nx * ny, purpose));
    double* const z = buffer.get();
    FftwPlan forward, back;
    {
        const fftw_r2r_kind there = periodic ? FFTW_R2HC : FFTW_REDFT10,
                            again = periodic ? FFTW_HC2R : FFTW_REDFT01;
        const auto lock = fftw_planning();
        forward.reset(fftw_plan_r2r_2d(map.ny, map.nx, z, z, there, there, FFTW_ESTIMATE));
        back.reset(fftw_plan_r2r_2d(map.ny, map.nx, z, z, again, again, FFTW_ESTIMATE));
    }
    if (!forward || !back)
        throw Error(Failure::internal, std::string(purpose) + ": FFTW made no plan");
    for (const int j : indices(map.ny))
        std::copy_n(map.row(j), nx, z + static_cast<std::size_t>(j) * nx);
    fftw_execute(forward.get());
    const double scale = 1.0 / ((periodic ? 1.0 : 4.0) * double(nx) * double(ny));
    damp(z, scale);
    fftw_execute(back.get());
    for (const int j : indices(map.ny))
        std::copy_n(z + static_cast<std::size_t>(j) * nx, nx, map.row(j));
}

void smooth_rounded(HeightMap& map, double step) {
    const auto nx = static_cast<std::size_t>(map.nx), ny = static_cast<std::size_t>(map.ny);
    const Form plane = detrend(map, Detrend::plane);  // its cosine series would hide the rounding
    // Mean power on rings of one wavenumber each; the power of the rounding is the same on all
    // rings.
    const double points = double(nx * ny), shorter = double(std::min(nx, ny));
    const auto ring = [&](std::size_t i, std::size_t j) {
        return static_cast<std::size_t>(
            std::lround(shorter * std::hypot(double(i) / double(nx), double(j) / double(ny))));
    };
    std::vector<double> power(ring(nx, ny) + 1), modes(power.size()), gain(power.size(), 0.0);
    constexpr double safety = 1.5;  // the power of the rounding on one ring scatters
    const double rounding = safety * 4 * points * step * step / 12;
    constexpr std::size_t near = 2;  // neighbouring rings on either side included in the mean
    damp_waves(map, false, "the cosine series of a map", [&](double* series, double scale) {
        for (const auto j : indices(ny))
            for (const auto i : indices(nx)) {
                power[ring(i, j)] += series[j * nx + i] * series[j * nx + i];
                ++modes[ring(i, j)];
            }
        for (const auto k : indices(power)) {
            double sum = 0, count = 0;
            for (std::size_t l = k - std::min(k, near); l <= std::min(k + near, power.size() - 1);
                 ++l) {
                sum += power[l];
                count += modes[l];
            }
            gain[k] = std::max(0.0, 1 - rounding * count / std::max(sum, 1e-300));
            if (k > 0 && gain[k] == 0) break;  // all shorter waves are rounding noise
        }
        for (const auto j : indices(ny))
            for (const auto i : indices(nx)) series[j * nx + i] *= gain[ring(i, j)] * scale;
    });
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx))
            map.row(j)[i] += plane.level + plane.slope_x * (i - 0.5 * (map.nx - 1)) * map.dx +
                             plane.slope_y * (j - 0.5 * (map.ny - 1)) * map.dy;
}

namespace {

// Heights along one axis of a map; index 0 is the point (i, j).
struct Profile {
    const HeightMap& map;
    int i, j;
    bool along_x;

    bool has(int k) const {
        if (map.periodic) return true;
        return along_x ? i + k >= 0 && i + k < map.nx : j + k >= 0 && j + k < map.ny;
    }
    double at(int k) const {
        return along_x ? map(wrapped(i + k, map.nx), j) : map(i, wrapped(j + k, map.ny));
    }
    double bend(int k) const {
        if (!along_x && map.ny == 1) return 0;
        return has(k - 1) && has(k + 1) ? at(k - 1) - 2 * at(k) + at(k + 1) : 0;
    }
};

double median_bend(const HeightMap& map, bool along_x) {
    std::vector<double> bends;
    const int skip = std::max(1, map.ny / 256);
    const int edge = map.ny > 1;
    for (int j = edge; j < map.ny - edge; j += skip)
        for (int i = 1; i < map.nx - 1; ++i)
            if (const double bend = std::abs(Profile{map, i, j, along_x}.bend(0)); bend > 0)
                bends.push_back(bend);
    if (bends.empty()) return 0;
    return median(bends);
}

// Kind of the break at point 0 of the profile, if there is one.
std::optional<Breaks::Kind> kind_of(const Profile& p, double least) {
    // a pit's second difference is twice its neighbours'; at a step a neighbour's has the same size
    constexpr double foremost = 1.3;
    const double bend = p.bend(0), before = p.bend(-1), after = p.bend(1);
    if (!(std::abs(bend) > least)) return {};
    // Smooth: the neighbours curve the same way, none the other way. A hill on a plain has large
    // second differences, too.
    constexpr double smooth = 0.3;
    const double sign = bend > 0 ? 1 : -1, like = std::max(sign * before, sign * after),
                 against = std::max(-sign * before, -sign * after);
    if (like > smooth * std::abs(bend) && against < smooth * std::abs(bend)) return {};
    if (bend > foremost * std::max(-before, -after)) return Breaks::pit;
    if (-bend > foremost * std::max(before, after)) return Breaks::spike;
    return Breaks::step;
}

}  // namespace

namespace {

// True if a neighbour is a pit or spike (`kind`), which causes the second difference at this point.
bool bent_by(const Profile& p, Breaks::Kind kind, double least) {
    const auto joins = [&](int k) {
        return p.has(k) &&
               kind_of({p.map, p.i + (p.along_x ? k : 0), p.j + (p.along_x ? 0 : k), p.along_x},
                       least) == kind;
    };
    return joins(-1) || joins(1);
}

// The larger of the jumps to the two neighbours.
double jump(const Profile& p) {
    return std::max(p.has(-1) ? std::abs(p.at(0) - p.at(-1)) : 0,
                    p.has(1) ? std::abs(p.at(1) - p.at(0)) : 0);
}

// Sorts points into pits, spikes and steps.
struct BreakSearch {
    const HeightMap& map;
    double least_x, least_y;  // smallest second differences of a break
    Breaks& breaks;
    std::vector<Breaks::Place> marked;  // spikes and steps

    void visit(int i, int j) {
        const Profile x{map, i, j, true}, y{map, i, j, false};
        const double bend_x = x.bend(0), bend_y = y.bend(0);
        if (!(std::abs(bend_x) > least_x || std::abs(bend_y) > least_y)) return;
        const auto along_x = kind_of(x, least_x), along_y = kind_of(y, least_y);
        if (along_x == Breaks::pit || along_y == Breaks::pit) {
            const bool across =
                along_x == Breaks::pit && (along_y != Breaks::pit || bend_x >= bend_y);
            breaks.pits.push_back({i, j, across});
            tell(Breaks::pit, i, j, 0.5 * (across ? bend_x : bend_y));
            return;
        }
        const bool spike = along_x == Breaks::spike && (along_y == Breaks::spike || map.ny == 1);
        const auto left = [&](Breaks::Kind of) {
            return (along_x && !bent_by(x, of, least_x)) || (along_y && !bent_by(y, of, least_y));
        };
        if (!spike && !left(Breaks::pit)) return;
        marked.push_back({i, j});
        if (spike) breaks.spikes.push_back({i, j});
        if (!spike && !left(Breaks::spike)) return;
        tell(spike ? Breaks::spike : Breaks::step, i, j,
             spike ? -0.5 * (map.ny > 1 ? std::max(bend_x, bend_y) : bend_x)
                   : std::max(jump(x), jump(y)));
    }

private:
    void tell(Breaks::Kind kind, int i, int j, double size) {
        Breaks::Found& found = breaks.found[kind];
        if (++found.points == 1 || size > found.size) {
            found.largest = {i, j};
            found.size = size;
        }
    }
};

// Distance of every point to the nearest marked one.
std::vector<std::uint8_t> distances_to(const std::vector<Breaks::Place>& marked,
                                       const HeightMap& map) {
    std::vector<std::uint8_t> distance(map.points(), Breaks::kMostClear);
    constexpr int reach = Breaks::kMostClear;
    for (const auto [i, j, unused] : marked)
        for (int dj = -reach; dj <= reach; ++dj)
            for (int di = -reach; di <= reach; ++di) {
                int k = i + di, l = j + dj;
                if (map.periodic) {
                    k = wrapped(k, map.nx);
                    l = wrapped(l, map.ny);
                }
                if (k < 0 || l < 0 || k >= map.nx || l >= map.ny) continue;
                auto& clear = distance[map.index(k, l)];
                clear = std::min(clear,
                                 static_cast<std::uint8_t>(std::max(std::abs(di), std::abs(dj))));
            }
    return distance;
}

}  // namespace

Breaks find_breaks(const HeightMap& map, double height_step) {
    Breaks breaks;
    const int nx = map.nx, ny = map.ny;
    if (nx < 3 || (ny < 3 && ny != 1)) return breaks;
    constexpr double rounding = 3;  // rounding changes a second difference by up to two steps
    BreakSearch search{map,
                       std::max(kBreak * median_bend(map, true), rounding * height_step),
                       std::max(kBreak * median_bend(map, false), rounding * height_step),
                       breaks,
                       {}};
    for (const int j : indices(ny))
        for (const int i : indices(nx)) search.visit(i, j);
    if (!search.marked.empty()) breaks.clear = distances_to(search.marked, map);
    return breaks;
}

void raise_pits(HeightMap& map, const Breaks& breaks) {
    // Weights of the Lagrange polynomial through 1, 2 or 3 points on either side, evaluated at the
    // middle.
    constexpr double weights[3][3] = {
        {1.0 / 2, 0, 0}, {4.0 / 6, -1.0 / 6, 0}, {15.0 / 20, -6.0 / 20, 1.0 / 20}};
    const auto row_by_row = [](const Breaks::Place& a, const Breaks::Place& b) {
        return a.j != b.j ? a.j < b.j : a.i < b.i;
    };
    for (const bool along_x : {true, false}) {
        std::vector<double> raised;
        for (const Breaks::Place& pit : breaks.pits) {
            const Profile p{map, pit.i, pit.j, along_x};
            int reach = 0;
            const auto taken = [&](int k) {  // outside the map, or a pit itself
                if (!p.has(k)) return true;
                const Breaks::Place there{pit.i + (along_x ? k : 0), pit.j + (along_x ? 0 : k)};
                const auto other =
                    std::lower_bound(breaks.pits.begin(), breaks.pits.end(), there, row_by_row);
                return other != breaks.pits.end() && other->i == there.i && other->j == there.j &&
                       other->along_x == along_x;
            };
            while (reach < 3 && !taken(reach + 1) && !taken(-reach - 1)) ++reach;
            double z = map(pit.i, pit.j);
            if (pit.along_x == along_x && reach > 0) {
                z = 0;
                for (int k = 1; k <= reach; ++k)
                    z += weights[reach - 1][k - 1] * (p.at(k) + p.at(-k));
            }
            raised.push_back(z);
        }
        for (const auto k : indices(raised))
            map.row(breaks.pits[k].j)[breaks.pits[k].i] = raised[k];
    }
}

}  // namespace rsc
