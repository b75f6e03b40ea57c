// The numbers rsc works with. Moments and forces are made of squares and powers of lengths and moduli: beyond these bounds they would
// overflow a double, whatever the units.
#pragma once

#include "std.hpp"

namespace rsc {

inline constexpr double kLargestNumber = 1e50;
inline constexpr const char* kNumberBounds = "must be finite, 1e50 at most";
inline constexpr const char* kPositiveBounds = "must be from 1e-50 to 1e50";

// A number that may be 0, of either sign; so small a one is as good as 0.
inline bool usable(double v) noexcept { return std::abs(v) <= kLargestNumber; }  // false for NaN
inline bool usable_positive(double v) noexcept { return v >= 1 / kLargestNumber && v <= kLargestNumber; }

// Asperities: summits with their curvatures (paper, section 3).

enum class Curvature { geometric, algebraic };
inline constexpr std::array kCurvatureNames = {"geometric", "algebraic"};

// Structure of arrays, one entry an asperity. x, y, z [length] and radius [length] are always there; the rest is empty when
// the asperities were given without curvatures.
struct Asperities {
    std::vector<double> x, y, z, radius;
    std::vector<double> kappa1, kappa2;  // principal curvatures, kappa1 >= kappa2 > 0 [1/length]
    std::vector<double> angle;           // direction of the kappa2 axis (the long axis of the contact ellipse) from x, in (-pi/2, pi/2]
    std::vector<double> biharmonic;      // nabla^4 z at the summit [1/length^3]; empty unless a law needs it
    std::size_t size() const { return x.size(); }
};

// The columns of Asperities, for code that treats all of them alike.
struct AsperityColumn {
    const char* name;
    std::vector<double> Asperities::*values;
    bool required;     // otherwise it may be empty
    int length_power;  // of its unit; the angle is in radian
    const char* meaning;
};
inline constexpr std::array<AsperityColumn, 8> kAsperityColumns{{
    {"x", &Asperities::x, true, 1, "x of the summit"},
    {"y", &Asperities::y, true, 1, "y of the summit"},
    {"z", &Asperities::z, true, 1, "height of the summit"},
    {"radius", &Asperities::radius, true, 1, "radius of the asperity"},
    {"kappa1", &Asperities::kappa1, false, -1, "larger principal curvature, positive for a peak"},
    {"kappa2", &Asperities::kappa2, false, -1, "smaller principal curvature, positive for a peak"},
    {"angle", &Asperities::angle, false, 0, "direction of the axis of kappa2, the long axis of the contact ellipse, from x"},
    {"biharmonic", &Asperities::biharmonic, false, -3, "biharmonic of the height at the summit, nabla^4 z"},
}};

// Checks asperities given by the user: throws Error(bad_input) unless there is at least one, all arrays that are not empty have
// the same length (kappa1, kappa2 and angle together), all values are finite, radii positive, kappa1 >= kappa2 > 0 and no two lie at
// the same (x, y). `name(i)` says in the message which one is meant.
void validate(const Asperities& asperities, const std::function<std::string(std::size_t)>& name);

}  // namespace rsc
