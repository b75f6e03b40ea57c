#include "physics/stress/spot_stress.hpp"

#include "base/parallel.hpp"

namespace rsc {
namespace {

StressTensor turned(const StressTensor& s, double cosine, double sine) {
    StressTensor t;
    t.xx = cosine * cosine * s.xx + sine * sine * s.yy;
    t.yy = sine * sine * s.xx + cosine * cosine * s.yy;
    t.xy = cosine * sine * (s.xx - s.yy);
    t.zz = s.zz;
    t.xz = cosine * s.xz;
    t.yz = sine * s.xz;
    return t;
}

}  // namespace

StressTensor hertz_stress(double r, double z, double f, double a, double nu) {
    const double p0 = 1.5 * f / (std::numbers::pi * a * a);
    const double outside = r * r + z * z - a * a;
    const double u = 0.5 * (outside + std::hypot(outside, 2 * a * z));  // [length^2]
    const double root = std::sqrt(u);
    // z/sqrt(u), its limit where both are 0
    const double ratio = root > 0 ? z / root : std::sqrt(std::max(0.0, 1 - r * r / (a * a)));
    const double cube = ratio * ratio * ratio;
    const double spread = u * u + a * a * z * z;
    const double pressed = spread > 0 ? cube * a * a * u / spread : ratio;
    const double angle = root > 0 ? root / a * std::atan2(a, root) : 0.0;
    // (1 - ratio^3) a^2/r^2, on the axis its limit
    const double wide = a * a + z * z;
    const double hoop = r * r > 1e-8 * wide ? (1 - cube) * a * a / (r * r) : 1.5 * a * a / wide;
    StressTensor s;
    s.xx = (1 - 2 * nu) / 3 * hoop + pressed +
           ratio * (u * (1 - nu) / (a * a + u) + (1 + nu) * angle - 2);
    s.yy =
        -(1 - 2 * nu) / 3 * hoop - ratio * (2 * nu + u * (1 - nu) / (a * a + u) - (1 + nu) * angle);
    s.zz = -pressed;
    s.xz = spread > 0 ? -r * z * z / spread * a * a * root / (a * a + u) : 0.0;
    return s * p0;
}

LargestStress stress_below(const Level& level, double nu, double depth) {
    constexpr int around = 8;  // points of a ring
    const std::size_t n = level.f.size();
    const auto stress = [&](double x, double y) {
        StressTensor sum;
        for (const auto k : indices(n)) {
            if (!(level.a[k] > 0)) continue;
            const double dx = x - level.x[k], dy = y - level.y[k], r = std::hypot(dx, dy);
            sum += turned(hertz_stress(r, depth, level.f[k], level.a[k], nu), r > 0 ? dx / r : 1.0,
                          r > 0 ? dy / r : 0.0);
        }
        return measures_of(sum);
    };
    std::vector<LargestStress> each(n);
    parallel_for(n, 1, 0, [&](std::size_t k) {
        const double x = level.x[k], y = level.y[k];
        each[k].take(stress(x, y), x, y);
        for (const double radius : {0.5 * level.a[k], level.a[k]})
            for (const int p : indices(around)) {
                const double angle = 2 * std::numbers::pi * p / around;
                const double px = x + radius * std::cos(angle), py = y + radius * std::sin(angle);
                each[k].take(stress(px, py), px, py);
            }
    });
    LargestStress all;
    for (const LargestStress& one : each) all.take(one);
    return all;
}

}  // namespace rsc
