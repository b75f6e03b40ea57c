// Frictionless contact of the axisymmetric profile z = A (1 - J0(q r)), the sum of waves of one
// length in all directions (Sneddon, Int. J. Eng. Sci. 3, 1965, 47): delta = A (1 - cos(q a)), P =
// 2 E* A [sin(q a)/q - a cos(q a)], dP = 2 E* a ddelta. Relative to the paraboloid with the same
// curvature kappa = A q^2/2 at the top, all quantities are functions of
//     t = q^2 delta/(4 kappa) = sin^2(q a/2)
// only; for q^2 < 0, cos and sin become cosh and sinh. At t = 1 the contact reaches the trough of
// the profile, q a = pi.
#pragma once

#include "base/std.hpp"

namespace rsc {

class BesselProfile {
public:
    template <class T>
    struct Values {
        T radius;  // a/sqrt(delta/kappa)
        T load;    // P/[(4/3) E* delta^(3/2)/sqrt(kappa)]
        T work;    // int P ddelta/[(8/15) E* delta^(5/2)/sqrt(kappa)]
    };
    using Shape = Values<double>;

    // Functions for t <= 1, with relative errors below 3e-14. They are tabulated in the usual
    // range, because they are the innermost loop of the solver.
    Shape at(double t) const;

    static const BesselProfile& table();

private:
    BesselProfile();

    // Polynomials on cells of width 1/32: in t up to kMiddle, and beyond in w = sqrt(1 - t) = cos(q
    // a/2), because the functions of t have a square-root singularity at 1.
    static constexpr double kFirst = -1, kMiddle = 0.5, kCellsPerUnit = 32;
    static constexpr int kCellsOfT = 48, kCells = kCellsOfT + 23, kTerms = 9;
    using Polynomial = std::array<double, kTerms>;
    struct Cell {
        Polynomial radius, load, work;
    };
    std::array<Cell, kCells> cells_;
};

}  // namespace rsc
