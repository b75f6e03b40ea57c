// What a case means, worked out from its text: the surface and its moments, the contacts of each
// level, E*, R*, the tip. The levels are the library's (problem/job.hpp).
#pragma once

#include "check.hpp"
#include "run/realize.hpp"
#include "truth/elimination.hpp"
#include "truth/values/checked_file.hpp"

namespace values {

using namespace rsc;

// sums of some hundred terms, and differences of few digits
inline constexpr double kRounding = 1e-11;

inline double sum(const Vector& v) {
    double s = 0;
    for (double x : v) s += x;
    return s;
}
inline double mean(const Vector& v) { return sum(v) / double(v.size()); }
inline double number(std::size_t n) { return double(n); }

// --- Surfaces

struct Moments4 {
    double m0 = kNone, m2 = kNone, m4 = kNone;
};

// Heights as a rectangle of points.
struct Grid {
    long nx = 0, ny = 0;
    double dx = 0, dy = 0, x0 = 0, y0 = 0;
    bool periodic = false;
    bool joined = false;  // differences across the border are those of the surface
    Vector z;
    double at_point(long i, long j) const { return z[(j + ny) % ny * nx + (i + nx) % nx]; }
    double x(long i) const { return x0 + dx * double(i); }
    double y(long j) const { return y0 + dy * double(j); }

