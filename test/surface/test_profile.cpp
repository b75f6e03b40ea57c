// Profiles: parameters and filters of waves and forms in closed form, Abel pairs, moments, and the
// way back from the profiles of synthesized surfaces to their spectrum.
#include "surface/profile.hpp"

#include "check.hpp"
#include "support/height_maps.hpp"
#include "support/refused.hpp"
#include "support/simpson.hpp"
#include "surface/measured.hpp"
#include "surface/synthesis.hpp"

namespace test_profile {

using namespace rsc;

template <class Height>
HeightMap line_of(int n, double step, Height height) {
    return height_map(n, 1, step, 1, [&](int i, int) { return height(i * step); });
}

TEST(parameters_of_a_sine) {
    // 20 whole waves of amplitude A: Ra = 2A/pi, Rq = A/sqrt 2, Rz = 2A, Rku = 3/2, Rdq = k A/sqrt
    // 2.
    const double A = 0.4, k = 2 * pi / 0.25;
    const int n = 4000;
    const HeightMap line = line_of(n, 5.0 / n, [&](double x) { return 7 + A * std::sin(k * x); });
    const ProfileParameters p = profile_parameters(line, 1.0);
    CHECK(p.samplings == 5);
    CHECK_RELATIVE(p.ra, 2 * A / pi, 1e-4);  // of the points of a wave
    CHECK_RELATIVE(p.rq, A / std::sqrt(2.0), 1e-12);
    CHECK_RELATIVE(p.rz, 2 * A, 1e-12);
    CHECK_CLOSE(p.rsk, 0, 1e-12);
    CHECK_RELATIVE(p.rku, 1.5, 1e-12);
    CHECK_RELATIVE(p.rdq, k * A / std::sqrt(2.0), 6.0 / n);  // 6 points left out, sixth order
}

TEST(forms_of_profiles) {
    const auto line = [](double x) { return 3 - 0.2 * x; };
    const auto arc = [](double x) { return std::sqrt(900 - (x - 4) * (x - 4)); };
    HeightMap tilted = line_of(300, 0.05, line), round = line_of(300, 0.05, arc);
    const Form of_line = detrend(tilted, Detrend::plane), of_arc = detrend(round, Detrend::sphere);
    CHECK_RELATIVE(of_line.slope_x, -0.2, 1e-12);
    CHECK_RELATIVE(of_arc.radius, 30, 1e-9);
    for (const int i : indices(300)) {
        CHECK_CLOSE(tilted(i, 0), 0, 1e-12);
        CHECK_CLOSE(round(i, 0), 0, 1e-10);
    }
    HeightMap bent = line_of(300, 0.05, [](double x) { return 1 + x * (0.3 - 0.04 * x); });
    CHECK_RELATIVE(detrend(bent, Detrend::quadratic).zxx, -0.08, 1e-10);
}

TEST(long_waves_are_removed_and_ends_lost) {
    // Of a wave of length lambda the Gaussian filter leaves 1 - 2^(-(cutoff/lambda)^2).
    const double cutoff = 0.8, step = 0.001;
    for (const double lambda : {0.2, 0.8, 2.4}) {
        HeightMap line =
            line_of(16000, step, [&](double x) { return std::cos(2 * pi * x / lambda); });
        MeasureOptions options;
        options.detrend = Detrend::none;
        options.cutoff_long = cutoff;
        const Measured m = measure(line, options);
        CHECK(line.nx == 16000 - 800);
        CHECK_RELATIVE(line.x0, 0.4, 1e-12);
        const double left = 1 - std::exp2(-std::pow(cutoff / lambda, 2));
        // Half a cutoff from the end the weight of what is beyond is 0.8 %.
        for (int i = 0; i < line.nx; i += 100)
            CHECK_CLOSE(line(i, 0), left * std::cos(2 * pi * line.x(i) / lambda), 0.008);
        CHECK_RELATIVE(m.profile->parameters.length, 15.2, 1e-9);
    }
    HeightMap brief = line_of(100, step, [](double x) { return x; });
    REFUSED(measure(brief, {.cutoff_long = 0.095}), "half a cutoff is lost at each end");
}

TEST(spikes_and_missing_points_of_a_profile) {
    const auto wave = [](double x) { return std::sin(x); };
    HeightMap line = line_of(2000, 0.01, wave);
    line.row(0)[700] += 3;
    line.row(0)[1200] -= 2;
    line.row(0)[1500] = line.row(0)[1501] = std::nan("");
    MeasureOptions options;
    options.missing = Missing::fill;
    options.detrend = Detrend::none;
    options.outliers = 1000;  // a sine has no noise
    const Measured m = measure(line, options);
    CHECK(m.outliers.count == 2 && m.missing == 4);
    for (const int i : indices(2000)) CHECK_CLOSE(line(i, 0), wave(line.x(i)), 1e-4);
}

TEST(abel_pair_of_a_gaussian) {
    // Phi = exp(-k^2) has C1 = sqrt(pi) exp(-q^2).
    std::vector<double> q, c1;
    for (double k = 0.01; k < 6; k *= 1.003) {
        q.push_back(k);
        c1.push_back(std::sqrt(pi) * std::exp(-k * k));
    }
    const std::vector<double> phi = isotropic_spectrum(q, c1);
    for (const auto i : indices(q))
        if (q[i] < 2) CHECK_RELATIVE(phi[i], std::exp(-q[i] * q[i]), 3e-4);  // power laws between
}

SelfAffineFit surface(double H, bool plateau) {
    SelfAffineFit s;
    s.Phi0.value = 2e-7;
    s.kl.value = 30;
    s.ks.value = 2000;
    s.hurst.value = H;
    s.plateau = plateau;
    s.kl_seen = s.ks_seen = true;
    return s;
}

TEST(abel_pair_of_a_self_affine_surface) {
    for (const double H : {0.0, 0.3, 0.8, 1.0})
        for (const bool plateau : {false, true}) {
            const SelfAffineFit s = surface(H, plateau);
            // C1 = 2 int Phi(sqrt(q^2 + t^2)) dt, by Simpson's rule in ln t.
            for (const double q : {5.0, 29.0, 31.0, 300.0, 1900.0}) {
                double sum = 0;
                const double edges[] = {1e-3, std::sqrt(std::max(900 - q * q, 1e-6)),
                                        std::sqrt(4e6 - q * q)};
                for (const int part : indices(2))
                    sum += simpson(std::log(edges[part]), std::log(edges[part + 1]), 4000,
                                   [&](double l) {
                                       const double t = std::exp(l);
                                       // strictly inside the band at its ends
                                       const double k = std::clamp(std::hypot(q, t), 1e-9, 2000.0);
                                       const bool below = part == 0 && q < 30;
                                       return 2 * t *
                                              (below ? (plateau ? s.Phi0.value : 0.0)
                                                     : s(std::max(k, q < 30 ? 30.0 : q)));
                                   });
                CHECK_RELATIVE(profile_of_self_affine(s, q), sum, 1e-3);
            }
            // And back, where C1 falls.
            std::vector<double> q, c1;
            for (double k = 3; k < 1999; k *= 1.003) {
                q.push_back(k);
                c1.push_back(profile_of_self_affine(s, k));
            }
            const std::vector<double> phi = isotropic_spectrum(q, c1);
            for (const auto i : indices(q))
                if (q[i] > 33 && q[i] < 1500) CHECK_RELATIVE(phi[i], s(q[i]), 0.02);
        }
}

// One wave in the length is what a line takes, two are what a bow takes; waves beyond the cutoffs
// are left out with them.
TEST(range_of_a_profile_spectrum) {
    const HeightMap profile = line_of(128, 0.5, [](double x) { return std::sin(3 * x * x); });
    const double unit = 2 * pi / 64;
    const auto range = [&](double cutoff_long, double cutoff_short, Detrend form, int from,
                           int to) {
        const ProfileSpectrum s = profile_spectrum(profile, cutoff_long, cutoff_short, form);
        CHECK_RELATIVE(s.wavenumber.front(), from * unit, 1e-12);
        CHECK_RELATIVE(s.middle.back() + 0.5 * (s.modes.back() - 1) * unit, to * unit, 1e-12);
        CHECK(sum_of(s.modes) == to - from + 1);
    };
    range(0, 0, Detrend::plane, 2, 64);
    range(0, 0, Detrend::sphere, 3, 64);
    range(64 / 6.5, 64 / 40.5, Detrend::quadratic, 7, 40);
    range(64 / 1.2, 0, Detrend::plane, 2, 64);
}

TEST(moments_of_profile_and_surface) {
    for (const double H : {0.3, 0.8}) {
        const SelfAffineFit s = surface(H, false);
        const double L = 2 * pi / 3;
        const Moments m = theoretical_moments(
            {.L = L, .hurst = H, .L_lambda_l = 10, .L_lambda_s = 2000.0 / 3, .sigma = 1});
        double moment[3] = {};
        // up to the ends of the band, where C1 has corners and a root
        for (const auto& [from, to] : {std::pair(0.0, 30.0), std::pair(30.0, 2000.0)})
            for (const int p : indices(3))
                moment[p] += simpson(0, pi / 2, 20000, [&](double a) {
                    const double q = from + (to - from) * std::sin(a) * std::sin(a);
                    const double dq = 2 * (to - from) * std::sin(a) * std::cos(a);
                    return 2 * std::pow(q, 2 * p) * profile_of_self_affine(s, q) * dq;
                });
        CHECK_RELATIVE(moment[1] / moment[0], m.m2 / m.m0, 1e-5);
        CHECK_RELATIVE(moment[2] / moment[0], m.m4 / m.m0, 1e-5);
    }
}

// The profiles of 20 synthesized surfaces: how many of the stated 90 % intervals hold the truth.
TEST(way_back_from_profiles_of_surfaces) {
    const Spectrum truth{
        .L = 4,
        .hurst = 0.8,
        .L_lambda_l = 32,
        .L_lambda_s = 400,
        .plateau = true,
        .sigma = 0.002,
    };
    const Moments m = theoretical_moments(truth);
    const double lambda_s = truth.L / truth.L_lambda_s;
    constexpr int surfaces = 20, n = 1600;
    int inside[4] = {};
    double mean[4] = {};
    for (const int seed : indices(surfaces)) {
        const HeightMap map = synthesize(truth, n, Normalise::ensemble, seed + 1, 1);
        HeightMap line = height_map(n, 1, map.dx, 1, [&](int i, int) { return map(i, 311); });
        const Measured measured = measure(line, {});
        const ProfileFit& fit = *measured.profile->fit;
        const Fitted& ks = fit.surface.ks;
        const std::tuple<double, Fitted> all[] = {{truth.sigma, fit.sigma},
                                                  {std::sqrt(m.m2), fit.slope},
                                                  {truth.hurst, fit.surface.hurst},
                                                  {2 * pi / lambda_s, ks}};
        for (const int k : indices(4)) {
            const auto& [value, fitted] = all[k];
            inside[k] += std::abs(fitted.value - value) <= fitted.error;
            mean[k] += fitted.value / value / surfaces;
        }
    }
    // 18 of 20 are expected; 14 or fewer would be met once in 90 times.
    for (const int k : indices(4)) {
        CHECK(inside[k] >= 15);
        CHECK_RELATIVE(mean[k], 1, 0.05);
    }
}

}  // namespace test_profile
