#include "asperities/uniqueness.hpp"

#include "asperities/lapack.hpp"
#include "interaction/close_pairs.hpp"

namespace rsc {
namespace {

using Vector = std::vector<double>;

constexpr double kWidening = 3;  // shells of radius rho = kWidening (2/pi) a
constexpr double kDiagonal = 1 - 1 / kWidening;

struct Pair {
    std::size_t i, j;
    double d;
};

// An element of a symmetric matrix.
struct Coupling {
    std::size_t i, j;
    double value;
};

// Interaction energy of two unit shells of radii p and q at a distance d < p + q: the mean of
// 1/max(r, p) over the shell q.
double shell_energy(double p, double q, double d) {
    if (d <= std::abs(p - q)) return 1 / std::max(p, q);
    const double near = d - q;
    return ((p * p - near * near) / (2 * p) + d + q - p) / (2 * d * q);
}

// Element (2/pi) sqrt(a b) (1/d - U) of the overlap matrix for contact radii a and b at a distance
// d.
double shell_overlap(double a, double b, double d) {
    constexpr double scale = kWidening * 2 / pi;
    if (!(d < scale * (a + b)) || !(a > 0) || !(b > 0)) return 0;
    return 2 / pi * std::sqrt(a * b) * (1 / d - shell_energy(scale * a, scale * b, d));
}

// Pairs whose shells overlap.
std::vector<Pair> shell_pairs(const Vector& x, const Vector& y, const Vector& a,
                              const Period& period) {
    Vector rho(a);
    for (double& r : rho) r *= kWidening * 2 / pi;
    std::vector<Pair> pairs;
    for_close_pairs(x, y, rho, period, [&](std::size_t i, std::size_t j, double d) {
        pairs.push_back({i, j, d});
    });
    return pairs;
}

// True if the shells are small compared with the period, as the proof requires.
bool shells_fit(const Vector& a, const Period& period) {
    return a.empty() || *std::max_element(a.begin(), a.end()) < std::min(period.x, period.y) / 10;
}

// Points connected by overlapping shells, with at least one row sum that does not prove
// definiteness.
struct Cluster {
    std::vector<std::size_t> points;
    std::vector<Pair> pairs;  // i and j are positions in `points`
};

// `pairs` must contain at least all pairs of overlapping shells.
std::vector<Cluster> doubtful_clusters(const std::vector<Pair>& pairs, const Vector& a) {
    const std::size_t n = a.size();
    Vector row(n, 0.0);
    std::vector<double> overlap;
    overlap.reserve(pairs.size());
    for (const Pair& p : pairs) {
        overlap.push_back(shell_overlap(a[p.i], a[p.j], p.d));
        row[p.i] += overlap.back();
        row[p.j] += overlap.back();
    }
    if (std::all_of(row.begin(), row.end(), [](double sum) { return sum < kDiagonal; })) return {};

    std::vector<std::size_t> parent(n);
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (overlap[k] > 0) parent[root(pairs[k].i)] = root(pairs[k].j);
    }
    constexpr std::size_t none = at(-1);
    std::vector<std::size_t> cluster_of(n, none),
        place(n);  // by root; position of a point in its cluster
    std::vector<Cluster> clusters;
    for (const auto i : indices(n)) {
        if (row[i] < kDiagonal || cluster_of[root(i)] != none) continue;
        cluster_of[root(i)] = clusters.size();
        clusters.emplace_back();
    }
    for (const auto i : indices(n)) {
        const std::size_t c = cluster_of[root(i)];
        if (c == none) continue;
        place[i] = clusters[c].points.size();
        clusters[c].points.push_back(i);
    }
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const std::size_t c = cluster_of[root(pairs[k].i)];
        if (c != none && overlap[k] > 0)
            clusters[c].pairs.push_back({place[pairs[k].i], place[pairs[k].j], pairs[k].d});
    }
    return clusters;
}

// Tests a cluster by factorisation; `a` are the contact radii of its points.
bool positive_definite(const Cluster& cluster, const Vector& a) {
    constexpr std::size_t largest = 400;
    const std::size_t m = cluster.points.size();
    if (m > largest) return false;
    Vector matrix(m * m, 0.0);
    for (const auto i : indices(m)) matrix[i * m + i] = kDiagonal;
    for (const Pair& p : cluster.pairs) {
        matrix[p.i * m + p.j] = matrix[p.j * m + p.i] = shell_overlap(a[p.i], a[p.j], p.d);
    }
    return lapack::is_positive_definite(int(m), matrix.data());
}

