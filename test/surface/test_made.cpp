// Surfaces with a direction, with heights that are not Gaussian, and what is measured of them.
#include "base/format.hpp"
#include "check.hpp"
#include "support/height_maps.hpp"
#include "support/refused.hpp"
#include "surface/detection.hpp"
#include "surface/height_distribution.hpp"
#include "surface/measured_spectrum.hpp"
#include "surface/synthesis.hpp"

namespace test_made {

using namespace rsc;

Spectrum model(double aspect, double direction, double hurst = 0.8) {
    return {.hurst = hurst,
            .L_lambda_l = 4,
            .L_lambda_s = 32,
            .aspect = aspect,
            .direction = direction};
}

HeightMap made(const Spectrum& s, int n, Moments* sampled = nullptr, int threads = 1) {
    return synthesize(s, n, Normalise::sample, 3, 7, sampled, threads);
}

double difference(const HeightMap& a, const HeightMap& b, int step = 1, bool transposed = false) {
    double worst = 0;
    for (const int j : indices(a.ny))
        for (const int i : indices(a.nx))
            worst = check::worse(
                worst, std::abs(a(i, j) - (transposed ? b(j, i) : b(step * i, step * j))));
    return worst;
}

TEST(directions) {
    const HeightMap isotropic = made(model(1, 0), 128);
    // a direction without anisotropy is none
    CHECK(difference(isotropic, made(model(1, 70), 128)) == 0);
    CHECK(difference(made(model(5, 0), 192), made(model(5, 90), 192), 1, true) == 0);
    CHECK(difference(made(model(5, 20), 192), made(model(5, 70), 192), 1, true) == 0);
    CHECK(difference(made(model(5, 20), 192), made(model(5, 20), 192, nullptr, 3)) == 0);
    CHECK(difference(made(model(5, 20), 192), made(model(5, 20), 384), 2) < 1e-12 * 0.01);
    REFUSED(made(model(16, 0), 254),
            "256");  // waves across the lay are four times as short as L_lambda_s says
}

// Summits found while a surface is made as its transpose are those of the surface.
TEST(summits) {
    for (const Detail detail : {Detail::grid, Detail::subgrid}) {
        const Spectrum s = model(3, 70);
        const HeightMap map = made(s, 256);
        const double points = detail == Detail::grid ? 0 : 256 / shortest_wave(s);
        const Asperities all =
            find_asperities(map, Curvature::geometric, nullptr, 1, detail, points);
        Moments sampled;
        const Asperities found = make_asperities(
            s, 256, Normalise::sample, 3, 7, Curvature::geometric, nullptr, &sampled, 2, detail);
        CHECK(found.size() == all.size() && found.size() > 100);
        CHECK(sampled.tensor.m20 >
              sampled.tensor.m02);  // the lay is nearer to y: slopes are steeper along x
        double worst = 0;
        for (const auto i : indices(found)) {
            // Those found between grid points are ordered by the points where the search began.
            std::size_t k = 0;
            for (const auto j : indices(all))
                if (std::hypot(all.x[j] - found.x[i], all.y[j] - found.y[i]) <
                    std::hypot(all.x[k] - found.x[i], all.y[k] - found.y[i]))
                    k = j;
            if (detail == Detail::grid) CHECK(k == i);
            worst = check::worse(worst,
                                 std::hypot(all.x[k] - found.x[i], all.y[k] - found.y[i]) / map.dx);
            worst = check::worse(worst, std::abs(all.kappa1[k] / found.kappa1[i] - 1));
            worst =
                check::worse(worst, std::abs(std::remainder(all.angle[k] - found.angle[i], pi)) *
                                        (all.kappa1[k] / all.kappa2[k] - 1));
        }
        CHECK(worst < 1e-9);
    }
}

// The closed forms of the moments against sums over the modes drawn, whose mean over surfaces they
// are, and against finite differences.
TEST(moments) {
    for (const auto& [aspect, direction] :
         {std::pair{3.0, 0.0}, {3.0, 30.0}, {6.0, 115.0}, {2.0, 135.0}, {2.0, -45.0}}) {
        const Spectrum s = model(aspect, direction);
        const MomentTensor theory = theoretical_moments(s).tensor;
        MomentTensor mean;
        using M = MomentTensor;
        constexpr double M::*slopes[] = {&M::m20, &M::m11, &M::m02};
        constexpr double M::*curvatures[] = {&M::m40, &M::m31, &M::m22, &M::m13, &M::m04};
        constexpr int surfaces = 100;
        for (int k = 1; k <= surfaces; ++k) {
            const Moments sampled = RowSource(s, 192, Normalise::ensemble, 1, k, 1).sampled();
            for (const auto m : slopes) mean.*m += sampled.tensor.*m / surfaces;
            for (const auto m : curvatures) mean.*m += sampled.tensor.*m / surfaces;
            CHECK_RELATIVE(sampled.m2, sampled.tensor.m2(), 1e-12);
            CHECK_RELATIVE(sampled.m4, sampled.tensor.m4(), 1e-12);
        }
        // Sampling error of the sums, and the sum over integer wave vectors in place of the
        // integral.
        constexpr double near = 0.06;
        const double slope = theory.m20 + theory.m02, curvature = theory.m40 + theory.m04;
        for (const auto m : slopes) CHECK_CLOSE(mean.*m, theory.*m, near * slope);
        for (const auto m : curvatures) CHECK_CLOSE(mean.*m, theory.*m, near * curvature);
        // Stretching leaves the number of summits.
        CHECK_RELATIVE(theoretical_moments(s).summit_density(),
                       theoretical_moments(model(1, 0)).summit_density(), 1e-9);
        // A turn leaves the traces.
        CHECK_RELATIVE(theory.m2(), theoretical_moments(model(aspect, 0)).m2, 1e-12);
        CHECK_RELATIVE(theory.m4(), theoretical_moments(model(aspect, 0)).m4, 1e-12);
        Moments sampled;
        const MomentTensor grid = grid_moments(made(s, 1536, &sampled)).tensor;
        CHECK_CLOSE(grid.m20, sampled.tensor.m20, 0.02 * slope);
        CHECK_CLOSE(grid.m11, sampled.tensor.m11, 0.02 * slope);
        CHECK_CLOSE(grid.m31, sampled.tensor.m31, 0.03 * curvature);
        CHECK_CLOSE(grid.m13, sampled.tensor.m13, 0.03 * curvature);
    }
}

// The spectrum by direction of a surface made with a table of one is the table's, and its moments
// are the integrals of the closed form.
TEST(circle) {
    for (const double hurst : {0.5, 0.8, 1.0})
        for (const auto& [aspect, direction] : {std::pair{1.0, 0.0}, {3.0, 40.0}, {10.0, 100.0}}) {
            const Spectrum s = model(aspect, direction, hurst);
            const HeightMap map = made(s, 256);
            const MeasuredSpectrum measured = measure_spectrum(map);
            if (aspect > 1) {
                const double off = std::remainder(measured.lay - direction, 180);
                CHECK(std::abs(off) <= (aspect > 3 ? 2 : 6));  // the few long waves scatter
                // Rms slopes are in the ratio of the correlation lengths.
                CHECK_RELATIVE(isotropy(map).ratio, 1 / aspect, 0.15);
            }
            // The band and the Hurst exponent, found in wave vectors stretched back.
            const Isotropy slopes = isotropy(map);
            const SelfAffineFit fit =
                fit_self_affine(measure_spectrum(map, 1 / slopes.ratio, slopes.direction));
            constexpr double tau = 2 * pi;
            // At aspect 10 the shortest waves have 2.5 points: differences see them flatter, and
            // the ratio of slopes is low.
            CHECK_CLOSE(fit.hurst.value, hurst, aspect > 3 ? 0.15 : 0.05);
            CHECK_CLOSE(fit.kl.value / tau, s.L_lambda_l,
                        2);  // the rings of long waves have few modes
            CHECK_RELATIVE(fit.ks.value / tau, s.L_lambda_s, aspect > 3 ? 0.1 : 0.01);
            const SpectrumTable plane(measured.plane_wavenumber, measured.plane_psd,
                                      MeasuredSpectrum::kAngles);
            CHECK_RELATIVE(
                plane.sigma(), 0.01,
                // straight lines between the few rings of long waves, nothing below the first
                0.2);
            Spectrum twin =
                tabulated_spectrum(std::make_shared<SpectrumTable>(plane), s.L, s.sigma);
            Moments of_twin;
            const HeightMap again = synthesize(twin, 258, Normalise::sample, 5, 1, &of_twin);
            CHECK_RELATIVE(isotropy(again).ratio, isotropy(map).ratio, 0.2);
            CHECK_RELATIVE(of_twin.rms_slope(), grid_moments(map).rms_slope(), 0.15);
            CHECK_RELATIVE(of_twin.m2, theoretical_moments(twin).m2, 0.15);
        }
}

// Quantiles of sinh(u/2) and exp(u/4), u being normal: kurtosis and skewness in closed form
// (Johnson 1949).
TEST(distributions) {
    std::vector<double> score, symmetric, lognormal;
    for (double u = -6; u <= 6; u += 0.01) {
        score.push_back(u);
        symmetric.push_back(std::sinh(u / 2));
        lognormal.push_back(std::exp(u / 4));
    }
    const double w = std::exp(0.25), v = std::exp(1.0 / 16);
    const auto kurtosis = [](double x) { return ((x + 2) * x + 3) * x * x - 3; };
    const HeightShape even = HeightDistribution::of_quantiles(score, symmetric).shape(),
                      skewed = HeightDistribution::of_quantiles(score, lognormal).shape();
    CHECK_CLOSE(even.skewness, 0, 1e-9);
    CHECK_RELATIVE(even.kurtosis, 0.5 * (std::pow(w, 4) + 2 * w * w + 3), 1e-3);
    CHECK_RELATIVE(skewed.skewness, (v + 2) * std::sqrt(v - 1), 1e-3);
    CHECK_RELATIVE(skewed.kurtosis, kurtosis(v), 1e-3);
    for (const auto& [skewness, kurtosis] :
         {std::pair{2.0, 5.0}, {0.0, 0.9}, {1.0, 1.9}, {-1.0, 2.05}}) {
        Spectrum s = model(1, 0);
        s.shape = {skewness, kurtosis};
        REFUSED(validate(s), text_of(skewness * skewness + 1));
    }
}

// Amplitude of a mode of a map by its definition.
double amplitude(const HeightMap& map, int kx, int ky) {
    std::complex<double> sum = 0;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx))
            sum += map(i, j) *
                   std::polar(1.0, -2 * pi * (1.0 * kx * i / map.nx + 1.0 * ky * j / map.ny));
    return std::abs(sum) / (map.nx * map.ny);
}

