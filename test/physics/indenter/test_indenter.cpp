// Shapes of the indenter against their definitions: derivatives by differences, bounds by sampling,
// symmetries.
#include "base/error.hpp"
#include "check.hpp"
#include "contact/indentation.hpp"
#include "physics/indenter/shapes.hpp"
#include "support/asperities.hpp"
#include "support/height_maps.hpp"
#include "surface/surface.hpp"

namespace test_indenter {

using namespace rsc;

// A second body of a few waves, n x 3/2 n points on the unit square.
std::shared_ptr<const HeightMap> waves(int n, bool periodic) {
    const int ny = 3 * n / 2;
    auto map = std::make_shared<HeightMap>(height_map(n, ny, 1.0 / n, 1.0 / ny, [=](int i, int j) {
        const double x = 2 * pi * i / n, y = 2 * pi * j / ny;
        return 0.01 * (std::cos(3 * x + 1) * std::cos(2 * y) + std::sin(x - 2 * y));
    }));
    map->periodic = periodic;
    return map;
}

Shape shape(const std::string& name, const ShapeKeys& keys) {
    return make_shape(shape_number(name.c_str()), keys);
}

ShapeKeys keys() {
    ShapeKeys k;
    k.R = 1.5;
    k.R_rough = -4;  // a socket
    k.radii[0] = 0.7;
    k.radii[1] = 4;
    k.angle = 0.3;
    k.slope = 0.2;
    k.radius = 0.1;
    k.rim_radius = 0.6;
    k.map = waves(64, true);
    return k;
}

// Derivatives of s by central differences, to some relative error.
void derivatives(const char* name) {
    const Shape s = shape(name, keys());
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-0.35, 0.35);
    constexpr double h = 1e-4, first = 1e-6, second = 1e-5, fourth = 2e-2;
    double worst1 = 0, worst2 = 0, worst4 = 0, size1 = 0, size2 = 0, size4 = 0;
    for (int k = 0; k < 100; ++k) {
        const double x = uniform(random), y = uniform(random);
        if (std::abs(std::hypot(x, y) - 0.1) < 0.02 || std::hypot(x, y) < 0.05)
            continue;  // where the punch's flat end begins; the cone's tip
        const auto at = [&](double dx, double dy) { return s->height(x + dx, y + dy); };
        const Vec2 g = s->gradient(x, y);
        const Tensor c = s->curvature(x, y);
        worst1 = check::worse(worst1, {std::abs(g.x - (at(h, 0) - at(-h, 0)) / (2 * h)),
                                       std::abs(g.y - (at(0, h) - at(0, -h)) / (2 * h))});
        worst2 = check::worse(
            worst2,
            {std::abs(c.xx - (at(h, 0) - 2 * at(0, 0) + at(-h, 0)) / (h * h)),
             std::abs(c.yy - (at(0, h) - 2 * at(0, 0) + at(0, -h)) / (h * h)),
             std::abs(c.xy - (at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4 * h * h))});
        const double e = 2e-3;
        const auto laplacian = [&](double dx, double dy) {
            const Tensor t = s->curvature(x + dx, y + dy);
            return t.xx + t.yy;
        };
        const double biharmonic = (laplacian(e, 0) + laplacian(-e, 0) + laplacian(0, e) +
                                   laplacian(0, -e) - 4 * laplacian(0, 0)) /
                                  (e * e);
        if (std::string(name) == "cone" ||
            std::string(name) == "map") {  // of the others it is told as 0
            worst4 = check::worse(worst4, std::abs(s->biharmonic(x, y) - biharmonic));
            size4 = std::max(size4, std::abs(biharmonic));
        }
        size1 = std::max({size1, std::abs(g.x), std::abs(g.y)});
        size2 = std::max({size2, std::abs(c.xx), std::abs(c.yy), std::abs(c.xy)});
    }
    CHECK(worst1 <= first * size1);
    CHECK(worst2 <= second * size2);
    CHECK(worst4 <= fourth * size4);
    double x[3] = {-0.1, 0.02, 0.3}, many[3];
    s->heights(3, x, 0.17, many);
    for (const int k : indices(3)) CHECK_CLOSE(many[k], s->height(x[k], 0.17), 1e-15);
}

