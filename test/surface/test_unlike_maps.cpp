// Maps in which everything differs from everything else (nx != ny, dx != dy, x0 != y0, heights
// without symmetry) against slow plain computations, and what transposing, mirroring and rescaling
// them must do to every number that comes out.
#include "check.hpp"
#include "support/height_maps.hpp"
#include "surface/defects.hpp"
#include "surface/detection.hpp"
#include "surface/measured.hpp"

namespace test_unlike_maps {

using namespace rsc;
constexpr double kRounding = 1e-11;  // sums over some hundred points in another order

// Waves of many directions and noise on a form.
HeightMap rough(int nx, int ny, double dx = 0.3, double dy = 0.2, double noise = 0.2) {
    std::mt19937 random(7);
    HeightMap map = height_map(nx, ny, dx, dy, [&](int i, int j) {
        return 3 + 0.05 * i - 0.03 * j + std::sin(0.9 * i + 0.4 * j) +
               0.6 * std::cos(0.7 * i - 1.1 * j + 0.3) + 0.3 * std::sin(0.2 * i * 1.7 + 1.6 * j) +
               noise * (static_cast<double>(random()) / 4294967296.0 - 0.5);
    });
    map.x0 = -1.3;
    map.y0 = 2.1;
    return map;
}

HeightMap like(const HeightMap& from, int nx, int ny,
               const std::function<double(int, int)>& height) {
    HeightMap map = height_map(nx, ny, from.dx, from.dy, height);
    map.x0 = from.x0;
    map.y0 = from.y0;
    map.periodic = from.periodic;
    return map;
}

HeightMap transposed(const HeightMap& m) {
    HeightMap t = like(m, m.ny, m.nx, [&](int i, int j) { return m(j, i); });
    t.dx = m.dy;
    t.dy = m.dx;
    t.x0 = m.y0;
    t.y0 = m.x0;
    return t;
}

HeightMap mirrored(const HeightMap& m) {  // x -> -x
    HeightMap t = like(m, m.nx, m.ny, [&](int i, int j) { return m(m.nx - 1 - i, j); });
    t.x0 = -m.x0 - (m.nx - 1) * m.dx;
    return t;
}

HeightMap rescaled(const HeightMap& m, double lengths) {
    HeightMap t = like(m, m.nx, m.ny, [&](int i, int j) { return lengths * m(i, j); });
    t.dx *= lengths;
    t.dy *= lengths;
    t.x0 *= lengths;
    t.y0 *= lengths;
    return t;
}

HeightMap copy(const HeightMap& m) { return rescaled(m, 1); }

// Every ring of the spectrum from a sum over all points for each mode.
TEST(spectra) {
    for (const auto& [nx, ny, dx, dy] :
         {std::tuple{15, 22, 0.3, 0.2}, {18, 13, 0.1, 0.4}, {20, 12, 0.25, 0.25}})
        for (const bool periodic : {false, true}) {
            HeightMap map = rough(nx, ny, dx, dy);
            map.periodic = periodic;
            const auto w = [&](int i, int j) {
                return periodic ? 1.0
                                : std::pow(std::sin(pi * (i + 0.5) / nx), 2) *
                                      std::pow(std::sin(pi * (j + 0.5) / ny), 2);
            };
            double mean = 0, weight = 0, squares = 0;
            for (int j = 0; j < ny; ++j)
                for (int i = 0; i < nx; ++i) {
                    mean += w(i, j) * map(i, j);
                    weight += w(i, j);
                    squares += w(i, j) * w(i, j);
                }
            mean /= weight;
            const double sx = 2 * pi / (nx * dx), sy = 2 * pi / (ny * dy), ring = std::min(sx, sy);
            std::vector<double> power(60, 0.0), modes(60, 0.0);
            for (int q = -((ny - 1) / 2); q <= ny / 2; ++q)
                for (int p = -((nx - 1) / 2); p <= nx / 2; ++p) {
                    std::complex<double> sum = 0;
                    for (int j = 0; j < ny; ++j)
                        for (int i = 0; i < nx; ++i)
                            sum += w(i, j) * (map(i, j) - mean) *
                                   std::polar(1.0, -2 * pi *
                                                       (static_cast<double>(p * i) / nx +
                                                        static_cast<double>(q * j) / ny));
                    const std::size_t r = std::lround(std::hypot(sx * p, sy * q) / ring);
                    if (r < power.size()) {
                        power[r] += std::norm(sum) / (nx * ny * squares * sx * sy);
                        modes[r] += 1;
                    }
                }
            const MeasuredSpectrum s = measure_spectrum(map);
            std::size_t k = 0;
            const std::size_t rings = std::lround(pi / std::max(dx, dy) / ring);
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
            CHECK(s.independent == (periodic ? 0.5 : 0.5 * 0.514 * 0.514) &&
                  s.coupled == (periodic ? 1 : 1 / 0.514));
        }
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
        v.push_back({transpose ? y : x, power});
        v.push_back({transpose ? x : y, power});
    };
    const auto one = [&](double x, int power) { v.push_back({x, power}); };
    two(m.nx, m.ny, 0);
    two(m.dx, m.dy, 1);
    one(static_cast<double>(m.missing), 0);
    one(m.missing_share, 0);
    one(m.form.level, 1);
    two(m.form.slope_x, m.form.slope_y, 0);
    two(m.form.zxx, m.form.zyy, -1);
    one(m.form.zxy, -1);
    one(m.form.radius, 1);
    one(m.form.rms, 1);
    one(m.filter_cutoff, 1);
    for (const Roughness& r : {m.as_read, m.without_form, m.filtered}) {
        one(r.height, 1);
        v.push_back({r.slope, 0, true});
        v.push_back({r.curvature, -1, true});
    }
    one(m.parameters.sq, 1);
    one(m.parameters.ssk, 0);
    one(m.parameters.sku, 0);
    one(m.isotropy, 0);
    v.push_back({m.parameters.sdq, 0, true});
    one(m.height_bin, 1);
    one(m.shortest_wave, 1);
    one(m.points_per_wave(), 0);
    for (std::size_t k = 0; k < m.spectrum.psd.size(); ++k) {
        one(m.spectrum.wavenumber[k], -1);
        one(m.spectrum.psd[k], 4);
        one(m.spectrum.modes[k], 0);
    }
    CHECK(m.fit.has_value());
    if (m.fit) {
        one(m.fit->hurst.value, 0);
        one(m.fit->hurst.error, 0);
        one(m.fit->Phi0.value, 4);
        one(m.fit->Phi0.error, 4);
        one(m.fit->kl.value, -1);
        one(m.fit->kl.error, -1);
        one(m.fit->ks.value, -1);
        one(m.fit->ks.error, -1);
        one(m.fit->plateau, 0);
        one(m.fit->ks_seen, 0);
        one(m.fit->kl_seen, 0);
        one(m.fit->plateau_seen, 0);
    }
    return v;
}

