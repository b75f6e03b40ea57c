// Sphere without approximation, s = R - sqrt(R^2 - rho^2), and the flat as its limit.

#include "base/error.hpp"
#include "physics/indenter/shapes.hpp"

namespace rsc {
namespace {

class Sphere final : public IndenterShape {
public:
    Sphere(const char* name, const ShapeKeys& keys) : IndenterShape(name, keys), R_(keys.R) {}

    std::string text(const std::string& unit) const override {
        return format("sphere R = %g %s", R_, unit.c_str());
    }

    double height(double x, double y) const override { return of_square(x * x + y * y); }
    void heights(int n, const double* x, double y, double* s) const override {
        for (const int k : indices(n)) s[k] = of_square(x[k] * x[k] + y * y);
    }
    Vec2 gradient(double x, double y) const override {
        const double up = std::sqrt(R_ * R_ - (x * x + y * y));
        return {x / up, y / up};
    }
    Tensor curvature(double x, double y) const override {
        const double square = R_ * R_ - (x * x + y * y), cube = square * std::sqrt(square);
        return {(square + x * x) / cube, x * y / cube, (square + y * y) / cube};
    }
    double lowest(const Box& box) const override {
        return height(std::clamp(0.0, box.x0, box.x1), std::clamp(0.0, box.y0, box.y1));
    }
    // s decreases by at most s(rho + way) - s(rho), which grows with rho; s <= drop means rho <=
    // sqrt(drop (2 R - drop)).
    double most_fallen(double way, double drop) const override {
        const double rho = drop < R_ ? std::sqrt(std::max(0.0, drop * (2 * R_ - drop))) : R_,
                     before = rho + way;
        return before < R_ ? of_square(before * before) - of_square(rho * rho) : kInfinity;
    }
    double reach() const override { return R_; }
    bool round() const override { return true; }
    double hertz_radius() const override { return R_; }
    // Hertz (Johnson 1985, section 4.2): N = (4/3) E* sqrt(R) u^(3/2), A = pi R u.
    std::optional<SmoothContact> smooth(double E_star) const override {
        return SmoothContact{4.0 / 3 * E_star * std::sqrt(R_), 1.5, std::numbers::pi * R_, 1};
    }
    std::vector<Vec2> outline(double height) const override {
        return circle(std::sqrt(std::max(0.0, height * (2 * R_ - height))));
    }

private:
    double of_square(double rho2) const {  // R - sqrt(R^2 - rho^2) without cancellation
        return rho2 > R_ * R_ ? kInfinity : rho2 / (R_ + std::sqrt(R_ * R_ - rho2));
    }
    double R_;
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
    bool round() const override { return true; }
    double hertz_radius() const override { return kInfinity; }
    bool repeats(double, double) const override { return true; }
};

}  // namespace

std::shared_ptr<const IndenterShape> make_sphere(const char* name, const ShapeKeys& keys) {
    if (!(keys.R > 0)) bad_input("the radius of the sphere must be positive (Infinity: flat)");
    if (std::isinf(keys.R)) return std::make_shared<Flat>(name, keys);
    return std::make_shared<Sphere>(name, keys);
}

}  // namespace rsc