Vector of_points(const Cluster& cluster, const Vector& values) {
    Vector own;
    for (std::size_t i : cluster.points) own.push_back(values[i]);
    return own;
}

// out = C x for the symmetric matrix C.
void couple(const std::vector<Coupling>& C, const Vector& x, Vector& out) {
    std::fill(out.begin(), out.end(), 0.0);
    for (const auto& c : C) {
        out[c.i] += c.value * x[c.j];
        out[c.j] += c.value * x[c.i];
    }
}

// Largest secant slope of the law, divided by 2 E*, between the solution v and any penetration up
// to `high`; for convex laws it is that of
// `high`.
double secant(const Law& law, double E_star, int asperity, double v, double force, double slope,
              double high) {
    if (v <= 0 && high <= 0) return 0;
    if (!law.capabilities().convex)
        return law.memory()->steepest(asperity, std::max(v, high)) / (2 * E_star);
    const double rise = high - v;
    if (std::abs(rise) <= 1e-6 * std::max(high, v)) return slope / (2 * E_star);
    return (law.force(asperity, high) - force) / rise / (2 * E_star);
}

// Tests whether a cluster, in the field of all others, has only the given solution: the box of its
// possible penetrations is divided until each part is proved to contain no solution or to be too
// small for two.
class Search {
public:
    Search(const Law& law, double E_star, const Cluster& cluster,
           const std::vector<Coupling>& close, const std::vector<int>& asperity, const Vector& v,
           const Vector& slope, double noise)
        : law_(law),
          E_star_(E_star),
          cluster_(cluster),
          v_(of_points(cluster, v)),
          slope_(of_points(cluster, slope)),
          noise_(noise) {
        for (std::size_t i : cluster.points) asperity_.push_back(asperity[i]);
        std::vector<std::size_t> place(v.size(), v.size());
        for (const auto k : indices(cluster.points)) place[cluster.points[k]] = k;
        for (const auto& c : close) {
            const std::size_t i = place[c.i], j = place[c.j];
            if (i < v.size() && j < v.size()) inside_.push_back({i, j, c.value});
        }
        force_ = forces(v_);
        f_low_ = f_high_ = change_ = relief_ = force_;
    }

    // `low` and `high`: bounds on the penetrations of the cluster's points.
    bool finds_one(Vector low, Vector high) { return within(std::move(low), std::move(high), 12); }

private:
    Vector forces(const Vector& v) const {
        Vector f(v.size());
        for (const auto k : indices(v)) f[k] = law_.force(asperity_[k], v[k]);
        return f;
    }

    // Narrows the bounds by the equation v = v0 - B (F - F0). Returns false if there is no solution
    // between them.
    bool narrow(Vector& low, Vector& high) {
        // Possible change of the field of more distant contacts, relative to the possible change by
        // the cluster itself.
        constexpr double give = 0.1;
        f_low_ = forces(low);
        f_high_ = forces(high);
        // Sets relief_ to what less force on the partners, less(k), adds to the penetrations.
        const auto relieve = [&](auto less) {
            for (const auto k : indices(v_)) change_[k] = less(k);
            couple(inside_, change_, relief_);
        };
        relieve(
            [&](std::size_t k) { return std::max(f_high_[k] - force_[k], force_[k] - f_low_[k]); });
        Vector slack(relief_);
        for (double& s : slack) s = give * s + noise_;
        relieve([&](std::size_t k) { return force_[k] - f_low_[k]; });
        for (const auto k : indices(v_)) high[k] = std::min(high[k], v_[k] + relief_[k] + slack[k]);
        relieve([&](std::size_t k) { return f_high_[k] - force_[k]; });
        for (const auto k : indices(v_)) low[k] = std::max(low[k], v_[k] - relief_[k] - slack[k]);
        for (std::size_t k = 0; k < v_.size(); ++k) {
            if (low[k] > high[k]) return false;
        }
        return true;
    }

