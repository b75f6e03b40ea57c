// The union of elliptic spots against closed forms of circles, their affine images, and counting.
#include "check.hpp"
#include "contact/spots.hpp"

namespace test_spots {

using namespace rsc;

// What circles of radii r and s share at distance d.
double lens(double r, double s, double d) {
    if (d >= r + s) return 0;
    if (d <= std::abs(r - s)) return pi * std::min(r, s) * std::min(r, s);
    const double p = std::acos((d * d + r * r - s * s) / (2 * d * r)),
                 q = std::acos((d * d + s * s - r * r) / (2 * d * s));
    return r * r * (p - 0.5 * std::sin(2 * p)) + s * s * (q - 0.5 * std::sin(2 * q));
}

Spot circle(double x, double y, double r, double angle = 0) { return {x, y, r, r, angle}; }

// The plane stretched along x by a factor, then turned and moved: circles become ellipses, areas
// grow by the factor.
Spot image(double x, double y, double r, double factor, double turn) {
    return {1 + factor * x * std::cos(turn) - y * std::sin(turn),
            2 + factor * x * std::sin(turn) + y * std::cos(turn), factor * r, r, turn};
}

TEST(two_circles_and_their_images) {
    for (double d : {0.0, 0.3, 0.31, 0.7, 1.0, 1.6999, 1.7001, 3.0})
        for (double turn : {0.0, 0.4, -1.2, pi / 2}) {
            const double area = pi * (1 + 0.49) - lens(1, 0.7, d);
            CHECK_RELATIVE(union_area({circle(5, 1, 1, turn), circle(5 + d * std::cos(turn),
                                                                     1 + d * std::sin(turn), 0.7)}),
                           area, 1e-13);
            for (double factor : {1.0, 3.0, 40.0}) {
                CHECK_RELATIVE(
                    union_area({image(0, 0, 1, factor, turn), image(0, d, 0.7, factor, turn)}),
                    factor * area, 1e-12);
                CHECK_RELATIVE(
                    union_area({image(0, 0, 1, factor, turn), image(d, 0, 0.7, factor, turn)}),
                    factor * area, 1e-12);
            }
        }
}

// Two roots close together, found between the samples of a border: a sliver of 1e-6 of a spot.
TEST(slivers) {
    for (double deep : {1e-2, 1e-3, 1e-4})
        for (double turn = 0; turn < 0.2; turn += 0.013) {
            const double d = 2 - deep;
            const double area =
                union_area({circle(0, 0, 1), circle(d * std::cos(turn), d * std::sin(turn), 1)});
            CHECK_CLOSE(2 * pi - area, lens(1, 1, d), 1e-13);
        }
}

// Crossed ellipses, one within another, and one that all share, counted on a fine grid.
TEST(against_counting) {
    const std::vector<Spot> spots{{0, 0, 1.0, 0.3, 0.2},
                                  {0.1, 0.1, 0.9, 0.2, 1.7},
                                  {0.4, 0.1, 0.1, 0.05, 0},
                                  {-0.5, -0.4, 0.6, 0.5, -0.7},
                                  {3, 0, 0.5, 0.5, 0}};
    constexpr int n = 3000;
    constexpr double kCounting = 1e-4;  // n^(-3/2) of the square, and some
    long inside = 0;
    for (const int i : indices(n))
        for (const int j : indices(n)) {
            const double x = -2 + 4 * (i + 0.5) / n, y = -2 + 4 * (j + 0.5) / n;
            for (const Spot& s : spots) {
                const double c = std::cos(s.angle), t = std::sin(s.angle), dx = x - s.x,
                             dy = y - s.y;
                if (std::hypot((dx * c + dy * t) / s.major, (dy * c - dx * t) / s.minor) >= 1)
                    continue;
                ++inside;
                break;
            }
        }
    CHECK_CLOSE(union_area(spots), 16.0 * double(inside) / (double(n) * n) + pi * 0.25, kCounting);
}

TEST(all_spots) {
    CHECK(union_area({}) == 0);
    CHECK(union_area({circle(0, 0, 0), circle(0, 0, 1)}) == pi);
}

}  // namespace test_spots
