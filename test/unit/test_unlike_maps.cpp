// Maps in which everything differs from everything else (nx != ny, dx != dy, x0 != y0, heights without symmetry) against slow plain
// computations, and what transposing, mirroring and rescaling them must do to every number that comes out.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "check.hpp"
#include "error.hpp"
#include "rough/detection.hpp"
#include "rough/measured.hpp"
#include "rough/missing.hpp"

using namespace rsc;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-11;  // sums over some hundred points in another order

HeightMap blank(int nx, int ny, double dx, double dy) {
    HeightMap map;
    map.allocate(nx, ny, nx + 5);
    map.dx = dx, map.dy = dy, map.x0 = -1.3, map.y0 = 2.1;
    return map;
}

// Waves of many directions and noise on a form.
HeightMap rough(int nx, int ny, double dx = 0.3, double dy = 0.2, double noise = 0.2) {
    HeightMap map = blank(nx, ny, dx, dy);
    std::mt19937 random(7);
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            map.row(j)[i] = 3 + 0.05 * i - 0.03 * j + std::sin(0.9 * i + 0.4 * j) + 0.6 * std::cos(0.7 * i - 1.1 * j + 0.3) +
                            0.3 * std::sin(0.2 * i * 1.7 + 1.6 * j) + noise * (static_cast<double>(random()) / 4294967296.0 - 0.5);
    return map;
}

HeightMap like(const HeightMap& from, int nx, int ny, const std::function<double(int, int)>& height) {
    HeightMap map = blank(nx, ny, from.dx, from.dy);
    map.x0 = from.x0, map.y0 = from.y0, map.periodic = from.periodic;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) map.row(j)[i] = height(i, j);
    return map;
}

HeightMap transposed(const HeightMap& m) {
    HeightMap t = like(m, m.ny, m.nx, [&](int i, int j) { return m(j, i); });
    t.dx = m.dy, t.dy = m.dx, t.x0 = m.y0, t.y0 = m.x0;
    return t;
}

HeightMap mirrored(const HeightMap& m) {  // x -> -x
    HeightMap t = like(m, m.nx, m.ny, [&](int i, int j) { return m(m.nx - 1 - i, j); });
    t.x0 = -m.x0 - (m.nx - 1) * m.dx;
    return t;
}

HeightMap rescaled(const HeightMap& m, double lengths) {
    HeightMap t = like(m, m.nx, m.ny, [&](int i, int j) { return lengths * m(i, j); });
    t.dx *= lengths, t.dy *= lengths, t.x0 *= lengths, t.y0 *= lengths;
    return t;
}

HeightMap copy(const HeightMap& m) { return rescaled(m, 1); }

void moments() {
    for (const bool periodic : {false, true})
        for (const bool holes : {false, true}) {
            HeightMap map = rough(13, 9);
            map.periodic = periodic;
            if (holes) map.row(0)[3] = map.row(4)[7] = map.row(8)[12] = std::nan("");
            const auto z = [&](int i, int j) { return map((i + 13) % 13, (j + 9) % 9); };
            const auto mean = [&](int edge, const std::function<double(int, int)>& of) {
                double sum = 0, count = 0;
                for (int j = edge; j < 9 - edge; ++j)
                    for (int i = edge; i < 13 - edge; ++i)
                        if (const double v = of(i, j); !std::isnan(v)) sum += v, count += 1;
                return sum / count;
            };
            const int edge = periodic ? 0 : 1;
            const double level = mean(0, z), h = map.dx, k = map.dy;
            const Moments m = grid_moments(map);
            CHECK_RELATIVE(m.m0, mean(0, [&](int i, int j) { return std::pow(z(i, j) - level, 2); }), kRounding);
            CHECK_RELATIVE(m.m2,
                           0.5 * mean(edge,
                                      [&](int i, int j) {
                                          return std::pow((z(i + 1, j) - z(i, j)) / h, 2) + std::pow((z(i, j + 1) - z(i, j)) / k, 2);
                                      }),
                           kRounding);
            const double m40 = mean(edge, [&](int i, int j) { return std::pow((z(i + 1, j) + z(i - 1, j) - 2 * z(i, j)) / (h * h), 2); });
            const double m04 = mean(edge, [&](int i, int j) { return std::pow((z(i, j + 1) + z(i, j - 1) - 2 * z(i, j)) / (k * k), 2); });
            const double m22 =
                mean(edge, [&](int i, int j) { return std::pow((z(i + 1, j + 1) - z(i, j + 1) - (z(i + 1, j) - z(i, j))) / (h * k), 2); });
            CHECK_RELATIVE(m.m4, (m40 + m04 + 3 * m22) / 3, kRounding);
            const Roughness r = roughness(map);
            CHECK_RELATIVE(r.height, std::sqrt(m.m0), 1e-15);
            CHECK_RELATIVE(r.slope, std::sqrt(2 * m.m2), 1e-15);
            CHECK_RELATIVE(r.curvature, std::sqrt(m.m4), 1e-15);
        }
    // Differences need three points a side; two give the heights' own moment.
    for (const auto [nx, ny] : {std::array{2, 9}, {9, 2}}) {
        const Moments m = grid_moments(rough(nx, ny));
        CHECK(m.m0 > 0 && m.m2 == 0 && m.m4 == 0);
    }
    for (const auto [nx, ny] : {std::array{2, 9}, {9, 2}}) {
        HeightMap narrow = rough(nx, ny);
        narrow.periodic = true;
        CHECK(grid_moments(narrow).m2 == 0 && grid_moments(narrow).m4 == 0);
    }
    const HeightMap three = like(rough(3, 3), 3, 3, [](int i, int) { return i == 1 ? 1.0 : 0.0; });
    CHECK_RELATIVE(grid_moments(three).m2, 0.5 * std::pow(1 / 0.3, 2), 1e-13);
}

