// Measured maps: form, missing points, filter, spectrum, against maps whose form, holes and
// spectrum are known.
#include "surface/measured.hpp"

#include "base/error.hpp"
#include "check.hpp"
#include "support/height_maps.hpp"
#include "support/refused.hpp"
#include "surface/defects.hpp"
#include "surface/form.hpp"
#include "surface/synthesis.hpp"

namespace test_measured {

using namespace rsc;

template <class Height>
HeightMap make(int nx, int ny, double dx, double dy, Height height) {
    return height_map(nx, ny, dx, dy, [&](int i, int j) { return height(i * dx, j * dy); });
}

double largest(const HeightMap& map) {
    double most = 0;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) most = std::fmax(most, std::abs(map(i, j)));
    return most;
}

// Rings have the same modes in any unit of length, also where the sides of a map are as 3 to 2 and
// many modes lie midway between two rings.
TEST(rings_in_units) {
    const auto modes = [](double unit) {
        return measure_spectrum(make(48, 32, unit * 0.01, unit * 0.01,
                                     [](double x, double y) { return std::sin(x) + y; }))
            .modes;
    };
    for (const double unit : {1e3, 1e-3, 1.7, 0.3}) CHECK(modes(unit) == modes(1));
    // So have their fits, also of narrow maps with a lay, in which some rings have no modes.
    for (int seed = 1; seed <= 24; ++seed) {
        const HeightMap z =
            synthesize({.L_lambda_l = 4, .L_lambda_s = 12 + seed / 2.0, .plateau = true}, 64,
                       Normalise::sample, seed, 1);
        const auto fit = [&](double unit) {
            const HeightMap map = height_map(64, 15 + 2 * seed, 0.01 * unit, 0.01 * unit,
                                             [&](int i, int j) { return unit * z(i, j); });
            return fit_self_affine(measure_spectrum(map, seed % 2 == 0 ? 1 : 9));
        };
        const SelfAffineFit one = fit(1);
        for (const double unit : {1e3, 1e-3, 1e-9}) {
            const SelfAffineFit f = fit(unit);
            CHECK_RELATIVE(f.kl.value * unit, one.kl.value, 1e-9);
            CHECK_RELATIVE(f.ks.value * unit, one.ks.value, 1e-9);
            CHECK_CLOSE(f.hurst.value, one.hurst.value,
                        1e-8);  // its search ends within rounding errors of the likelihood
        }
    }
}

