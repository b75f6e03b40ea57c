// Distributions over contacts (paper, section 5), and their sums over realizations.
#pragma once

#include "base/std.hpp"
#include "contact/level.hpp"

namespace rsc {

// Distributions are histograms, which add up over realizations without storing contacts. The bins
// follow from theory, so that all realizations use the same.

// Bins of equal width from 0: the mean pressure of a contact to `pressure_max`, the pressure at a
// point to 1.5 pressure_max (the peak of a Hertz contact is 1.5 times its mean), the area of a spot
// to `area_max`, the gap to `gap_max`. Larger values count as overflow.
struct PdfBins {
    int bins = 60;
    double pressure_max = 0;  // [force/length^2]
    double area_max = 0;      // [length^2]
    double gap_max = 0;       // [length]; 0: there are no gaps
    double mean_pressure_width() const { return pressure_max / bins; }
    double pressure_width() const { return 1.5 * pressure_max / bins; }
    double area_width() const { return area_max / bins; }
    double gap_width() const { return gap_max / bins; }
};

// Bins that contain nearly all values at separations above about one sigma. A summit of curvature k
// and penetration g has the mean pressure 4/(3 pi) E* sqrt(k g) and the area pi g / k; the ranges
// follow from multiples of sigma for g and sqrt(m4) for k. Without interaction one contact in a
// thousand is beyond them at a separation of 2 sigma; interaction reduces g. `hardest` is the
// largest possible mean pressure (Infinity: no limit). Throws Error(bad_input) unless all other
// arguments are positive and finite.
PdfBins make_pdf_bins(int bins, double E_star, double sigma, double sqrt_m4, double hardest);

// Histogram of values by weight: the number of contacts, or the area on which the pressure has the
// value [length^2].
struct Histogram {
    std::vector<double> weight;  // of each bin
    double overflow = 0;         // weight beyond the last bin
    // Of the pressure: sums of pi a^2 and (pi a^2)^2; total^2/squares is the effective number of
    // contacts.
    double total = 0, squares = 0;
    std::array<double, 4> power{};  // sums of weight times the powers 1 to 4 of the value
};

// The distributions of one level, of one realization or summed over realizations.
struct Distributions {
    double separation = 0;               // Z0 of the level, summed over realizations [length]
    std::int64_t levels = 0;             // number of realizations
    std::int32_t step = 0;               // index of the level, from 0; -1 if realizations differ
    Histogram mean_pressure, spot_area;  // one count per contact
    Histogram pressure;                  // at a random point of the contact area
    Histogram gap;                       // at the open points between two flats; empty: no gaps
};

// Distributions of one level. The mean pressure of a contact is f/(pi a^2). Each contact
// contributes the Hertzian density 2 p/p0^2 of its point pressures on [0, p0], p0 = 1.5 f/(pi a^2),
// integrated exactly over each bin; the pressure of a yielding contact is uniform.
// Contacts without area are ignored. If the level has pixels, the point pressures are theirs.
Distributions distributions_of(const PdfBins& bins, const Level& level, std::int32_t step);

// Calls visit(number) for every number of `d` that is summed over realizations, in a fixed order.
template <class D, class Visit>
void for_each_number(D& d, Visit visit) {
    const auto all = [&](auto& values) {
        for (auto& value : values) visit(value);
    };
    visit(d.separation);
    all(d.mean_pressure.weight);
    visit(d.mean_pressure.overflow);
    all(d.pressure.weight);
    for (auto* value : {&d.pressure.overflow, &d.pressure.total, &d.pressure.squares})
        visit(*value);
    all(d.spot_area.weight);
    visit(d.spot_area.overflow);
    for (const auto k : indices(d.pressure.power))
        for (auto* h : {&d.mean_pressure, &d.pressure, &d.spot_area}) visit(h->power[k]);
    if (d.gap.weight.empty()) return;
    all(d.gap.weight);
    visit(d.gap.overflow);
    all(d.gap.power);
}

// Sums of the distributions of a level over realizations, which are added in their order.
struct DistributionSums {
    std::int32_t step = 0;        // index of the level, from 0; -1 if realizations differ
    std::vector<double> numbers;  // in the order of for_each_number; empty: no realizations
};

void add(DistributionSums& sums, const Distributions& one);
void add(DistributionSums& sums, const DistributionSums& more);
Distributions rounded(const DistributionSums& sums, const PdfBins& bins, std::int64_t realizations);

// NaN without contacts.
struct DistributionMoments {
    double mean = kNotComputed, deviation = kNotComputed, skewness = kNotComputed,
           kurtosis = kNotComputed;  // kurtosis is 3 for a Gaussian
};
DistributionMoments moments_of(double count, const std::array<double, 4>& power);

// Results for the file: probability densities (integral 1 including the overflow) and moments.
struct ShownDistributions {
    Distributions sum;
    std::vector<double> mean_pressure_pdf, pressure_pdf, spot_area_pdf, gap_pdf;
    DistributionMoments mean_pressure_moments, pressure_moments, spot_area_moments, gap_moments;
};
ShownDistributions shown_distributions(const PdfBins& bins, const Distributions& sum);

}  // namespace rsc