// Sq, Ssk, Sku, Sdq, the isotropy of slopes and the histogram of heights.
void heights(int nx, int ny) {
    HeightMap map = rough(nx, ny);
    const int points = nx * ny;
    double mean = 0, p2 = 0, p3 = 0, p4 = 0;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) mean += map(i, j) / points;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const double d = map(i, j) - mean;
            p2 += d * d / points, p3 += d * d * d / points, p4 += d * d * d * d / points;
        }
    const HeightParameters p = height_parameters(map);
    CHECK_RELATIVE(p.sq, std::sqrt(p2), kRounding);
    CHECK_RELATIVE(p.ssk, p3 / std::pow(p2, 1.5), 1e-10);
    CHECK_RELATIVE(p.sku, p4 / (p2 * p2), kRounding);
    CHECK_RELATIVE(p.sdq, std::sqrt(2 * grid_moments(map).m2), 1e-14);
    // The smallest and the largest rms slope over all directions, from gradients in the middle of each four points.
    const auto slope = [&](double angle) {
        double sum = 0;
        for (int j = 0; j < ny - 1; ++j)
            for (int i = 0; i < nx - 1; ++i) {
                const double zx = (map(i + 1, j) + map(i + 1, j + 1) - map(i, j) - map(i, j + 1)) / (2 * map.dx);
                const double zy = (map(i, j + 1) + map(i + 1, j + 1) - map(i, j) - map(i + 1, j)) / (2 * map.dy);
                sum += std::pow(std::cos(angle) * zx + std::sin(angle) * zy, 2);
            }
        return std::sqrt(sum);
    };
    double least = HUGE_VAL, most = 0;
    for (int k = 0; k < 2000; ++k) least = std::min(least, slope(kPi * k / 2000)), most = std::max(most, slope(kPi * k / 2000));
    CHECK(least < 0.9 * most);
    CHECK_RELATIVE(isotropy_ratio(map), least / most, 1e-5);  // directions in steps of 0.09 degrees
    // Bins from -5 to 5 Sq about the mean; what lies beyond, here one point, is left out.
    map.row(3)[4] += 40;
    const Measured m = measure(map, {Missing::refuse, Detrend::none, 0});
    mean += 40.0 / points;
    CHECK(m.height_pdf.size() == 60);
    CHECK_RELATIVE(m.height_bin, m.parameters.sq / 6, 1e-14);
    for (int b = 0; b < 60; ++b) {
        int inside = 0;
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                inside += map(i, j) - mean >= (b - 30) * m.height_bin && map(i, j) - mean < (b - 29) * m.height_bin;
        CHECK_CLOSE(m.height_pdf[static_cast<std::size_t>(b)], inside / (points * m.height_bin), 1e-12);
    }
}

