// Frictionless contact of the axisymmetric profile z = A (1 - J0(q r)), that of waves of one length from all directions (Sneddon, Int. J.
// Eng. Sci. 3, 1965, 47): delta = A (1 - cos(q a)), P = 2 E* A [sin(q a)/q - a cos(q a)], dP = 2 E* a ddelta. With the curvature at its top,
// kappa = A q^2/2, everything over its value for the paraboloid of that curvature, sqrt(delta/kappa) and so on, is a function of
//     t = q^2 delta/(4 kappa) = sin^2(q a/2)
// alone; q^2 < 0 makes cosh and sinh of cos and sin. t = 1 is the contact that reaches the profile's trough, q a = pi.
#pragma once

#include "std.hpp"

namespace rsc {

class BesselProfile {
public:
    struct Shape {
        double radius;  // a/sqrt(delta/kappa)
        double load;    // P/[(4/3) E* delta^(3/2)/sqrt(kappa)]
        double work;    // of int P ddelta, over [(8/15) E* delta^(5/2)/sqrt(kappa)]
    };

    // The functions for t <= 1, relative errors below 3e-14. Tabulated where contacts are: they are the solver's innermost loop.
    Shape at(double t) const;
    double load(double t) const;
    double radius(double t) const;

    static const BesselProfile& table();

private:
    BesselProfile();

    // Polynomials on cells 1/32 wide, of t up to kMiddle, and beyond it of w = sqrt(1 - t) = cos(q a/2): in t the functions have a root's
    // singularity at 1, thirty half cells from the last one.
    static constexpr double kFirst = -1, kMiddle = 0.5, kCellsPerUnit = 32;
    static constexpr int kCellsOfT = 48, kCells = kCellsOfT + 23, kTerms = 9;
    using Polynomial = std::array<double, kTerms>;
    struct Cell {
        Polynomial radius, load, work;
    };
    struct Place {
        const Cell* cell;
        double s;  // -1 to 1
    };
    Place place(double t) const;
    std::array<Cell, kCells> cells_;
};

}  // namespace rsc
