// Products over some pixels of a periodic plane: stencils against their transform, second
// differences and the same on all pixels; split products against transforms over all pixels.
#include "check.hpp"
#include "elements/sparse_plane.hpp"

namespace test_sparse_plane {

using namespace rsc;

struct Spots {
    std::vector<std::size_t> rows = {0};
    std::vector<std::int32_t> column;
    std::vector<double> p;
};

// Discs of random size and place, some across the edges.
Spots spots(int nx, int ny) {
    std::mt19937 random(3);
    std::vector<double> plane(nx * ny, 0.0);
    for (int s = 0; s < 20; ++s) {
        const int x = static_cast<int>(random() % static_cast<unsigned>(nx)),
                  y = static_cast<int>(random() % static_cast<unsigned>(ny));
        const double r2 = 1 + static_cast<double>(random() % 60);
        for (int b = -8; b <= 8; ++b)
            for (int a = -8; a <= 8; ++a)
                if (a * a + b * b < r2)
                    plane[(y + b + ny) % ny * nx + (x + a + nx) % nx] =
                        std::sqrt(r2 - a * a - b * b);
    }
    Spots all;
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i)
            if (const double p = plane[j * nx + i]; p > 0) {
                all.column.push_back(i);
                all.p.push_back(p);
            }
        all.rows.push_back(all.p.size());
    }
    return all;
}

// All pixels of the plane.
Spots all_pixels(int nx, int ny) {
    Spots all;
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) all.column.push_back(i);
        all.rows.push_back(all.column.size());
    }
    return all;
}

void stencil(int nx, int ny) {
    constexpr int reach = 3, width = 2 * reach + 1;
    const PixelStencil taps(
        reach, [](double kx, double ky) { return kx + 2 * ky; },
        [](int a) { return 1 - std::abs(a) / 4.0; });
    const PixelStencil second(
        reach, [](double kx, double) { return 2 - 2 * std::cos(kx); }, [](int) { return 1.0; });
    const auto convolved = [](const PixelStencil& by, const Spots& on, int columns, int rows,
                              const std::vector<float>& x) {
        std::vector<float> y(x.size());
        SparsePlane(columns, rows).convolve(by, {on.rows, on.column}, x.data(), y.data(), 1);
        return y;
    };
    std::vector<float> one(width * width, 0.0f);
    one[reach * width + reach] = 1;
    double sum = 0;
    for (const float t : convolved(taps, all_pixels(width, width), width, width, one))
        sum += static_cast<double>(t);
    CHECK_CLOSE(sum, taps.transform(0), 1e-5);
    const std::vector<float> differences =
        convolved(second, all_pixels(width, width), width, width, one);
    for (int k = 0; k < width * width; ++k) {
        const int off = std::abs(k - reach * width - reach);
        CHECK_CLOSE(differences[k], off == 0 ? 2.0 : off == 1 ? -1.0 : 0.0, 1e-5);
    }
    const Spots set = spots(nx, ny);
    const std::vector<float> some = convolved(taps, set, nx, ny, {set.p.begin(), set.p.end()});
    std::vector<float> plane(nx * ny, 0.0f);
    std::vector<std::size_t> place;
    for (std::size_t j = 0, k = 0; j + 1 < set.rows.size(); ++j)
        for (; k < set.rows[j + 1]; ++k) place.push_back(j * nx + set.column[k]);
    for (std::size_t k = 0; k < place.size(); ++k) plane[place[k]] = static_cast<float>(set.p[k]);
    const std::vector<float> everywhere = convolved(taps, all_pixels(nx, ny), nx, ny, plane);
    for (std::size_t k = 0; k < place.size(); ++k) CHECK_CLOSE(some[k], everywhere[place[k]], 1e-4);
}

void split(int nx, int ny, double aspect, double tolerance,
           const std::function<double(double)>& share = {}) {
    CHECK(SplitPixels::suits(nx, ny, aspect, share));
    const Spots set = spots(nx, ny);
    PeriodicPixels<double> exact(nx, ny, 1, aspect, share);
    const auto n = nx;
    std::vector<double> truth(set.p.size()), Kx, again;
    exact.apply(
        [&](int j, double* row) {
            std::fill_n(row, n, 0.0);
            for (std::size_t k = set.rows[j]; k < set.rows[j + 1]; ++k)
                row[set.column[k]] = set.p[k];
        },
        [&](int j, const double* row) {
            for (std::size_t k = set.rows[j]; k < set.rows[j + 1]; ++k)
                truth[k] = row[set.column[k]];
        });
    SplitPixels fast(nx, ny, aspect, share);
    SparsePlane plane(nx, ny);
    fast.multiply(plane, {set.rows, set.column}, set.p, Kx, 1);
    fast.multiply(plane, {set.rows, set.column}, set.p, again, 3);
    double worst = 0, largest = 0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        worst = std::max(worst, std::abs(Kx[k] - truth[k]));
        largest = std::max(largest, std::abs(truth[k]));
    }
    CHECK(worst < tolerance * largest);
    CHECK(again == Kx);
}

TEST(all_sparse_plane) {
    stencil(48, 40);
    stencil(37, 19);
    split(128, 128, 1, 5e-3);
    split(256, 128, 1.2, 3e-2);  // the B-splines are made up for as on square pixels
    for (const double h :
         {0.5, 2.0, 8.0, 40.0})  // layers of this many pixels, stiffer and softer than their base
        for (const double share : {3.0, -0.8})
            split(128, 128, 1, 4e-2, [=](double k) { return share * std::exp(-h * k); });
    CHECK(!SplitPixels::suits(128, 128, 1, [](double k) { return 100 * std::exp(-k); }) &&
          !SplitPixels::suits(96, 128, 1) && !SplitPixels::suits(130, 128, 1));
}

}  // namespace test_sparse_plane