// Every ring of the spectrum from a sum over all points for each mode.
void spectra() {
    for (const auto& [nx, ny, dx, dy] : {std::tuple{15, 22, 0.3, 0.2}, {18, 13, 0.1, 0.4}, {20, 12, 0.25, 0.25}})
        for (const bool periodic : {false, true}) {
            HeightMap map = rough(nx, ny, dx, dy);
            map.periodic = periodic;
            const auto w = [&](int i, int j) {
                return periodic ? 1.0 : std::pow(std::sin(kPi * (i + 0.5) / nx), 2) * std::pow(std::sin(kPi * (j + 0.5) / ny), 2);
            };
            double mean = 0, weight = 0, squares = 0;
            for (int j = 0; j < ny; ++j)
                for (int i = 0; i < nx; ++i) mean += w(i, j) * map(i, j), weight += w(i, j), squares += w(i, j) * w(i, j);
            mean /= weight;
            const double sx = 2 * kPi / (nx * dx), sy = 2 * kPi / (ny * dy), ring = std::min(sx, sy);
            std::vector<double> power(60, 0.0), modes(60, 0.0);
            for (int q = -((ny - 1) / 2); q <= ny / 2; ++q)
                for (int p = -((nx - 1) / 2); p <= nx / 2; ++p) {
                    std::complex<double> sum = 0;
                    for (int j = 0; j < ny; ++j)
                        for (int i = 0; i < nx; ++i)
                            sum += w(i, j) * (map(i, j) - mean) *
                                   std::polar(1.0, -2 * kPi * (static_cast<double>(p * i) / nx + static_cast<double>(q * j) / ny));
                    const auto r = static_cast<std::size_t>(std::lround(std::hypot(sx * p, sy * q) / ring));
                    if (r < power.size()) power[r] += std::norm(sum) / (nx * ny * squares * sx * sy), modes[r] += 1;
                }
            const MeasuredSpectrum s = measure_spectrum(map);
            std::size_t k = 0;
            const auto rings = static_cast<std::size_t>(std::lround(kPi / std::max(dx, dy) / ring));
            for (std::size_t r = 1; r <= rings; ++r) {
                if (modes[r] == 0) continue;
                CHECK(k < s.psd.size());
                if (k >= s.psd.size()) return;
                CHECK_RELATIVE(s.wavenumber[k], static_cast<double>(r) * ring, 1e-14);
                CHECK(s.modes[k] == modes[r]);
                CHECK_RELATIVE(s.psd[k], power[r] / modes[r], 1e-9);
                ++k;
            }
            CHECK(k == s.psd.size() && s.wavenumber.size() == k && s.modes.size() == k);
            CHECK(s.independent == (periodic ? 0.5 : 0.5 * 0.514 * 0.514) && s.coupled == (periodic ? 1 : 1 / 0.514));
        }
}

