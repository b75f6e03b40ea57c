// Stresses in the rough body below its surface: the tensor and what is read off it. z points into
// the body, from 0 at its undeformed surface; tension is positive.
#pragma once

#include "base/std.hpp"

namespace rsc {

struct StressTensor {
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;  // [force/length^2]

    StressTensor& operator+=(const StressTensor& other);
    StressTensor operator*(double factor) const;
};

// Quantities of a tensor on which yielding and fracture depend [force/length^2].
struct StressMeasures {
    double mises = 0;    // von Mises's equivalent stress
    double shear = 0;    // largest shear stress, half of Tresca's
    double tension = 0;  // largest principal stress; negative where all are compressive
};
StressMeasures measures_of(const StressTensor& s);

// Largest measures on a plane and where they are.
struct LargestStress {
    struct Value {
        double value = std::numeric_limits<double>::quiet_NaN();  // [force/length^2]
        double x = value, y = value;                              // [length]
        double error = value;  // expected, relative (trust/grid_error.hpp); NaN: none is stated

        // Keeps the larger value, the first of equal ones.
        void take(double other, double x_, double y_);
    };
    Value mises, shear, tension;
    void take(const StressMeasures& m, double x, double y);
    void take(const LargestStress& other);
};

// Tangential traction per unit of pressure in full slip: the friction coefficient times the
// direction in which body 2 slides.
struct SlidingTraction {
    double x = 0, y = 0;
    bool any() const { return x != 0 || y != 0; }
};

}  // namespace rsc
