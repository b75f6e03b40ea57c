// Distributions over contacts (paper, section 5), and the exact sums in which they add up over realizations.
#pragma once

#include "contact/level.hpp"
#include "observe/fits.hpp"

namespace rsc {

// Sums over realizations that do not depend, bit for bit, on the order and grouping of their terms, so that the results of two campaigns
// can be merged.

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

// The power of two for terms of about the size `scale`, some 2^bits times smaller. 0, without rounding, where it would underflow.
inline double quantum_of(double scale, int bits) {
    const double quantum = scale > 0 && std::isfinite(scale) ? std::ldexp(1.0, std::ilogb(scale) - bits) : 0.0;
    return quantum > std::numeric_limits<double>::min() ? quantum : 0.0;
}

// The term nearest to the value.
inline ExactSum exact_term(double value, double quantum) { return {quantum > 0 ? std::nearbyint(value / quantum) * quantum : value, 0.0}; }

// Distributions over contacts (paper, section 5), as histograms that add up over realizations and never store a contact. The bins
// follow from theory, so that all realizations share them.

// Bins of equal width from 0: the mean pressure of a contact to `pressure_max`, the pressure at a point to 1.5 pressure_max (the
// peak of a Hertz contact is 1.5 times its mean), the area of a spot to `area_max`. Larger values count as overflow.
struct PdfBins {
    int bins = 60;
    double pressure_max = 0;  // [force/length^2]
    double area_max = 0;      // [length^2]
    double mean_pressure_width() const { return pressure_max / bins; }
    double pressure_width() const { return 1.5 * pressure_max / bins; }
    double area_width() const { return area_max / bins; }
};

// Ranges that hold nearly everything down to a separation of one sigma or so. Lengths are measured by sigma and curvatures by
// sqrt(m4): a summit of curvature k pressed in by g has the mean pressure 4/(3 pi) E* sqrt(k g) and the area pi g / k. Without
// interaction about one contact in a thousand lies beyond them at separations of 2 sigma, and interaction only lowers g. Throws
// Error(bad_input) unless everything is positive and finite, but for `hardest`: no summit bears a higher mean pressure (Infinity: any).
PdfBins make_pdf_bins(int bins, double E_star, double sigma, double sqrt_m4, double hardest);

// Equal contributions: one count a contact, and sums of the powers 1 to 4 of the values.
struct CountHistogram {
    std::vector<std::int64_t> count;
    std::int64_t overflow = 0;
    std::array<double, 4> power{};
    std::int64_t total() const;
};

// Contributions by area: the pressure at a random point of the contact area.
struct AreaHistogram {
    std::vector<double> area;       // [length^2]
    double overflow = 0;            // [length^2]
    double total = 0;               // sum of pi a^2
    double squares = 0;             // sum of (pi a^2)^2: total^2/squares is the number of equal contacts these stand for
    std::array<double, 4> power{};  // sums of area times the powers 1 to 4 of the pressure
};

// The three distributions of one level of one realization, or their sums over realizations.
struct Distributions {
    double separation = 0;    // Z0 of the level, summed over realizations [length]
    std::int64_t levels = 0;  // how many realizations are in it
    std::int32_t step = 0;    // the level's index, from 0; -1 once realizations differ in it
    CountHistogram mean_pressure;
    AreaHistogram pressure;
    CountHistogram spot_area;
};

// One level. Mean pressure p = f/(pi a^2); each contact gives the point pressure its own density 2 p/p0^2 on [0, p0], p0 = 1.5
// f/(pi a^2), integrated exactly over each bin; one that yields carries p everywhere. Contacts of no area are left out. A level with
// pixels gives the point pressures of those.
Distributions distributions_of(const PdfBins& bins, const Level& level, std::int32_t step);

// Every number of `d` that adds up over realizations, in a fixed order, with the size it typically has: visit(number, scale). Scale 0:
// whole numbers.
template <class D, class Visit>
void for_each_number(D& d, const PdfBins& bins, Visit visit) {
    const double p = bins.pressure_max, area = bins.area_max;
    visit(d.separation, std::sqrt(area));
    for (auto& count : d.mean_pressure.count) visit(count, 0.0);
    visit(d.mean_pressure.overflow, 0.0);
    for (auto& value : d.pressure.area) visit(value, area);
    visit(d.pressure.overflow, area);
    visit(d.pressure.total, area);
    visit(d.pressure.squares, area * area);
    for (auto& count : d.spot_area.count) visit(count, 0.0);
    visit(d.spot_area.overflow, 0.0);
    double p_power = 1, area_power = 1;
    for (std::size_t k = 0; k < 4; ++k) {
        p_power *= p, area_power *= area;
        visit(d.mean_pressure.power[k], p_power);
        visit(d.pressure.power[k], area * p_power);
        visit(d.spot_area.power[k], area_power);
    }
}

// The distributions of a level summed over realizations.
struct DistributionSums {
    std::int32_t step = 0;          // the level's index, from 0; -1 once realizations differ in it
    std::vector<ExactSum> numbers;  // by for_each_number; empty: of no realization
};

void add(DistributionSums& sums, const PdfBins& bins, const Distributions& one);
void add(DistributionSums& sums, const DistributionSums& more);
Distributions rounded(const DistributionSums& sums, const PdfBins& bins, std::int64_t realizations);

struct DistributionMoments {
    double mean = kAbsent, deviation = kAbsent, skewness = kAbsent, kurtosis = kAbsent;  // kurtosis is 3 for a Gaussian
};
DistributionMoments moments_of(double count, const std::array<double, 4>& power);

// Written to the file: densities per unit of their argument (integral 1 including the overflow), moments and fits.
struct FittedDistributions {
    Distributions sum;
    std::vector<double> mean_pressure_pdf, pressure_pdf, spot_area_pdf;
    DistributionMoments mean_pressure_moments, pressure_moments, spot_area_moments;
    ScaleFit rayleigh;     // of the mean pressure
    GammaFit gamma;        // of the pressure
    ScaleFit exponential;  // of the spot area
};
FittedDistributions fit_distributions(const PdfBins& bins, const Distributions& sum);

}  // namespace rsc