// The fit as its header states it, slowly: every cut is tried and each of its lines fitted from the points themselves.
class SlowFit {
public:
    struct Cut {
        std::size_t low, high;
        bool plateau;
    };
    struct Line {
        double height, slope, left, weight, mean, xx;
        double at(double x) const { return height + slope * (x - mean); }
    };
    explicit SlowFit(const MeasuredSpectrum& s) {
        double sum = 0;
        for (std::size_t i = 0; i < s.psd.size(); ++i) {
            const double m = s.independent * s.modes[i];
            x.push_back(std::log(s.wavenumber[i])), y.push_back(std::log(s.psd[i]) + 0.5 / m), w.push_back(m), sum += m;
            power.push_back(std::exp(x[i] + y[i]));
        }
        for (double& v : w) v *= static_cast<double>(w.size()) / sum;
    }
    std::size_t n() const { return x.size(); }
    Line line(std::size_t from, std::size_t to, std::size_t flat = 0, std::size_t corner = 0) const {
        Line l{};
        const auto place = [&](std::size_t i) { return x[i < flat ? corner : i]; };
        for (std::size_t i = from; i < to; ++i) l.weight += w[i], l.mean += w[i] * place(i), l.height += w[i] * y[i];
        if (l.weight > 0) l.mean /= l.weight, l.height /= l.weight;
        double xy = 0;
        for (std::size_t i = from; i < to; ++i)
            l.xx += w[i] * std::pow(place(i) - l.mean, 2), xy += w[i] * (place(i) - l.mean) * (y[i] - l.height);
        l.slope = l.xx > 1e-9 * l.weight ? xy / l.xx : 0;
        for (std::size_t i = from; i < to; ++i) l.left += w[i] * std::pow(y[i] - l.at(place(i)), 2);
        return l;
    }
    Line law(const Cut& c) const { return c.plateau ? line(0, c.high, c.low, c.low) : line(c.low, c.high); }
    std::array<double, 2> left(const Cut& c) const {
        Line all[3] = {law(c), {}, {}};
        if (!c.plateau && c.low > 2) all[1] = line(0, c.low - 2);
        if (c.high + 2 < n()) all[2] = line(c.high + 2, n());
        return {all[0].left + all[1].left + all[2].left, all[0].weight + all[1].weight + all[2].weight};
    }
    double cost(const Cut& c) const {
        const double slope = law(c).slope;
        double inside = 0, whole = 0;
        for (std::size_t i = 0; i < n(); ++i) whole += power[i], inside += i >= c.low && i < c.high ? power[i] : 0;
        if (slope < -5 || slope > -1 || inside < 0.01 * whole) return HUGE_VAL;
        const double parameters = 2 + (c.low > 0 ? c.plateau ? 1 : 3 : 0) + (c.high < n() ? 3 : 0);
        const auto l = left(c);
        return static_cast<double>(n()) * std::log(l[0] / l[1] + 1e-6) + 2 * parameters * std::log(static_cast<double>(n()));
    }
    Cut best() const {
        Cut best{0, n(), false};
        double least = HUGE_VAL;
        for (const bool plateau : {false, true})
            for (std::size_t low = plateau ? 1 : 0; low < n(); ++low)
                for (std::size_t high = low + 4; high <= n(); ++high)
                    if (const double c = cost({low, high, plateau}); c < least) least = c, best = {low, high, plateau};
        return best;
    }
    std::vector<double> x, y, w, power;
};

// Rings of a law with a plateau, a gap or nothing below ring `low`, a power law up to `high`, another beyond, all scattering by `scatter`.
MeasuredSpectrum rings(int n, int low, int high, double below, double hurst, double scatter, double unit) {
    MeasuredSpectrum s;
    s.independent = 0.21, s.coupled = 1.7;
    std::mt19937 random(3);
    for (int r = 1; r <= n; ++r) {
        const double noise = 1 + scatter * (static_cast<double>(random()) / 2147483648.0 - 1);
        const double k = r * unit, law = 3e-4 * std::pow(r / 10.0, -2 * (1 + hurst));
        s.wavenumber.push_back(k);
        s.modes.push_back(std::round(2 * kPi * r));
        s.psd.push_back(noise * (r < low     ? (below < 0 ? 3e-4 * std::pow(low / 10.0, -2 * (1 + hurst)) : below * law)
                                 : r <= high ? law
                                             : 1e-3 * law * std::pow(static_cast<double>(r) / high, 3)));
    }
    return s;
}

