// Interface of the shape of body 2, the indenter.
//
// A shape defines the height s(x, y) of the indenter's face above its tip, at the offset (x, y)
// from the tip. With the tip at (x0, y0) and the separation Z0, the penetration of a point of the
// surface without interaction is g0 = z(x, y)
// - s(x - x0, y - y0) - Z0. A new shape
// requires one file with a class derived from IndenterShape and one row in the table of shapes.hpp.
#pragma once

#include "base/std.hpp"

namespace rsc {

struct HeightMap;

struct Vec2 {
    double x = 0, y = 0;
};

// Second derivatives of a height.
struct Tensor {
    double xx = 0, xy = 0, yy = 0;
};

// Rectangle of offsets from the tip: x0 <= x <= x1, y0 <= y <= y1.
struct Box {
    double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

// Contact with a smooth half-space, for shapes with a closed-form power law: at the penetration u,
// N = force_factor u^force_power and A = area_factor u^area_power.
struct SmoothContact {
    double force_factor = 0, force_power = 1, area_factor = 0, area_power = 0;
    double force(double u) const;
    double depth_under(double force) const;  // u at a force N >= 0
    double area_under(double force) const;   // contact area at a force N >= 0
};

// Parameters of all shapes (keys of &indenter). Each shape uses its own.
struct ShapeKeys {
    double R = kInfinity;        // sphere: its radius [length]; Infinity: a flat; < 0: concave
    double R_rough = kInfinity;  // sphere: the radius of body 1, alike
    double radii[2] = {0, 0};    // paraboloid: principal radii [length]; Infinity is allowed
    double angle = 0;            // direction of the first from x [radian]
    double slope = 0;            // cone
    double radius = 0,
           rim_radius = 0;  // punch: radii of its flat end and of its rounded rim [length]
    std::shared_ptr<const HeightMap>
        map;  // map: heights of body 2, positive upwards like those of body 1
    // map: mean distance of its summits, its shortest wave [length]; 0: unknown
    double spacing = 0, shortest_wave = 0;
    double m2 = 0;  // map: Moments::m2 of its differences, without those across its border
    std::vector<std::uint8_t>
        filled;  // map: 1 at j*nx + i where a point was missing; empty if none was
    std::vector<std::string> report;  // map: report of its processing for the screen
};

class IndenterShape {
public:
    explicit IndenterShape(const char* name, const ShapeKeys& keys) : name_(name), keys_(keys) {}
    virtual ~IndenterShape() = default;

    const char* name() const { return name_; }       // name in &indenter shape
    const ShapeKeys& keys() const { return keys_; }  // its parameters
    virtual std::string text(
        const std::string& length_unit) const = 0;  // for the screen: "sphere R = 2.5 mm"

    // s [length]; Infinity outside the indenter.
    virtual double height(double x, double y) const = 0;
    // s at the offsets (x[k], y), k = 0 ... n-1.
    virtual void heights(int n, const double* x, double y, double* s) const {
        for (const int k : indices(n)) s[k] = height(x[k], y);
    }
    // Gradient and second derivatives of s where s is finite, and nabla^4 s [1/length^3] for laws
    // that need it.
    virtual Vec2 gradient(double x, double y) const = 0;
    virtual Tensor curvature(double x, double y) const = 0;
    virtual double biharmonic(double x, double y) const { return (void)x, (void)y, 0.0; }

    // Lower bound of s over a rectangle of offsets.
    virtual double lowest(const Box& box) const = 0;
    // Upper bound of the decrease of s, when the tip moves by `way` [length], at any point where s
    // is at most `drop` afterwards. Infinity: unknown.
    virtual double most_fallen(double way, double drop) const {
        return (void)way, (void)drop, kInfinity;
    }
    // Largest distance of points of the indenter from the tip.
    virtual double reach() const { return kInfinity; }

    // True for a plane: nothing depends on the position of the tip.
    virtual bool flat() const { return false; }
    // Radius of the circle about the tip on which the face bends with a radius below `blunt`
    // [length], so that it may press where the surface has no summit; 0: a corner at the tip;
    // negative: none.
    virtual double edge(double blunt) const { return (void)blunt, -1.0; }
    // Radius R* of one sphere or two; Infinity for a flat; NaN for any other shape.
    virtual double hertz_radius() const { return std::numeric_limits<double>::quiet_NaN(); }
    // True if the shape has the periods (x, y), so that it can be one of two periodic flats, or of
    // the one that is finite, for line contact.
    virtual bool repeats(double x, double y) const { return (void)x, (void)y, false; }

    // Contact with a smooth half-space of modulus E*; empty if no closed form is known.
    virtual std::optional<SmoothContact> smooth(double E_star) const {
        return (void)E_star, std::nullopt;
    }
    // Closed contour s = `height` > 0 as offsets from the tip; empty unless the contour is one
    // closed curve.
    virtual std::vector<Vec2> outline(double height) const {
        return (void)height, std::vector<Vec2>{};
    }

private:
    const char* name_;
    ShapeKeys keys_;
};

// Shared handle of an IndenterShape. Constructed from a number it is a sphere of that radius
// (Infinity: flat); throws Error(bad_input) unless the radius is positive.
class Shape {
public:
    Shape() = default;  // empty
    Shape(double R);
    Shape(std::shared_ptr<const IndenterShape> shape) : shape_(std::move(shape)) {}
    const IndenterShape* operator->() const { return shape_.get(); }
    explicit operator bool() const { return shape_ != nullptr; }

private:
    std::shared_ptr<const IndenterShape> shape_;
};

// Contour of a shape of revolution: a circle.
std::vector<Vec2> circle(double radius);

}  // namespace rsc
