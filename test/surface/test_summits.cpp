// Summits between the points of the grid, against the Fourier sum itself and closed forms.
#include "base/error.hpp"
#include "check.hpp"
#include "surface/detection.hpp"
#include "surface/modes.hpp"
#include "surface/summits.hpp"
#include "surface/synthesis.hpp"

namespace test_summits {

using namespace rsc;

// A surface as a list of waves, z = sum of 2 Re[c exp(2 pi i (kx x + ky y)/L)], evaluated without
// any grid.
struct Waves {
    struct Wave {
        int kx, ky;
        std::complex<double> c;
    };
    std::vector<Wave> waves;
    double L = 1;

    double derivative(double x, double y, int p, int q) const {
        const std::complex<double> i(0, 1);
        double sum = 0;
        for (const Wave& w : waves) {
            const double kx = 2 * pi / L * w.kx, ky = 2 * pi / L * w.ky;
            sum += 2 * (w.c * std::pow(i * kx, p) * std::pow(i * ky, q) *
                        std::exp(i * (kx * x + ky * y)))
                           .real();
        }
        return sum;
    }
    double biharmonic(double x, double y) const {
        return derivative(x, y, 4, 0) + 2 * derivative(x, y, 2, 2) + derivative(x, y, 0, 4);
    }

    // Moved by (x, y).
    Waves moved(double x, double y) const {
        Waves m = *this;
        for (Wave& w : m.waves) w.c *= std::polar(1.0, -2 * pi / L * (w.kx * x + w.ky * y));
        return m;
    }
    HeightMap map(int nx, int ny) const {
        HeightMap map;
        map.allocate(nx, ny, nx);
        map.dx = L / nx;
        map.dy = L / ny;
        map.periodic = true;
        for (const int j : indices(ny))
            for (const int i : indices(nx))
                map.row(j)[i] = derivative(i * map.dx, j * map.dy, 0, 0);
        return map;
    }
};

// The modes a synthetic surface is made of, with sigma by the mean square of all of them.
Waves waves_of(const Spectrum& s, std::int64_t seed, std::int64_t realization) {
    Waves w;
    w.L = s.L;
    double square = 0;
    const int most = int(s.L_lambda_s);
    for (int kx = 0; kx <= most; ++kx)
        for (int ky = kx > 0 ? -most : 1; ky <= most; ++ky) {
            const double phi = relative_psd(s, kx, ky);
            if (phi == 0) continue;
            const std::complex<double> c = std::sqrt(phi) * mode_noise({seed, realization}, kx, ky);
            w.waves.push_back({kx, ky, c});
            square += 2 * std::norm(c);
        }
    for (auto& wave : w.waves) wave.c *= s.sigma / std::sqrt(square);
    return w;
}

Spectrum small_spectrum(double L_lambda_l, double L_lambda_s) {
    return {.L = 2, .L_lambda_l = L_lambda_l, .L_lambda_s = L_lambda_s};
}

double rms(const std::vector<double>& v) {
    double sum = 0;
    for (double x : v) sum += x * x;
    return std::sqrt(sum / double(v.size()));
}

// Largest distances of each summit from the truth: the gradient there as a way to the top, height,
// curvatures, biharmonic, the last three over their rms values.
std::array<double, 4> errors(const Asperities& a, const Waves& w) {
    std::array<double, 4> worst{};
    const double z_scale = rms(a.z), kappa = rms(a.kappa1), quartic = rms(a.biharmonic);
    for (const auto i : indices(a)) {
        const auto d = [&](int p, int q) { return w.derivative(a.x[i], a.y[i], p, q); };
        const double xx = d(2, 0), yy = d(0, 2), xy = d(1, 1);
        const double trace = xx + yy, root = std::hypot(xx - yy, 2 * xy);
        worst[0] = check::worse(worst[0], std::hypot(d(1, 0), d(0, 1)) / kappa);
        worst[1] = check::worse(worst[1], std::abs(a.z[i] - d(0, 0)) / z_scale);
        worst[2] = check::worse(worst[2], {std::abs(a.kappa1[i] - 0.5 * (root - trace)) / kappa,
                                           std::abs(a.kappa2[i] - 0.5 * (-root - trace)) / kappa});
        // The surface is least curved along the axis of kappa2.
        const double c = std::cos(a.angle[i]), s = std::sin(a.angle[i]);
        worst[2] = check::worse(
            worst[2], std::abs(-(c * c * xx + 2 * c * s * xy + s * s * yy) - a.kappa2[i]) / kappa);
        worst[3] = check::worse(worst[3],
                                std::abs(a.biharmonic[i] - w.biharmonic(a.x[i], a.y[i])) / quartic);
    }
    return worst;
}

TEST(against_the_fourier_sum) {
    const Spectrum s = small_spectrum(2, 16);
    const Waves w = waves_of(s, 5, 2);
    std::size_t fine_summits = 0;
    for (const int n :
         {34, 64, 80, 128, 256, 512, 1024}) {  // 34 points are too few: it works on 68
        SummitCount count;
        const Asperities a = make_asperities(s, n, Normalise::sample, 5, 2, Curvature::geometric,
                                             &count, nullptr, 1, Detail::subgrid);
        const auto e = errors(a, w);
        CHECK(e[0] * n / s.L < 1e-7);
        CHECK(e[1] < 1e-9);
        CHECK(e[2] <
              // the last step is not applied to the derivatives: kNear^2 and the stencil's 1e-9
              1e-7);
        CHECK(e[3] < 2e-7);
        CHECK(a.size() == a.biharmonic.size() && long(a.size()) == count.summits);
        for (const auto i : indices(a)) {
            CHECK(a.x[i] >= 0 && a.x[i] < s.L && a.y[i] >= 0 && a.y[i] < s.L);
            CHECK_RELATIVE(a.radius[i], 1 / std::sqrt(a.kappa1[i] * a.kappa2[i]), 1e-12);
        }
        if (n == 512) fine_summits = a.size();
        if (n == 1024)
            CHECK(
                // nothing is missed any more: 32 points in lambda_s tell all apart No summit twice.
                a.size() == fine_summits);
        for (const auto i : indices(a))
            for (const std::size_t j : indices(i)) {
                const double x = std::remainder(a.x[i] - a.x[j], s.L),
                             y = std::remainder(a.y[i] - a.y[j], s.L);
                CHECK(std::hypot(x, y) > 1e-3 * s.L / n);
            }
    }
}

// z = A cos(k(x - x0)) + B cos(k(y - y0)): one summit a cell, everything in closed form, on a grid
// with different steps.
TEST(closed_form) {
    Waves w;
    w.L = 3;
    const double k = 2 * pi / w.L * 4, x0 = 0.1234, y0 = 0.3217, A = 0.02, B = 0.05;
    w.waves = {{4, 0, 0.5 * A * std::polar(1.0, -k * x0)},
               {0, 4, 0.5 * B * std::polar(1.0, -k * y0)}};
    for (const auto [nx, ny] : {std::array{16, 16}, {20, 32}, {50, 24}}) {
        SummitCount count;
        const Asperities a =
            find_asperities(w.map(nx, ny), Curvature::algebraic, &count, 1, Detail::subgrid, 4);
        CHECK(a.size() == 16 && count.saddles == 0 && count.repeated == 0);
        for (const auto i : indices(a)) {
            CHECK_CLOSE(std::remainder(a.x[i] - x0, w.L / 4), 0, 1e-9);
            CHECK_CLOSE(std::remainder(a.y[i] - y0, w.L / 4), 0, 1e-9);
            CHECK_RELATIVE(a.z[i], A + B, 1e-9);
            CHECK_RELATIVE(a.kappa1[i], B * k * k, 1e-8);
            CHECK_RELATIVE(a.kappa2[i], A * k * k, 1e-8);
            CHECK_CLOSE(a.angle[i], 0, 1e-8);
            // All summits are elongated along x, in the ratio r of the squared axes of a Hertz
            // contact: they flatten by the quartic on its rim.
            const double r = std::pow(B / A, 2 * 0.636),
                         flattening = (r * A + B / r) * (A + B) / (2 * std::sqrt(A * B));
            CHECK_RELATIVE(a.biharmonic[i], flattening * k * k * k * k, 1e-7);
            CHECK_RELATIVE(a.radius[i], 2 / ((A + B) * k * k), 1e-8);
        }
    }
    CHECK_THROWS(
        find_asperities(w.map(16, 16), Curvature::geometric, nullptr, 1, Detail::subgrid, 3.9),
        Error);
}

// A map that is not periodic and holds a polynomial of the stencil's degree: exact. An elongated
// summit alone has the biharmonic of the round profile equivalent to it, a round one its own.
TEST(polynomial) {
    for (const bool round : {false, true}) {
        HeightMap map;
        map.allocate(25, 21, 25);
        map.dx = 0.1;
        map.dy = 0.2;
        map.x0 = 3;
        map.y0 = -1;
        const double x0 = 4.23, y0 = 0.87;
        for (const int j : indices(21))
            for (const int i : indices(25)) {
                const double x = 3 + 0.1 * i - x0, y = -1 + 0.2 * j - y0;
                map.row(j)[i] = 1 - (round ? 1.5 * (x * x + y * y) : 2 * x * x + y * y + x * y) +
                                0.3 * x * x * x - 0.5 * x * x * x * x - 0.25 * x * x * y * y -
                                0.125 * y * y * y * y;
            }
        const Asperities a =
            find_asperities(map, Curvature::geometric, nullptr, 1, Detail::subgrid);
        CHECK(a.size() == 1);
        if (a.size() != 1) return;
        CHECK_CLOSE(a.x[0], x0, 1e-10);
        CHECK_CLOSE(a.y[0], y0, 1e-10);
        CHECK_CLOSE(a.z[0], 1, 1e-12);
        CHECK_CLOSE(a.kappa1[0] * a.kappa2[0], round ? 9 : 7, 1e-8);  // 3 * 3, 4 * 2 - 1
        CHECK_CLOSE(a.kappa1[0] + a.kappa2[0], 6, 1e-8);
        if (round) CHECK_CLOSE(a.biharmonic[0], -12 - 2 - 3, 1e-6);  // 24*0.5, 2*4*0.25, 24*0.125
    }
}

// A summit is there once, also where two sides of the period meet: surfaces with summits reached
// from several starts, each summit in turn moved onto the corner of the period, and around it.
TEST(once_each) {
    long moved = 0, tried = 0;
    for (int k = 1; k <= 200; ++k) {
        const Spectrum s = small_spectrum(2, 5);
        SummitCount count;
        make_asperities(s, 20, Normalise::sample, 5, k, Curvature::geometric, &count, nullptr, 1,
                        Detail::subgrid);
        if (count.repeated == 0) continue;
        const Waves w = waves_of(s, 5, k);
        const auto found = [&](const Waves& waves) {
            return find_asperities(waves.map(20, 20), Curvature::geometric, nullptr, 1,
                                   Detail::subgrid, 4);
        };
        const Asperities a = found(w);
        for (const auto i : indices(a))
            for (const auto [dx, dy] : {std::array{0.02, 0.02}, {0.025, 0.0}, {0.0, 0.025}}) {
                const Asperities b = found(w.moved(dx * s.L - a.x[i], dy * s.L - a.y[i]));
                long here = 0;
                for (const auto j : indices(b))
                    here += std::hypot(std::remainder(b.x[j] - dx * s.L, s.L),
                                       std::remainder(b.y[j] - dy * s.L, s.L)) < 1e-5 * s.L;
                CHECK(here <= 1);
                moved += here;
                ++tried;
            }
    }
    CHECK(tried > 150 && 100 * moved >= 99 * tried);  // four points a wave miss one in 200
}

TEST(all_summits) {
    {  // pits, saddles and points at the border of a body above are no summits
        Asperities none;
        for (const SecondOrder& second : {SecondOrder{1, 1, 0}, {-1, 1, 0}, {-kInfinity, -1, 0}})
            CHECK(!append_summit(0, 0, 0, second, Curvature::geometric, none));
        CHECK(!append_summit(0, 0, kInfinity, {-1, -1, 0}, Curvature::geometric, none) &&
              none.size() == 0);
    }
}

}  // namespace test_summits