TEST(forms) {
    constexpr double kRemoved = 1e-10;  // of the height the form spans
    const auto plane = [](double x, double y) { return 1e3 + 0.3 * x - 0.2 * y; };
    HeightMap tilted = make(80, 50, 0.1, 0.15, plane);
    const Form p = detrend(tilted, Detrend::plane);
    CHECK_CLOSE(largest(tilted), 0.0, kRemoved * 3);
    CHECK_RELATIVE(p.slope_x, 0.3, 1e-10);
    CHECK_RELATIVE(p.slope_y, -0.2, 1e-10);
    // What is told of a form holds in the middle of the map, points missing or not.
    const double mx = 0.5 * 79 * 0.1, my = 0.5 * 49 * 0.15;
    CHECK_RELATIVE(p.level, plane(mx, my), 1e-12);
    HeightMap torn = make(80, 50, 0.1, 0.15, [&](double x, double y) {
        return x < 4 && y < 3 ? std::nan("") : plane(x, y) - 1e3;
    });
    CHECK_RELATIVE(detrend(torn, Detrend::plane).level, plane(mx, my) - 1e3, 1e-10);
    const auto second = [](double x, double y) {
        return 5 + 0.3 * x - 0.2 * y + 0.05 * x * x - 0.08 * x * y + 0.02 * y * y;
    };
    HeightMap bent = make(80, 50, 0.1, 0.15, second);
    const Form q = detrend(bent, Detrend::quadratic);
    CHECK_CLOSE(largest(bent), 0.0, kRemoved * 5);
    CHECK_RELATIVE(q.zxx, 0.1, 1e-10);
    CHECK_RELATIVE(q.zxy, -0.08, 1e-10);
    CHECK_RELATIVE(q.zyy, 0.04, 1e-10);
    CHECK_RELATIVE(q.level, second(mx, my), 1e-10);
    CHECK_RELATIVE(q.slope_x, 0.3 + 0.1 * mx - 0.08 * my, 1e-10);
    CHECK_RELATIVE(q.slope_y, -0.2 - 0.08 * mx + 0.04 * my, 1e-10);
    // Spheres from nearly flat to nearly half, apex in the map or beside it, domes and bowls, some
    // points missing.
    for (const double sign : {1.0, -1.0})
        for (const double R : {5.5, 20.0, 1e4})
            for (const double apex : {4.0, 1.0}) {
                const auto sphere = [&](double x, double y) {
                    const double r2 = (x - apex) * (x - apex) + (y - 3) * (y - 3);
                    return 7 +
                           sign * (r2 < R * R ? -r2 / (std::sqrt(R * R - r2) + R) : std::nan(""));
                };
                HeightMap ball = make(80, 50, 0.1, 0.15, sphere);
                ball.row(7)[9] = std::nan("");
                double span = 0, lowest = kInfinity, highest = -kInfinity;
                for (const int j : indices(50))
                    for (const int i : indices(80)) {
                        lowest = std::fmin(lowest, ball(i, j));
                        highest = std::fmax(highest, ball(i, j));
                    }
                span = highest - lowest;
                const Form s = detrend(ball, Detrend::sphere);
                CHECK_CLOSE(largest(ball), 0.0, kRemoved * span);
                CHECK_RELATIVE(s.radius, sign * R, 1e-7);
                const double dx = mx - apex, dy = my - 3, up = std::sqrt(R * R - dx * dx - dy * dy),
                             cube = up * up * up;
                CHECK_RELATIVE(s.level, sphere(mx, my), 1e-9);
                CHECK_CLOSE(s.slope_x, -sign * dx / up, 1e-7 * 4 / R);
                CHECK_CLOSE(s.slope_y, -sign * dy / up, 1e-7 * 4 / R);
                CHECK_RELATIVE(s.zxx, -sign * (up * up + dx * dx) / cube, 1e-6);
                CHECK_CLOSE(s.zxy, -sign * dx * dy / cube, 1e-6 / R);
                CHECK_RELATIVE(s.zyy, -sign * (up * up + dy * dy) / cube, 1e-6);
                CHECK(std::isnan(ball(9, 7)));
            }
    // The form under roughness: what is left is the roughness, up to its own projection on the
    // form.
    const Spectrum spectrum{.L = 8, .L_lambda_l = 16, .L_lambda_s = 40, .sigma = 0.01};
    const HeightMap rough = synthesize(spectrum, 128, Normalise::sample, 3, 1);
    HeightMap both = rough.copy();
    both.periodic = false;
    for (const int j : indices(128))
        for (const int i : indices(128)) {
            const double x = i * both.dx - 4, y = j * both.dy - 4;
            both.row(j)[i] += std::sqrt(30.0 * 30 - x * x - y * y);
        }
    const Form s = detrend(both, Detrend::sphere);
    CHECK_RELATIVE(s.rms, 0.01, 0.01);
    CHECK_RELATIVE(s.radius, 30.0, 0.01);
    // The rms height left is about the mean, also of what was left as it is.
    HeightMap steps =
        make(20, 20, 1, 1, [](double x, double) { return std::lround(x) % 2 == 0 ? 5.25 : 4.75; });
    CHECK_RELATIVE(detrend(steps, Detrend::none).rms, 0.25, 1e-12);
    // Points on one line fix no plane, and none fix nothing.
    HeightMap line =
        make(20, 20, 1, 1, [](double x, double y) { return y == 3 ? x : std::nan(""); });
    REFUSED(detrend(line, Detrend::plane),
            "the points of the map do not determine a plane: too few");
    HeightMap nothing = make(20, 20, 1, 1, [](double, double) { return std::nan(""); });
    CHECK_THROWS(detrend(nothing, Detrend::mean), Error);
    CHECK_THROWS(fill_missing(nothing), Error);
}

// Stretched back by its lay, a spectrum has the cutoffs that it was made with.
TEST(lay) {
    const Spectrum spectrum{
        .L = 1,
        .L_lambda_l = 8,
        .L_lambda_s = 40,
        .sigma = 0.01,
        .aspect = 3,
        .direction = 30,
    };
    HeightMap map = synthesize(spectrum, 256, Normalise::sample, 5, 1);
    const Measured m = measure(map, {});
    CHECK(m.fit && m.fit->aspect > 2);
    CHECK_RELATIVE(m.fit->kl.value, 2 * pi * 8, 0.1);
    CHECK_RELATIVE(m.fit->ks.value, 2 * pi * 40, 0.1);
}