void fits() {
    bool seen[2][2] = {};
    for (const auto& [low, high, below, hurst, scatter] : {std::tuple{0, 70, 0.0, 0.6, 0.2},
                                                           {12, 70, -1.0, 0.8, 0.1},
                                                           {9, 45, -1.0, 0.3, 0.3},
                                                           {8, 50, 0.01, 0.9, 0.2},
                                                           {0, 40, 0.0, 0.5, 0.4}}) {
        const double unit = 0.37;
        const MeasuredSpectrum s = rings(70, low, high, below, hurst, scatter, unit);
        const SelfAffineFit fit = fit_self_affine(s);
        const SlowFit slow(s);
        const SlowFit::Cut best = slow.best();
        const std::size_t n = slow.n();
        seen[best.plateau][best.high < n] = true;
        CHECK(fit.plateau == best.plateau && fit.ks_seen == (best.high < n));
        CHECK_RELATIVE(fit.kl.value, s.wavenumber[best.low], 1e-14);
        SlowFit::Cut inner = best;  // without the rings at the breaks
        if (best.high < n) --inner.high;
        if (best.low > 0 && !best.plateau) ++inner.low;
        const SlowFit::Line line = slow.law(inner);
        const double rings_used = static_cast<double>(best.high - (best.plateau ? 0 : best.low));
        const double variance = s.coupled * std::max(line.left / (rings_used - 2), 1e-6);
        CHECK_RELATIVE(fit.hurst.value, -0.5 * line.slope - 1, 1e-9);
        CHECK_RELATIVE(fit.hurst.error, 0.5 * std::sqrt(variance / line.xx), 1e-7);
        const double xl = std::log(fit.kl.value);
        CHECK_RELATIVE(fit.Phi0.value, std::exp(line.at(xl)), 1e-9);
        CHECK_RELATIVE(fit.Phi0.error, fit.Phi0.value * std::sqrt(variance * (1 / line.weight + std::pow(xl - line.mean, 2) / line.xx)),
                       1e-6);
        // ks: where the heights, straight between rings, fall to half of the line; the last ring that has half is near the break.
        double ks = s.wavenumber[n - 1];
        const auto share = [&](std::size_t i) { return std::exp(slow.y[i] - line.at(slow.x[i])); };
        if (best.high < n) {
            std::size_t last = best.high - 1;
            while (last < std::min(n - 1, best.high + 3) && share(last + 1) > 0.5) ++last;
            while (share(last) <= 0.5) --last;
            ks = s.wavenumber[last] + unit * (share(last) - 0.5) / (share(last) - share(last + 1));
        }
        CHECK_RELATIVE(fit.ks.value, ks, 1e-9);
        // How far the breaks may move.
        const double limit = slow.left(best)[0] + variance;
        const auto moves = [&](bool lower) {
            std::size_t at[2] = {lower ? best.low : best.high, lower ? best.low : best.high};
            for (const int way : {-1, 1})
                for (;;) {
                    std::size_t& end = at[way > 0];
                    const std::size_t to = end + static_cast<std::size_t>(way);
                    SlowFit::Cut c = best;
                    (lower ? c.low : c.high) = to;
                    if ((way < 0 && end == 0) || c.low + 4 > c.high || c.high > n || slow.left(c)[0] > limit) break;
                    end = to;
                }
            const double width = s.wavenumber[std::min(at[1], n - 1)] - s.wavenumber[std::min(at[0], n - 1)];
            return std::max(0.5 * width, 0.5 * unit / std::sqrt(3.0));
        };
        CHECK_RELATIVE(fit.kl.error, best.low == 0 ? 0.5 * unit : moves(true), 1e-12);
        CHECK_RELATIVE(fit.ks.error, best.high < n ? moves(false) : 0.5 * unit, 1e-12);
        // What it is a fit of.
        CHECK(fit(0.99 * fit.kl.value) == (fit.plateau ? fit.Phi0.value : 0) && fit(1.01 * fit.ks.value) == 0);
        CHECK(fit(fit.ks.value) > 0);
        CHECK_RELATIVE(fit(1.5 * fit.kl.value), fit.Phi0.value * std::pow(1.5, -2 * (1 + fit.hurst.value)), 1e-12);
    }
    CHECK(seen[0][0] && seen[0][1] && seen[1][0] && seen[1][1]);
    // Eight rings are enough, seven are not, and rings without power are none.
    MeasuredSpectrum few = rings(8, 0, 8, 0, 0.5, 0.1, 1);
    CHECK(can_fit(few));
    CHECK(fit_self_affine(few).hurst.error > 0);
    few.psd[5] = 0;
    CHECK(!can_fit(few));
    CHECK_THROWS(fit_self_affine(few), Error);
}

// Every number of a measured map, with what a transposition swaps and a change of lengths scales.
struct Value {
    double value;
    int power;             // of length
    bool forward = false;  // from forward differences, which a mirror makes backward ones
};