    explicit Grid(const HeightMap& map)
        : nx(map.nx),
          ny(map.ny),
          dx(map.dx),
          dy(map.dy),
          x0(map.x0),
          y0(map.y0),
          periodic(map.periodic),
          joined(map.periodic) {
        for (const int j : indices(map.ny))
            for (const int i : indices(map.nx)) z.push_back(map(i, j));
    }
    double power(int p) const {
        const double level = mean(z);
        double s = 0;
        for (double h : z) s += std::pow(h - level, p);
        return s / number(z.size());
    }
    struct Second {
        double xx, yy, xy;  // xy by the four diagonal points
    };
    Second second(long i, long j) const {
        const double c = 2 * at_point(i, j);
        return {(at_point(i + 1, j) + at_point(i - 1, j) - c) / (dx * dx),
                (at_point(i, j + 1) + at_point(i, j - 1) - c) / (dy * dy),
                (at_point(i + 1, j + 1) - at_point(i - 1, j + 1) - at_point(i + 1, j - 1) +
                 at_point(i - 1, j - 1)) /
                    (4 * dx * dy)};
    }
    // <z_x^2 + z_y^2>/2 and (<z_xx^2> + <z_yy^2> + 3 <z_xy^2>)/3 of forward and second differences.
    Moments4 differences() const {
        double m2 = 0, m4 = 0, n = 0;
        for (long j = joined ? 0 : 1; j < ny - (joined ? 0 : 1); ++j)
            for (long i = joined ? 0 : 1; i < nx - (joined ? 0 : 1); ++i, ++n) {
                const double zx = (at_point(i + 1, j) - at_point(i, j)) / dx,
                             zy = (at_point(i, j + 1) - at_point(i, j)) / dy;
                const Second s = second(i, j);
                const double xy = (at_point(i + 1, j + 1) - at_point(i, j + 1) -
                                   at_point(i + 1, j) + at_point(i, j)) /
                                  (dx * dy);
                m2 += (zx * zx + zy * zy) / 2;
                m4 += (s.xx * s.xx + s.yy * s.yy + 3 * xy * xy) / 3;
            }
        return {power(2), m2 / n, m4 / n};
    }
    // The same from the Fourier modes of a periodic surface: exact.
    Moments4 modes() const {
        using Complex = std::complex<double>;
        const auto root = [](long k, long n) {
            return std::polar(1.0, -2 * pi * double(k % n) / double(n));
        };
        std::vector<Complex> rows(z.size()), wx(nx), wy(ny);
        for (const long k : indices(nx)) wx[k] = root(k, nx);
        for (const long k : indices(ny)) wy[k] = root(k, ny);
        for (const long j : indices(ny))
            for (long k = 0; k <= nx / 2; ++k)
                for (const long i : indices(nx)) rows[j * nx + k] += z[j * nx + i] * wx[i * k % nx];
        Moments4 m{0, 0, 0};
        for (long k = 0; k <= nx / 2; ++k)
            for (const long l : indices(ny)) {
                Complex h = 0;
                for (const long j : indices(ny)) h += rows[j * nx + k] * wy[j * l % ny];
                const double both = k == 0 || 2 * k == nx ? 1 : 2,
                             power = both * std::norm(h / number(z.size()));
                const double kx = 2 * pi * double(k) / (dx * double(nx));
                const double ky = 2 * pi * double(2 * l > ny ? l - ny : l) / (dy * double(ny));
                if (k == 0 && l == 0) continue;
                m.m0 += power;
                m.m2 += power * (kx * kx + ky * ky) / 2;
                m.m4 += power * (std::pow(kx, 4) + std::pow(ky, 4) + 3 * kx * kx * ky * ky) / 3;
            }
        return m;
    }
    // Points strictly above their eight neighbours.
    long maxima() const {
        long found = 0;
        for (long j = periodic ? 0 : 1; j < ny - (periodic ? 0 : 1); ++j)
            for (long i = periodic ? 0 : 1; i < nx - (periodic ? 0 : 1); ++i) {
                bool top = true;
                for (long b = -1; b <= 1; ++b)
                    for (long a = -1; a <= 1; ++a)
                        top =
                            top && ((a == 0 && b == 0) || at_point(i, j) > at_point(i + a, j + b));
                found += top;
            }
        return found;
    }
};

// Closed forms (THEORY.rst, Moments).
inline Moments4 closed_forms(const Case& c) {
    const auto& s = c.surface;
    const double L = s.L.value_or(1.0), kl = 2 * pi * s.L_lambda_l / L,
                 zeta = s.L_lambda_s / s.L_lambda_l;
    const double xi = 1 / s.L_lambda_l;
    const auto form = [&](double p, double T) {
        const double e = p - 2 * s.hurst,
                     flat = s.plateau ? (1 - std::pow(xi, p + 2)) / (p + 2) : 0;
        return T * std::pow(kl, p + 2) * (flat + (std::pow(zeta, e) - 1) / e);
    };
    const double sigma = s.sigma.value_or(0.01), Phi0 = sigma * sigma / form(0, 2 * pi);
    return {sigma * sigma, Phi0 * form(2, pi), Phi0 * form(4, 0.75 * pi)};
}

// --- Contacts

struct Spot2 {
    double x = 0, y = 0, f = 0, area = 0;
    std::int32_t index = 0;
    bool yields = false, cut = false;  // cut: with a pixel where the map ends
    double own = 0;                    // of the map: what spots before it do not cover
    double radius() const { return std::sqrt(area / pi); }
    double pressure() const { return f / area; }
};
struct Pixel2 {
    double x, y, p;
    std::int32_t contact;
};
struct Contacts2 {
    std::vector<Spot2> spots;
    std::vector<Pixel2> pixels;  // of elements
    double pixel = 0;            // their area
    double dx = 0, dy = 0;       // and sides
};

// Connected sets of pixels, with the areas of pixel_spots.hpp; numbered as the level numbers them.
inline Contacts2 of_pixels(const Level& level, long nx, long ny, bool periodic, double H) {
    const LevelPixels& q = level.pixels;
    Contacts2 out;
    out.pixel = q.dx * q.dy;
    out.dx = q.dx;
    out.dy = q.dy;
    std::vector<long> place(nx * ny, -1), own(q.index.size(), -1);
    for (const auto k : indices(q.index)) place[q.index[k]] = long(k);
    const auto neighbours = [&](std::size_t k) {
        std::vector<long> found;
        const long i = q.index[k] % nx, j = q.index[k] / nx;
        for (const auto& [a, b] : {std::pair{1L, 0L}, {-1L, 0L}, {0L, 1L}, {0L, -1L}}) {
            long u = i + a, v = j + b;
            if (periodic) {
                u = (u + nx) % nx;
                v = (v + ny) % ny;
            }
            if (u >= 0 && u < nx && v >= 0 && v < ny && place[v * nx + u] >= 0)
                found.push_back(place[v * nx + u]);
        }
        return found;
    };
    // Sides where the map itself ends: no border of the contact.
    const auto beyond = [&](std::size_t k) {
        const long i = q.index[k] % nx, j = q.index[k] / nx;
        return periodic ? 0.0 : double((i == 0) + (i == nx - 1) + (j == 0) + (j == ny - 1));
    };
    std::map<long, std::int32_t> library;  // my number to the level's
    long sets = 0;
    for (const auto first : indices(own)) {
        if (own[first] >= 0) continue;
        std::vector<std::size_t> open{first};
        own[first] = sets++;
        while (!open.empty()) {
            const std::size_t k = open.back();
            open.pop_back();
            for (const long l : neighbours(k))
                if (own[l] < 0) {
                    own[l] = own[first];
                    open.push_back(l);
                }
        }
    }
    struct Sum {
        double n = 0, hard = 0, sides = 0, px = 0, py = 0, peak = 0;
        long i = 0, j = 0;
    };
    std::vector<Sum> sums(sets);
    out.spots.resize(sets);
    for (const auto k : indices(own)) {
        const auto [there, fresh] = library.insert({own[k], q.contact[k]});
        CHECK(there->second == q.contact[k]);
        Sum& s = sums[q.contact[k]];
        const bool hard = q.pressure[k] >= H;
        s.n += 1;
        s.hard += hard;
        if (!hard) s.sides += 4 - number(neighbours(k).size()) - beyond(k);
        out.spots[q.contact[k]].cut = out.spots[q.contact[k]].cut || beyond(k) > 0;
        if (q.pressure[k] > s.peak) {
            s.peak = q.pressure[k];
            s.i = q.index[k] % nx;
            s.j = q.index[k] / nx;
        }
        out.spots[q.contact[k]].f += q.pressure[k] * out.pixel;
        out.spots[q.contact[k]].yields = out.spots[q.contact[k]].yields || hard;
        out.pixels.push_back({q.x0 + q.dx * double(q.index[k] % nx),
                              q.y0 + q.dy * double(q.index[k] / nx), q.pressure[k], q.contact[k]});
    }
    CHECK(long(library.size()) == sets);
    for (const auto k : indices(own)) {  // middles, from the peak
        Sum& s = sums[q.contact[k]];
        long a = q.index[k] % nx - s.i, b = q.index[k] / nx - s.j;
        if (periodic) a -= nx * std::lround(double(a) / double(nx));
        if (periodic) b -= ny * std::lround(double(b) / double(ny));
        s.px += q.pressure[k] * double(a);
        s.py += q.pressure[k] * double(b);
    }
    for (const auto c : indices(sums)) {
        const Sum& s = sums[c];
        Spot2& spot = out.spots[c];
        const double border =
            (pi - 1 + std::log(2.0)) / 24 * (1 + s.hard / s.n * (s.hard / s.n)) * s.sides;
        const double p = spot.f / out.pixel;
        spot.area = out.pixel * (s.n - border);
        double i = double(s.i) + s.px / p, j = double(s.j) + s.py / p;
        if (periodic) i -= double(nx) * std::floor(i / double(nx));
        if (periodic) j -= double(ny) * std::floor(j / double(ny));
        spot.x = q.x0 + q.dx * i;
        spot.y = q.y0 + q.dy * j;
    }
    return out;
}

// --- A case, and what it means

struct Truth {
    Case c;
    Job job;                           // the library's: its levels come of it
    std::vector<Realization> r;        // those levels
    std::vector<Grid> heights;         // of each realization; none: a list
    double x0 = 0, y0 = 0, Lx, Ly;     // the surface
    double E, R, tip_x, tip_y, sigma;  // sigma: what separations are divided by
    double spacing = 0;                // <d>; 0: not known
    bool periodic, elements, synthetic, list, hertz;
    Moments4 theory, regime;  // regime: what the regimes are drawn with
    double m2_made = kNone;   // what flats are compared with: of the surfaces made
    std::vector<std::vector<Contacts2>> contacts;
    std::size_t steps = 0, M = 0;

