// Surfaces, closed forms, maps and radial means.
#pragma once

#include "truth/values/levels.hpp"

namespace values {

using namespace rsc;

inline void surfaces(CheckedFile& f, const Truth& t) {
    std::vector<Moments4> own, grid;
    for (const std::size_t k : indices(t.M)) {
        grid.push_back(t.list ? Moments4{} : t.heights[k].differences());
        own.push_back(t.synthetic ? t.heights[k].modes() : grid.back());
        if (t.list) own.back().m0 = Truth::variance(t.r[k].asperities.z);
    }
    f.same("sigma", t.each_surface([&](auto k) { return std::sqrt(own[k].m0); }), 1e-10);
    f.same("m2", t.each_surface([&](auto k) { return own[k].m2; }), 1e-9);
    f.same("m4", t.each_surface([&](auto k) { return own[k].m4; }), 1e-9);
    f.same("rms_slope", t.each_surface([&](auto k) { return std::sqrt(2 * own[k].m2); }), 1e-9);
    f.same("m2_grid", t.each_surface([&](auto k) { return grid[k].m2; }), 1e-9);
    f.same("m4_grid", t.each_surface([&](auto k) { return grid[k].m4; }), 1e-9);
    const bool own_summits =
        t.elements ||
        t.hertz;  // others touch at summits of the difference to the sphere: test_summits
    const auto curvature = [&](std::size_t k, bool geometric) {
        if (!own_summits)
            return geometric ? t.r[k].statistics.mean_kappa_g : t.r[k].statistics.mean_kappa_a;
        const Asperities& a = t.r[k].asperities;
        double s = 0;
        for (const auto i : indices(a.kappa1))
            s += geometric ? std::sqrt(a.kappa1[i] * a.kappa2[i]) : (a.kappa1[i] + a.kappa2[i]) / 2;
        return a.kappa1.empty() || t.list ? kNone : s / number(a.size());
    };
    f.same("mean_kappa_g", t.each_surface([&](auto k) { return curvature(k, true); }), kRounding);
    f.same("mean_kappa_a", t.each_surface([&](auto k) { return curvature(k, false); }), kRounding);
    if (!t.elements) {
        f.same("summits", t.each_surface([&](auto k) {
            return own_summits ? number(t.r[k].asperities.size())
                               : double(t.r[k].statistics.summits);
        }));
        f.same("saddles",
               t.each_surface([&](auto k) -> double {  // of summits between the points: every_value
                   if (t.list || !t.hertz || (t.c.surface.missing == Missing::fill))
                       return double(t.r[k].statistics.saddles);
                   return double(t.heights[k].maxima()) - number(t.r[k].asperities.size());
               }));
    }

    const Moments4& m = t.theory;
    f.same("m0_theory", {m.m0}, 1e-10);
    f.same("m2_theory", {m.m2}, 1e-10);
    f.same("m4_theory", {m.m4}, 1e-10);
    f.same("nayak_theory", {m.m0 * m.m4 / (m.m2 * m.m2)}, 1e-10);
    f.same("density_theory", {std::sqrt(3) * m.m4 / (18 * pi * m.m2)}, 1e-10);
}

inline void regimes(CheckedFile& f, const Truth& t) {
    const Vector N = f.values("force_mean");
    const double m2 = t.regime.m2, m4 = t.regime.m4, A0 = t.Lx * t.Ly;
    constexpr double kDigits = 3e-5;  // the paper's five of 212.66
    f.same("transition_force", {212.66 * std::pow(m2, 1.5) * t.E / m4}, kDigits);
    // r_g = 1/<kappa_g>, <kappa_g> = 1.356 sqrt(m4) of three digits.
    f.same("area_I", t.each_step([&](auto s) {
        return pi * std::pow(3 * 0.737 / std::sqrt(m4) * N[s] / (4 * t.E), 2.0 / 3);
    }),
           1e-3);
    f.same("area_II", t.each_step([&](auto s) {
        return 0.2 * std::sqrt(2 * pi) * N[s] / (std::sqrt(2 * m2) * t.E);
    }),
           1e-9);
    if (!t.periodic) {
        f.same("area_hertz", t.each_step([&](auto s) {
            return std::isinf(t.R) ? kNone : pi * std::pow(3 * N[s] * t.R / (4 * t.E), 2.0 / 3);
        }),
               kRounding);
        return;
    }
    const auto p = [&](std::size_t s) { return N[s] / (A0 * t.E * std::sqrt(2 * t.m2_made)); };
    f.same("area_persson", t.each_step([&](auto s) { return std::erf(std::sqrt(2) * p(s)); }),
           1e-9);
    f.same("area_bgt", t.each_step([&](auto s) { return std::sqrt(2 * pi) * p(s); }), 1e-9);
    // Greenwood and Williamson by plain sums over heights t of the summits.
    double density = 0, kappa = 0;
    for (const Realization& r : t.r) {
        density += number(r.asperities.size()) / A0 / number(t.M);
        double g = 0;
        for (const auto i : indices(r.asperities))
            g += std::sqrt(r.asperities.kappa1[i] * r.asperities.kappa2[i]);
        kappa += g / number(r.asperities.size()) / number(t.M);
    }
    const double s2 = t.regime.m0 - 0.8968 * m2 * m2 / m4, deviation = std::sqrt(s2), r = 1 / kappa;
    const auto F = [](double n, double h) {
        double total = 0;
        constexpr double step = 2e-4;
        for (double v = h + step / 2; v < 8; v += step)
            total += std::pow(v - h, n) * std::exp(-v * v / 2) / std::sqrt(2 * pi) * step;
        return total;
    };
    f.same("area_gw", t.each_step([&](auto s) {
        if (t.elements || !(s2 > 0)) return kNone;
        double low = -5, high = 6;
        for (int k = 0; k < 40; ++k) {
            const double h = (low + high) / 2;
            (4.0 / 3 * density * std::sqrt(r) * std::pow(deviation, 1.5) * F(1.5, h) >
                     N[s] / (A0 * t.E)
                 ? low
                 : high) = h;
        }
        return N[s] > 0 ? pi * density * r * deviation * F(1, low) : 0;
    }),
           1e-5);
}

// Means of a map over circles: cubic curves between cell centres (observe/map.hpp), written as
// Hermite's.
inline double cubic(long n, const std::function<double(long)>& f, double s) {
    const long i = std::clamp(long(std::floor(s)), 0L, n - 2);
    const auto slope = [&](long k) {
        if (k == 0) return (-3 * f(0) + 4 * f(1) - f(2)) / 2;
        if (k == n - 1) return (3 * f(k) - 4 * f(k - 1) + f(k - 2)) / 2;
        return (f(k + 1) - f(k - 1)) / 2;
    };
    const double t = s - double(i), u = 1 - t;
    return (1 + 2 * t) * u * u * f(i) + t * u * u * slope(i) + t * t * (3 - 2 * t) * f(i + 1) -
           t * t * u * slope(i + 1);
}

inline void maps(CheckedFile& f, const Truth& t) {
    const Cells g(t);
    const std::size_t cells = g.nx * g.ny;
    Vector x, y;
    for (const long i : indices(g.nx)) x.push_back(g.x0 + g.side * (double(i) + 0.5));
    for (const long j : indices(g.ny)) y.push_back(g.y0 + g.side * (double(j) + 0.5));
    f.same("x", x, kRounding);
    f.same("y", y, kRounding);
    f.same("map_cell_side", {g.side}, kRounding);
    const double below_last = double(g.ny - 1) * g.side,
                 covered = std::min(1.0, (t.Ly - below_last) / g.side);
    f.attribute("y", "share_of_last_row", {covered}, 1e-12);
    Vector area(t.steps * cells), force(area);
    std::vector<long double> area_sum(area.size()), force_sum(area.size());
    for (const std::size_t k : indices(t.M))
        for (const std::size_t s : indices(t.steps)) {
            const CellSums c = cells_of(t.contacts[k][s], g);
            for (const std::size_t i : indices(cells)) {
                area_sum[s * cells + i] += c.area[i];
                force_sum[s * cells + i] += c.force[i];
            }
        }
    const double divisor = g.side * g.side * number(t.M);
    for (const auto i : indices(area)) {
        area[i] = double(area_sum[i]) / divisor;
        force[i] = double(force_sum[i]) / divisor;
    }
    const double scale = *std::ranges::max_element(force);
    f.same("map_area_fraction", area, 1e-13);
    f.same("map_pressure", force, 1e-13, 1e-15 * scale);
    CHECK(scale > 0);
    if (t.periodic) return CHECK(!f.has("radius") && !f.has("radial_pressure"));
    const double largest =
        std::min({t.tip_x - t.x0, t.x0 + t.Lx - t.tip_x, t.tip_y - t.y0, t.y0 + t.Ly - t.tip_y});
    if (!(largest > 0))
        return CHECK(!f.has("radius") && !f.has("radial_pressure"));  // the tip is not over the map
    const std::size_t bins = t.c.output.radial_bins;
    Vector radius;
    for (const std::size_t b : indices(bins))
        radius.push_back((number(b) + 0.5) * largest / number(bins));
    f.same("radius", radius, kRounding);
    const auto radial = [&](const Vector& map) {
        Vector out;
        for (const std::size_t s : indices(t.steps))
            for (double r : radius) {
                const int angles = 4 * std::max(16, int(std::ceil(4 * pi * r / g.side)));
                double total = 0;
                for (const int k : indices(angles)) {
                    const double phi = 2 * pi * (k + 0.5) / angles;
                    const double u = (t.tip_x + r * std::cos(phi) - g.x0) / g.side - 0.5,
                                 v = (t.tip_y + r * std::sin(phi) - g.y0) / g.side - 0.5;
                    total += cubic(
                        g.ny,
                        [&](long j) {
                            return cubic(
                                g.nx,
                                [&](long i) {
                                    return map[s * cells + (j * g.nx + i)] /
                                           (j == g.ny - 1 ? covered : 1);
                                },
                                u);
                        },
                        v);
                }
                out.push_back(total / angles);
            }
        return out;
    };
    f.same("radial_area_fraction", radial(area), 1e-10, 1e-12);
    f.same("radial_pressure", radial(force), 1e-10, 1e-12 * scale);
    const Vector N = f.values("force_mean");
    Vector hertz;
    for (const std::size_t s : indices(t.steps))
        for (double r : radius) {
            const double a = std::cbrt(3 * N[s] * t.R / (4 * t.E));
            hertz.push_back(r < a ? 3 * N[s] / (2 * pi * a * a) * std::sqrt(1 - r * r / (a * a))
                                  : 0);
            if (std::isinf(t.R)) hertz.back() = kNone;
        }
    f.same("hertz_pressure", hertz, 1e-9);
}

}  // namespace values
