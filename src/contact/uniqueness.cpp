#include "contact/uniqueness.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "contact/lapack.hpp"

namespace rsc {
namespace {

// Energy of two unit shells of radii p and q at distance d < p + q: 1/max(r, p) averaged over the shell q.
double shell_energy(double p, double q, double d) {
    if (d <= std::abs(p - q)) return 1 / std::max(p, q);
    const double near = d - q;
    return ((p * p - near * near) / (2 * p) + d + q - p) / (2 * d * q);
}

// Pairs with a coupling; what the tests iterate over.
struct Coupling {
    std::size_t i, j;
    double value;
};

// out = C x for the symmetric matrix C of the couplings.
void couple(const std::vector<Coupling>& C, const std::vector<double>& x, std::vector<double>& out) {
    std::fill(out.begin(), out.end(), 0.0);
    for (const auto& c : C) {
        out[c.i] += c.value * x[c.j];
        out[c.j] += c.value * x[c.i];
    }
}

}  // namespace

bool positive_definite_by_shells(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& a) {
    constexpr double widening = 3;  // rho = widening (2/pi) a
    constexpr double diagonal = 1 - 1 / widening;
    const std::size_t n = a.size();
    std::vector<double> rho(n), row(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) rho[i] = widening * 2 / std::numbers::pi * a[i];
    const auto overlap_of = [&](std::size_t i, std::size_t j, double d) {
        return 2 / std::numbers::pi * std::sqrt(a[i] * a[j]) * (1 / d - shell_energy(rho[i], rho[j], d));
    };
    // Gershgorin settles most sets; a cluster with a row it does not settle is factorised whole.
    for_close_pairs(x, y, rho, [&](std::size_t i, std::size_t j, double d) {
        const double c = overlap_of(i, j, d);
        row[i] += c;
        row[j] += c;
    });
    if (std::all_of(row.begin(), row.end(), [](double sum) { return sum < diagonal; })) return true;

    std::vector<Coupling> overlap;
    std::vector<std::size_t> parent(n);
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for_close_pairs(x, y, rho, [&](std::size_t i, std::size_t j, double d) {
        overlap.push_back({i, j, overlap_of(i, j, d)});
        parent[root(i)] = root(j);
    });
    struct Cluster {
        std::size_t members = 0;
        std::vector<Coupling> overlap;
    };
    constexpr std::size_t none = static_cast<std::size_t>(-1), largest_cluster = 400;
    std::vector<std::size_t> cluster_of(n, none), place(n);  // of a root; of a point in its cluster
    std::vector<Cluster> doubtful;
    for (std::size_t i = 0; i < n; ++i) {
        if (row[i] < diagonal || cluster_of[root(i)] != none) continue;
        cluster_of[root(i)] = doubtful.size();
        doubtful.emplace_back();
    }
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t c = cluster_of[root(i)];
        if (c != none) place[i] = doubtful[c].members++;
    }
    for (const auto& pair : overlap) {
        const std::size_t c = cluster_of[root(pair.i)];
        if (c != none) doubtful[c].overlap.push_back({place[pair.i], place[pair.j], pair.value});
    }
    for (const Cluster& cluster : doubtful) {
        const std::size_t m = cluster.members;
        if (m > largest_cluster) return false;
        std::vector<double> matrix(m * m, 0.0);
        for (std::size_t i = 0; i < m; ++i) matrix[i * m + i] = diagonal;
        for (const auto& pair : cluster.overlap) matrix[pair.i * m + pair.j] = matrix[pair.j * m + pair.i] = pair.value;
        if (!lapack::is_positive_definite(static_cast<int>(m), matrix.data())) return false;
    }
    return true;
}

bool has_one_solution(const Law& law, double E_star, const std::vector<int>& asperity, const std::vector<double>& x,
                      const std::vector<double>& y, const std::vector<double>& v, const std::vector<double>& force,
                      const std::vector<double>& slope) {
    if (std::isinf(E_star)) return true;
    const std::size_t n = v.size();
    // Partners beyond `near` contact radii cannot be the other half of a second solution: there S B S < 0.16.
    constexpr double near = 2.0;
    constexpr double touch = 1e-300;  // passive points have no radius of their own but are found by the others' reach
    std::vector<double> reach(n), alone(v), high, low(n), f(force), relief(n);
    for (std::size_t i = 0; i < n; ++i) reach[i] = std::max(near * slope[i] / (2 * E_star), touch);
    // Penetrations of candidates far from touching come from single precision: partners that nearly coincide are beyond its judgement.
    constexpr double resolved = 1e-6;
    const double nearest = resolved * std::max(*std::max_element(x.begin(), x.end()) - *std::min_element(x.begin(), x.end()),
                                               *std::max_element(y.begin(), y.end()) - *std::min_element(y.begin(), y.end()));
    bool told_apart = true;
    std::vector<Coupling> close;
    for_close_pairs(x, y, reach, [&](std::size_t i, std::size_t j, double d) {
        told_apart = told_apart && d > nearest;
        if (d > 0) close.push_back({i, j, 1 / (std::numbers::pi * E_star * d)});
    });
    if (!told_apart) return false;
    couple(close, f, relief);
    for (std::size_t i = 0; i < n; ++i) alone[i] += relief[i];
    // Bounds on the penetrations of any other solution: at most those with every close partner gone, hence at least ..., and so on.
    constexpr int narrowings = 3;
    high = alone;
    std::vector<double> secant(n);
    double room = std::numeric_limits<double>::infinity();  // sum of what the bounds leave above the solution
    for (int k = 0; k < narrowings; ++k) {
        double left = 0;
        for (std::size_t i = 0; i < n; ++i) left += std::max(high[i], 0.0) - std::max(v[i], 0.0);
        if (left > 0.98 * room) return false;  // the bounds no longer close in
        room = left;
        for (std::size_t i = 0; i < n; ++i) {
            secant[i] = 0;
            if (high[i] <= 0) continue;
            const double base = std::max(v[i], 0.0), rise = high[i] - base;
            const double D = rise > 1e-6 * high[i] ? (law.force(asperity[i], high[i]) - law.force(asperity[i], base)) / rise : slope[i];
            secant[i] = std::max(D, slope[i]) / (2 * E_star);
        }
        if (positive_definite_by_shells(x, y, secant)) return true;
        for (auto [from, to] : {std::pair{&high, &low}, std::pair{&low, &high}}) {
            for (std::size_t i = 0; i < n; ++i) f[i] = law.force(asperity[i], (*from)[i]);
            couple(close, f, relief);
            for (std::size_t i = 0; i < n; ++i) (*to)[i] = alone[i] - relief[i];
        }
    }
    return false;
}

long count_overlapping(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& a) {
    long pairs = 0;
    for_close_pairs(x, y, a, [&](std::size_t, std::size_t, double) { ++pairs; });
    return pairs;
}

}  // namespace rsc
