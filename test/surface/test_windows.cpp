// What is known of a spectrum from a window cut out of a larger surface.
#include "check.hpp"
#include "support/height_maps.hpp"
#include "surface/form.hpp"
#include "surface/measured_spectrum.hpp"
#include "surface/synthesis.hpp"

namespace test_windows {

using namespace rsc;

constexpr int kPoints = 128, kTimes = 4;  // of a window's side; sides of the surface

HeightMap window(const Spectrum& of_window, int number, bool tilted) {
    Spectrum s = of_window;
    s.L *= kTimes;
    s.L_lambda_l *= kTimes;
    s.L_lambda_s *= kTimes;
    const HeightMap whole = synthesize(s, kPoints * kTimes, Normalise::ensemble, 11, number);
    HeightMap map = height_map(kPoints, kPoints, whole.dx, whole.dy, [&](int i, int j) {
        return whole((i + 37 * number) % whole.nx, (j + 91 * number) % whole.ny);
    });
    if (tilted) detrend(map, Detrend::plane);
    return map;
}

// value +- error, or a bound where the window cannot know more, holds the truth in nine windows of
// ten.
TEST(coverage) {
    constexpr int kWindows = 8;
    // of 144 windows a share of 0.9 is found as less with a chance of 1 in 100
    constexpr double kLeast = 0.83;
    int all = 0, hurst = 0, kl = 0, ks = 0, plateaus = 0;
    double bias = 0, psd = 0;
    for (const double h : {0.3, 0.8})
        for (const double low : {1.0, 4.0, 8.0})
            for (const double high : {16.0, 32.0})
                for (const bool plateau : {false, true}) {
                    if (high < 3 * low) continue;
                    const Spectrum s{.L = 1,
                                     .hurst = h,
                                     .L_lambda_l = low,
                                     .L_lambda_s = high,
                                     .plateau = plateau,
                                     .sigma = 1e-3};
                    // Phi of the ensemble at kl by its definition: the sum over modes is sigma^2.
                    double sum = 0;
                    for (int q = -int(high); q <= high; ++q)
                        for (int r = -int(high); r <= high; ++r) sum += relative_psd(s, q, r);
                    const double phi = s.sigma * s.sigma / (sum * std::pow(2 * pi, 2));
                    for (int k = 1; k <= kWindows; ++k) {
                        const SelfAffineFit fit =
                            fit_self_affine(measure_spectrum(window(s, k + 100 * all, k % 2 == 0)));
                        const double step = 2 * pi, found = fit.kl.value / step;
                        ++all;
                        hurst += std::abs(fit.hurst.value - h) <= fit.hurst.error;
                        bias += fit.hurst.value - h;
                        kl += fit.kl_seen ? std::abs(found - low) <= fit.kl.error / step
                                          : found >= low;
                        ks += std::abs(fit.ks.value / step - high) <= fit.ks.error / step;
                        plateaus += fit.kl_seen && fit.plateau_seen && fit.plateau != plateau;
                        // Phi0 belongs to kl: in the middle of the band the two do not mix.
                        const double middle = step * std::sqrt(low * high);
                        psd +=
                            std::log(fit.Phi0.value *
                                     std::pow(middle / fit.kl.value, -2 * (1 + fit.hurst.value)) /
                                     (phi * relative_psd(s, std::sqrt(low * high), 0)));
                        if (low == 8.0) CHECK(fit.kl_seen);
                        if (low == 1.0) CHECK(!fit.kl_seen || fit.kl.error > 0);
                    }
                }
    CHECK(hurst >= kLeast * all && kl >= kLeast * all && ks >= kLeast * all);
    CHECK_CLOSE(bias / all, 0.0, 0.03);
    CHECK(plateaus == 0);
    CHECK_CLOSE(psd / all, 0.0, 0.1);  // a window has few long waves
}

}  // namespace test_windows