std::vector<Value> everything(const Measured& m, bool transpose = false) {
    std::vector<Value> v;
    const auto two = [&](double x, double y, int power) {
        v.push_back({transpose ? y : x, power}), v.push_back({transpose ? x : y, power});
    };
    const auto one = [&](double x, int power) { v.push_back({x, power}); };
    two(m.nx, m.ny, 0), two(m.dx, m.dy, 1), one(static_cast<double>(m.missing), 0), one(m.missing_share, 0);
    one(m.form.level, 1), two(m.form.slope_x, m.form.slope_y, 0), two(m.form.zxx, m.form.zyy, -1), one(m.form.zxy, -1);
    one(m.form.radius, 1), one(m.form.rms, 1), one(m.filter_cutoff, 1);
    for (const Roughness& r : {m.as_read, m.without_form, m.filtered}) {
        one(r.height, 1);
        v.push_back({r.slope, 0, true}), v.push_back({r.curvature, -1, true});
    }
    one(m.parameters.sq, 1), one(m.parameters.ssk, 0), one(m.parameters.sku, 0), one(m.isotropy, 0);
    v.push_back({m.parameters.sdq, 0, true});
    one(m.height_bin, 1), one(m.shortest_wave(), 1), one(m.points_per_wave(), 0);
    for (std::size_t k = 0; k < m.spectrum.psd.size(); ++k)
        one(m.spectrum.wavenumber[k], -1), one(m.spectrum.psd[k], 4), one(m.spectrum.modes[k], 0);
    CHECK(m.fit.has_value());
    if (m.fit) {
        one(m.fit->hurst.value, 0), one(m.fit->hurst.error, 0), one(m.fit->Phi0.value, 4), one(m.fit->Phi0.error, 4);
        one(m.fit->kl.value, -1), one(m.fit->kl.error, -1), one(m.fit->ks.value, -1), one(m.fit->ks.error, -1);
        one(m.fit->plateau, 0), one(m.fit->ks_seen, 0);
    }
    return v;
}

void symmetries() {
    for (const Detrend how : {Detrend::none, Detrend::mean, Detrend::plane, Detrend::quadratic, Detrend::sphere})
        for (const double cutoff : {0.0, 1.1}) {
            HeightMap bent = rough(41, 30);
            for (int j = 0; j < 30; ++j)
                for (int i = 0; i < 41; ++i) bent.row(j)[i] -= 0.02 * (0.09 * std::pow(i - 15, 2) + 0.04 * std::pow(j - 20, 2));
            bent.row(3)[20] = bent.row(3)[21] = bent.row(17)[5] = bent.row(29)[40] = std::nan("");
            HeightMap map = copy(bent), turned = transposed(bent), mirror = mirrored(bent), large = rescaled(bent, 1000);
            const auto measured = [&](HeightMap& of, double scale) { return measure(of, {Missing::fill, how, scale * cutoff}); };
            const Measured m = measured(map, 1), t = measured(turned, 1), r = measured(mirror, 1), l = measured(large, 1000);
            const std::vector<Value> a = everything(m), b = everything(t, true), d = everything(l);
            std::vector<Value> c = everything(r);
            constexpr std::size_t kSlopeX = 7, kZxy = 11;
            CHECK(c[kSlopeX].value == r.form.slope_x && c[kZxy].value == r.form.zxy);
            c[kSlopeX].value = -c[kSlopeX].value, c[kZxy].value = -c[kZxy].value;
            CHECK(a.size() == b.size() && a.size() == c.size() && a.size() == d.size());
            for (std::size_t k = 0; k < std::min({a.size(), b.size(), c.size(), d.size()}); ++k) {
                const double size = std::abs(a[k].value) + 1e-6 * (a[k].power == 4 ? m.spectrum.psd[0] : 1);
                CHECK_CLOSE(b[k].value, a[k].value, 1e-7 * size);
                CHECK_CLOSE(c[k].value, a[k].value, (c[k].forward ? 1e-2 : 1e-7) * size);
                CHECK_CLOSE(d[k].value * std::pow(1000.0, -a[k].power), a[k].value, 1e-7 * size);
            }
            double worst = 0;
            for (int j = 0; j < 30; ++j)
                for (int i = 0; i < 41; ++i)
                    worst = check::worse(worst, {std::abs(turned(j, i) - map(i, j)), std::abs(mirror(40 - i, j) - map(i, j)),
                                                 std::abs(1e-3 * large(i, j) - map(i, j))});
            CHECK_CLOSE(worst, 0, 1e-9);
            CHECK(m.filter_cutoff == cutoff && m.form.how == how);
            CHECK_RELATIVE(m.missing_share, 4.0 / (41 * 30), 1e-14);
            CHECK(m.missing == 4 && m.filled.size() == 41 * 30 && std::count(m.filled.begin(), m.filled.end(), 1) == 4);
            CHECK(m.filled[3 * 41 + 21] == 1 && m.filled[29 * 41 + 40] == 1);
        }
}

