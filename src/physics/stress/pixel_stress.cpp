#include "physics/stress/pixel_stress.hpp"

namespace rsc {
namespace {

// Integrals of the kernels of point forces over both coordinates, with R^2 = x^2 + y^2 + z^2. Terms
// that depend on one coordinate only are left out: they cancel in the alternating sum.
struct Corner {
    double x, y, z, R, xz2, yz2;  // xz2 = x^2 + z^2
    double solid_angle;           // of z/R^3
    double log;                   // ln(R + z)

    Corner(double x_, double y_, double z_)
        : x(x_),
          y(y_),
          z(z_),
          R(std::sqrt(x * x + y * y + z * z)),
          xz2(x * x + z * z),
          yz2(y * y + z * z),
          solid_angle(std::atan2(x * y, z * R)),
          log(std::log(R + z)) {}

    // Of d^2 ln(R + z)/dx^2; the one of d^2/dy^2 is the solid angle less this one.
    double bent_x() const { return std::atan2(x * y * (R - z), x * x * R + z * y * y); }
};

// Of 3 x^2 z/R^5, with s2 = x^2 + z^2.
double pressed_along(const Corner& c, double s2) {
    return c.solid_angle - c.z * c.x * c.y / (c.R * s2);
}

StressTensor under_pressure(const Corner& c, double nu) {
    const double bent = c.bent_x(), weight = 1 - 2 * nu;
    StressTensor s;
    s.xx = -pressed_along(c, c.xz2) + weight * (c.solid_angle - bent);
    s.yy = -pressed_along(c, c.yz2) + weight * bent;
    s.zz = -c.solid_angle - c.z * c.x * c.y * (c.R * c.R + c.z * c.z) / (c.R * c.xz2 * c.yz2);
    s.xy = -c.z / c.R - weight * c.log;
    s.xz = c.z * c.z * c.y / (c.R * c.xz2);
    s.yz = c.z * c.z * c.x / (c.R * c.yz2);
    return s;
}

// Under a traction of 1 along x.
StressTensor under_traction(const Corner& c, double nu) {
    const double weight = 1 - 2 * nu;
    const double log_y = std::asinh(c.y / std::sqrt(c.xz2));
    const double log_x = std::asinh(c.x / std::sqrt(c.yz2));
    StressTensor s;
    s.xx = 2 * log_y + c.x * c.x * c.y / (c.R * c.xz2) - weight * c.y / (c.R + c.z);
    s.yy = log_y - c.y / c.R + weight * (c.y / (c.R + c.z) - log_y);
    s.zz = c.z * c.z * c.y / (c.R * c.xz2);
    s.xy = log_x - c.x / c.R + weight * c.x / (c.R + c.z);
    s.xz = -pressed_along(c, c.xz2);
    s.yz = -c.z / c.R;
    return s;
}

StressTensor exchanged(const StressTensor& s) { return {s.yy, s.xx, s.zz, s.xy, s.yz, s.xz}; }

}  // namespace

StressTensor corner_stress(double x, double y, double z, double nu,
                           const SlidingTraction& sliding) {
    const Corner corner(x, y, z);
    StressTensor s = under_pressure(corner, nu);
    if (sliding.x != 0) s += under_traction(corner, nu) * sliding.x;
    if (sliding.y != 0) s += exchanged(under_traction(Corner(y, x, z), nu)) * sliding.y;
    return s * (0.5 / pi);
}

StressTensor pixel_stress(double x, double y, double z, double a, double b, double nu,
                          const SlidingTraction& sliding) {
    StressTensor s = corner_stress(x + a, y + b, z, nu, sliding);
    s += corner_stress(x + a, y - b, z, nu, sliding) * -1;
    s += corner_stress(x - a, y + b, z, nu, sliding) * -1;
    s += corner_stress(x - a, y - b, z, nu, sliding);
    return s;
}

}  // namespace rsc