    bool within(Vector low, Vector high, int deepest) {
        constexpr int parts = 200, narrowings = 3;
        if (++parts_ > parts) return false;
        for (int i = 0; i < narrowings; ++i) {
            if (!narrow(low, high)) return true;
        }
        Vector a(v_.size());
        for (const auto k : indices(a))
            a[k] = secant(law_, E_star_, asperity_[k], v_[k], force_[k], slope_[k], high[k]);
        if (positive_definite(cluster_, a)) return true;
        if (deepest == 0) return false;
        std::size_t widest = 0;
        double range = -1;
        for (const auto k : indices(a)) {
            const double wide =
                law_.force(asperity_[k], high[k]) - law_.force(asperity_[k], low[k]);
            if (wide > range) {
                widest = k;
                range = wide;
            }
        }
        const double middle = 0.5 * (std::max(low[widest], 0.0) + high[widest]);
        Vector below(high), above(low);
        below[widest] = above[widest] = middle;
        // A second solution, if any, is found faster in the half without the first.
        if (v_[widest] > middle)
            return within(low, below, deepest - 1) && within(above, high, deepest - 1);
        return within(above, high, deepest - 1) && within(low, below, deepest - 1);
    }

    const Law& law_;
    double E_star_;
    const Cluster& cluster_;
    Vector v_, slope_, force_;
    double noise_;  // errors of v
    std::vector<int> asperity_;
    std::vector<Coupling> inside_;
    int parts_ = 0;
    Vector f_low_, f_high_, change_, relief_;
};

}  // namespace

bool positive_definite_by_shells(const Vector& x, const Vector& y, const Vector& a,
                                 const Period& period) {
    if (!shells_fit(a, period)) return false;
    for (const Cluster& cluster : doubtful_clusters(shell_pairs(x, y, a, period), a)) {
        if (!positive_definite(cluster, of_points(cluster, a))) return false;
    }
    return true;
}

namespace {

// Partners beyond `kNear` contact radii cannot cause a second solution with their present radii,
// since S B S < 0.16. But a flat asperity of radius r_j >> r_i may form a large spot of radius
// A_j = sqrt(r_j f_i G) if the force of i vanishes, so that (2/pi) sqrt(a_i A_j)/d > `kFar` up to
// d = farthest() a_i (r_j/r_i)^(1/5).
constexpr double kNear = 2.0, kFar = 0.25;
double farthest() { return std::pow(std::pow(2 / (pi * kFar), 2) * std::sqrt(4 / (3 * pi)), 0.4); }

// Radius of passive points, which are found by the reach of others.
constexpr double kTouch = 1e-300;

struct Radii {
    Vector radius, flatness;  // a_i; r_i^(1/5)
    Vector reach;

    Radii(const Law& law, double E_star, const std::vector<int>& asperity, const Vector& slope,
          double deepest)
        : radius(slope.size()), flatness(slope.size()), reach(slope.size()) {
        double sharpest = 0;
        for (const auto i : indices(slope)) {
            radius[i] = slope[i] / (2 * E_star);
            flatness[i] =
                deepest > 0 ? std::pow(law.area(asperity[i], deepest) / (pi * deepest), 0.2) : 0;
            if (radius[i] > 0) sharpest = std::max(sharpest, radius[i] / flatness[i]);
        }
        for (const auto i : indices(slope))
            reach[i] = std::max({kNear * radius[i], farthest() * sharpest * flatness[i], kTouch});
    }
};

struct Partners {
    std::vector<Coupling> close;
    // Not close by their radii, but one may be flat and form a large spot.
    std::vector<Pair> distant;
    bool told_apart = true;

    Partners(const Kernel& kernel, const Vector& x, const Vector& y, const Radii& r) {
        const auto extent = [](const Vector& c) {
            return *std::max_element(c.begin(), c.end()) - *std::min_element(c.begin(), c.end());
        };
        // Penetrations of candidates far from contact are computed in single precision, which
        // cannot resolve nearly coinciding partners.
        constexpr double resolved = 1e-6;
        const double nearest = resolved * std::max(extent(x), extent(y));
        const double far = farthest();
        for_close_pairs(x, y, r.reach, kernel.period(),
                        [&](std::size_t i, std::size_t j, double d) {
                            if (d < std::max(kNear * (r.radius[i] + r.radius[j]), 2 * kTouch)) {
                                told_apart = told_apart && d > nearest;
                                if (d > 0) close.push_back({i, j, kernel.at(d, 0)});
                            } else if (d * r.flatness[i] < far * r.radius[i] * r.flatness[j] ||
                                       d * r.flatness[j] < far * r.radius[j] * r.flatness[i]) {
                                distant.push_back({i, j, d});
                            }
                        });
    }

