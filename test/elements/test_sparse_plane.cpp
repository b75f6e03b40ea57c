// Products over some pixels of a periodic plane, split into near and far parts, against transforms
// over all pixels.
#include "check.hpp"
#include "elements/sparse_plane.hpp"

namespace test_sparse_plane {

using namespace rsc;

struct Spots {
    std::vector<std::size_t> rows = {0};
    std::vector<std::int32_t> column;
    Array<float> p;
};

// Discs of random size and place, some across the edges.
Spots spots(int nx, int ny) {
    std::mt19937 random(3);
    std::vector<double> plane(nx * ny, 0.0);
    for (int s = 0; s < 20; ++s) {
        const int x = int(random() % unsigned(nx)), y = int(random() % unsigned(ny));
        const double r2 = 1 + double(random() % 60);
        for (int b = -8; b <= 8; ++b)
            for (int a = -8; a <= 8; ++a)
                if (a * a + b * b < r2)
                    plane[(y + b + ny) % ny * nx + (x + a + nx) % nx] =
                        std::sqrt(r2 - a * a - b * b);
    }
    Spots all;
    for (const int j : indices(ny)) {
        for (const int i : indices(nx))
            if (const double p = plane[j * nx + i]; p > 0) {
                all.column.push_back(i);
                all.p.push_back(float(p));
            }
        all.rows.push_back(all.p.size());
    }
    return all;
}

void split(int nx, int ny, double aspect, double tolerance,
           const std::function<double(double)>& share = {}) {
    CHECK(SplitPixels::suits(nx, ny, aspect, share));
    const Spots set = spots(nx, ny);
    PeriodicPixels<double> exact(nx, ny, 1, aspect, share);
    const auto n = nx;
    std::vector<double> truth(set.p.size());
    Array<float> Kx, again;
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
    for (const auto k : indices(truth)) {
        worst = std::max(worst, std::abs(Kx[k] - truth[k]));
        largest = std::max(largest, std::abs(truth[k]));
    }
    CHECK(worst < tolerance * largest);
    CHECK(again == Kx);
}

TEST(all_sparse_plane) {
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
