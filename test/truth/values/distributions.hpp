// Histograms, densities and moments, from the contacts of all realizations.
#pragma once

#include "truth/values/truth.hpp"

namespace values {

using namespace rsc;

// Skewness and kurtosis are absent where values do not spread beyond rounding.
struct Moments1 {
    double mean, deviation, skewness, kurtosis;
    Moments1 or_absent() const {
        const bool spread = deviation * deviation > 1e-12 * (mean * mean + deviation * deviation);
        return {mean, std::isnan(deviation) ? 0 : deviation, spread ? skewness : kNone,
                spread ? kurtosis : kNone};
    }
};
// Of values with weights.
inline Moments1 moments_of(const Vector& values, const Vector& weights) {
    const double all = sum(weights);
    const auto power = [&](double about, int n) {
        double s = 0;
        for (const auto i : indices(values)) s += weights[i] * std::pow(values[i] - about, n);
        return s / all;
    };
    const double m = power(0, 1), d = std::sqrt(power(m, 2));
    return {m, d, power(m, 3) / (d * d * d), power(m, 4) / (d * d * d * d)};
}

// Of the pressures of Hertz spots (density 2 p/p0^2) and of places with one pressure, by exact raw
// moments.
struct Part {
    double area, p;
    bool hertz;
};
inline Moments1 moments_of(const std::vector<Part>& parts) {
    long double all = 0, m[5] = {};
    for (const Part& q : parts) {
        all += q.area;
        for (int n = 1; n <= 4; ++n)
            m[n] += q.hertz ? q.area * 2 * std::pow(1.5L * q.p, n) / (n + 2)
                            : q.area * std::pow(static_cast<long double>(q.p), n);
    }
    for (long double& v : m) v /= all;
    const long double a = m[1], v = m[2] - a * a, d = std::sqrt(v);
    return {double(a), double(d), double((m[3] - 3 * a * m[2] + 2 * a * a * a) / (v * d)),
            double((m[4] - 4 * a * m[3] + 6 * a * a * m[2] - 3 * a * a * a * a) / (v * v))};
}

inline void distributions(CheckedFile& f, const Truth& t) {
    const auto& wanted = t.c.output.pdf_levels;
    const std::size_t n = t.c.output.pdf_bins, D = wanted.size();
    double sqrt_m4 = std::sqrt(t.regime.m4);
    if (t.list) sqrt_m4 = 0.9 / mean(t.r[0].asperities.radius);
    if (t.c.surface.source == Source::heights) sqrt_m4 = std::sqrt(t.heights[0].differences().m4);
    const double hardest =
        1.1 * t.c.solids.hardness * std::sqrt(1 + 4 * t.c.solids.size_effect * sqrt_m4);
    const double reach = std::min(1.2 * t.E * std::sqrt(t.sigma * sqrt_m4), hardest),
                 width_p = reach / number(n), width_q = 1.5 * width_p,
                 width_A = 10 * t.sigma / sqrt_m4 / number(n);
    const auto axis = [&](const std::string& name, double width) {
        Vector v;
        for (const std::size_t b : indices(n)) v.push_back((number(b) + 0.5) * width);
        f.same(name, v, 1e-9);
        f.attribute(name, "bin_width", {width}, 1e-9);
    };
    axis("pressure_mean_bin", width_p);
    axis("pressure_bin", width_q);
    axis("spot_area_bin", width_A);
    Vector number_of;
    for (std::size_t b = 1; b <= n; ++b) number_of.push_back(number(b));
    f.same("bin", number_of);
    f.same("pdf_level", wanted, 1e-14);

    Vector used, step;
    Vector counts, count_over, count_pdf, spot_counts, spot_over, spot_pdf, areas, area_over,
        area_pdf, independent;
    std::array<std::vector<Moments1>, 3> moments;
    for (const std::size_t d : indices(D)) {
        Vector p, A, one, count(n), spot(n), area(n);
        std::vector<Part> parts;
        double over = 0, over_A = 0, over_q = 0, Z = 0, squares = 0, where = -1;
        for (const std::size_t k : indices(t.M)) {
            std::size_t s = 0;
            for (std::size_t i = 1; i < t.steps; ++i)
                if (std::abs(t.r[k].levels[i].separation - wanted[d] * t.sigma) <
                    std::abs(t.r[k].levels[s].separation - wanted[d] * t.sigma))
                    s = i;
            where = k == 0 || where == number(s) + 1 ? number(s) + 1 : 0;
            Z += t.r[k].levels[s].separation;
            const Contacts2& c = t.contacts[k][s];
            Vector pixels(c.spots.size());
            for (const Spot2& q : c.spots) {
                p.push_back(q.pressure());
                A.push_back(q.area);
                one.push_back(1);
                if (c.pixels.empty()) {
                    parts.push_back({q.area, q.pressure(), !q.yields});
                    squares += q.area * q.area;
                }
            }
            for (const Pixel2& q : c.pixels) {
                parts.push_back({c.pixel, q.p, false});
                pixels[q.contact] += c.pixel;
            }
            for (double a : pixels) squares += a * a;
        }
        const auto put = [&](Vector& into, double& beyond, double value, double width) {
            for (const std::size_t b : indices(n))
                if (value >= number(b) * width && value < (number(b) + 1) * width)
                    return void(into[b] += 1);
            beyond += 1;
        };
        for (double v : p) put(count, over, v, width_p);
        for (double v : A) put(spot, over_A, v, width_A);
        double total = 0;
        for (const Part& q : parts) {
            const auto below = [&](double edge) {
                return q.hertz      ? std::min(1.0, std::pow(edge / (1.5 * q.p), 2))
                       : edge > q.p ? 1.0
                                    : 0.0;
            };
            for (const std::size_t b : indices(n))
                area[b] += q.area * (below((number(b) + 1) * width_q) - below(number(b) * width_q));
            over_q += q.area * (1 - below(number(n) * width_q));
            total += q.area;
        }
        const double m = number(p.size());
        used.push_back(Z / number(t.M) / t.sigma);
        step.push_back(where);
        count_over.push_back(over);
        spot_over.push_back(over_A);
        area_over.push_back(over_q);
        for (const std::size_t b : indices(n)) {
            counts.push_back(count[b]);
            spot_counts.push_back(spot[b]);
            areas.push_back(area[b]);
            count_pdf.push_back(m > 0 ? count[b] / (m * width_p) : kNone);
            spot_pdf.push_back(m > 0 ? spot[b] / (m * width_A) : kNone);
            area_pdf.push_back(m > 0 ? area[b] / (total * width_q) : kNone);
        }
        independent.push_back(squares > 0 ? total * total / squares : 0);
        const Moments1 none{kNone, kNone, kNone, kNone};
        moments[0].push_back(m > 0 ? moments_of(p, one).or_absent() : none);
        moments[1].push_back(m > 0 ? moments_of(parts).or_absent() : none);
        moments[2].push_back(m > 0 ? moments_of(A, one).or_absent() : none);
    }
    f.same("pdf_separation_sigma", used, 1e-12);
    f.same("pdf_step", step);
    f.attribute("pdf_step", "start_index", {1});
    f.same("pressure_mean_count", counts);
    f.attribute("pressure_mean_count", "overflow", count_over);
    f.same("spot_area_count", spot_counts);
    f.attribute("spot_area_count", "overflow", spot_over);
    const double most = *std::ranges::max_element(areas);
    f.same("pressure_area", areas, 1e-9, 1e-12 * most);
    f.attribute("pressure_area", "overflow", area_over, 1e-9, 1e-12 * most);
    f.same("pressure_mean_pdf", count_pdf, 1e-9);
    f.same("spot_area_pdf", spot_pdf, 1e-9);
    f.same("pressure_pdf", area_pdf, 1e-9, 1e-11 / width_q);
    f.attribute("pressure_pdf", "independent_contacts", independent, 1e-10);
    const std::array<const char*, 3> of{"pressure_mean_pdf", "pressure_pdf", "spot_area_pdf"};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto put = [&](const char* name, double Moments1::*member) {
            Vector v;
            for (const Moments1& m : moments[i]) v.push_back(m.*member);
            // A difference of powers loses digits where the values hardly spread; skewness may be
            // 0.
            const bool ratio = member == &Moments1::skewness,
                       deviation = member == &Moments1::deviation;
            const bool fourth = member == &Moments1::kurtosis;
            double spread = 0;  // of the mean over the deviation
            for (const Moments1& m : moments[i])
                if (m.deviation > 0) spread = std::max(spread, m.mean / m.deviation);
            f.attribute(of[i], name, v, 1e-6,
                        ratio       ? 1e-9 + 1e-15 * std::pow(spread, 3)
                        : deviation ? 1e-7 * moments[i][0].mean
                        : fourth    ? 1e-15 * std::pow(spread, 4)
                                    : 0);
        };
        put("mean", &Moments1::mean);
        put("standard_deviation", &Moments1::deviation);
        put("skewness", &Moments1::skewness);
        put("kurtosis", &Moments1::kurtosis);
    }
    // What they hold: test_result_file.
    CHECK(f.has("pdf_sums") == (t.M > 1));
}

}  // namespace values
