// The proof of positive definiteness by shells never proves what is false, and is sharp enough to
// be useful; Lanczos.
#include "asperities/uniqueness.hpp"

#include "asperities/lapack.hpp"
#include "asperities/law.hpp"
#include "check.hpp"
#include "contact/spots.hpp"
#include "support/paths.hpp"

namespace test_uniqueness {

using namespace rsc;

using Vector = std::vector<double>;

// I + S B S with (S B S)_ij = (2/pi) sqrt(a_i a_j)/d_ij, dense.
Vector dense(const Vector& x, const Vector& y, const Vector& a) {
    const std::size_t n = a.size();
    Vector M(n * n);
    for (const std::size_t i : indices(n)) {
        for (const std::size_t j : indices(n)) {
            const double d = std::hypot(x[i] - x[j], y[i] - y[j]);
            M[i * n + j] = i == j ? 1.0 : 2 / pi * std::sqrt(a[i] * a[j]) / d;
        }
    }
    return M;
}

struct Points {
    Vector x, y, a;
};
Points random_points(std::size_t n, double radius, double spread, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal;
    Points p;
    for (const std::size_t i : indices(n)) {
        p.x.push_back(uniform(random));
        p.y.push_back(uniform(random));
        p.a.push_back(i % 7 == 6
                          ? 0.0
                          : radius * std::exp(spread * normal(random)));  // some are not in contact
    }
    return p;
}

TEST(proofs_are_true) {
    int proved = 0, proved_with_overlaps = 0, indefinite = 0;
    for (unsigned seed = 0; seed < 400; ++seed) {
        const Points p =
            random_points(5 + seed % 60, 0.002 * (1 + seed % 40), 0.5 * (seed % 4), seed);
        Vector M = dense(p.x, p.y, p.a);
        const bool definite = lapack::is_positive_definite(int(p.a.size()), M.data());
        const bool proof = positive_definite_by_shells(p.x, p.y, p.a);
        CHECK(!proof || definite);
        proved += proof;
        proved_with_overlaps += proof && count_overlapping(p.x, p.y, p.a) > 0;
        indefinite += !definite;
    }
    CHECK(indefinite > 50);            // the test meets what it is about
    CHECK(proved_with_overlaps > 20);  // overlapping spots alone do not defeat the proof
}

// All solutions that are minima along every force, from all 2^n subsets at work at first:
// coordinate descent on the energy, which is convex in each force alone.
std::vector<Vector> all_minima(const Law& law, double E_star, const Asperities& p,
                               const Vector& g0) {
    const std::size_t n = g0.size();
    std::vector<Vector> minima;
    for (unsigned subset = 0; subset < 1u << n; ++subset) {
        Vector F(n), v(n);
        for (const std::size_t i : indices(n))
            F[i] = subset >> i & 1 ? law.force(int(i), g0[i]) : 0;
        double change = 1;
        for (int sweep = 0; sweep < 100000 && change > 1e-12; ++sweep) {
            change = 0;
            for (const std::size_t i : indices(n)) {
                v[i] = g0[i];
                for (const std::size_t j : indices(n)) {
                    if (j != i)
                        v[i] -= F[j] / (pi * E_star * std::hypot(p.x[i] - p.x[j], p.y[i] - p.y[j]));
                }
                const double f = law.force(int(i), v[i]);
                change = std::max(change, std::abs(f - F[i]));
                F[i] = f;
            }
        }
        const auto same = [&](const Vector& other) {
            for (const std::size_t i : indices(n)) {
                if (std::abs(other[i] - v[i]) > 1e-6) return false;
            }
            return true;
        };
        if (std::ranges::none_of(minima, same)) minima.push_back(v);
    }
    return minima;
}

// Where a second solution exists, uniqueness is never told; where none does, nearly always.
TEST(told_only_where_it_is_so) {
    constexpr double E_star = 1 / pi;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    int unique = 0, several = 0, told = 0, several_wide = 0;
    for (const int set : indices(8000)) {
        const std::size_t n = 2 + set % 5;
        const bool wide =
            // radii over decades: a flat asperity far outside the spot of a sharp one may be its
            // rival
            set >= 4000;
        const double side = std::sqrt(double(n)) * (0.3 + 1.2 * uniform(random)) *
                            (wide ? 3 : 1);  // contact radii are up to 1
        Asperities p;
        Vector g0;
        std::vector<int> all;
        for (const std::size_t i : indices(n)) {
            p.x.push_back(side * uniform(random));
            p.y.push_back(side * uniform(random));
            p.z.push_back(0);
            p.radius.push_back(wide ? std::pow(10.0, -1 + 8 * uniform(random))
                                    : 0.3 + uniform(random));
            g0.push_back(wide ? std::pow(10.0, -2 * uniform(random)) : uniform(random));
            all.push_back(int(i));
        }
        const auto law = make_law(LawKind::hertz, p, E_star);
        law->prepare(all);
        const auto minima = all_minima(*law, E_star, p, g0);
        if (wide)
            several_wide += minima.size() > 1;
        else
            (minima.size() == 1 ? unique : several) += 1;
        for (const Vector& v : minima) {
            Vector force(n), slope(n), work(n);
            law->respond(int(n), all.data(), v.data(), force.data(), slope.data(), work.data());
            const bool one = doubtful_parts(*law, *make_kernel(Interaction::point, E_star), all,
                                            p.x, p.y, v, force, slope)
                                 .empty();
            CHECK(!one || minima.size() == 1);
            told += one && !wide;
        }
    }
    CHECK(several > 200 && several_wide > 200);
    CHECK(told > 0.8 * unique);
}

// Of several solutions a level has the same one whatever the levels before: crowded groups of
// summits, far apart, many of which have two.
TEST(several_after_any_way) {
    constexpr double E_star = 1 / pi, kTolerance = 1e-11, kSame = 1e-8;
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    Asperities p;
    for (const int group : indices(60))
        for (int k = 0; k < 3; ++k) {
            p.x.push_back(30.0 * (group % 8) + uniform(random));
            p.y.push_back(30.0 * (group / 8) + uniform(random));
            p.z.push_back(uniform(random));
            p.radius.push_back(0.3 + uniform(random));
        }
    const SolverOptions options{.tolerance = kTolerance};
    const auto path = [&] { return asperity_path(p, {E_star, kInfinity, 0, 0}, options); };
    int several = 0;
    for (const int k : indices(10)) {
        const double Z0 = 0.4 - 0.05 * k;
        const Level truth = path().at_separation(Z0);
        several += !truth.unique;
        for (const double before : {Z0 - 1.5, Z0 - 0.05, Z0 + 0.05, Z0 + 0.3}) {
            Path walked = path();
            (void)walked.at_separation(before);
            const Level level = walked.at_separation(Z0);
            CHECK(level.contacts == truth.contacts);
            CHECK_RELATIVE(level.force, truth.force, kSame);
        }
    }
    CHECK(several > 5);
}

// The lowest eigenvalue against bisection on Cholesky of the shifted matrix.
TEST(lanczos_finds_the_lowest) {
    for (unsigned seed = 0; seed < 10; ++seed) {
        const Points p = random_points(40, 0.03, 0.5, seed);
        const Vector M = dense(p.x, p.y, p.a);
        const std::size_t n = p.a.size();
        double low = -100, high = 100;
        for (int i = 0; i < 60; ++i) {
            const double shift = 0.5 * (low + high);
            Vector shifted = M;
            for (const std::size_t k : indices(n)) shifted[k * n + k] -= shift;
            (lapack::is_positive_definite(int(n), shifted.data()) ? low : high) = shift;
        }
        Vector vector;
        const double found = lapack::lanczos_lowest(
            n,
            [&](const Vector& in, Vector& out) {
                for (const std::size_t i : indices(n)) {
                    out[i] = 0;
                    for (const std::size_t j : indices(n)) out[i] += M[i * n + j] * in[j];
                }
            },
            vector);
        CHECK((found > 0) == (low > 0));
        // Lanczos stops once the sign is sure: within 20 % of the value, or below it by its error
        // bound.
        CHECK_CLOSE(found, low, 0.25 * std::abs(low) + 1e-9);
    }
}

}  // namespace test_uniqueness
