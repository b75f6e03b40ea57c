// Asperities: summits with their curvatures (paper, section 3), and the bounds of numbers.
#pragma once

#include "base/std.hpp"

namespace rsc {

// Bounds of all input numbers. Moments and forces are products of powers of lengths and moduli;
// beyond these bounds they could overflow a double, whatever the units.
inline constexpr double kLargestNumber = 1e50;
inline constexpr const char* kNumberBounds = "must be finite and at most 1e50";
inline constexpr const char* kPositiveBounds = "must be from 1e-50 to 1e50";

// Bounds for numbers of either sign, 0 included, and for positive ones.
inline bool usable(double v) noexcept { return std::abs(v) <= kLargestNumber; }  // false for NaN
inline bool usable_positive(double v) noexcept {
    return v >= 1 / kLargestNumber && v <= kLargestNumber;
}

enum class Curvature { geometric, algebraic };
inline constexpr std::array kCurvatureNames = {"geometric", "algebraic"};

// Structure of arrays, one entry for each asperity. x, y, z [length] and radius [length] are
// required; the others are empty if the asperities were given without curvatures.
struct Asperities {
    std::vector<double> x, y, z, radius;
    std::vector<double> kappa1, kappa2;  // principal curvatures, kappa1 >= kappa2 > 0 [1/length]
    // Direction of the kappa2 axis (the long axis of the contact ellipse) from x, in (-pi/2, pi/2].
    std::vector<double> angle;
    // Nabla^4 z at the summit [1/length^3]; with a lay, or one summit alone, that of the round
    // profile equivalent to an elongated summit; empty unless a law needs it.
    std::vector<double> biharmonic;

    std::size_t size() const { return x.size(); }
};

// Description of a column of Asperities.
struct AsperityColumn {
    const char* name;
    std::vector<double> Asperities::*values;
    bool required;     // otherwise it may be empty
    int length_power;  // power of the length in its unit; the angle is in radians
    const char* meaning;
};
inline constexpr std::array<AsperityColumn, 8> kAsperityColumns{{
    {"x", &Asperities::x, true, 1, "x of the summit"},
    {"y", &Asperities::y, true, 1, "y of the summit"},
    {"z", &Asperities::z, true, 1, "height of the summit"},
    {"radius", &Asperities::radius, true, 1, "radius of the asperity"},
    {"kappa1", &Asperities::kappa1, false, -1, "larger principal curvature, positive for a peak"},
    {"kappa2", &Asperities::kappa2, false, -1, "smaller principal curvature, positive for a peak"},
    {"angle", &Asperities::angle, false, 0,
     "direction of the axis of kappa2, the long axis of the contact ellipse, from x"},
    {"biharmonic", &Asperities::biharmonic, false, -3,
     "biharmonic of the height at the summit, nabla^4 z"},
}};

// The asperities with these indices, in this order; and their replacement by others.
Asperities selected(const Asperities& all, const std::vector<std::size_t>& which);
void replace(Asperities& all, const std::vector<std::size_t>& which, const Asperities& some);

// The indices, in order, of two asperities with the same (x, y), if there are any: they would count
// one contact twice.
std::optional<std::pair<std::size_t, std::size_t>> coincident(const Asperities& asperities);

// Checks asperities given by the user. Throws Error(bad_input) unless there is at least one
// asperity, all non-empty arrays have the same length (kappa1, kappa2 and angle are given
// together), all values are finite, all radii are positive, kappa1 >= kappa2 > 0, and no two
// asperities have the same (x, y). `name(i)` returns the name of asperity i for messages.
void validate(const Asperities& asperities, const std::function<std::string(std::size_t)>& name);

}  // namespace rsc
