// Close pairs: all of them, each once, whatever the sizes, also across the borders of a surface
// that repeats, against the double loop; the same order at every call.
#include "interaction/close_pairs.hpp"

#include "check.hpp"
#include "contact/spots.hpp"

namespace test_close_pairs {

using namespace rsc;

using Vector = std::vector<double>;
using Pairs = std::vector<std::tuple<std::size_t, std::size_t, double>>;

Pairs found(const Vector& x, const Vector& y, const Vector& reach, const Period& period) {
    Pairs pairs;
    for_close_pairs(x, y, reach, period,
                    [&](std::size_t i, std::size_t j, double d) { pairs.emplace_back(i, j, d); });
    return pairs;
}

Pairs by_double_loop(const Vector& x, const Vector& y, const Vector& reach, const Period& period) {
    Pairs pairs;
    for (const auto i : indices(x)) {
        for (std::size_t j = i + 1; j < x.size(); ++j) {
            const double dx = period.nearest_x(x[i] - x[j]), dy = period.nearest_y(y[i] - y[j]),
                         limit = reach[i] + reach[j];
            if (!(reach[i] > 0) || !(reach[j] > 0) || dx * dx + dy * dy >= limit * limit) continue;
            pairs.emplace_back(i, j, std::sqrt(dx * dx + dy * dy));
        }
    }
    return pairs;
}

void the_same(const Vector& x, const Vector& y, const Vector& reach, const Period& period = {}) {
    Pairs pairs = found(x, y, reach, period);
    CHECK(pairs == found(x, y, reach, period));
    std::ranges::sort(pairs);
    const Pairs truth = by_double_loop(x, y, reach, period);
    bool same = pairs.size() == truth.size();
    for (std::size_t k = 0; same && k < pairs.size(); ++k) {
        const auto& [i, j, d] = pairs[k];
        const auto& [p, q, distance] = truth[k];
        same = i == p && j == q && std::abs(d - distance) <= (period.finite() ? 1e-14 : 0);
    }
    CHECK(same);
    CHECK(count_overlapping(x, y, reach, period) == long(pairs.size()));
}

// Sizes from equal to spread over ten decades, squares and thin strips of points; some points have
// no reach.
TEST(random_points) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal;
    long met = 0;
    for (const int set : indices(240)) {
        const double flat = set % 3 == 0 ? 1 : set % 3 == 1 ? 0.01 : 0, spread = set % 5;
        const double side = set % 2 == 0 ? 1 : 1e-3;
        Vector x, y, reach;
        for (const int i : indices(2 + set)) {
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

// One spot over everything among many small ones, a few of middle size.
TEST(one_huge_spot) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (double huge : {0.1, 0.5, 2.0, 1e6, kInfinity}) {
        Vector x, y, reach;
        for (const int i : indices(1500)) {
            x.push_back(uniform(random));
            y.push_back(uniform(random));
            reach.push_back(i == 700 ? huge : i % 300 == 0 ? 0.1 : 0.01 * uniform(random));
        }
        the_same(x, y, reach);
    }
}

// Points some periods away, too.
TEST(repeating) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const int set : indices(60)) {
        Vector x, y, reach;
        for (const int i : indices(80)) {
            x.push_back(uniform(random) + (i % 5 - 2));
            y.push_back(0.7 * uniform(random));
            reach.push_back(i % 9 == 0 ? 0
                                       : (set % 3 == 0 && i == 4 ? 0.3 : 0.05) * uniform(random));
        }
        the_same(x, y, reach, {1, 0.7});
    }
}

}  // namespace test_close_pairs
