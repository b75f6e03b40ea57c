#include "observe/distributions.hpp"

#include "base/error.hpp"

namespace rsc {
namespace {

void add_value(Histogram& h, double value, double weight, double width) {
    const double position = value / width;
    (position < double(h.weight.size()) ? h.weight[at(position)] : h.overflow) += weight;
    double power = weight;
    for (double& sum : h.power) sum += power *= value;
}

// Adds `area` distributed with the density 2 p / p0^2 on [0, p0], whose cumulative distribution is
// (p/p0)^2.
void spread_pressure(Histogram& h, double p0, double area, double width) {
    double below = 0;
    for (std::size_t b = 0; b < h.weight.size() && below < 1; ++b) {
        const double edge = width * double(b + 1) / p0;
        const double cumulative = edge < 1 ? edge * edge : 1;
        h.weight[b] += area * (cumulative - below);
        below = cumulative;
    }
    h.overflow += area * (1 - below);
    h.total += area;
    h.squares += area * area;
    double power = 1;
    for (const auto k : indices(h.power)) {  // <p^n> = 2 p0^n / (n + 2)
        power *= p0;
        h.power[k] += area * 2 * power / double(k + 3);
    }
}

// Adds the pressures of pixels, each with its area. The number of contacts is the number of
// independent observations.
void add_pixels(Histogram& h, const Level& level, double width) {
    const LevelPixels& pixels = level.pixels;
    const double area = pixels.dx * pixels.dy;
    std::vector<double> of_contact(level.a.size(), 0.0);
    for (const auto k : indices(pixels.index)) {
        add_value(h, pixels.pressure[k], area, width);
        h.total += area;
        of_contact[at(pixels.contact[k])] += area;
    }
    if (!pixels.index.empty())
        for (double a : of_contact) h.squares += a * a;
}

Distributions no_contacts(const PdfBins& bins) {
    const auto n = at(bins.bins);
    Distributions d;
    for (Histogram* h : {&d.mean_pressure, &d.pressure, &d.spot_area}) h->weight.assign(n, 0.0);
    if (bins.gap_max > 0) d.gap.weight.assign(n, 0.0);
    return d;
}

double all_weights(const Histogram& h) {
    return std::accumulate(h.weight.begin(), h.weight.end(), 0.0) + h.overflow;
}

std::vector<double> density(const Histogram& h, double width) {
    const double total = all_weights(h);
    std::vector<double> pdf(h.weight.size(), kNotComputed);
    if (!(total > 0)) return pdf;
    for (const auto b : indices(pdf)) pdf[b] = h.weight[b] / (total * width);
    return pdf;
}

}  // namespace

PdfBins make_pdf_bins(int bins, double E_star, double sigma, double sqrt_m4, double hardest) {
    if (bins < 1)
        bad_input("distributions: the number of bins must be at least 1, not " +
                  std::to_string(bins));
    const double pressure = E_star * std::sqrt(sigma * sqrt_m4), area = sigma / sqrt_m4;
    if (!(pressure > 0) || !std::isfinite(pressure) || !(area > 0) || !std::isfinite(area))
        bad_input(
            "distributions: E*, the rms height and the curvature scale must be positive and "
            "finite");
    return {bins, std::min(1.2 * pressure, hardest), 10 * area};
}

Distributions distributions_of(const PdfBins& bins, const Level& level, std::int32_t step) {
    Distributions d = no_contacts(bins);
    d.separation = level.separation;
    d.levels = 1;
    d.step = step;
    for (const auto k : indices(level.a)) {
        const double area = pi * level.a[k] * level.a[k];
        if (!(area > 0)) continue;
        const double p = level.f[k] / area;
        add_value(d.spot_area, area, 1, bins.area_width());
        if (!(p < 0)) add_value(d.mean_pressure, p, 1, bins.mean_pressure_width());
        if (!std::isnan(level.least_force))
            continue;  // with adhesion the pressure within a spot is not Hertzian
        if (!level.pixels.index.empty()) continue;
        if (k < level.yields.size() && level.yields[k]) {
            add_value(d.pressure, p, area, bins.pressure_width());
            d.pressure.total += area;
            d.pressure.squares += area * area;
        } else {
            spread_pressure(d.pressure, 1.5 * p, area, bins.pressure_width());
        }
    }
    if (std::isnan(level.least_force)) add_pixels(d.pressure, level, bins.pressure_width());
    const auto counts = std::min(d.gap.weight.size(), level.gaps.of_bin.size());
    std::copy_n(level.gaps.of_bin.begin(), counts, d.gap.weight.begin());
    d.gap.overflow = level.gaps.beyond;
    d.gap.power = level.gaps.power;
    return d;
}

void add(DistributionSums& sums, const Distributions& one) {
    DistributionSums term{one.step, {}};
    for_each_number(one, [&term](double number) { term.numbers.push_back(number); });
    add(sums, term);
}

void add(DistributionSums& sums, const DistributionSums& more) {
    if (sums.numbers.empty()) {
        sums = more;
        return;
    }
    if (sums.step != more.step) sums.step = -1;
    for (const auto k : indices(sums.numbers)) sums.numbers[k] += more.numbers[k];
}

Distributions rounded(const DistributionSums& sums, const PdfBins& bins,
                      std::int64_t realizations) {
    Distributions d = no_contacts(bins);
    d.levels = sums.numbers.empty() ? 0 : realizations;
    d.step = sums.step;
    auto next = sums.numbers.begin();
    if (!sums.numbers.empty()) for_each_number(d, [&next](double& number) { number = *next++; });
    return d;
}

DistributionMoments moments_of(double count, const std::array<double, 4>& power) {
    DistributionMoments m;
    if (!(count > 0)) return m;
    const double m1 = power[0] / count, m2 = power[1] / count, m3 = power[2] / count,
                 m4 = power[3] / count;
    const double variance = std::max(0.0, m2 - m1 * m1);
    m.mean = m1;
    m.deviation = std::sqrt(variance);
    if (variance > 1e-12 * m2) {  // smaller differences are rounding errors
        m.skewness = (m3 - 3 * m1 * m2 + 2 * m1 * m1 * m1) / (variance * m.deviation);
        m.kurtosis =
            (m4 - 4 * m1 * m3 + 6 * m1 * m1 * m2 - 3 * m1 * m1 * m1 * m1) / (variance * variance);
    }
    return m;
}

ShownDistributions shown_distributions(const PdfBins& bins, const Distributions& sum) {
    ShownDistributions out;
    out.sum = sum;
    out.mean_pressure_pdf = density(sum.mean_pressure, bins.mean_pressure_width());
    out.mean_pressure_moments =
        moments_of(all_weights(sum.mean_pressure), sum.mean_pressure.power);  // not under tension
    out.spot_area_pdf = density(sum.spot_area, bins.area_width());
    out.spot_area_moments = moments_of(all_weights(sum.spot_area), sum.spot_area.power);
    out.pressure_pdf = density(sum.pressure, bins.pressure_width());
    out.pressure_moments = moments_of(sum.pressure.total, sum.pressure.power);
    out.gap_pdf = density(sum.gap, bins.gap_width());
    out.gap_moments = moments_of(all_weights(sum.gap), sum.gap.power);
    return out;
}

}  // namespace rsc