void filled_points(int nx, int ny) {
    const HeightMap map = rough(nx, ny);
    std::mt19937 random(5);
    const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0; };
    std::vector<std::uint8_t> filled(static_cast<std::size_t>(nx * ny), 0);
    for (int k = 0; k < 9; ++k) filled[random() % filled.size()] = 1;
    filled[static_cast<std::size_t>(5 * nx)] = filled[static_cast<std::size_t>(9 * nx - 1)] = 1;  // at the ends of rows
    for (const bool biharmonic : {false, true})
        for (const double distance : {0.15, 0.5, 1.3}) {
            Asperities a;
            for (int k = 0; k < 400; ++k) {  // on grid points, where distances are exact
                a.x.push_back(map.x0 + map.dx * static_cast<double>(random() % static_cast<unsigned>(nx))),
                    a.y.push_back(map.y0 + map.dy * static_cast<double>(random() % static_cast<unsigned>(ny)));
                a.z.push_back(uniform()), a.kappa2.push_back(0.1 + uniform()), a.kappa1.push_back(a.kappa2.back() + uniform());
                a.radius.push_back(uniform()), a.angle.push_back(uniform());
                if (biharmonic) a.biharmonic.push_back(uniform());
            }
            const Asperities all = a;
            SummitCount count{400, 17, 3, 0, 0};
            drop_near_filled(a, count, map, filled, distance);
            std::vector<std::size_t> kept;
            double g = 0, mean = 0;
            for (std::size_t k = 0; k < 400; ++k) {
                double nearest = HUGE_VAL;
                for (int j = 0; j < ny; ++j)
                    for (int i = 0; i < nx; ++i)
                        if (filled[static_cast<std::size_t>(j * nx + i)])
                            nearest = std::min(nearest, std::hypot(map.x0 + i * map.dx - all.x[k], map.y0 + j * map.dy - all.y[k]));
                if (nearest < distance - 1e-9) continue;
                kept.push_back(k);
                g += std::sqrt(all.kappa1[k] * all.kappa2[k]), mean += 0.5 * (all.kappa1[k] + all.kappa2[k]);
            }
            CHECK(a.size() == kept.size() && !kept.empty() && kept.size() < 400);
            bool same = a.size() == kept.size();
            for (const AsperityColumn& column : kAsperityColumns) {
                const auto &now = a.*column.values, &before = all.*column.values;
                CHECK(now.size() == (before.empty() ? 0 : kept.size()));
                for (std::size_t k = 0; same && k < now.size(); ++k) same = now[k] == before[kept[k]];
            }
            CHECK(same);
            const auto n = static_cast<double>(kept.size());
            CHECK(count.summits == static_cast<long>(kept.size()) && count.saddles == 17 && count.repeated == 3);
            CHECK_RELATIVE(count.mean_kappa_g, g / n, kRounding);
            CHECK_RELATIVE(count.mean_kappa_a, mean / n, kRounding);
        }
}

// What is refused just beyond its bound, and not at it; what is said of a flat map.
void bounds() {
    for (const bool wide : {false, true})
        for (const double ratio : {0.9999e4, 1.0001e4}) {
            HeightMap map = rough(21, 14);
            (wide ? map.dx : map.dy) = ratio * (wide ? map.dy : map.dx);
            if (ratio < 1e4)
                CHECK(measure(map, {}).nx == 21);
            else
                CHECK_THROWS(measure(map, {}), Error);
        }
    HeightMap flat = like(rough(21, 14), 21, 14, [](int, int) { return 0.25; });
    CHECK(isotropy_ratio(flat) == 1);
    const Measured m = measure(flat, {Missing::refuse, Detrend::none, 0});
    CHECK(m.isotropy == 1 && m.parameters.sq == 0 && m.height_bin == 0 && !m.fit && m.height_pdf == std::vector<double>(60, 0.0));
    CHECK(m.shortest_wave() == 2 * 0.3 && m.points_per_wave() == 2);
    // All points missing, all but one.
    for (const Missing how : {Missing::refuse, Missing::fill}) {
        HeightMap none = like(flat, 21, 14, [](int, int) { return std::nan(""); });
        CHECK_THROWS(measure(none, {how, Detrend::none, 0}), Error);
        HeightMap one = like(flat, 21, 14, [](int i, int j) { return i == 3 && j == 4 ? 0.5 : std::nan(""); });
        if (how == Missing::refuse) {
            CHECK_THROWS(measure(one, {how, Detrend::none, 0}), Error);
        } else {
            CHECK(measure(one, {how, Detrend::none, 0}).missing == 21 * 14 - 1);
            for (int j = 0; j < 14; ++j)
                for (int i = 0; i < 21; ++i) CHECK_CLOSE(one(i, j), 0.5, 1e-12);
        }
    }
    // The first missing point by its place, wherever it is.
    for (const auto& [nx, ny] : {std::pair{21, 14}, {14, 21}}) {
        HeightMap torn = rough(nx, ny);
        torn.row(ny - 2)[nx - 3] = torn.row(ny - 1)[1] = std::nan("");
        try {
            measure(torn, {});
            CHECK(!"refused");
        } catch (const Error& e) {
            CHECK(std::string(e.what()) == "2 of 294 points are missing, the first in column " + std::to_string(nx - 3) + " of row " +
                                               std::to_string(ny - 2) +
                                               ", counted from 0 with y upwards; surface%missing = 'fill' fills them");
        }
    }
    HeightMap map;
    map.allocate(1, 1, 1);
    map.allocate(3, 2, 3);
    CHECK(map.nx == 3 && map.ny == 2 && map.stride == 3);
    CHECK_THROWS(map.allocate(0, 1, 1), Error);
    CHECK_THROWS(map.allocate(1, 0, 1), Error);
    CHECK_THROWS(map.allocate(3, 2, 2), Error);
}

