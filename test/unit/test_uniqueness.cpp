// The proof of positive definiteness by shells never proves what is false, and is sharp enough to be useful; close pairs; Lanczos.
#include "contact/uniqueness.hpp"

#include <numbers>
#include <random>

#include "check.hpp"
#include "contact/lanczos.hpp"
#include "contact/lapack.hpp"

using namespace rsc;

namespace {

using Vector = std::vector<double>;

// I + S B S with (S B S)_ij = (2/pi) sqrt(a_i a_j)/d_ij, dense.
Vector dense(const Vector& x, const Vector& y, const Vector& a) {
    const std::size_t n = a.size();
    Vector M(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const double d = std::hypot(x[i] - x[j], y[i] - y[j]);
            M[i * n + j] = i == j ? 1.0 : 2 / std::numbers::pi * std::sqrt(a[i] * a[j]) / d;
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
    for (std::size_t i = 0; i < n; ++i) {
        p.x.push_back(uniform(random));
        p.y.push_back(uniform(random));
        p.a.push_back(i % 7 == 6 ? 0.0 : radius * std::exp(spread * normal(random)));  // some are not in contact
    }
    return p;
}

void proofs_are_true() {
    int proved = 0, proved_with_overlaps = 0, indefinite = 0;
    for (unsigned seed = 0; seed < 400; ++seed) {
        const Points p = random_points(5 + seed % 60, 0.002 * (1 + seed % 40), 0.5 * (seed % 4), seed);
        Vector M = dense(p.x, p.y, p.a);
        const bool definite = lapack::is_positive_definite(static_cast<int>(p.a.size()), M.data());
        const bool proof = positive_definite_by_shells(p.x, p.y, p.a);
        CHECK(!proof || definite);
        proved += proof;
        proved_with_overlaps += proof && count_overlapping(p.x, p.y, p.a) > 0;
        indefinite += !definite;
    }
    std::printf("400 sets: %d indefinite, %d proved definite, %d of them with overlapping spots\n", indefinite, proved, proved_with_overlaps);
    CHECK(indefinite > 50);            // the test meets what it is about
    CHECK(proved_with_overlaps > 20);  // overlapping spots alone do not defeat the proof
}

// Two equal spots are definite down to d = (2/pi) a; the proof holds to within 10 % of that.
void pair_is_nearly_sharp() {
    const double a = 1, edge = 2 / std::numbers::pi;
    CHECK(positive_definite_by_shells({0, 1.1 * edge}, {0, 0}, {a, a}));
    CHECK(!positive_definite_by_shells({0, 0.999 * edge}, {0, 0}, {a, a}));
    CHECK(!positive_definite_by_shells({0, 0}, {0, 0}, {a, a}));  // coincident
    CHECK(positive_definite_by_shells({}, {}, {}));
}

void close_pairs_are_all_found() {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Points p = random_points(200, 0.01, seed % 3, seed);
        long brute = 0;
        for (std::size_t i = 0; i < p.a.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                brute += p.a[i] > 0 && p.a[j] > 0 && std::hypot(p.x[i] - p.x[j], p.y[i] - p.y[j]) < p.a[i] + p.a[j];
            }
        }
        CHECK(count_overlapping(p.x, p.y, p.a) == brute);
    }
}

// The lowest eigenvalue against bisection on Cholesky of the shifted matrix.
void lanczos_finds_the_lowest() {
    for (unsigned seed = 0; seed < 10; ++seed) {
        const Points p = random_points(40, 0.03, 0.5, seed);
        const Vector M = dense(p.x, p.y, p.a);
        const std::size_t n = p.a.size();
        double low = -100, high = 100;
        for (int i = 0; i < 60; ++i) {
            const double shift = 0.5 * (low + high);
            Vector shifted = M;
            for (std::size_t k = 0; k < n; ++k) shifted[k * n + k] -= shift;
            (lapack::is_positive_definite(static_cast<int>(n), shifted.data()) ? low : high) = shift;
        }
        Vector vector;
        const double found = lanczos_lowest(n, [&](const Vector& in, Vector& out) {
            for (std::size_t i = 0; i < n; ++i) {
                out[i] = 0;
                for (std::size_t j = 0; j < n; ++j) out[i] += M[i * n + j] * in[j];
            }
        }, vector);
        CHECK((found > 0) == (low > 0));
        // Lanczos stops once the sign is sure: within 20 % of the value, or below it by its error bound.
        CHECK_CLOSE(found, low, 0.25 * std::abs(low) + 1e-9);
    }
}

}  // namespace

int main() {
    proofs_are_true();
    pair_is_nearly_sharp();
    close_pairs_are_all_found();
    lanczos_finds_the_lowest();
    return check::summary();
}
