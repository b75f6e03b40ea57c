// Spheres without approximation, s = R - sqrt(R^2 - rho^2), and the flat as their limit. The form
// of body 1, if it is a sphere, too, is part of s: the heights of both bodies add. A radius below 0
// is that of a socket.

#include "base/error.hpp"
#include "contact/equivalent.hpp"
#include "physics/indenter/shapes.hpp"

namespace rsc {
namespace {

// For 1/R1 + 1/R2 > 0 the sum s is convex in rho: the curvature R^2/(R^2 - rho^2)^(3/2) of a sphere
// falls with R.
class Sphere final : public IndenterShape {
public:
    Sphere(const char* name, const ShapeKeys& keys)
        : IndenterShape(name, keys),
          R_{keys.R, keys.R_rough},
          R_star_(equivalent_radius({keys.R, keys.R_rough})),
          rim_(std::min(std::abs(keys.R), std::abs(keys.R_rough))) {}

    std::string text(const std::string& unit) const override {
        const bool two = std::isfinite(R_[0]) && std::isfinite(R_[1]);
        return two ? format("spheres R = %g and %g %s", R_[1], R_[0], unit.c_str())
                   : format("sphere R = %g %s", R_star_, unit.c_str());
    }

    double height(double x, double y) const override { return of_square(x * x + y * y); }
    void heights(int n, const double* x, double y, double* s) const override {
        for (const int k : indices(n)) s[k] = of_square(x[k] * x[k] + y * y);
    }
    Vec2 gradient(double x, double y) const override {
        double slope = 0;  // over rho
        for (const double R : R_) slope += 1 / up(R, x * x + y * y);
        return {x * slope, y * slope};
    }
    Tensor curvature(double x, double y) const override {
        Tensor sum;
        for (const double R : R_) {
            const double a = up(R, x * x + y * y);
            sum.xx += (1 + x / a * x / a) / a;
            sum.xy += x / a * y / a / a;
            sum.yy += (1 + y / a * y / a) / a;
        }
        return sum;
    }
    double lowest(const Box& box) const override {
        return height(std::clamp(0.0, box.x0, box.x1), std::clamp(0.0, box.y0, box.y1));
    }
    // s decreases by at most s(rho + way) - s(rho), which grows with rho.
    double most_fallen(double way, double drop) const override {
        const double rho = radius_at(drop), before = rho + way;
        return before < rim_ ? of_square(before * before) - of_square(rho * rho) : kInfinity;
    }
    double reach() const override { return rim_; }
    double hertz_radius() const override { return R_star_; }
    // Hertz (Johnson 1985, section 4.2): N = (4/3) E* sqrt(R) u^(3/2), A = pi R u.
    std::optional<SmoothContact> smooth(double E_star) const override {
        return SmoothContact{4.0 / 3 * E_star * std::sqrt(R_star_), 1.5, pi * R_star_, 1};
    }
    std::vector<Vec2> outline(double height) const override { return circle(radius_at(height)); }

private:
    // The centre of a sphere above its point at rho^2; below it for a socket.
    static double up(double R, double rho2) { return std::copysign(std::sqrt(R * R - rho2), R); }

    double of_square(double rho2) const {  // R - sqrt(R^2 - rho^2) without cancellation
        if (rho2 > rim_ * rim_) return kInfinity;
        double s = 0;
        for (const double R : R_) s += rho2 / (R + up(R, rho2));
        return s;
    }

    // rho at which s = h, at most that of the rim: the circle in which two spheres intersect whose
    // distance is R1 + R2 - h, with curvatures instead of radii.
    double radius_at(double h) const {
        const double c = 1 / R_[0], d = 1 / R_[1];
        if (!(h < of_square(rim_ * rim_))) return rim_;
        const double distance = c + d - h * c * d;
        const double square = h * (distance + c + d) * (2 - h * c) * (2 - h * d);
        return 0.5 * std::sqrt(std::max(0.0, square)) / distance;
    }

    double R_[2];  // of body 2 and of body 1
    double R_star_, rim_;
};

class Flat final : public IndenterShape {
public:
    using IndenterShape::IndenterShape;
    std::string text(const std::string&) const override { return "flat"; }
    double height(double, double) const override { return 0; }
    Vec2 gradient(double, double) const override { return {}; }
    Tensor curvature(double, double) const override { return {}; }
    double lowest(const Box&) const override { return 0; }
    double most_fallen(double, double) const override { return 0; }
    bool flat() const override { return true; }
    double hertz_radius() const override { return kInfinity; }
    bool repeats(double, double) const override { return true; }
};

}  // namespace

std::shared_ptr<const IndenterShape> make_sphere(const char* name, const ShapeKeys& keys) {
    if (std::isinf(keys.R) && std::isinf(keys.R_rough)) return std::make_shared<Flat>(name, keys);
    return std::make_shared<Sphere>(name, keys);
}

}  // namespace rsc
