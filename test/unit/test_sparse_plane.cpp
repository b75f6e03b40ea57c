// Products over some pixels of a periodic plane: stencils against direct sums, split products against transforms over all pixels.
#include "check.hpp"
#include "contact/interaction/sparse_plane.hpp"

using namespace rsc;

namespace {

struct Spots {
    std::vector<std::size_t> rows = {0};
    std::vector<std::int32_t> column;
    std::vector<double> p;
};

// Discs of random size and place, some across the edges.
Spots spots(int nx, int ny) {
    std::mt19937 random(3);
    std::vector<double> plane(static_cast<std::size_t>(nx * ny), 0.0);
    for (int s = 0; s < 20; ++s) {
        const int x = static_cast<int>(random() % static_cast<unsigned>(nx)), y = static_cast<int>(random() % static_cast<unsigned>(ny));
        const double r2 = 1 + static_cast<double>(random() % 60);
        for (int b = -8; b <= 8; ++b)
            for (int a = -8; a <= 8; ++a)
                if (a * a + b * b < r2)
                    plane[static_cast<std::size_t>((y + b + ny) % ny * nx + (x + a + nx) % nx)] = std::sqrt(r2 - a * a - b * b);
    }
    Spots all;
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i)
            if (const double p = plane[static_cast<std::size_t>(j * nx + i)]; p > 0) all.column.push_back(i), all.p.push_back(p);
        all.rows.push_back(all.p.size());
    }
    return all;
}

void stencil(int nx, int ny) {
    const Spots set = spots(nx, ny);
    constexpr int reach = 3;
    const PixelStencil taps(
        reach, [](double kx, double ky) { return kx + 2 * ky; }, [](int a) { return 1 - std::abs(a) / 4.0; });
    SparsePlane plane(nx, ny);
    std::vector<float> x(set.p.begin(), set.p.end()), y(x.size()), unit(x.size(), 0.0f), response(x.size());
    plane.convolve(taps, {set.rows, set.column}, x.data(), y.data(), 1);
    // The taps, from the answer to 1 at one pixel of a full plane.
    Spots full;
    for (int j = 0; j < 2 * reach + 1; ++j) {
        for (int i = 0; i < 2 * reach + 1; ++i) full.column.push_back(i), full.p.push_back(0);
        full.rows.push_back(full.p.size());
    }
    const std::size_t width = 2 * reach + 1;
    std::vector<float> one(width * width, 0.0f), tap(width * width), response_of_one(width * width);
    one[reach * width + reach] = 1;
    SparsePlane(2 * reach + 1, 2 * reach + 1).convolve(taps, {full.rows, full.column}, one.data(), tap.data(), 1);
    double sum = 0, worst = 0;
    for (float t : tap) sum += static_cast<double>(t);
    CHECK_CLOSE(sum, taps.transform(0), 1e-5);
    // Second differences along x.
    const PixelStencil second(
        reach, [](double kx, double) { return 2 - 2 * std::cos(kx); }, [](int) { return 1.0; });
    SparsePlane(2 * reach + 1, 2 * reach + 1).convolve(second, {full.rows, full.column}, one.data(), response_of_one.data(), 1);
    for (std::size_t k = 0; k < response_of_one.size(); ++k) {
        const auto from_middle = static_cast<std::ptrdiff_t>(k) - static_cast<std::ptrdiff_t>(reach * width + reach);
        CHECK_CLOSE(response_of_one[k], from_middle == 0 ? 2.0 : std::abs(from_middle) == 1 ? -1.0 : 0.0, 1e-5);
    }
    const auto around = [](int d, int n) { return (d % n + n + n / 2) % n - n / 2; };
    for (int j = 0; j < ny; ++j)
        for (std::size_t k = set.rows[static_cast<std::size_t>(j)]; k < set.rows[static_cast<std::size_t>(j) + 1]; ++k) {
            double direct = 0;
            for (int m = 0; m < ny; ++m)
                for (std::size_t l = set.rows[static_cast<std::size_t>(m)]; l < set.rows[static_cast<std::size_t>(m) + 1]; ++l) {
                    const int a = around(set.column[l] - set.column[k], nx), b = around(m - j, ny);
                    if (std::abs(a) > reach || std::abs(b) > reach) continue;
                    direct += static_cast<double>(tap[static_cast<std::size_t>((b + reach) * (2 * reach + 1) + a + reach)]) * set.p[l];
                }
            worst = std::max(worst, std::abs(direct - static_cast<double>(y[k])));
        }
    CHECK(worst < 1e-4);
}

void split(int nx, int ny, double aspect, double tolerance, const std::function<double(double)>& share = {}) {
    CHECK(SplitPixels::suits(nx, ny, aspect, share));
    const Spots set = spots(nx, ny);
    PeriodicPixels<double> exact(nx, ny, 1, aspect, share);
    const auto n = static_cast<std::size_t>(nx);
    std::vector<double> truth(set.p.size()), Kx, again;
    exact.apply(
        [&](int j, double* row) {
            std::fill_n(row, n, 0.0);
            for (std::size_t k = set.rows[static_cast<std::size_t>(j)]; k < set.rows[static_cast<std::size_t>(j) + 1]; ++k)
                row[set.column[k]] = set.p[k];
        },
        [&](int j, const double* row) {
            for (std::size_t k = set.rows[static_cast<std::size_t>(j)]; k < set.rows[static_cast<std::size_t>(j) + 1]; ++k)
                truth[k] = row[set.column[k]];
        });
    SplitPixels fast(nx, ny, aspect, share);
    SparsePlane plane(nx, ny);
    fast.multiply(plane, {set.rows, set.column}, set.p, Kx, 1);
    fast.multiply(plane, {set.rows, set.column}, set.p, again, 3);
    double worst = 0, largest = 0;
    for (std::size_t k = 0; k < truth.size(); ++k)
        worst = std::max(worst, std::abs(Kx[k] - truth[k])), largest = std::max(largest, std::abs(truth[k]));
    std::printf("%d x %d, aspect %g: split products within %.1e of the largest\n", nx, ny, aspect, worst / largest);
    CHECK(worst < tolerance * largest);
    CHECK(again == Kx);
}

}  // namespace

TESTS {
    stencil(48, 40);
    stencil(37, 19);
    split(128, 128, 1, 5e-3);
    split(256, 128, 1.2, 3e-2);                   // the B-splines are made up for as on square pixels
    for (const double h : {0.5, 2.0, 8.0, 40.0})  // layers of this many pixels, stiffer and softer than their base
        for (const double share : {3.0, -0.8}) split(128, 128, 1, 4e-2, [=](double k) { return share * std::exp(-h * k); });
    CHECK(!SplitPixels::suits(128, 128, 1, [](double k) { return 100 * std::exp(-k); }) && !SplitPixels::suits(96, 128, 1) &&
          !SplitPixels::suits(130, 128, 1));
}
