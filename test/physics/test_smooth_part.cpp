// A kernel with a smooth part, 1/(pi E* d) + s(d): its table, its pixels, the dense matrix, the tree over pixels and the Fourier
// transforms, against formulas and plain sums. s is what a charge below the surface would do, c/(pi E* sqrt(d^2 + depth^2)), whose modes
// are c exp(-k depth) of the half-space's. The products of asperities are in test_products.cpp.
#include "contact/interaction/kernel.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include "check.hpp"
#include "contact/deflection.hpp"
#include "contact/interaction/periodic_pixels.hpp"
#include "contact/interaction/pixel_kernels.hpp"
#include "contact/interaction/pixel_products.hpp"
#include "contact/solver/dgesv.hpp"
#include "random_asperities.hpp"

using namespace rsc;

namespace {

constexpr double kE = 3.0, kNear = 1 / (std::numbers::pi * kE);

struct Artificial {
    double c, depth;
    double at(double d) const { return kNear * c / std::hypot(d, depth); }
    double share(double k) const { return c * std::exp(-k * depth); }
    Substrate substrate() const {
        const Artificial a = *this;
        return {kE, std::make_shared<const SmoothPart>([a](double d) { return a.at(d); }, [a](double k) { return a.share(k); }, depth)};
    }
};

// Over |x' - x| < a, |y' - y| < b, cut into parts not wider than half the depth.
double over(const Artificial& s, double x, double y, double a, double b) {
    const int nx = 1 + static_cast<int>(4 * a / s.depth), ny = 1 + static_cast<int>(4 * b / s.depth);
    const auto integral = [](double from, double to, auto f) { return boost::math::quadrature::gauss<double, 7>::integrate(f, from, to); };
    double sum = 0;
    for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j)
            sum += integral(x - a + 2 * a * i / nx, x - a + 2 * a * (i + 1) / nx, [&](double u) {
                return integral(y - b + 2 * b * j / ny, y - b + 2 * b * (j + 1) / ny, [&](double v) { return s.at(std::hypot(u, v)); });
            });
    return sum;
}

void table() {
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
                CHECK_RELATIVE(body.smooth()->over_rectangle(x * wide, y * wide, a, b), over(s, x * wide, y * wide, a, b), 2e-10);
            }
    CHECK_RELATIVE(body.under_pixel(0.02, 0.01, 0.03, 0.04), kNear * love(0.02, 0.01, 0.015, 0.02) + over(s, 0.02, 0.01, 0.015, 0.02),
                   1e-11);
    // Deflection maps: spots feel it as points do.
    Level level;
    level.add_contact(0, 0.1, 0.2, 2.0, 0.01, 0.0);
    CHECK_RELATIVE(deflection(level, *kernel, 0.4, 0.6), spot_deflection(2.0, 0.01, 0.5, kE) + 2 * s.at(0.5), 1e-12);
}

void matrix() {
    const Artificial s{1.5, 0.1};
    const auto kernel = make_kernel(Interaction::point, s.substrate());
    const Asperities a = random_asperities(30, 0.02, 0.01, 5e-4, 0.5, 7);
    const auto law = make_law(LawKind::hertz, a, kE);
    WorkingSet set;
    for (int i = 0; i < 30; ++i) {
        const auto k = static_cast<std::size_t>(i);
        set.asperity.push_back(i), set.x.push_back(a.x[k]), set.y.push_back(a.y[k]), set.g0.push_back(0.01);
    }
    law->prepare(set.asperity);
    const std::size_t n = 30;
    std::vector<double> v(n, 0.004), force(n, 1e-3), R, K(n * n), f(n), slope(n), work(n);
    paper_equations(*law, *kernel, set, 1e-9, force, v, R, K.data());
    law->respond(set.size(), set.asperity.data(), v.data(), f.data(), slope.data(), work.data());
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const double d = std::hypot(a.x[i] - a.x[j], a.y[i] - a.y[j]);
            CHECK_RELATIVE(K[j * n + i], i == j ? 1 + slope[i] * s.at(0) : slope[i] * (kNear / d + s.at(d)), 1e-12);
        }
}