// Maps that end: what is found beside their borders is the same however the map is turned. Coarse, so that summits are far from where
// they are looked for.
void borders() {
    long summits = 0, beside[4] = {};
    for (unsigned seed = 1; seed <= 30; ++seed) {
        std::mt19937 random(seed);
        const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0; };
        const int nx = 44, ny = 25;
        HeightMap map = blank(nx, ny, 0.3, 0.2);
        std::vector<std::array<double, 4>> waves;
        for (int k = 0; k < 40; ++k) waves.push_back({3.4 * uniform() - 1.7, 3.4 * uniform() - 1.7, uniform(), 2 * kPi * uniform()});
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                map.row(j)[i] = 0;
                for (const auto& [p, q, height, phase] : waves) map.row(j)[i] += height * std::cos(p * i + q * j + phase);
            }
        const auto found = [](const HeightMap& m, SummitCount& count) {
            return find_asperities(m, Curvature::geometric, &count, 1, Detail::subgrid);
        };
        SummitCount one, two, three;
        const Asperities a = found(map, one), t = found(transposed(map), two), m = found(mirrored(map), three);
        CHECK(a.size() == t.size() && a.size() == m.size() && one.saddles == two.saddles && one.saddles == three.saddles);
        CHECK(one.repeated == two.repeated && one.repeated == three.repeated);
        for (std::size_t k = 0; k < a.size(); ++k) {
            double in_t = HUGE_VAL, in_m = HUGE_VAL;
            for (std::size_t l = 0; l < t.size(); ++l) in_t = std::min(in_t, std::hypot(t.x[l] - a.y[k], t.y[l] - a.x[k]));
            for (std::size_t l = 0; l < m.size(); ++l) in_m = std::min(in_m, std::hypot(m.x[l] + a.x[k], m.y[l] - a.y[k]));
            CHECK_CLOSE(in_t, 0, 1e-6);
            CHECK_CLOSE(in_m, 0, 1e-6);
            // The stencil of the point nearest to a summit lies in the map.
            const double u = (a.x[k] - map.x0) / map.dx, v = (a.y[k] - map.y0) / map.dy;
            const long i = std::lround(u), j = std::lround(v);
            CHECK(i >= kMeasuredReach && j >= kMeasuredReach && i < nx - kMeasuredReach && j < ny - kMeasuredReach);
            beside[0] += i == kMeasuredReach, beside[1] += i == nx - 1 - kMeasuredReach;
            beside[2] += j == kMeasuredReach, beside[3] += j == ny - 1 - kMeasuredReach;
        }
        summits += one.summits;
    }
    std::printf("borders: %ld summits, %ld %ld %ld %ld beside them\n", summits, beside[0], beside[1], beside[2], beside[3]);
    for (const long n : beside) CHECK(n > 5);
}

}  // namespace

TESTS {
    moments();
    heights(21, 14);
    heights(14, 21);
    spectra();
    fits();
    symmetries();
    filled_points(31, 22);
    filled_points(22, 31);
    bounds();
    borders();
}
