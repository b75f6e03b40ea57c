// Spectral moments against quadrature of the PSD, and the noise of a mode against Random123 and Box
// and Muller's formula.
#include "surface/spectrum.hpp"

#include <Random123/philox.h>

#include "base/vector_math.hpp"
#include "check.hpp"
#include "support/simpson.hpp"
#include "surface/modes.hpp"

namespace test_spectrum {

using namespace rsc;

Spectrum spectrum(double hurst, double l, double s, bool plateau) {
    return {.L = 1.7,
            .hurst = hurst,
            .L_lambda_l = l,
            .L_lambda_s = s,
            .plateau = plateau,
            .sigma = 0.03};
}

// Integral of Phi over the plane with weight cos^p K^p, by Simpson's rule in ln K on either side of
// kl and over the angle, with a
// PSD written out here. Returns the three moments scaled to m0 = sigma^2.
Moments by_quadrature(const Spectrum& s) {
    const double kl = 2 * pi * s.L_lambda_l / s.L, ks = 2 * pi * s.L_lambda_s / s.L,
                 k0 = 2 * pi / s.L;
    const auto radial = [&](double p, double from, double to, double exponent) {
        return simpson(std::log(from), std::log(to), 4000, [&](double k) {
            return std::exp((p + 2) * k) * std::pow(std::exp(k) / kl, exponent);
        });
    };
    const auto angular = [](int p) {
        double sum = 0;
        for (const int i : indices(64)) sum += std::pow(std::cos(2 * pi * i / 64), p);
        return sum * 2 * pi / 64;  // exact for trigonometric polynomials
    };
    const auto moment = [&](int p) {
        return angular(p) *
               (radial(p, kl, ks, -2 * (1 + s.hurst)) + (s.plateau ? radial(p, k0, kl, 0) : 0));
    };
    const double scale = s.sigma * s.sigma / moment(0);
    return {scale * moment(0), scale * moment(2), scale * moment(4)};
}

TEST(closed_forms) {
    // H = 0 and H = 1 are where p = 2H turns a power into a logarithm; just beside them nothing may
    // be lost to cancellation.
    for (const double hurst : {0.0, 1e-9, 0.3, 0.5, 0.8, 1.0 - 1e-12, 1.0})
        for (const bool plateau : {false, true}) {
            const Spectrum s = spectrum(hurst, 6, 300, plateau);
            const Moments m = theoretical_moments(s), q = by_quadrature(s);
            CHECK_RELATIVE(m.m0, q.m0, 1e-13);
            CHECK_RELATIVE(m.m2, q.m2, 1e-9);  // of the quadrature
            CHECK_RELATIVE(m.m4, q.m4, 1e-9);
        }
    // A ring of one wavelength: Nayak's parameter is 3/2 and the rms gradient K sigma.
    const Spectrum ring = spectrum(0.5, 100, 100.001, false);
    const Moments m = theoretical_moments(ring);
    CHECK_CLOSE(m.nayak(), 1.5, 1e-4);
    CHECK_RELATIVE(m.rms_slope(), 2 * pi * 100 / 1.7 * 0.03, 1e-4);
    CHECK_RELATIVE(m.mean_spacing() * m.mean_spacing() * m.summit_density(), 1.0, 1e-14);
}

TEST(band_edges) {
    const Spectrum s = spectrum(0.8, 5, 13, false);
    CHECK(relative_psd(s, 4, 2) == 0.0);
    CHECK(relative_psd(s, 3, 4) == 1.0);  // at kl: inside
    CHECK(relative_psd(s, 12, 5) > 0.0);  // at ks: inside
    CHECK(relative_psd(s, 13, 1) == 0.0);
    CHECK_RELATIVE(relative_psd(s, 6, 8), std::pow(2.0, -3.6), 1e-14);  // K = 2 kl
    Spectrum flat = s;
    flat.plateau = true;
    CHECK(relative_psd(flat, 0, 0) == 0.0);
    CHECK(relative_psd(flat, 0, 1) == 1.0);
    CHECK(relative_psd(flat, 4, 2) == 1.0);
    CHECK(relative_psd(flat, 3, 4) == 1.0);
    // A cutoff that rounding has moved still holds the modes on it.
    Spectrum rounded = s;
    rounded.L_lambda_l = 5 * (1 + 1e-15);
    rounded.L_lambda_s = 13 * (1 - 1e-15);
    CHECK_CLOSE(relative_psd(rounded, 3, 4), 1.0, 1e-12);
    CHECK(relative_psd(rounded, 12, 5) > 0.0);
}

// A table with unlike steps and slopes, rising and falling, and a gap: its integrals by Simpson's
// rule, its values by hand, and the moments of the surfaces made from it by sums over all modes of
// the plane.
TEST(tables) {
    const std::vector<double> k{2, 3.5, 5, 9, 10, 17}, psd{0.4, 0.9, 0.2, 0, 0.3, 0.05};
    const auto table = std::make_shared<const SpectrumTable>(k, psd);
    CHECK(table->lowest() == 2 && table->highest() == 17 && table->largest() == 0.9);
    const auto slow = [&](double x) {
        for (std::size_t i = 1; i < k.size(); ++i)
            if (x >= k[i - 1] && x < k[i])
                return psd[i] * psd[i - 1] > 0
                           ? psd[i - 1] *
                                 std::pow(psd[i] / psd[i - 1],
                                          std::log(x / k[i - 1]) / std::log(k[i] / k[i - 1]))
                           : 0.0;
        return 0.0;
    };
    for (const double x :
         {1.999, 2.3, 3.4, 4.1, 4.999, 5.001, 7.0, 9.5, 9.999, 10.001, 12.0, 16.9, 17.001})
        CHECK_CLOSE((*table)(x), slow(x), 1e-14);
    for (std::size_t i = 0; i < 5; ++i) CHECK_CLOSE((*table)(k[i]), slow(k[i]), 1e-14);
    CHECK_CLOSE((*table)(17), 0.05, 1e-15);
    // Rounding of a cutoff does not cut off the entry at it.
    CHECK_RELATIVE((*table)(2 * (1 - 1e-13)), 0.4, 1e-12);
    CHECK_RELATIVE((*table)(17 * (1 + 1e-13)), 0.05, 1e-12);
    const auto integral = [&](int power) {
        double sum = 0;
        for (std::size_t i = 1; i < k.size(); ++i)  // psd[i] at k[i], from either side
            sum += simpson(k[i - 1], k[i], 2000, [&](double x) {
                const bool gap = psd[i] * psd[i - 1] == 0;
                return gap ? 0 : (x < k[i] ? slow(x) : psd[i]) * std::pow(x, power);
            });
        return sum;
    };
    for (const auto& [p, circle] :
         {std::pair{0, 2 * pi}, {2, pi}, {4, 0.75 * pi}})  // the integral of cos^p over the circle
        CHECK_RELATIVE(table->integral(p, 0), circle * integral(p + 1), 1e-11);
    CHECK_RELATIVE(table->sigma(), std::sqrt(2 * pi * integral(1)), 1e-11);
    const Spectrum s = tabulated_spectrum(table, 6, 0.07);
    CHECK(s.L == 6 && s.sigma == 0.07 && s.table == table);
    CHECK_RELATIVE(s.L_lambda_l, 6 / pi, 1e-14);
    CHECK_RELATIVE(s.L_lambda_s, 51 / pi, 1e-14);
    // m_p = T(p) times the integral of K^(p+1) Phi, T = 2 pi, pi, 3 pi/4, scaled to sigma.
    const Moments m = theoretical_moments(s);
    CHECK_RELATIVE(m.m0, 0.07 * 0.07, 1e-14);
    CHECK_RELATIVE(m.m2, 0.5 * integral(3) / integral(1) * m.m0, 1e-11);
    CHECK_RELATIVE(m.m4, 0.375 * integral(5) / integral(1) * m.m0, 1e-11);
    Spectrum plateau = spectrum(0.7, 3, 8.5, true);
    for (const Spectrum& of : {s, plateau, spectrum(0.4, 2.5, 9, false)}) {
        double m0 = 0, m20 = 0, m40 = 0, m04 = 0, m22 = 0, m02 = 0;
        for (int ky = -20; ky <= 20; ++ky)
            for (int kx = -20; kx <= 20; ++kx) {
                const double q2 = kx * kx + ky * ky, step = 2 * pi / of.L, x = step * kx,
                             y = step * ky;
                const double power = q2 == 0    ? 0
                                     : of.table ? slow(step * std::sqrt(q2))
                                     : q2 > of.L_lambda_s * of.L_lambda_s ? 0
                                     : q2 >= of.L_lambda_l * of.L_lambda_l
                                         ? std::pow(q2, -(1 + of.hurst))
                                     : of.plateau ? std::pow(of.L_lambda_l, -2 * (1 + of.hurst))
                                                  : 0;
                m0 += power;
                m20 += power * x * x;
                m02 += power * y * y;
                m40 += power * x * x * x * x;
                m04 += power * y * y * y * y;
                m22 += power * x * x * y * y;
            }
        const Moments d = discrete_moments(of);
        const double scale = of.sigma * of.sigma / m0;
        CHECK_RELATIVE(d.m0, of.sigma * of.sigma, 1e-14);
        CHECK_RELATIVE(d.m2, scale * (m20 + m02) / 2, 1e-12);
        CHECK_RELATIVE(d.m4, scale * (m40 + m04 + 3 * m22) / 3, 1e-12);
    }
}

TEST(elementary_functions) {
    double worst_log = 0, worst_exp = 0, worst_trig = 0;
    for (int i = 1; i < 200000; ++i) {
        const double u = i / 200000.0, x = std::exp(60 * u - 36);
        worst_log = check::worse(worst_log, std::abs(vector_math::log_positive(x) - std::log(x)) /
                                                (std::abs(std::log(x)) + 1e-300));
        const double e = 80 * u - 40;
        worst_exp =
            check::worse(worst_exp, std::abs(vector_math::exp_moderate(e) / std::exp(e) - 1));
        double c, s;
        vector_math::cos_sin_turns(u, c, s);
        const long double turn = 2 * std::numbers::pi_v<long double> * u;
        worst_trig = std::max({worst_trig, std::abs(c - double(std::cos(turn))),
                               std::abs(s - double(std::sin(turn)))});
    }
    const double ulp = 2.3e-16;
    CHECK(worst_log < 2 * ulp);  // our error and the library's
    CHECK(worst_exp < 3 * ulp);
    CHECK(worst_trig < 2 * ulp);
    CHECK(vector_math::log_positive(1.0) == 0.0);
}

TEST(noise_is_philox) {
    // The words of a mode are Random123's for key = seed, counter = (kx, ky, realization); every
    // bit of all four counts.
    const NoiseKey key{.seed = 0x123456789abcdef, .realization = -3};
    const std::int32_t kx = 17, ky = -5;
    const r123::Philox4x32 philox;
    const auto w = philox({{17u, static_cast<std::uint32_t>(-5), 0xfffffffdu, 0xffffffffu}},
                          {{0x89abcdefu, 0x01234567u}});
    const auto uniform = [](std::uint32_t low, std::uint32_t high) {
        return double(low | (static_cast<std::uint64_t>(high & 0xfffff) << 32)) /
               4503599627370496.0;
    };
    const double radius = std::sqrt(-std::log(1 - uniform(w[0], w[1]))),
                 phase = 2 * pi * uniform(w[2], w[3]);
    const std::complex<double> z = mode_noise(key, kx, ky);
    CHECK_CLOSE(z.real(), radius * std::cos(phase), 1e-14);  // rounding of the phase here
    CHECK_CLOSE(z.imag(), radius * std::sin(phase), 1e-14);
    CHECK(mode_noise({key.seed + (std::int64_t{1} << 40), key.realization}, kx, ky) != z);
    CHECK(mode_noise({key.seed, key.realization + (std::int64_t{1} << 40)}, kx, ky) != z);
    CHECK(mode_noise(key, kx, -ky) != z);
    // A column gives the modes one by one, whatever its length.
    std::vector<double> re(101), im(101);
    column_noise(key, kx, -50, 101, re.data(), im.data());
    bool same = true;
    for (const int i : indices(101)) {
        const auto one = mode_noise(key, kx, i - 50);
        same = same && one.real() == re[i] && one.imag() == im[i];
    }
    CHECK(same);
}

}  // namespace test_spectrum