// lowest() and most_fallen() bound what is sampled.
void bounds(const char* name, bool sharp) {
    ShapeKeys k = keys();
    if (sharp) {
        k.rim_radius = 0;
        k.R_rough = 3;
        k.radii[1] = kInfinity;
        k.map = waves(64, false);
    }
    const Shape s = shape(name, k);
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(-0.6, 0.6), share(0, 1);
    bool holds = true;
    for (int trial = 0; trial < 200; ++trial) {
        Box box{uniform(random), 0, uniform(random), 0};
        box.x1 = box.x0 + 0.2 * share(random);
        box.y1 = box.y0 + 0.2 * share(random);
        const double lowest = s->lowest(box), way = 0.1 * share(random), drop = 0.1 * share(random),
                     t = 7 * share(random);
        const double fallen = s->most_fallen(way, drop);
        for (int p = 0; p < 50; ++p) {
            const double x = box.x0 + (box.x1 - box.x0) * share(random),
                         y = box.y0 + (box.y1 - box.y0) * share(random);
            const double now = s->height(x, y),
                         before = s->height(x + way * std::cos(t), y + way * std::sin(t));
            holds = holds && now >= lowest &&
                    (now > drop || before - now <= fallen + 1e-12 || std::isinf(fallen));
        }
    }
    CHECK(holds);
    CHECK(s->lowest({-kInfinity, kInfinity, -kInfinity, kInfinity}) <= s->height(0.01, 0.02));
    const std::vector<Vec2> outline = s->outline(0.004);
    double turned = 0;  // around the tip, once
    for (const auto k : indices(outline)) {
        const Vec2 p = outline[k], next = outline[(k + 1) % outline.size()];
        CHECK(std::abs(s->height(p.x * (1 - 1e-9), p.y * (1 - 1e-9)) - 0.004) <
              (sharp ? 0.0041 : 1e-8));
        turned += std::atan2(p.x * next.y - p.y * next.x, p.x * next.x + p.y * next.y);
    }
    CHECK_CLOSE(turned, outline.empty() ? 0 : 2 * pi, 1e-12);
}

TEST(all_indenter) {
    for (const ShapeRow& row : kShapes) {
        derivatives(row.name);
        bounds(row.name, false);
        bounds(row.name, true);
        CHECK(std::string(shape(row.name, keys())->name()) == row.name);
    }
    // Equal radii: the sphere to (rho/R)^2. Turned by any angle with the place: the same.
    ShapeKeys k = keys();
    k.radii[0] = k.radii[1] = k.R;
    k.R_rough = kInfinity;
    CHECK_RELATIVE(shape("paraboloid", k)->height(0.03, 0.04),
                   shape("sphere", k)->height(0.03, 0.04), std::pow(0.05 / k.R, 2));
    CHECK(shape("paraboloid", k)->hertz_radius() == k.R &&
          std::isnan(shape("paraboloid", keys())->hertz_radius()));
    for (const double turn : {0.1, 1.0, 2.5}) {
        ShapeKeys turned = keys();
        turned.angle += turn;
        const double c = std::cos(turn), s = std::sin(turn), x = 0.07, y = -0.02;
        CHECK_RELATIVE(shape("paraboloid", turned)->height(c * x - s * y, s * x + c * y),
                       shape("paraboloid", keys())->height(x, y), 1e-12);
    }
    // Of a map: its own points exactly, its middle at the tip; beyond its border nothing, unless it
    // repeats.
    for (const bool periodic : {false, true}) {
        k = keys();
        k.map = waves(32, periodic);
        const Shape map = shape("map", k);
        CHECK(map->height((5 - 15.5) / 32.0, (20 - 23.5) / 48.0) == -(*k.map)(5, 20));
        CHECK(std::isinf(map->height(0.6, 0)) == !periodic && map->repeats(1, 1) == periodic &&
              !map->repeats(1, 2));
    }
    // The sphere ends at its rim, which belongs to it.
    for (const auto& [x, y] : {std::pair{1.0, -2.0}, {0.5, -1.5}, {0.0, -2.0}, {0.5, -2.5}}) {
        const Indenter small{1.0, 0.5, 0.5, -2.0};
        CHECK(small.clearance(x, y, 2.0) == 1.5);
        CHECK(small.clearance(0.5 + (x - 0.5) * (1 + 1e-15), -2 + (y + 2) * (1 + 1e-15), 2.0) ==
              -kInfinity);
    }
    // What none of them can be, beside numbers beyond the bounds of their keys (test_registry).
    k = keys();
    k.radii[0] = k.radii[1] = kInfinity;
    k.map = nullptr;
    CHECK_THROWS(shape("paraboloid", k), Error);
    CHECK_THROWS(shape("map", k), Error);
    for (const double socket : {-1.5, -1.0, 0.0}) {  // of a ball of 1.5
        k.R_rough = socket;
        CHECK_THROWS(shape("sphere", k), Error);
    }
}

}  // namespace test_indenter
