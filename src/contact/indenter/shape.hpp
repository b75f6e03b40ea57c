// The form of body 2, the indenter, behind one interface.
//
// A shape is the height s(x, y) of the indenter's face above its tip, at the offset (x, y) from the tip. With the tip at (x0, y0) and the
// separation Z0, the penetration of a point of the surface without interaction is g0 = z(x, y) - s(x - x0, y - y0) - Z0.
// A new shape is one file with a class derived from IndenterShape and one row of the table in shapes.hpp.
#pragma once

#include "std.hpp"

namespace rsc {

struct HeightMap;

struct Vec2 {
    double x = 0, y = 0;
};

// Second derivatives of a height.
struct Tensor {
    double xx = 0, xy = 0, yy = 0;
};

// Offsets from the tip: the rectangle x0 <= x <= x1, y0 <= y <= y1.
struct Box {
    double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

// Contact of the shape with a smooth half-space, for shapes with a power law in closed form: pressed in by u, it carries
// N = force_factor u^force_power on the area A = area_factor u^area_power.
struct SmoothContact {
    double force_factor = 0, force_power = 1, area_factor = 0, area_power = 0;
    double force(double u) const;
    double area_under(double force) const;  // at a force N >= 0
};

// The parameters of all shapes, as the keys of &indenter have them. A shape reads those that are its own.
struct ShapeKeys {
    double R = std::numeric_limits<double>::infinity();  // sphere: its radius [length]; Infinity: a flat
    double radii[2] = {0, 0};                            // paraboloid: principal radii [length]; Infinity is allowed
    double angle = 0;                                    // direction of the first of them from x [radian]
    double slope = 0;                                    // cone
    double radius = 0, rim_radius = 0;                   // punch: of its flat end, of its rounded rim [length]
    std::shared_ptr<const HeightMap> map;                // map: heights of body 2, upwards positive as body 1's are
    std::vector<std::string> told;                       // map: what was done to it, for the screen
};

class IndenterShape {
public:
    explicit IndenterShape(const char* name, const ShapeKeys& keys) : name_(name), keys_(keys) {}
    virtual ~IndenterShape() = default;

    const char* name() const { return name_; }                           // as &indenter shape spells it
    const ShapeKeys& keys() const { return keys_; }                      // what it was made from
    virtual std::string text(const std::string& length_unit) const = 0;  // for the screen: "sphere R = 2.5 mm"

    // s [length]; Infinity where the indenter does not reach.
    virtual double height(double x, double y) const = 0;
    // s at the offsets (x[k], y), k = 0 ... n-1.
    virtual void heights(int n, const double* x, double y, double* s) const {
        for (int k = 0; k < n; ++k) s[k] = height(x[k], y);
    }
    // Gradient and second derivatives of s, and nabla^4 s [1/length^3] for those laws that want it; where s is finite.
    virtual Vec2 gradient(double x, double y) const = 0;
    virtual Tensor curvature(double x, double y) const = 0;
    virtual double biharmonic(double x, double y) const { return (void)x, (void)y, 0.0; }

    // A lower bound of s over a rectangle of offsets.
    virtual double lowest(const Box& box) const = 0;
    // The tip moves by `way` [length]: an upper bound of how far s falls at any place where it is afterwards at most `drop`. Infinity:
    // not known.
    virtual double most_fallen(double way, double drop) const { return (void)way, (void)drop, std::numeric_limits<double>::infinity(); }
    // No point of the indenter lies further from the tip than this.
    virtual double reach() const { return std::numeric_limits<double>::infinity(); }

    // A plane: nothing depends on the tip's place.
    virtual bool flat() const { return false; }
    // True if s depends on the distance from the tip alone.
    virtual bool round() const { return false; }
    // The radius R of Hertz's sphere, where this is one; Infinity for a flat; NaN for any other shape.
    virtual double hertz_radius() const { return std::numeric_limits<double>::quiet_NaN(); }
    // True if the shape repeats with the periods (x, y), so that it may be one of two periodic flats.
    virtual bool repeats(double x, double y) const { return (void)x, (void)y, false; }

    // The smooth indenter on a smooth half-space of modulus E*; empty where no closed form is known.
    virtual std::optional<SmoothContact> smooth(double E_star) const { return (void)E_star, std::nullopt; }
    // The closed curve on which s = `height` > 0, as offsets from the tip; empty where it is not one closed curve.
    virtual std::vector<Vec2> outline(double height) const { return (void)height, std::vector<Vec2>{}; }

private:
    const char* name_;
    ShapeKeys keys_;
};

// A shape as a value, shared between all who have it. Made from a number it is the sphere of that radius, Infinity being a flat. Throws
// Error(bad_input) for a radius that is not positive.
class Shape {
public:
    Shape() = default;  // none yet
    Shape(double R);
    Shape(std::shared_ptr<const IndenterShape> shape) : shape_(std::move(shape)) {}
    const IndenterShape* operator->() const { return shape_.get(); }
    explicit operator bool() const { return shape_ != nullptr; }

private:
    std::shared_ptr<const IndenterShape> shape_;
};

// The outline of a shape of revolution: a circle.
std::vector<Vec2> circle(double radius);

}  // namespace rsc
