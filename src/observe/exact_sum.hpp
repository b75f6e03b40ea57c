// Sums over realizations that come out the same, bit for bit, in whatever order and groups their terms are added, so that the
// results of two campaigns can be put together into that of a larger one.
#pragma once

#include <cmath>
#include <limits>

namespace rsc {

// A sum without rounding errors, held as two doubles (T. J. Dekker, Numer. Math. 18, 1971; the sum of two by D. E. Knuth): high is
// the sum rounded to a double, low what that leaves out. Every term is a multiple of a power of two, the quantum; the sum is then
// exact up to 2^105 quanta.
struct ExactSum {
    double high = 0, low = 0;

    void add(const ExactSum& term) {
        const ExactSum sum = of_two(high, term.high);
        *this = of_two(sum.high, sum.low + (low + term.low));
    }
    // a + b.
    static ExactSum of_two(double a, double b) {
        const double sum = a + b, b_in_sum = sum - a;
        return {sum, (a - (sum - b_in_sum)) + (b - b_in_sum)};
    }
};

// The power of two for terms of about the size `scale`, some 2^bits times smaller. 0, which rounds nothing, where it would leave the range of
// doubles.
inline double quantum_of(double scale, int bits) {
    const double quantum = scale > 0 && std::isfinite(scale) ? std::ldexp(1.0, std::ilogb(scale) - bits) : 0.0;
    return quantum > std::numeric_limits<double>::min() ? quantum : 0.0;
}

// The term nearest to the value.
inline ExactSum exact_term(double value, double quantum) { return {quantum > 0 ? std::nearbyint(value / quantum) * quantum : value, 0.0}; }

}  // namespace rsc
