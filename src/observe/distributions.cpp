#include "observe/distributions.hpp"

#include "error.hpp"

namespace rsc {
namespace {

void count_value(CountHistogram& h, double value, double width) {
    const double position = value / width;
    if (position < static_cast<double>(h.count.size()))
        ++h.count[static_cast<std::size_t>(position)];
    else
        ++h.overflow;
    double power = 1;
    for (double& sum : h.power) sum += power *= value;
}

// Adds `area` distributed with the density 2 p / p0^2 on [0, p0], whose cumulative distribution is (p/p0)^2.
void spread_pressure(AreaHistogram& h, double p0, double area, double width) {
    double below = 0;
    for (std::size_t b = 0; b < h.area.size() && below < 1; ++b) {
        const double edge = width * static_cast<double>(b + 1) / p0;
        const double cumulative = edge < 1 ? edge * edge : 1;
        h.area[b] += area * (cumulative - below);
        below = cumulative;
    }
    h.overflow += area * (1 - below);
    h.total += area;
    h.squares += area * area;
    double power = 1;
    for (std::size_t k = 0; k < h.power.size(); ++k) {  // <p^n> = 2 p0^n / (n + 2)
        power *= p0;
        h.power[k] += area * 2 * power / static_cast<double>(k + 3);
    }
}

// Adds `area` under the uniform pressure p.
void add_uniform(AreaHistogram& h, double p, double area, double width) {
    const double position = p / width;
    if (position < static_cast<double>(h.area.size()))
        h.area[static_cast<std::size_t>(position)] += area;
    else
        h.overflow += area;
    h.total += area;
    double power = area;
    for (double& sum : h.power) sum += power *= p;
}

// Adds the pressures of pixels, each with its area. The number of contacts is the number of independent observations.
void add_pixels(AreaHistogram& h, const Level& level, double width) {
    const LevelPixels& pixels = level.pixels;
    const double area = pixels.dx * pixels.dy;
    std::vector<double> of_contact(level.a.size(), 0.0);
    for (std::size_t k = 0; k < pixels.index.size(); ++k) {
        add_uniform(h, pixels.pressure[k], area, width);
        of_contact[static_cast<std::size_t>(pixels.contact[k])] += area;
    }
    if (!pixels.index.empty())
        for (double a : of_contact) h.squares += a * a;
}

Distributions no_contacts(const PdfBins& bins) {
    const auto n = static_cast<std::size_t>(bins.bins);
    Distributions d;
    d.mean_pressure.count.assign(n, 0);
    d.pressure.area.assign(n, 0.0);
    d.spot_area.count.assign(n, 0);
    return d;
}

Binned binned(const CountHistogram& h, double width) {
    Binned out{width, {}, static_cast<double>(h.overflow)};
    for (std::int64_t n : h.count) out.weight.push_back(static_cast<double>(n));
    return out;
}

std::vector<double> density(const Binned& binned) {
    const double total = binned.total();
    std::vector<double> pdf(binned.weight.size(), kAbsent);
    if (!(total > 0)) return pdf;
    for (std::size_t b = 0; b < pdf.size(); ++b) pdf[b] = binned.weight[b] / (total * binned.width);
    return pdf;
}

}  // namespace

PdfBins make_pdf_bins(int bins, double E_star, double sigma, double sqrt_m4, double hardest) {
    if (bins < 1) bad_input("distributions: the number of bins must be at least 1, not " + std::to_string(bins));
    const double pressure = E_star * std::sqrt(sigma * sqrt_m4), area = sigma / sqrt_m4;
    if (!(pressure > 0) || !std::isfinite(pressure) || !(area > 0) || !std::isfinite(area))
        bad_input("distributions: E*, the rms height and the curvature scale must be positive and finite");
    return {bins, std::min(1.2 * pressure, hardest), 10 * area};
}

std::int64_t CountHistogram::total() const {
    std::int64_t sum = overflow;
    for (std::int64_t n : count) sum += n;
    return sum;
}

Distributions distributions_of(const PdfBins& bins, const Level& level, std::int32_t step) {
    Distributions d = no_contacts(bins);
    d.separation = level.separation;
    d.levels = 1;
    d.step = step;
    for (std::size_t k = 0; k < level.a.size(); ++k) {
        const double area = std::numbers::pi * level.a[k] * level.a[k];
        if (!(area > 0)) continue;
        const double p = level.f[k] / area;
        count_value(d.spot_area, area, bins.area_width());
        if (!(p < 0)) count_value(d.mean_pressure, p, bins.mean_pressure_width());
        if (!std::isnan(level.least_force)) continue;  // with adhesion the pressure within a spot is not Hertzian
        if (!level.pixels.index.empty()) continue;
        if (k < level.yields.size() && level.yields[k]) {
            add_uniform(d.pressure, p, area, bins.pressure_width());
            d.pressure.squares += area * area;
        } else {
            spread_pressure(d.pressure, 1.5 * p, area, bins.pressure_width());
        }
    }
    if (std::isnan(level.least_force)) add_pixels(d.pressure, level, bins.pressure_width());
    return d;
}

// This quantum resolves the powers of small values, and sums over a million realizations remain exact.
constexpr int kSumBits = 84;

void add(DistributionSums& sums, const PdfBins& bins, const Distributions& one) {
    DistributionSums term{one.step, {}};
    for_each_number(one, bins, [&term](const auto& number, double scale) {
        term.numbers.push_back(exact_term(static_cast<double>(number), quantum_of(scale, kSumBits)));
    });
    add(sums, term);
}

void add(DistributionSums& sums, const DistributionSums& more) {
    if (sums.numbers.empty()) {
        sums = more;
        return;
    }
    if (sums.step != more.step) sums.step = -1;
    for (std::size_t k = 0; k < sums.numbers.size(); ++k) sums.numbers[k].add(more.numbers[k]);
}

Distributions rounded(const DistributionSums& sums, const PdfBins& bins, std::int64_t realizations) {
    Distributions d = no_contacts(bins);
    d.levels = sums.numbers.empty() ? 0 : realizations;
    d.step = sums.step;
    auto next = sums.numbers.begin();
    if (!sums.numbers.empty())
        for_each_number(d, bins,
                        [&next](auto& number, double) { number = static_cast<std::remove_reference_t<decltype(number)>>((next++)->high); });
    return d;
}

DistributionMoments moments_of(double count, const std::array<double, 4>& power) {
    DistributionMoments m;
    if (!(count > 0)) return m;
    const double m1 = power[0] / count, m2 = power[1] / count, m3 = power[2] / count, m4 = power[3] / count;
    const double variance = std::max(0.0, m2 - m1 * m1);
    m.mean = m1;
    m.deviation = std::sqrt(variance);
    if (variance > 1e-12 * m2) {  // smaller differences are rounding errors
        m.skewness = (m3 - 3 * m1 * m2 + 2 * m1 * m1 * m1) / (variance * m.deviation);
        m.kurtosis = (m4 - 4 * m1 * m3 + 6 * m1 * m1 * m2 - 3 * m1 * m1 * m1 * m1) / (variance * variance);
    }
    return m;
}

FittedDistributions fit_distributions(const PdfBins& bins, const Distributions& sum) {
    FittedDistributions out;
    out.sum = sum;
    const Binned mean_pressure = binned(sum.mean_pressure, bins.mean_pressure_width());
    const Binned spot_area = binned(sum.spot_area, bins.area_width());
    const Binned pressure{bins.pressure_width(), sum.pressure.area, sum.pressure.overflow};
    const auto contacts = static_cast<double>(sum.mean_pressure.total());

    out.mean_pressure_pdf = density(mean_pressure);
    out.mean_pressure_moments = moments_of(contacts, sum.mean_pressure.power);
    out.rayleigh = fit_rayleigh(contacts, sum.mean_pressure.power[1], mean_pressure);

    out.spot_area_pdf = density(spot_area);
    out.spot_area_moments = moments_of(contacts, sum.spot_area.power);
    out.exponential = fit_exponential(contacts, sum.spot_area.power[0], spot_area);

    out.pressure_pdf = density(pressure);
    out.pressure_moments = moments_of(sum.pressure.total, sum.pressure.power);
    if (sum.pressure.squares > 0)
        out.gamma =
            fit_generalised_gamma(pressure, out.pressure_moments.mean, sum.pressure.total * sum.pressure.total / sum.pressure.squares);
    return out;
}

}  // namespace rsc
