// What files of one realization hold: asperities, contacts, heights, friction, a measured map,
// levels compared with elements.
#pragma once

#include "asperities/law.hpp"
#include "contact/make.hpp"
#include "truth/values/truth.hpp"

namespace values {

using namespace rsc;

inline void asperities(CheckedFile& f, const Truth& t) {
    if (t.elements || t.M > 1) return CHECK(!f.has("asperity_x"));
    const Asperities& a = t.r[0].asperities;
    f.same("asperity_x", a.x);
    f.same("asperity_y", a.y);
    f.same("asperity_z", a.z);
    f.same("asperity_radius", a.radius);
    if (!a.kappa1.empty()) {
        f.same("asperity_kappa1", a.kappa1);
        f.same("asperity_kappa2", a.kappa2);
        f.same("asperity_angle", a.angle);
    }
    if (!a.biharmonic.empty()) f.same("asperity_biharmonic", a.biharmonic);
    CHECK(t.list || !a.kappa1.empty());
    CHECK((t.c.asperities.law == LawKind::hertz) == a.biharmonic.empty());
    if (!t.hertz || t.list) return;  // those between the points: test_summits
    const Grid& g = t.heights[0];
    for (const auto k : indices(a)) {
        const long i = std::lround((a.x[k] - g.x0) / g.dx), j = std::lround((a.y[k] - g.y0) / g.dy);
        CHECK_CLOSE(a.x[k], g.x(i), 1e-12 * t.Lx);
        CHECK_CLOSE(a.y[k], g.y(j), 1e-12 * t.Ly);
        CHECK(a.z[k] == g.at_point(i, j));
        const Grid::Second s = g.second(i, j);
        const auto curvature = [&](double angle) {
            const double c = std::cos(angle), d = std::sin(angle);
            return -(s.xx * c * c + 2 * s.xy * c * d + s.yy * d * d);
        };
        CHECK_CLOSE(curvature(a.angle[k]), a.kappa2[k], 1e-7 * a.kappa1[k]);
        CHECK_CLOSE(curvature(a.angle[k] + pi / 2), a.kappa1[k], 1e-7 * a.kappa1[k]);
        const double kappa = t.c.asperities.curvature == Curvature::geometric
                                 ? std::sqrt(a.kappa1[k] * a.kappa2[k])
                                 : (a.kappa1[k] + a.kappa2[k]) / 2;
        CHECK_RELATIVE(a.radius[k], 1 / kappa, kRounding);
    }
}

inline void contacts(CheckedFile& f, const Truth& t) {
    if (t.M > 1 || t.c.output.contacts == Contacts::none)
        return CHECK(!f.has("contact_start") && !f.has("contact_force"));
    Vector start, count, which, x, y, force, radius, yields;
    for (const std::size_t s : indices(t.steps)) {
        const auto& spots = t.contacts[0][s].spots;
        const bool kept = t.c.output.contacts != Contacts::last || s + 1 == t.steps;
        start.push_back(number(force.size()) + 1);
        count.push_back(kept ? number(spots.size()) : 0);
        for (const Spot2& p : spots) {
            if (!kept) continue;
            which.push_back(p.index + 1.0);
            x.push_back(p.x);
            y.push_back(p.y);
            force.push_back(p.f);
            radius.push_back(p.radius());
            yields.push_back(p.yields);
        }
    }
    f.same("contact_start", start);
    f.same("contact_count", count);
    f.attribute("contact_start", "start_index", {1});
    f.same("contact_force", force, kRounding);
    f.same("contact_radius", radius, kRounding);
    if (t.elements) {
        f.same("contact_x", x, kRounding, 1e-12 * t.Lx);
        f.same("contact_y", y, kRounding, 1e-12 * t.Ly);
        CHECK(!f.has("contact_asperity"));
    } else {
        f.same("contact_asperity", which);
        f.attribute("contact_asperity", "start_index", {1});
        CHECK(!f.has("contact_x"));
        CHECK(f.has("contact_major") == (!t.hertz && !force.empty()));
    }
    if (std::isfinite(t.c.solids.hardness)) f.same("contact_yields", yields);
    if (t.elements || t.hertz) return;
    // Other laws: what they answer to the penetrations.
    const auto law = make_law(t.c.asperities.law, t.r[0].asperities, t.E);
    Vector major, minor, angle;
    for (const auto k : indices(which)) {
        const int i = int(which[k]) - 1;
        law->prepare({&i, 1});
        const double root = std::sqrt(law->footprint(i, 0).axes);
        major.push_back(radius[k] / root);
        minor.push_back(radius[k] * root);
        angle.push_back(t.r[0].asperities.angle[i]);
    }
    f.same("contact_major", major, kRounding);
    f.same("contact_minor", minor, kRounding);
    f.same("contact_angle", angle, kRounding);
    f.same("contact_spot_x", x, kRounding, 1e-12 * t.Lx);
    f.same("contact_spot_y", y, kRounding, 1e-12 * t.Ly);
    for (std::size_t s = 0; s < t.steps && !std::isfinite(t.c.solids.hardness); ++s)
        for (const auto k : indices(t.contacts[0][s].spots)) {
            const Spot2& p = t.contacts[0][s].spots[k];
            law->prepare(std::array{int(p.index)});
            CHECK_RELATIVE(p.f, law->force(p.index, t.r[0].levels[s].u[k]), 1e-4);
            CHECK_RELATIVE(p.area, law->area(p.index, t.r[0].levels[s].u[k]), kRounding);
        }
}

// The pixels in contact at every stored level, with those that yield, and no others.
inline void contact_mask(CheckedFile& f, const Truth& t) {
    if (!f.has("contact_mask")) {
        for (const Contacts2& c : t.contacts[0])
            CHECK(t.M > 1 || t.c.output.contacts != Contacts::automatic || c.pixels.empty());
        return;
    }
    const Vector x = f.values("mask_x"), y = f.values("mask_y"), mask = f.values("contact_mask");
    const Vector steps = f.values("mask_step");
    const auto place = [](const Vector& centres, double at) {
        const auto next = std::ranges::upper_bound(centres, at) - centres.begin();
        const auto near = std::max<std::ptrdiff_t>(next - 1, 0);
        const bool above = next < std::ssize(centres) && centres[next] - at < at - centres[near];
        return above ? next : near;
    };
    for (const auto k : indices(steps)) {
        const Contacts2& c = t.contacts[0][at(steps[k]) - 1];
        const auto level = std::span(mask).subspan(k * x.size() * y.size(), x.size() * y.size());
        std::size_t touching = 0;
        for (const double flag : level) touching += flag == 1 || flag == 2;
        CHECK(touching == c.pixels.size());
        for (const Pixel2& p : c.pixels) {
            const double flag = level[place(y, p.y) * x.size() + place(x, p.x)];
            CHECK(flag == (p.p >= t.c.solids.hardness ? 2 : 1));
        }
    }
}

inline void heights(CheckedFile& f, const Truth& t) {
    if (!t.c.output.heights) return CHECK(!f.has("height"));
    const Grid& g = t.heights[0];
    Vector x, y;
    for (const long i : indices(g.nx)) x.push_back(g.x(i));
    for (const long j : indices(g.ny)) y.push_back(g.y(j));
    f.same("height_x", x, 0, 1e-13 * t.Lx);
    f.same("height_y", y, 0, 1e-13 * t.Ly);
    f.same("height", g.z);
}

// First loading up to full slip and a cycle at each level (THEORY.rst, section Friction); the
// curves themselves: test_friction.
inline void friction(CheckedFile& f, const Truth& t) {
    if (!(t.c.solids.friction > 0)) return CHECK(!f.has("tangential_force") && !f.has("point"));
    constexpr std::size_t first = 21, points = 62;
    Vector number_of(points);
    std::iota(number_of.begin(), number_of.end(), 1);
    f.same("point", number_of);
    f.attribute("point", "first_loading", {1, first});
    f.attribute("point", "cycle", {first + 1, points});
    const double *E = t.c.solids.E, *nu = t.c.solids.nu, G1 = E[0] / (2 * (1 + nu[0])),
                 G2 = E[1] / (2 * (1 + nu[1]));
    const double m = 4 / ((2 - nu[0]) / G1 + (2 - nu[1]) / G2) / t.E, mu = t.c.solids.friction;
    double touch = -kInfinity;
    const Asperities& a = t.r[0].asperities;
    for (const auto i : indices(a)) touch = std::max(touch, a.z[i] + t.top(a.x[i], a.y[i]));
    const Vector xy = f.values("tangential_displacement"), forces = f.values("tangential_force");
    Vector xi, Q;
    for (std::size_t k = 0; k < xy.size(); k += 2) {
        xi.push_back(xy[k]);
        Q.push_back(forces[k]);
    }
    Vector stiffness, cross, slips;
    for (const std::size_t s : indices(t.steps)) {
        const Level& level = t.r[0].levels[s];
        const std::size_t begin = s * points, full = begin + first - 1;
        for (const std::size_t k : indices(points))  // along x
            CHECK(std::isnan(xi[begin + k]) ||
                  (xy[2 * (begin + k) + 1] == 0 && forces[2 * (begin + k) + 1] == 0));
        const bool touches = level.separation < touch;
        stiffness.push_back(touches ? -m * level.stiffness : kNone);
        cross.push_back(touches ? 0 : kNone);
        slips.push_back(touches ? mu / m * (touch - level.separation) : kNone);
        CHECK(std::isnan(xi[full]) != touches && std::isnan(Q[begin]) != touches);
        if (!touches) continue;
        CHECK_RELATIVE(xi[full], mu / m * (touch - level.separation), 1e-10);
        CHECK_RELATIVE(Q[full], mu * f.values("force")[s], 1e-5);
        CHECK_RELATIVE(xi[full + 1], 0.9 * xi[full], 1e-10);
        double work = 0;  // around the cycle, by the trapezoidal rule
        for (std::size_t k = full + 1; k + 1 < begin + points; ++k)
            work += 0.5 * (Q[k] + Q[k + 1]) * (xi[k + 1] - xi[k]);
        CHECK_RELATIVE(f.values("cycle_work")[s], work, 0.01);
    }
    for (const char* name :
         {"tangential_stiffness", "tangential_stiffness_xx", "tangential_stiffness_yy"})
        f.same(name, stiffness, 1e-9);
    f.same("tangential_stiffness_xy", cross);
    f.same("full_slip", slips, 1e-10);
    f.same("cycle", {1});
}

// A measured map: its parameters from its heights, what was done to it from the library's steps
// (test_measured).
inline void measured(CheckedFile& f, const Truth& t, const HeightMap* as_read) {
    if (!as_read) return CHECK(!f.has("sq") && !f.has("filled_points"));
    HeightMap map = as_read->copy();
    long missing = 0;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) missing += std::isnan(map(i, j));
    const auto& keys = t.c.surface;
    const Measured m = measure(map, {keys.missing, keys.detrend, keys.filter_cutoff});
    Grid g = t.heights[0];
    g.periodic = false;  // as it was measured
    const double points = number(g.z.size());
    f.same("filled_points", {double(missing)});
    f.attribute("filled_points", "share", {double(missing) / points}, kRounding);
    f.same("form_removed", {double(keys.detrend)});
    f.attribute("form_removed", "flag_values", {0, 1, 2, 3, 4});
    if (keys.detrend == Detrend::sphere) f.attribute("form_removed", "radius", {m.form.radius});
    f.same("filter_cutoff", {keys.filter_cutoff});
    f.same("map_stage", {1, 2, 3});
    f.attribute("map_stage", "flag_values", {1, 2, 3});
    const Moments4 last = g.differences();
    const Roughness end{std::sqrt(last.m0), std::sqrt(2 * last.m2), std::sqrt(last.m4)};
    const bool filtered = keys.filter_cutoff > 0;
    CHECK(filtered == (m.without_form.slope > 1.0001 * m.filtered.slope) &&
          m.as_read.height > 1.01 * m.without_form.height);
    const auto stages = [&](double Roughness::*what) {
        return Vector{m.as_read.*what, filtered ? m.without_form.*what : end.*what, end.*what};
    };
    f.same("stage_rms_height", stages(&Roughness::height), 1e-9);
    f.same("stage_rms_slope", stages(&Roughness::slope), 1e-9);
    f.same("stage_rms_curvature", stages(&Roughness::curvature), 1e-9);
    const double sq = std::sqrt(g.power(2));
    f.same("sq", {sq}, 1e-9);
    f.same("ssk", {g.power(3) / std::pow(sq, 3)}, 1e-7, 1e-9);
    f.same("sku", {g.power(4) / std::pow(sq, 4)}, 1e-9);
    f.same("sdq", {std::sqrt(2 * last.m2)}, 1e-9);
    // Mean square slopes in all directions.
    double low = 1e300, high = 0;
    for (const int k : indices(3600)) {
        const double c = std::cos(pi * k / 3600), s = std::sin(pi * k / 3600);
        static double xx, xy, yy;
        if (k == 0) {
            xx = xy = yy = 0;
            for (long j = 0; j + 1 < g.ny; ++j)
                for (long i = 0; i + 1 < g.nx; ++i) {
                    const double a = g.at_point(i, j), b = g.at_point(i + 1, j),
                                 d = g.at_point(i, j + 1);
                    const double e = g.at_point(i + 1, j + 1);
                    const double zx = (b + e - a - d) / (2 * g.dx),
                                 zy = (d + e - a - b) / (2 * g.dy);
                    xx += zx * zx;
                    xy += zx * zy;
                    yy += zy * zy;
                }
        }
        const double slope = xx * c * c + 2 * xy * c * s + yy * s * s;
        low = std::min(low, slope);
        high = std::max(high, slope);
    }
    f.same("isotropy_ratio", {std::sqrt(low / high)}, 1e-5);
    CHECK(m.fit.has_value());
    f.same("points_per_wave", {m.shortest_wave / std::max(g.dx, g.dy)}, kRounding);
    Vector middles, density(60);
    const double width = sq / 6, level = mean(g.z);
    for (const int b : indices(60)) middles.push_back((b - 29.5) * width);
    for (double z : g.z)
        for (std::size_t b = 0; b < 60; ++b)
            if (z - level >= middles[b] - width / 2 && z - level < middles[b] + width / 2)
                density[b] += 1 / (points * width);
    f.same("height_bin", middles, 1e-9);
    f.same("height_pdf", density, 1e-9);