void tree() {
    const double dx = 0.01, dy = 0.024;
    for (const double depth : {0.002, 0.02, 0.5}) {
        const Artificial s{-0.8, depth};
        const Substrate body = s.substrate();
        std::vector<Pixel> pixels;
        std::mt19937 random(3);
        for (int spot = 0; spot < 6; ++spot) {
            const int x = static_cast<int>(random() % 300), y = static_cast<int>(random() % 300);
            for (int k = 0; k < 30; ++k) pixels.push_back({1000 * (spot % 2) + x + k % 7, 20 * spot + y + k / 7});
        }
        const std::size_t n = pixels.size();
        std::vector<double> p(n), w(n), exact(n, 0.0);
        for (double& v : p) v = static_cast<double>(random() % 1000) / 1000;
        double error = 0, norm = 0;
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t l = 0; l < n; ++l) {
                const double x = (pixels[k].x - pixels[l].x) * dx, y = (pixels[k].y - pixels[l].y) * dy;
                const double far = dx * dy * s.at(std::hypot(x, y));  // exact enough where the rectangle is small against the distance
                const double layer = std::hypot(x, y) > 60 * (dx + dy) ? far : over(s, x, y, dx / 2, dy / 2);
                exact[k] += p[l] * (kNear * love(x, y, dx / 2, dy / 2) + layer);
            }
        for (const double wanted : {1e-3, 1e-6}) {
            const auto products = make_tree_products(body, dx, dy, 1e-3, wanted);
            products->set_pixels(pixels);
            products->apply(p.data(), w.data(), PixelProducts::Accuracy::full);
            error = norm = 0;
            for (std::size_t k = 0; k < n; ++k) error += std::pow(w[k] - exact[k], 2), norm += exact[k] * exact[k];
            CHECK_CLOSE(std::sqrt(error / norm), 0, wanted + 1e-6 * (wanted < 1e-5));
            CHECK_RELATIVE(products->coefficient(3, -2), body.under_pixel(3 * dx, 2 * dy, dx, dy), 1e-12);
            CHECK_RELATIVE(products->coefficient(300, 0), body.under_pixel(300 * dx, 0, dx, dy), 1e-12);
        }
    }
}

// A wave of pressure answers with its own share, there and back, in float and double, on even and odd grids.
template <class Real>
void wave(int nx, int ny, int m, int n) {
    const Artificial s{2.0, 0.7};
    const double dx = 0.3, dy = 0.2, pi = std::numbers::pi;
    PeriodicPixels<Real> pixels(nx, ny, dx, dy, [s](double k) { return s.share(k); });
    const double kx = 2 * pi * m / (nx * dx), ky = 2 * pi * n / (ny * dy), k = std::hypot(kx, ky);
    const auto value = [&](int i, int j) { return std::cos(kx * i * dx + ky * j * dy + 0.4); };
    for (const bool back : {false, true}) {
        const double answer = 2 / k * (1 + s.share(k)) / pixels.unit(), factor = back ? 1 / answer : answer;
        pixels.apply(
            [&](int j, Real* row) {
                for (int i = 0; i < nx; ++i) row[i] = static_cast<Real>(value(i, j));
            },
            [&](int j, const Real* row) {
                for (int i = 0; i < nx; ++i)
                    CHECK_CLOSE(static_cast<double>(row[i]), factor * value(i, j), (sizeof(Real) == 4 ? 1e-5 : 1e-12) * factor);
            },
            back ? PeriodicPixels<Real>::Answer::pressure : PeriodicPixels<Real>::Answer::deflection);
    }
}

}  // namespace

TESTS {
    table();
    matrix();
    tree();
    wave<double>(24, 15, 3, -2);
    wave<double>(15, 24, 0, 11);
    wave<float>(24, 16, 10, 1);
}