TEST(heights) {
    // the median is in the middle
    CHECK(quantiles({3, 1, 0, 2}, {-9, 0, 9}) == (std::vector<double>{0, 1.5, 3}));
    for (const auto& [skewness, kurtosis, aspect] :
         {std::tuple{-1.0, 4.5, 1.0}, {0.0, 2.0, 3.0}, {0.6, 3.5, 1.0}}) {
        Spectrum s = model(aspect, 25);
        const HeightMap gaussian = made(s, 256);
        s.shape = {skewness, kurtosis};
        Moments sampled;
        const HeightMap map = made(s, 256, &sampled);
        const HeightParameters p = height_parameters(map);
        CHECK_CLOSE(p.ssk, skewness, 0.02);
        CHECK_CLOSE(p.sku, kurtosis, 0.05);
        CHECK_CLOSE(p.ssk, sampled.heights.skewness, 1e-3);
        CHECK_CLOSE(p.sku, sampled.heights.kurtosis, 1e-2);
        CHECK_RELATIVE(p.sq, 0.01, 1e-12);
        for (const auto& [kx, ky] : {std::pair{4, 3}, {5, -7}, {0, 9}, {12, 0}})
            CHECK_CLOSE(amplitude(map, kx, ky), amplitude(gaussian, kx, ky), 1e-14);
        CHECK(difference(map, made(s, 256, nullptr, 3)) == 0);
        CHECK(difference(map, made(s, 512), 2) < 1e-12 * 0.01);
    }
}

