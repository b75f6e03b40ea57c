// The potential of a point and its images: closed forms, sums over finer lattices, Ewald's sum with
// other parameters; and spots across the borders.
#include "base/error.hpp"
#include "check.hpp"
#include "contact/spots.hpp"
#include "interaction/kernel.hpp"
#include "interaction/lattice.hpp"

namespace test_lattice {

using namespace rsc;

constexpr double kSum = 1e-12;  // of 1/L: what the lattice promises
// 4 zeta(1/2) beta(1/2), the square lattice's own sum
constexpr double kSelf = -3.900264920001955886982;

// Of the square lattice: four sublattices make one of half the side, two one that is turned by 45
// degrees.
TEST(closed_forms) {
    for (double L : {1.0, 2.5e-3, 1e4}) {
        const Lattice square({L, L});
        const double root = std::sqrt(2.0);
        CHECK_CLOSE(square.self() * L, kSelf, kSum);
        CHECK_CLOSE(square.least() * L, kSelf * (root - 1), kSum);
        CHECK_CLOSE(square.at(L / 2, 0) * L, kSelf * (2 - root) / 2, kSum);
        CHECK_CLOSE(square.at(0, L / 2) * L, kSelf * (2 - root) / 2, kSum);
    }
    const auto unit = make_kernel(Interaction::point, 1 / pi, {1, 1});
    CHECK_CLOSE(unit->shift(), 1.61554, 1e-5);
    CHECK_CLOSE(unit->self(), -3.90026492 + 1.615542, 1e-6);
    CHECK_CLOSE(unit->at(0.5, 0.5), 0, kSum);
}

// Another parameter shares the sum out otherwise between images and modes.
double ewald(double x, double y, double Lx, double Ly, double b) {
    double sum = -2 * std::sqrt(pi) / (b * Lx * Ly);
    const int mx = int(7 / (b * Lx)) + 2, my = int(7 / (b * Ly)) + 2;
    for (int m = -mx; m <= mx; ++m)
        for (int n = -my; n <= my; ++n) {
            const double d = std::hypot(x - m * Lx, y - n * Ly);
            sum += d > 0 ? std::erfc(b * d) / d : -2 * b / std::sqrt(pi);
        }
    const int kx = int(14 * b * Lx / (2 * pi)) + 1, ky = int(14 * b * Ly / (2 * pi)) + 1;
    for (int m = -kx; m <= kx; ++m)
        for (int n = -ky; n <= ky; ++n) {
            if (m == 0 && n == 0) continue;
            const double p = 2 * pi * m / Lx, q = 2 * pi * n / Ly, k = std::hypot(p, q);
            sum += 2 * pi / (Lx * Ly) * std::erfc(k / (2 * b)) / k * std::cos(p * x + q * y);
        }
    return sum;
}

TEST(lattice_sums) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (double aspect : {1.0, 1.7, 4.0, 0.3}) {
        const double Lx = 1, Ly = aspect, size = std::sqrt(aspect);
        const Lattice lattice({Lx, Ly});
        double worst = std::abs(lattice.self() - ewald(0, 0, Lx, Ly, 1.4)) * size;
        std::vector<double> x, y, f, phi(1);
        for (const int k : indices(150)) {
            x.push_back(Lx * uniform(random));
            y.push_back(Ly * uniform(random));
            f.push_back(uniform(random));
            const double exact = ewald(x.back(), y.back(), Lx, Ly, k % 2 ? 1.4 : 2.6);
            const double scale = std::max(1.0, std::abs(exact) * size);
            worst = check::worse(
                worst,
                {std::abs(lattice.at(x.back(), y.back()) - exact) * size / scale,
                 std::abs(lattice.at(x.back() + 3 * Lx, y.back() - 2 * Ly) - exact) * size / scale,
                 std::abs(lattice.at(-x.back(), y.back()) - exact) * size / scale});
        }
        CHECK_CLOSE(worst, 0, kSum);
        // The sum over many sources, one of them at the target.
        x[77] = 5.125 * Lx;
        y[77] = 0.25 * Ly;
        const double xt = 0.125 * Lx, yt = 2.25 * Ly;
        double sum = f[77] * lattice.self();
        for (const auto k : indices(f))
            if (k != 77) sum += f[k] * lattice.at(xt - x[k], yt - y[k]);
        lattice.potential(1, &xt, &yt, f.size(), x.data(), y.data(), f.data(), phi.data());
        CHECK_CLOSE(phi[0] * size, sum * size, 1e-11);
    }
    CHECK_THROWS(Lattice({1, 4.5}), Error);
    CHECK_THROWS(Lattice({1, Period{}.x}), Error);
    CHECK_THROWS(Lattice({0, 1}), Error);
}

// Heaps of ellipses in the middle of the cell, and moved across its borders; a chain of circles
// around the torus.
TEST(spots_wrap) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    const Period period{1, 1};
    for (int set = 0; set < 20; ++set) {
        std::vector<Spot> spots;
        for (int i = 0; i < 30; ++i) {
            const double major = 0.05 * uniform(random);
            spots.push_back({0.35 + 0.3 * uniform(random), 0.35 + 0.3 * uniform(random), major,
                             major * uniform(random), 3 * uniform(random)});
        }
        const double area = union_area(spots);
        const double mx = uniform(random), my = uniform(random);
        for (Spot& s : spots) {
            s.x += mx;
            s.y += my;
            if (s.x > 1) s.x -= 1;
            if (s.y > 1) s.y -= 1;
        }
        CHECK_CLOSE(union_area(spots, nullptr, period), area, 1e-13);
    }
    std::vector<Spot> ring;
    const double r = 0.07, d = 0.1;
    for (const int i : indices(10)) ring.push_back({0.1 * i, 0.5, r, r, 0.3 * i});
    const double lens = 2 * r * r * std::acos(d / (2 * r)) - d / 2 * std::sqrt(4 * r * r - d * d);
    CHECK_CLOSE(union_area(ring, nullptr, period), 10 * (pi * r * r - lens), 1e-14);
}

}  // namespace test_lattice