TEST(missing_points) {
    // The difference equation is exact for harmonic polynomials up to the third degree; on
    // rectangular pixels up to the second.
    const auto cubic = [](double x, double y) {
        return 1e3 + x * x * x - 3 * x * y * y + 0.5 * (x * x - y * y) + x * y - 2 * x;
    };
    const auto square = [](double x, double y) { return x * x - y * y + 3 * x * y + y; };
    const auto check = [](auto height, double dx, double dy, double tolerance) {
        HeightMap map = make(60, 45, dx, dy, height);
        const HeightMap truth = map.copy();
        long holes = 0;
        for (const int j : indices(map.ny))
            for (const int i : indices(map.nx)) {
                const bool ring = std::hypot(i - 30, j - 22) < 12 && std::hypot(i - 30, j - 22) > 5;
                if (ring || (i == 3 && j == 4) || (i > 50 && i < 56 && j > 2 && j < 40)) {
                    map.row(j)[i] = std::nan("");
                    ++holes;
                }
            }
        CHECK(count_missing(map) == holes);
        const auto filled = fill_missing(map);
        CHECK(filled.size() == 60u * 45u && filled[4 * 60 + 3] == 1 && filled[0] == 0);
        double error = 0, span = 0;
        for (const int j : indices(map.ny))
            for (const int i : indices(map.nx)) {
                error = std::fmax(error, std::abs(map(i, j) - truth(i, j)));
                span = std::fmax(span, std::abs(truth(i, j) - truth(0, 0)));
            }
        CHECK_CLOSE(error, 0.0, tolerance * span);
    };
    check(cubic, 0.1, 0.1, 1e-10);
    check(square, 0.1, 0.17, 1e-10);
    // At an edge the normal derivative is taken as zero: a function of y alone is kept at the edges
    // x = 0 and Lx.
    HeightMap edge = make(40, 40, 1, 1, [](double, double y) { return 2 * y; });
    for (int j = 10; j < 20; ++j)
        for (const int i : indices(6)) edge.row(j)[i] = std::nan("");
    fill_missing(edge);
    for (int j = 10; j < 20; ++j) CHECK_CLOSE(edge(0, j), 2.0 * j, 1e-8);
}

TEST(filtering) {
    CHECK_RELATIVE(gaussian_transmission(0.8, 2 * pi / 0.8), 0.5, 1e-14);
    // A wave of the cutoff's length comes out at half its height (on a periodic map, where it is a
    // mode).
    HeightMap wave = make(64, 48, 0.1, 0.2, [](double x, double y) {
        return std::cos(2 * pi * (2 * x / 6.4 + 3 * y / 9.6));
    });
    wave.periodic = true;
    const double k = 2 * pi * std::hypot(2 / 6.4, 3 / 9.6);
    HeightMap half = wave.copy();
    gaussian_filter(half, 2 * pi / k);
    double error = 0;
    for (const int j : indices(48))
        for (const int i : indices(64))
            error = std::fmax(error, std::abs(half(i, j) - 0.5 * wave(i, j)));
    CHECK_CLOSE(error, 0.0, 1e-13);
    // Against the convolution with the weighting function of the standard, exp(-pi (r/(alpha
    // cutoff))^2), reflected at the edges.
    const Spectrum spectrum{.L = 4, .L_lambda_l = 2, .L_lambda_s = 16, .sigma = 1};
    HeightMap map = synthesize(spectrum, 40, Normalise::sample, 2, 1);
    map.periodic = false;
    map.ny = 31;
    map.dy = 0.13;
    const HeightMap before = map.copy();
    const double cutoff = 2.4,
                 alpha = std::sqrt(std::log(2.0) /
                                   pi);  // 18 steps and more: no aliasing of the weights
    gaussian_filter(map, cutoff);
    const auto reflected = [](int i, int n) {
        i = ((i % (2 * n)) + 2 * n) % (2 * n);
        return i < n ? i : 2 * n - 1 - i;
    };
    error = 0;
    for (const int j : {0, 1, 15, 30})
        for (const int i : {0, 2, 20, 39}) {
            double sum = 0, weight = 0;
            for (int b = -90; b <= 90; ++b)
                for (int a = -110; a <= 110; ++a) {
                    const double r2 = (a * map.dx * a * map.dx + b * map.dy * b * map.dy) /
                                      (alpha * alpha * cutoff * cutoff);
                    const double w = std::exp(-pi * r2);
                    sum += w * before(reflected(i + a, 40), reflected(j + b, 31));
                    weight += w;
                }
            error = std::fmax(error, std::abs(map(i, j) - sum / weight));
        }
    CHECK_CLOSE(error, 0.0, 1e-12);
    CHECK_THROWS(gaussian_filter(map, -1.0), Error);
    CHECK_THROWS(measure(map, {.filter_cutoff = 1e3 * map.Lx()}), Error);  // only rounding is left
}

}  // namespace test_measured
