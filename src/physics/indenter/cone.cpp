// The cone: s = slope rho.

#include "base/error.hpp"
#include "physics/indenter/shapes.hpp"

namespace rsc {
namespace {

class Cone final : public IndenterShape {
public:
    Cone(const char* name, const ShapeKeys& keys) : IndenterShape(name, keys), slope_(keys.slope) {}

    std::string text(const std::string&) const override {
        return format("cone of slope %g", slope_);
    }
    double height(double x, double y) const override { return slope_ * std::sqrt(x * x + y * y); }
    Vec2 gradient(double x, double y) const override {
        const double rho = std::sqrt(x * x + y * y);
        return rho > 0 ? Vec2{slope_ * x / rho, slope_ * y / rho} : Vec2{};  // mean over the tip
    }
    Tensor curvature(double x, double y) const override {
        const double rho2 = x * x + y * y, cube = rho2 * std::sqrt(rho2);
        return cube > 0
                   ? Tensor{slope_ * y * y / cube, -slope_ * x * y / cube, slope_ * x * x / cube}
                   : Tensor{};
    }
    double biharmonic(double x, double y) const override {
        const double rho2 = x * x + y * y;
        return rho2 > 0 ? slope_ / (rho2 * std::sqrt(rho2)) : 0.0;
    }
    double lowest(const Box& box) const override {
        return height(std::clamp(0.0, box.x0, box.x1), std::clamp(0.0, box.y0, box.y1));
    }
    double most_fallen(double way, double) const override { return slope_ * way; }
    double edge(double) const override { return 0; }
    // Sneddon, Int. J. Eng. Sci. 3 (1965): u = (pi/2) a slope, N = (2/pi) E* u^2/slope.
    std::optional<SmoothContact> smooth(double E_star) const override {
        const double a = 2 / (pi * slope_);  // over u
        return SmoothContact{2 / pi * E_star / slope_, 2, pi * a * a, 2};
    }
    std::vector<Vec2> outline(double height) const override { return circle(height / slope_); }

private:
    double slope_;
};

}  // namespace

std::shared_ptr<const IndenterShape> make_cone(const char* name, const ShapeKeys& keys) {
    if (!(keys.slope > 0) || std::isinf(keys.slope))
        bad_input("the slope of the cone must be positive and finite");
    return std::make_shared<Cone>(name, keys);
}

}  // namespace rsc
