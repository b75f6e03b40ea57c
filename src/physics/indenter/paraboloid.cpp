// Paraboloid with two principal radii: two crossed cylinders, a roller, a ball in a groove. If one
// radius is Infinity it is a cylinder, which extends to the border of the surface.

#include "asperities/ellipse.hpp"
#include "base/error.hpp"
#include "physics/indenter/shapes.hpp"

namespace rsc {
namespace {

class Paraboloid final : public IndenterShape {
public:
    Paraboloid(const char* name, const ShapeKeys& keys)
        : IndenterShape(name, keys),
          c_(std::cos(keys.angle)),
          s_(std::sin(keys.angle)),
          k1_(1 / keys.radii[0]),
          k2_(1 / keys.radii[1]) {}

    std::string text(const std::string& unit) const override {
        const ShapeKeys& k = keys();
        const double degrees = k.angle * 180 / pi;
        if (k1_ > 0 && k2_ > 0)
            return format("paraboloid of radii %g and %g %s, the first at %g degrees", k.radii[0],
                          k.radii[1], unit.c_str(), degrees);
        const double axis = std::fmod(degrees + (k2_ > 0 ? 0 : 90), 180);
        return format("cylinder R = %g %s (axis at %g degrees from x)",
                      k2_ > 0 ? k.radii[1] : k.radii[0], unit.c_str(), axis);
    }
    double height(double x, double y) const override {
        const double u = c_ * x + s_ * y, v = c_ * y - s_ * x;
        return 0.5 * (k1_ * u * u + k2_ * v * v);
    }
    Vec2 gradient(double x, double y) const override {
        const double u = k1_ * (c_ * x + s_ * y), v = k2_ * (c_ * y - s_ * x);
        return {c_ * u - s_ * v, s_ * u + c_ * v};
    }
    Tensor curvature(double, double) const override {
        return {k1_ * c_ * c_ + k2_ * s_ * s_, (k1_ - k2_) * c_ * s_,
                k1_ * s_ * s_ + k2_ * c_ * c_};
    }
    double lowest(const Box& box) const override {
        if (!std::isfinite(box.x0) || !std::isfinite(box.x1) || !std::isfinite(box.y0) ||
            !std::isfinite(box.y1))
            return 0;
        const auto least_square = [&](double a, double b) {  // smallest (a x + b y)^2 over the box
            const double middle = a * 0.5 * (box.x0 + box.x1) + b * 0.5 * (box.y0 + box.y1);
            const double half =
                std::abs(a) * 0.5 * (box.x1 - box.x0) + std::abs(b) * 0.5 * (box.y1 - box.y0);
            const double least = std::max(0.0, std::abs(middle) - half);
            return least * least;
        };
        return 0.5 * (k1_ * least_square(c_, s_) + k2_ * least_square(-s_, c_)) * (1 - 1e-12);
    }
    // Uses s(q + d) - s(q) = q.C d + d.C d/2 and q.C d <= sqrt(q.C q) sqrt(d.C d).
    double most_fallen(double way, double drop) const override {
        const double m = std::sqrt(std::max(k1_, k2_)) * way;
        return std::sqrt(2 * std::max(0.0, drop)) * m + 0.5 * m * m;
    }
    // A cylinder repeats along its axis.
    bool repeats(double x, double y) const override {
        constexpr double rounding = 1e-12;
        const Tensor k = curvature(0, 0);
        const double small = rounding * std::max(k1_, k2_);
        return std::abs(k.xy) <= small && (std::isinf(x) || std::abs(k.xx) <= small) &&
               (std::isinf(y) || std::abs(k.yy) <= small);
    }
    double hertz_radius() const override {
        return k1_ == k2_ ? keys().radii[0] : std::numeric_limits<double>::quiet_NaN();
    }
    // Elliptic Hertz contact (Johnson 1985, section 4.2); empty for a cylinder, whose approach
    // depends on its length.
    std::optional<SmoothContact> smooth(double E_star) const override {
        if (!(k1_ > 0 && k2_ > 0)) return std::nullopt;
        const EllipseFactors f = ellipse_factors(std::max(k1_, k2_) / std::min(k1_, k2_));
        const double R = 1 / std::sqrt(k1_ * k2_);
        return SmoothContact{4.0 / 3 * E_star * std::sqrt(R) * std::pow(f.F2, -1.5), 1.5,
                             pi * f.F1 * f.F1 * R / f.F2, 1};
    }
    std::vector<Vec2> outline(double height) const override {
        std::vector<Vec2> curve;
        if (!(k1_ > 0 && k2_ > 0)) return curve;
        for (const Vec2& p : circle(1)) {
            const double u = p.x * std::sqrt(2 * height / k1_),
                         v = p.y * std::sqrt(2 * height / k2_);
            curve.push_back({c_ * u - s_ * v, s_ * u + c_ * v});
        }
        return curve;
    }

private:
    double c_, s_, k1_, k2_;
};

}  // namespace

std::shared_ptr<const IndenterShape> make_paraboloid(const char* name, const ShapeKeys& keys) {
    for (const double R : keys.radii)
        if (!(R > 0))
            bad_input("the radii of the paraboloid must be positive (Infinity: straight)");
    if (std::isinf(keys.radii[0]) && std::isinf(keys.radii[1]))
        bad_input("a paraboloid of radii Infinity, Infinity is a flat");
    return std::make_shared<Paraboloid>(name, keys);
}

}  // namespace rsc