    explicit Truth(const Case& settings) : c(settings) {
        job = prepare(c);
        for (const int k : indices(c.run.realizations))
            r.push_back(realize(job, c.run.first_realization + k, 1));
        steps = r[0].levels.size();
        M = r.size();
        list = c.surface.source == Source::asperities;
        synthetic = has_spectrum(c);
        elements = by_elements(c);
        periodic = c.indentation.boundary == Boundary::periodic;
        hertz = !elements && c.asperities.law == LawKind::hertz;
        for (int k = 0; k < c.run.realizations && !list; ++k) {
            heights.emplace_back((elements ? make_element_surface(c, c.run.first_realization + k, 1)
                                           : make_surface(c, c.run.first_realization + k, 1))
                                     .map);
            heights.back().joined = synthetic;
        }
        Lx = Ly = c.surface.L.value_or(1.0);
        if (c.surface.source == Source::heights) {
            const Grid& g = heights[0];
            x0 = g.x0;
            y0 = g.y0;
            Lx = double(g.nx) * g.dx;
            Ly = double(g.ny) * g.dy;
        }
        E = 1 / ((1 - c.solids.nu[0] * c.solids.nu[0]) / c.solids.E[0] +
                 (1 - c.solids.nu[1] * c.solids.nu[1]) / c.solids.E[1]);
        R = 1 / (1 / c.solids.R[0] + 1 / c.solids.R[1]);
        // In the middle: of a map's points, of what was made.
        const bool map = c.surface.source == Source::heights;
        tip_x = c.indentation.centre[0].value_or(x0 + (Lx - (map ? heights[0].dx : 0)) / 2);
        tip_y = c.indentation.centre[1].value_or(y0 + (Ly - (map ? heights[0].dy : 0)) / 2);
        if (synthetic && c.surface.source == Source::synthetic) theory = closed_forms(c);
        if (c.surface.source == Source::spectrum)
            theory = {job.theory->m0, job.theory->m2, job.theory->m4};  // test_spectrum
        if (c.surface.sigma)
            sigma = *c.surface.sigma;
        else if (synthetic)
            sigma = c.surface.source == Source::spectrum ? std::sqrt(theory.m0) : 0.01;
        else
            sigma = list ? std::sqrt(variance(r[0].asperities.z)) : std::sqrt(heights[0].power(2));
        if (synthetic)
            spacing = 1 / std::sqrt(std::sqrt(3) * theory.m4 / (18 * pi * theory.m2));
        else if (!elements)
            spacing = std::sqrt(Lx * Ly / number(r[0].asperities.size()));
        if (synthetic) {
            regime = theory;
        } else if (!list) {
            regime = {0, 0, 0};
            for (const Grid& g : heights) {
                const Moments4 m = g.differences();
                regime.m0 += m.m0 / number(M);
                regime.m2 += m.m2 / number(M);
                regime.m4 += m.m4 / number(M);
            }
        }
        m2_made = regime.m2;
        if (synthetic && periodic) {
            m2_made = 0;
            for (const Grid& g : heights) m2_made += g.modes().m2 / number(M);
        }
        for (const std::size_t k : indices(M)) {
            contacts.emplace_back();
            for (const Level& l : r[k].levels) contacts.back().push_back(contacts_of(l, k));
        }
    }
    static double variance(const Vector& v) {
        double s = 0;
        for (double x : v) s += (x - mean(v)) * (x - mean(v)) / number(v.size());
        return s;
    }
    Contacts2 contacts_of(const Level& l, std::size_t k) const {
        if (elements)
            return of_pixels(l, heights[k].nx, heights[k].ny, periodic, c.solids.hardness);
        Contacts2 out;
        for (const auto i : indices(l.f)) {
            out.spots.push_back({l.x[i], l.y[i], l.f[i], pi * l.a[i] * l.a[i], l.asperity[i],
                                 !l.yields.empty() && l.yields[i] != 0});
            out.spots.back().own = l.own_area.empty() ? out.spots.back().area : l.own_area[i];
        }
        return out;
    }
    double top(double x, double y) const {  // height of the sphere, negative, above its tip's level
        const double rho2 = (x - tip_x) * (x - tip_x) + (y - tip_y) * (y - tip_y);
        double fall = 0;  // of both bodies
        for (const double one : c.solids.R)
            if (std::isfinite(one)) fall += one - std::sqrt(one * one - rho2);
        return -fall;
    }
    // The slope of the sum of both spheres at an offset from the tip, over this offset.
    double slope_over_offset(double rho2) const {
        double sum = 0;
        for (const double one : c.solids.R)
            if (std::isfinite(one)) sum += 1 / std::sqrt(one * one - rho2);
        return sum;
    }
    double distance(double x, double y, double u, double v) const {
        double a = x - u, b = y - v;
        if (periodic) {
            a -= Lx * std::round(a / Lx);
            b -= Ly * std::round(b / Ly);
        }
        return std::hypot(a, b);
    }
    // A value of every level, realization by realization.
    Vector rows(const std::function<double(std::size_t, std::size_t)>& of) const {
        Vector v;
        for (const std::size_t k : indices(M))
            for (const std::size_t s : indices(steps)) v.push_back(of(k, s));
        return v;
    }
    Vector each_step(const std::function<double(std::size_t)>& of) const {
        Vector v;
        for (const std::size_t s : indices(steps)) v.push_back(of(s));
        return v;
    }
    Vector each_surface(const std::function<double(std::size_t)>& of) const {
        Vector v;
        for (const std::size_t k : indices(M)) v.push_back(of(k));
        return v;
    }
    double hardness(std::int32_t i) const {
        return c.solids.hardness * std::sqrt(1 + c.solids.size_effect / r[0].asperities.radius[i]);
    }
};

}  // namespace values
