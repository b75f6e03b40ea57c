// Pressures on pixels: Love's kernel against integration and its own far expansion, products by the
// tree against direct sums.
#include "check.hpp"
#include "elements/connected_pixels.hpp"
#include "elements/elements.hpp"
#include "elements/pixel_products.hpp"
#include "interaction/pixel_kernels.hpp"

#include "base/parallel.hpp"

namespace test_pixels {

using namespace rsc;

// Integral of 1/r over the rectangle by Gauss's rule with 4 points in each of m x m parts.
double integrated(double x, double y, double a, double b, int m) {
    const double t[2] = {0.3399810435848563, 0.8611363115940526},
                 w[2] = {0.6521451548625461, 0.3478548451374538};
    double sum = 0;
    for (const int i : indices(m))
        for (const int j : indices(m))
            for (const int p : indices(4))
                for (const int q : indices(4)) {
                    const double u = a * ((2 * i + 1 + (p < 2 ? t[p] : -t[p - 2])) / m - 1);
                    const double v = b * ((2 * j + 1 + (q < 2 ? t[q] : -t[q - 2])) / m - 1);
                    sum += w[p % 2] * w[q % 2] / std::hypot(x - u, y - v);
                }
    return sum * a * b / (m * m);
}

// Deflections by a unit pressure on the pixel (0, 0): its own, and that of another one.
std::array<double, 2> of_unit_pressure(PixelProducts& products, Pixel other) {
    const std::array<double, 2> p{1, 0};
    std::array<double, 2> w;
    products.set_pixels({{0, 0}, other});
    products.apply(p.data(), w.data(), PixelProducts::Accuracy::full);
    return w;
}

// The straight parts of the border of 5 x 3 pixels with one more above the corner, and of a strip
// that goes around a period.
TEST(straight_parts) {
    std::vector<Pixel> block;
    for (const int y : indices(3))
        for (const int x : indices(5)) block.push_back({x + 2, y});
    CHECK(squares_of_straight_parts(block, 0, 0) == 2 * 25 + 2 * 9);
    block.push_back({2, 3});
    CHECK(squares_of_straight_parts(block, 0, 0) == 25 + 16 + 1 + 16 + 9 + 1);
    std::vector<Pixel> strip;
    for (const int y : {4, 5})
        for (const int x : indices(8)) strip.push_back({x, y});
    CHECK(squares_of_straight_parts(strip, 8, 0) == 2 * 64);
    CHECK(squares_of_straight_parts(strip, 0, 0) == 2 * 64 + 2 * 4);
}

TEST(kernel) {
    // In the middle of a square of side 1 the four corners give 4 ln(1 + sqrt 2).
    CHECK_RELATIVE(love(0, 0, 0.5, 0.5), 4 * std::log(1 + std::numbers::sqrt2), 1e-15);
    // A rectangle in its middle: 4 [a asinh(b/a) + b asinh(a/b)].
    CHECK_RELATIVE(love(0, 0, 0.5, 1.5), 4 * (0.5 * std::asinh(3.0) + 1.5 * std::asinh(1.0 / 3)),
                   1e-15);
    const double places[][4] = {{1, 0, 0.5, 0.5},  {1, 1, 0.5, 0.5},     {-2, 3, 0.5, 0.5},
                                {7, -5, 0.5, 0.5}, {1.3, 2.7, 0.5, 1.0}, {4, 0, 0.5, 2}};
    for (const auto& p : places)
        CHECK_RELATIVE(love(p[0], p[1], p[2], p[3]), integrated(p[0], p[1], p[2], p[3], 40), 1e-11);
    // Symmetric, and finite where the point lies on the border's continuation.
    CHECK_RELATIVE(love(-3, 2, 0.5, 0.7), love(3, -2, 0.5, 0.7), 1e-14);
    CHECK_RELATIVE(love(0.5, 4, 0.5, 0.5), integrated(0.5, 4, 0.5, 0.5, 40), 1e-11);
    // Halves add up to the whole: holds on the rectangle itself, too.
    CHECK_RELATIVE(love(0.1, 0.2, 0.5, 0.5),
                   love(0.35, 0.2, 0.25, 0.5) + love(-0.15, 0.2, 0.25, 0.5), 1e-14);
    // The first correction is h^2/(24 d^3); the expansion's error falls with the sixth power of the
    // distance.
    CHECK_RELATIVE(love(40, 0, 0.5, 0.5) - 1.0 / 40, 1 / (24 * 64000.0), 2e-3);
    const auto error = [](double d) {
        return std::abs(love_far(0.8 * d, 0.6 * d, 0.5, 0.8) / love(0.8 * d, 0.6 * d, 0.5, 0.8) -
                        1);
    };
    CHECK(error(4) < std::pow(0.8 / 4, 6) / 20);
    CHECK_CLOSE(std::log2(error(4) / error(8)), 6.0, 0.2);
    CHECK_RELATIVE(pixel_kernel(17, 3, 1), love(17, 3, 0.5, 0.5), 1e-10);
    CHECK_RELATIVE(pixel_kernel(3, 40, 2), love(3, 40, 0.5, 1), 1e-10);
}

// Clusters of pixels, some of negative indices, over an extent of `extent`.
std::vector<Pixel> clusters(int spots, int radius, int extent, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Pixel> pixels;
    std::vector<char> taken(extent * extent, 0);
    for (int k = 0; k < spots; ++k) {
        const int cx = int(random() % unsigned(extent)), cy = int(random() % unsigned(extent));
        for (int y = std::max(0, cy - radius); y < std::min(extent, cy + radius); ++y)
            for (int x = std::max(0, cx - radius); x < std::min(extent, cx + radius); ++x) {
                auto& t = taken[y * extent + x];
                if (t || (x - cx) * (x - cx) + (y - cy) * (y - cy) >= radius * radius) continue;
                t = 1;
                pixels.push_back({x - extent / 3, y - extent / 2});
            }
    }
    return pixels;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double d = 0, s = 0;
    for (const auto k : indices(a)) {
        d += (a[k] - b[k]) * (a[k] - b[k]);
        s += b[k] * b[k];
    }
    return std::sqrt(d / s);
}

TEST(products) {
    const double E = 3.0, dx = 0.01;
    for (const double dy : {0.01, 0.024}) {
        const struct {
            int spots, radius, extent;
        } families[] = {{1, 1, 4},   {3, 6, 40},   {40, 4, 900},
                        {1, 30, 60}, {8, 9, 1200}, {300, 3, 900}};
        for (const auto& family : families) {
            const auto pixels = clusters(family.spots, family.radius, family.extent, 5);
            const std::size_t n = pixels.size();
            std::mt19937 random(3);
            std::vector<double> positive(n), mixed(n), w(n);
            for (const std::size_t k : indices(n)) {
                positive[k] = double(random() % 1000) / 1000;
                mixed[k] = positive[k] - 0.5;
                if (k % 5 == 3) positive[k] = 0;
            }
            const double scale = 1 / (pi * E);
            const std::size_t size = family.extent;
            std::vector<double> table(size * size);
            for (const std::size_t y : indices(size))
                for (const std::size_t x : indices(size))
                    table[y * size + x] =
                        scale * love(double(x) * dx, double(y) * dy, 0.5 * dx, 0.5 * dy);
            const auto exact = [&](const std::vector<double>& p) {
                std::vector<double> sums(n, 0.0);
                for (const std::size_t k : indices(n))
                    for (const std::size_t l : indices(n))
                        sums[k] += p[l] * table[std::abs(pixels[k].y - pixels[l].y) * size +
                                                std::abs(pixels[k].x - pixels[l].x)];
                return sums;
            };
            for (const double wanted : {1e-3, 1e-5, 1e-11}) {
                if (wanted < 1e-9 && family.extent > 100)
                    continue;  // its matrices take long to make
                const auto tree = make_tree_products(E, dx, dy, 1e-3, wanted);
                tree->set_pixels(pixels);
                CHECK(tree->full_error() <= wanted);
                tree->apply(positive.data(), w.data(), PixelProducts::Accuracy::full);
                CHECK(difference(w, exact(positive)) <= wanted);
                tree->apply(mixed.data(), w.data(), PixelProducts::Accuracy::full);
                CHECK(difference(w, exact(mixed)) <= 4 * wanted);
            }
            const auto tree = make_tree_products(E, dx, dy, 1e-5, 1e-6);
            CHECK_RELATIVE(of_unit_pressure(*tree, {2, 1})[1],
                           scale * love(2 * dx, dy, 0.5 * dx, 0.5 * dy), 1e-13);
            tree->set_pixels(pixels);
            const auto precise = make_tree_products(E, dx, dy, 1e-3, 1e-11);
            CHECK_RELATIVE(of_unit_pressure(*precise, {200, 31})[1],
                           scale * love(200 * dx, 31 * dy, 0.5 * dx, 0.5 * dy), 1e-10);
            // Elsewhere: half of the pixels press on all.
            std::vector<double> some = positive;
            std::fill(some.begin() + static_cast<std::ptrdiff_t>((n + 1) / 2), some.end(), 0.0);
            tree->set_pixels({});
            tree->elsewhere(some.data(), pixels, w.data());
            CHECK(difference(w, exact(some)) <= 1e-5);
            // Any number of threads, the same bits.
            std::vector<double> one(n);
            tree->set_pixels(pixels);
            tree->apply(positive.data(), w.data(), PixelProducts::Accuracy::full);
            const rsc::LoopThreads loops(rsc::most_threads(0) == 1 ? 3 : 1);
            tree->apply(positive.data(), one.data(), PixelProducts::Accuracy::full);
            CHECK(w == one);
            // Where deflections are wanted they are the same bits; elsewhere these or 0.
            std::vector<char> wanted(n);
            for (std::size_t k = 0; k < n; k += 97) wanted[k] = 1;
            tree->apply(positive.data(), one.data(), PixelProducts::Accuracy::full, wanted.data());
            for (const std::size_t k : indices(n))
                CHECK(one[k] == w[k] || (one[k] == 0 && !wanted[k]));
        }
    }
}

// The residual contains the penetration of a pixel without pressure, and not its gap: of two pixels
// one carries its penetration g0 alone, and the other one penetrates by half of that, or is as far
// away. Tolerance: rounding.
TEST(pixels_without_pressure) {
    const auto products = make_tree_products(3.0, 0.01, 0.01, 1e-3, 1e-6);
    const auto [own, other] = of_unit_pressure(*products, {1, 0});
    ElementsSolver solver(*products, kInfinity);
    for (const double penetration : {0.5, -0.5}) {
        std::vector<double> p{1, 0};
        const ElementsOutcome start =
            solver.solve({{0, 0}, {1, 0}}, {own, other + penetration * own}, 1e-6, 0, p);
        CHECK_CLOSE(start.residual, std::max(penetration, 0.0), 1e-12);
        CHECK(!start.converged);
    }
}

}  // namespace test_pixels