    // Counts distant partners as close of which one could be large enough. `relief`: the
    // additional penetrations if all close partners lost contact.
    void add_rivals(const Law& law, const Kernel& kernel, const std::vector<int>& asperity,
                    const Vector& v, const Vector& force, const Vector& radius,
                    const Vector& relief) {
        Vector all(relief);  // additional penetration of each if all its partners lost contact
        for (const Pair& p : distant) {
            all[p.i] += force[p.j] * kernel.at(p.d, 0);
            all[p.j] += force[p.i] * kernel.at(p.d, 0);
        }
        const auto rivals = [&](std::size_t i, std::size_t j, double d) {
            const double A = std::sqrt(law.area(asperity[j], v[j] + all[j]) / pi);
            return 2 / pi * std::sqrt(radius[i] * A) > kFar * d;
        };
        for (const Pair& p : distant) {
            if (rivals(p.i, p.j, p.d) || rivals(p.j, p.i, p.d))
                close.push_back({p.i, p.j, kernel.at(p.d, 0)});
        }
    }
};

}  // namespace

std::vector<std::vector<std::size_t>> doubtful_parts(const Law& law, const Kernel& kernel,
                                                     const std::vector<int>& asperity,
                                                     const Vector& x, const Vector& y,
                                                     const Vector& v, const Vector& force,
                                                     const Vector& slope) {
    if (kernel.none() || v.empty()) return {};
    const auto all = [&] {
        std::vector<std::size_t> points(v.size());
        std::iota(points.begin(), points.end(), 0);
        return std::vector<std::vector<std::size_t>>{points};
    };
    if (!law.capabilities().convex && !law.memory()) return all();  // its slopes are not bounded
    // On a soft layer self() < 0: a spot wider than the layer can be unstable by itself (no minimum
    // of the energy).
    if (std::ranges::any_of(slope, [&](double rate) { return 1 + rate * kernel.self() <= 0; }))
        return all();
    const double E_star = kernel.modulus();
    const std::size_t n = v.size();
    const double deepest = *std::max_element(v.begin(), v.end());
    const Radii radii(law, E_star, asperity, slope, deepest);
    Partners partners(kernel, x, y, radii);
    if (!partners.told_apart) return all();

    // Bounds on the penetrations of any other solution: upper bounds without the close partners
    // give lower bounds, and so on.
    Vector alone(v), relief(n), high, low(n), f(n), a(n);
    couple(partners.close, force, relief);
    if (!partners.distant.empty()) {
        partners.add_rivals(law, kernel, asperity, v, force, radii.radius, relief);
        couple(partners.close, force, relief);
    }
    for (const auto i : indices(n)) alone[i] += relief[i];
    high = alone;
    const auto secants = [&] {
        for (const auto i : indices(n)) {
            a[i] = std::max(secant(law, E_star, asperity[i], v[i], force[i], slope[i], high[i]),
                            slope[i] / (2 * E_star));
        }
    };
    secants();
    if (!shells_fit(a, kernel.period())) return all();
    // For the widest shells; the bounds only become narrower below.
    const auto pairs = shell_pairs(x, y, a, kernel.period());
    auto doubtful = doubtful_clusters(pairs, a);
    const auto settled = [&](const Cluster& cluster) {
        return positive_definite(cluster, of_points(cluster, a));
    };
    std::erase_if(doubtful, settled);
    if (doubtful.empty()) return {};
    for (auto [from, to] : {std::pair{&high, &low}, std::pair{&low, &high}}) {
        for (const auto i : indices(n)) f[i] = law.force(asperity[i], (*from)[i]);
        couple(partners.close, f, relief);
        for (const auto i : indices(n)) (*to)[i] = alone[i] - relief[i];
    }
    secants();
    doubtful = doubtful_clusters(pairs, a);
    std::erase_if(doubtful, settled);
    // Penetrations of candidates far from contact are computed in single precision.
    constexpr double precision = 1e-4;
    std::vector<std::vector<std::size_t>> parts;
    for (const Cluster& cluster : doubtful) {
        Search search(law, E_star, cluster, partners.close, asperity, v, slope,
                      precision * deepest);
        if (!search.finds_one(of_points(cluster, low), of_points(cluster, high)))
            parts.push_back(cluster.points);
    }
    return parts;
}

}  // namespace rsc