TEST(symmetries) {
    for (const Detrend how :
         {Detrend::none, Detrend::mean, Detrend::plane, Detrend::quadratic, Detrend::sphere})
        for (const double cutoff : {0.0, 1.1}) {
            HeightMap bent = rough(41, 30);
            for (int j = 0; j < 30; ++j)
                for (int i = 0; i < 41; ++i)
                    bent.row(j)[i] -=
                        0.02 * (0.09 * std::pow(i - 15, 2) + 0.04 * std::pow(j - 20, 2));
            bent.row(3)[20] = bent.row(3)[21] = bent.row(17)[5] = bent.row(29)[40] = std::nan("");
            HeightMap map = copy(bent), turned = transposed(bent), mirror = mirrored(bent),
                      large = rescaled(bent, 1000);
            const auto measured = [&](HeightMap& of, double scale) {
                return measure(of, {Missing::fill, how, scale * cutoff});
            };
            const Measured m = measured(map, 1), t = measured(turned, 1), r = measured(mirror, 1),
                           l = measured(large, 1000);
            const std::vector<Value> a = everything(m), b = everything(t, true), d = everything(l);
            std::vector<Value> c = everything(r);
            constexpr std::size_t kSlopeX = 7, kZxy = 11;
            CHECK(c[kSlopeX].value == r.form.slope_x && c[kZxy].value == r.form.zxy);
            c[kSlopeX].value = -c[kSlopeX].value;
            c[kZxy].value = -c[kZxy].value;
            CHECK(a.size() == b.size() && a.size() == c.size() && a.size() == d.size());
            for (std::size_t k = 0; k < std::min({a.size(), b.size(), c.size(), d.size()}); ++k) {
                const double size =
                    std::abs(a[k].value) + 1e-6 * (a[k].power == 4 ? m.spectrum.psd[0] : 1);
                CHECK_CLOSE(b[k].value, a[k].value, 1e-7 * size);
                CHECK_CLOSE(c[k].value, a[k].value, (c[k].forward ? 1e-2 : 1e-7) * size);
                CHECK_CLOSE(d[k].value * std::pow(1000.0, -a[k].power), a[k].value, 1e-7 * size);
            }
            double worst = 0;
            for (int j = 0; j < 30; ++j)
                for (int i = 0; i < 41; ++i)
                    worst = check::worse(worst, {std::abs(turned(j, i) - map(i, j)),
                                                 std::abs(mirror(40 - i, j) - map(i, j)),
                                                 std::abs(1e-3 * large(i, j) - map(i, j))});
            CHECK_CLOSE(worst, 0, 1e-9);
            CHECK(m.filter_cutoff == cutoff && m.form.how == how);
            CHECK_RELATIVE(m.missing_share, 4.0 / (41 * 30), 1e-14);
            CHECK(m.missing == 4 && m.filled.empty());
        }
}

// Points by their distance to the nearest measured one, which the mask counts in steps along rows
// and columns.
void depths(int nx, int ny) {
    const auto at = [nx](int i, int j) { return j * nx + i; };
    std::vector<std::uint8_t> hole(at(0, ny), 0);
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            hole[at(i, j)] = std::hypot(i - 3, j - 9) < 6.5 || (i > 20 && j % 5 > 0);
    for (const int steps : {0, 1, 2, 3, 40}) {
        std::vector<std::uint8_t> kept = hole;
        keep_depths(kept, nx, ny, steps);
        long wrong = 0, deep = 0;
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                int nearest = nx + ny;
                for (int k = 0; k < ny; ++k)
                    for (int h = 0; h < nx; ++h)
                        if (!hole[at(h, k)])
                            nearest = std::min(nearest, std::abs(h - i) + std::abs(k - j));
                deep += nearest > steps;
                wrong += !kept.empty() && (kept[at(i, j)] == 1) != (nearest > steps);
            }
        CHECK(wrong == 0 && kept.empty() == (deep == 0));
    }
}

TEST(unlike_maps) {
    depths(31, 22);
    depths(22, 31);
}

}  // namespace test_unlike_maps