    f.same("wavenumber", m.spectrum.wavenumber);
    f.same("psd", m.spectrum.psd);
    const SelfAffineFit& fit = *m.fit;
    f.same(
        "psd_fit",
        [&] {
            Vector v;
            // The mean over directions of the spectrum in wave vectors stretched along the lay.
            constexpr int angles = 180;
            for (double k : m.spectrum.wavenumber) {
                double sum = 0;
                for (const int a : indices(angles)) {
                    const double way = pi * (a + 0.5) / angles, g2 = fit.aspect;
                    const double q = k * std::sqrt(g2 * std::pow(std::cos(way), 2) +
                                                   std::pow(std::sin(way), 2) / g2);
                    const double line =
                        fit.Phi0.value * std::pow(q / fit.kl.value, -2 * (1 + fit.hurst.value));
                    sum += q > fit.ks.value * (1 + 1e-12) ? 0
                           : fit.kl_seen && q < fit.kl.value * (1 - 1e-12)
                               ? (fit.plateau ? fit.Phi0.value : 0)
                               : line;
                }
                v.push_back(sum / angles);
            }
            return v;
        }(),
        1e-9);
}

// The levels of &compare once more by elements. `path`: the separations through which elements that
// yield have to go before each.
inline void compared(CheckedFile& f, const Truth& t, const std::vector<Vector>& path) {
    const auto& keys = t.c.compare.levels;
    if (keys.empty()) return CHECK(!f.has("compare_step"));
    Surface surface;
    std::unique_ptr<Path> elements;
    double finer = 1;  // the grid of a made surface is refined on the way
    const auto refine = [&] {
        Case c = t.c;
        c.elements.points_per_wave *= finer;
        elements.reset();
        surface = make_element_surface(c, t.c.run.first_realization, 1);
        elements = make_element_contact(surface.map, t.job.indenter, t.job.solver);
    };
    refine();
    const Vector columns = f.values("compare_columns");
    Vector step, Z, N, A, pixels, n, residual, error_Z, error_N, error_A, error_n;
    Level last;
    Contacts2 c;
    const bool by_force = t.c.indentation.control == Control::force;
    const double unit = by_force ? 1 : t.sigma;
    for (std::size_t i = 0; i < std::max(keys.size(), path.size()); ++i) {
        std::size_t s = 0;
        if (path.empty()) {
            const auto off = [&](std::size_t k) {
                return std::abs((by_force ? t.r[0].levels[k].force : t.r[0].levels[k].separation) -
                                keys[i] * unit);
            };
            for (std::size_t k = 1; k < t.steps; ++k)
                if (off(k) < off(s)) s = k;
        } else {
            for (std::size_t k = 0; k + 1 < path[i].size(); ++k)
                elements->at_separation(path[i][k] * t.sigma);
            s = std::lround(path[i].back());
        }
        const Level& level = t.r[0].levels[s];
        while (surface.map.nx < columns.at(i)) {
            finer *= 2;
            refine();
        }
        CHECK(surface.map.nx == columns[i] && (finer == 1 || t.synthetic));
        last =
            by_force ? elements->at_force(level.force) : elements->at_separation(level.separation);
        c = of_pixels(last, surface.map.nx, surface.map.ny, t.periodic, t.c.solids.hardness);
        double force = 0, area = 0;
        for (const Spot2& p : c.spots) {
            force += p.f;
            area += p.area;
        }
        const double count = number(c.spots.size());
        step.push_back(number(s) + 1);
        Z.push_back(last.separation);
        N.push_back(force);
        A.push_back(area);
        pixels.push_back(number(c.pixels.size()) * c.pixel);
        n.push_back(count);
        residual.push_back(last.residual);
        error_Z.push_back(level.separation - last.separation);
        error_N.push_back(force > 0 ? f.values("force")[s] / force - 1 : kNone);
        error_A.push_back(area > 0 ? f.values("contact_area")[s] / area - 1 : kNone);
        error_n.push_back(count > 0 ? f.values("contacts")[s] / count - 1 : kNone);
    }
    f.same("compare_step", step);
    f.attribute("compare_step", "start_index", {1});
    f.same("compare_separation", Z);
    f.same("compare_force", N, kRounding);
    f.same("compare_contact_area", A, kRounding);
    f.same("compare_contact_area_pixels", pixels, kRounding);
    f.same("compare_contacts", n);
    f.same("compare_residual", residual);
    if (by_force)
        f.same("separation_error", error_Z, 0, 1e-12 * t.sigma);
    else
        f.same("force_error", error_N, 0, 1e-10);
    CHECK(f.has("force_error") == !by_force && f.has("separation_error") == by_force);
    f.same("area_error", error_A, 0, 1e-10);
    f.same("contacts_error", error_n, 0, 1e-12);
    Vector x, y, p;
    for (const Pixel2& q : c.pixels) {
        x.push_back(q.x);
        y.push_back(q.y);
        p.push_back(q.p);
    }
    f.same("compare_pixel_x", x, 0, 1e-12 * t.Lx);
    f.same("compare_pixel_y", y, 0, 1e-12 * t.Ly);
    f.same("compare_pixel_pressure", p);
    f.attribute("compare_pixel_x", "pixel_size", {surface.map.dx}, kRounding);
    f.attribute("compare_pixel_y", "pixel_size", {surface.map.dy}, kRounding);
}

}  // namespace values
