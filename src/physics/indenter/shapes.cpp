#include "contact/shape.hpp"

#include "physics/indenter/shapes.hpp"

namespace rsc {

double SmoothContact::force(double u) const { return force_factor * std::pow(u, force_power); }

double SmoothContact::depth_under(double force) const {
    return std::pow(force / force_factor, 1 / force_power);
}
double SmoothContact::area_under(double force) const {
    return area_factor * std::pow(force / force_factor, area_power / force_power);
}

Shape::Shape(double R) {
    ShapeKeys keys;
    keys.R = R;
    *this = make_shape(0, keys);
}

Shape make_shape(int shape, const ShapeKeys& keys) {
    const ShapeRow& row = kShapes.at(at(shape));
    return row.make(row.name, keys);
}

int shape_number(const char* name) {
    const auto row = std::ranges::find_if(
        kShapes, [name](const ShapeRow& r) { return std::strcmp(r.name, name) == 0; });
    return int(row - kShapes.begin());
}

std::vector<Vec2> circle(double radius) {
    constexpr int points = 180;
    std::vector<Vec2> curve;
    for (const int k : indices(points)) {
        const double t = 2 * pi * k / points;
        curve.push_back({radius * std::cos(t), radius * std::sin(t)});
    }
    return curve;
}

}  // namespace rsc
