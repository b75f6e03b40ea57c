// Flat-ended round punch with a sharp or rounded rim: s = 0 up to the radius a, s = r - sqrt(r^2 -
// (rho - a)^2) up to a + r.

#include "base/error.hpp"
#include "physics/indenter/shapes.hpp"

namespace rsc {
namespace {

class Punch final : public IndenterShape {
public:
    Punch(const char* name, const ShapeKeys& keys)
        : IndenterShape(name, keys), a_(keys.radius), r_(keys.rim_radius) {}

    std::string text(const std::string& unit) const override {
        return format(r_ > 0 ? "flat punch of radius %g %s, its rim rounded by %g"
                             : "flat punch of radius %g %s",
                      a_, unit.c_str(), r_);
    }
    double height(double x, double y) const override {
        const double t = beyond(x, y);
        if (t <= 0) return 0;
        return t > r_ ? kInfinity : t * t / (r_ + std::sqrt(r_ * r_ - t * t));
    }
    Vec2 gradient(double x, double y) const override {
        const double t = beyond(x, y), rho = std::sqrt(x * x + y * y);
        if (!(t > 0)) return {};
        const double slope = t / std::sqrt(r_ * r_ - t * t);
        return {slope * x / rho, slope * y / rho};
    }
    Tensor curvature(double x, double y) const override {
        const double t = beyond(x, y), rho = std::sqrt(x * x + y * y);
        if (!(t > 0)) return {};
        const double up2 = r_ * r_ - t * t, along = r_ * r_ / (up2 * std::sqrt(up2)),
                     round = t / std::sqrt(up2) / rho;
        const double ex = x / rho, ey = y / rho;
        return {along * ex * ex + round * ey * ey, (along - round) * ex * ey,
                along * ey * ey + round * ex * ex};
    }
    double lowest(const Box& box) const override {
        return height(std::clamp(0.0, box.x0, box.x1), std::clamp(0.0, box.y0, box.y1));
    }
    double reach() const override { return a_ + r_; }
    double edge(double blunt) const override { return r_ < blunt ? a_ : -1; }
    // Sharp rim only: N = 2 E* a u over the whole flat end.
    std::optional<SmoothContact> smooth(double E_star) const override {
        if (r_ > 0) return std::nullopt;
        return SmoothContact{2 * E_star * a_, 1, pi * a_ * a_, 0};
    }
    std::vector<Vec2> outline(double height) const override {
        return circle(a_ +
                      (height < r_ ? std::sqrt(std::max(0.0, height * (2 * r_ - height))) : r_));
    }

private:
    // Distance outside the flat end.
    double beyond(double x, double y) const { return std::sqrt(x * x + y * y) - a_; }

    double a_, r_;
};

}  // namespace

std::shared_ptr<const IndenterShape> make_punch(const char* name, const ShapeKeys& keys) {
    if (!(keys.radius > 0) || std::isinf(keys.radius))
        bad_input("the radius of the punch must be positive and finite");
    if (!(keys.rim_radius >= 0) || std::isinf(keys.rim_radius))
        bad_input("the rim_radius of the punch must be finite and not negative (0: sharp)");
    return std::make_shared<Punch>(name, keys);
}

}  // namespace rsc
