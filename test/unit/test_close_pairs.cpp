// Close pairs: all of them, each once, whatever the sizes, against the double loop; the same order at every call.
#include "contact/close_pairs.hpp"

#include <limits>
#include <random>
#include <tuple>

#include "check.hpp"
#include "contact/spots.hpp"

using namespace rsc;

namespace {

using Vector = std::vector<double>;
using Pairs = std::vector<std::tuple<std::size_t, std::size_t, double>>;

Pairs found(const Vector& x, const Vector& y, const Vector& reach) {
    Pairs pairs;
    for_close_pairs(x, y, reach, [&](std::size_t i, std::size_t j, double d) { pairs.emplace_back(i, j, d); });
    return pairs;
}

Pairs by_double_loop(const Vector& x, const Vector& y, const Vector& reach) {
    Pairs pairs;
    for (std::size_t i = 0; i < x.size(); ++i) {
        for (std::size_t j = i + 1; j < x.size(); ++j) {
            const double dx = x[i] - x[j], dy = y[i] - y[j], limit = reach[i] + reach[j];
            if (!(reach[i] > 0) || !(reach[j] > 0) || dx * dx + dy * dy >= limit * limit) continue;
            pairs.emplace_back(i, j, std::sqrt(dx * dx + dy * dy));
        }
    }
    return pairs;
}

void the_same(const Vector& x, const Vector& y, const Vector& reach) {
    Pairs pairs = found(x, y, reach);
    CHECK(pairs == found(x, y, reach));
    std::sort(pairs.begin(), pairs.end());
    CHECK(pairs == by_double_loop(x, y, reach));
    CHECK(count_overlapping(x, y, reach) == static_cast<long>(pairs.size()));
}

// Sizes from equal to spread over ten decades, squares and thin strips of points; some points have no reach.
void random_points() {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal;
    long met = 0;
    for (int set = 0; set < 240; ++set) {
        const double flat = set % 3 == 0 ? 1 : set % 3 == 1 ? 0.01 : 0, spread = set % 5, side = set % 2 == 0 ? 1 : 1e-3;
        Vector x, y, reach;
        for (int i = 0; i < 2 + set; ++i) {
            x.push_back(5 + side * uniform(random));
            y.push_back(-7 + side * flat * uniform(random));
            if (set % 7 == 0) std::swap(x.back(), y.back());
            reach.push_back(i % 7 == 6 ? 0.0 : 0.02 * side * std::exp(spread * normal(random)));
        }
        the_same(x, y, reach);
        met += count_overlapping(x, y, reach);
    }
    CHECK(met > 10000);  // the test meets what it is about
}

// Pairs in neighbouring cells, just close enough and just not: on a lattice of unit distances at every size of the lattice.
void neighbours_on_a_lattice() {
    for (int n = 2; n < 20; ++n) {
        Vector x, y;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) x.push_back(i), y.push_back(j);
        }
        const double tiny = 1e-9, diagonal = std::sqrt(2.0);
        const auto pairs = [&](double reach) { return count_overlapping(x, y, Vector(x.size(), reach)); };
        CHECK(pairs(0.5) == 0);  // spots that touch do not overlap
        CHECK(pairs(0.5 + tiny) == 2L * n * (n - 1));
        CHECK(pairs(0.5 * diagonal + tiny) == 2L * n * (n - 1) + 2L * (n - 1) * (n - 1));
    }
}

// One spot over everything among many small ones, a few of middle size.
void one_huge_spot() {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (double huge : {0.1, 0.5, 2.0, 1e6, std::numeric_limits<double>::infinity()}) {
        Vector x, y, reach;
        for (int i = 0; i < 1500; ++i) {
            x.push_back(uniform(random));
            y.push_back(uniform(random));
            reach.push_back(i == 700 ? huge : i % 300 == 0 ? 0.1 : 0.01 * uniform(random));
        }
        the_same(x, y, reach);
    }
}

void degenerate_sets() {
    const double smallest = std::numeric_limits<double>::denorm_min();
    CHECK(found({}, {}, {}).empty());
    CHECK(found({1}, {1}, {1}).empty());
    CHECK(found({1, 1, 2}, {1, 1, 1}, {1, 0, -1}).empty());
    CHECK((found({1, 1, 1}, {2, 2, 2}, {1, 1, 1}) == Pairs{{0, 1, 0.0}, {0, 2, 0.0}, {1, 2, 0.0}}));  // coincident
    CHECK(found({0, 0}, {0, 0}, {1e-300, 1e-300}).empty());                                           // a reach whose square is 0
    CHECK(found(Vector(200, 0.0), Vector(200, smallest), Vector(200, 1.0)).size() == 199 * 100);
    Vector apart(200, 0.0);
    apart[7] = smallest;
    CHECK(found(apart, Vector(200, 0.0), Vector(200, 1.0)).size() == 199 * 100);
}

}  // namespace

TESTS {
    random_points();
    neighbours_on_a_lattice();
    one_huge_spot();
    degenerate_sets();
}