// A spectrum given as a table by direction, which goes on with zeros beyond the waves as that of a
// measured map does: the heights are changed as for the stretched spectrum itself, long waves first
// or all at once.
TEST(tabulated) {
    for (const double shortest : {20.0, 40.0}) {
        Spectrum s = model(4, 30);
        s.L_lambda_s = shortest;
        s.shape = {-0.8, 4};
        constexpr std::size_t angles = 360;
        std::vector<double> rings, psd;
        for (double q = 1; q <= 100; q *= 1.01) {
            rings.push_back(2 * pi * q);
            for (const std::size_t a : indices(angles)) {
                const double angle = pi * double(a) / angles;
                psd.push_back(relative_psd(s, q * std::cos(angle), q * std::sin(angle)));
            }
        }
        Spectrum table =
            tabulated_spectrum(std::make_shared<SpectrumTable>(rings, psd, angles), s.L, s.sigma);
        table.shape = s.shape;
        const HeightMap stretched = made(s, 256), same = made(table, 256);
        double product = 0, squares = 0;
        for (const int j : indices(same.ny))
            for (const int i : indices(same.nx)) {
                product += stretched(i, j) * same(i, j);
                squares += stretched(i, j) * stretched(i, j);
            }
        CHECK(product > 0.98 * squares);
    }
}

// Of heights spread evenly a quantile is the share of a normal variable below the score.
TEST(height_quantiles) {
    const HeightQuantiles q = height_quantiles(
        height_map(64, 64, 1, 1, [](int i, int j) { return (37 * (i + 64 * j)) % 4096; }));
    for (const auto k : indices(q.score))
        CHECK_CLOSE(q.height[k], 2048 * std::erf(q.score[k] / std::numbers::sqrt2), 1);
}

}  // namespace test_made
