// A kernel with a smooth part, 1/(pi E* d) + s(d): its table, its pixels and the Fourier
// transforms, against formulas and plain sums. s is what a charge below the surface would do, c/(pi
// E* sqrt(d^2 + depth^2)), whose modes are c exp(-k depth) of the half-space's. The products of
// asperities are in test_products.cpp.
#include "interaction/kernel.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include "check.hpp"
#include "contact/deflection.hpp"
#include "elements/periodic_pixels.hpp"
#include "interaction/pixel_kernels.hpp"

namespace test_smooth_part {

using namespace rsc;

constexpr double kE = 3.0, kNear = 1 / (pi * kE);

struct Artificial {
    double c, depth;
    double at(double d) const { return kNear * c / std::hypot(d, depth); }
    double share(double k) const { return c * std::exp(-k * depth); }
    Substrate substrate() const {
        const Artificial a = *this;
        return {kE,
                std::make_shared<const SmoothPart>([a](double d) { return a.at(d); },
                                                   [a](double k) { return a.share(k); }, depth)};
    }
};

// Over |x' - x| < a, |y' - y| < b, cut into parts not wider than half the depth.
double over(const Artificial& s, double x, double y, double a, double b) {
    const int nx = 1 + int(4 * a / s.depth), ny = 1 + int(4 * b / s.depth);
    const auto integral = [](double from, double to, auto f) {
        return boost::math::quadrature::gauss<double, 7>::integrate(f, from, to);
    };
    double sum = 0;
    for (const int i : indices(nx))
        for (const int j : indices(ny))
            sum += integral(x - a + 2 * a * i / nx, x - a + 2 * a * (i + 1) / nx, [&](double u) {
                return integral(y - b + 2 * b * j / ny, y - b + 2 * b * (j + 1) / ny,
                                [&](double v) { return s.at(std::hypot(u, v)); });
            });
    return sum;
}

TEST(table) {
    const Artificial s{-0.7, 0.03};
    const Substrate body = s.substrate();
    for (double d = 1e-6; d < 1e9; d *= 1.7) CHECK_RELATIVE(body.smooth_at(d), s.at(d), 1e-12);
    CHECK_RELATIVE(body.smooth_at(0), s.at(0), 1e-12);
    // The kernel is the sum, its own place the smooth part alone.
    const auto kernel = make_kernel(Interaction::point, body);
    CHECK_RELATIVE(kernel->at(0.3, -0.4), kNear / 0.5 + s.at(0.5), 1e-11);
    CHECK_RELATIVE(kernel->self(), s.at(0), 1e-12);
    // Pixels wider and narrower than the depth, from above and far away.
    for (const double wide : {0.001, 0.03, 0.3})
        for (const double aspect : {1.0, 2.5})
            for (const double x : {0.0, 1.0, 7.3, 15.0, 40.0}) {
                const double a = 0.5 * wide, b = a * aspect, y = 0.7 * x;
                CHECK_RELATIVE(body.smooth()->over_rectangle(x * wide, y * wide, a, b),
                               over(s, x * wide, y * wide, a, b), 2e-10);
            }
    CHECK_RELATIVE(body.under_pixel(0.02, 0.01, 0.03, 0.04),
                   kNear * love(0.02, 0.01, 0.015, 0.02) + over(s, 0.02, 0.01, 0.015, 0.02), 1e-11);
    // Deflection maps: spots feel it as points do.
    Level level;
    level.add_contact(0, 0.1, 0.2, 2.0, 0.01, 0.0);
    CHECK_RELATIVE(deflection(level, *kernel, 0.4, 0.6),
                   spot_deflection(2.0, 0.01, 0.5, kE) + 2 * s.at(0.5), 1e-12);
}

// A wave of pressure answers with its own share, there and back, in float and double, on even and
// odd grids.
template <class Real>
void wave(int nx, int ny, int m, int n) {
    const Artificial s{2.0, 0.7};
    const double dx = 0.3, dy = 0.2;
    PeriodicPixels<Real> pixels(nx, ny, dx, dy, [s](double k) { return s.share(k); });
    const double kx = 2 * pi * m / (nx * dx), ky = 2 * pi * n / (ny * dy), k = std::hypot(kx, ky);
    const auto value = [&](int i, int j) { return std::cos(kx * i * dx + ky * j * dy + 0.4); };
    for (const bool back : {false, true}) {
        const double answer = 2 / k * (1 + s.share(k)) / pixels.unit(),
                     factor = back ? 1 / answer : answer;
        pixels.apply(
            [&](int j, Real* row) {
                for (const int i : indices(nx)) row[i] = static_cast<Real>(value(i, j));
            },
            [&](int j, const Real* row) {
                for (const int i : indices(nx))
                    CHECK_CLOSE(double(row[i]), factor * value(i, j),
                                (sizeof(Real) == 4 ? 1e-5 : 1e-12) * factor);
            },
            back ? PeriodicPixels<Real>::Answer::pressure
                 : PeriodicPixels<Real>::Answer::deflection);
    }
}

TEST(smooth_part) {
    wave<double>(24, 15, 3, -2);
    wave<double>(15, 24, 0, 11);
    wave<float>(24, 16, 10, 1);
}

}  // namespace test_smooth_part
