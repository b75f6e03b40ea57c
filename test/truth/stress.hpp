// Stresses under point forces on a half-space, and sums of them over a loaded region: slow, and
// nothing of it is shared with src/physics/stress.
#pragma once

#include "check.hpp"

namespace truth {

using Tensor = std::array<double, 6>;  // xx, yy, zz, xy, xz, yz

// Johnson (1985), equations 3.18 and 3.76, in forms without a singularity on the axis: a force 1
// into the body (along 2), or along x (0) or y (1), at the origin; z > 0 is the depth.
inline Tensor point_force(int along, double x, double y, double z, double nu) {
    const double R = std::sqrt(x * x + y * y + z * z), R2 = R * R, R3 = R2 * R, R5 = R3 * R2;
    const double s = R + z, w = 1 - 2 * nu, pi2 = 2 * pi;
    if (along == 2) {
        const double bent = (2 * R + z) / (R3 * s * s), plain = z / R3 - 1 / (R * s);
        return {(-3 * x * x * z / R5 + w * (plain + x * x * bent)) / pi2,
                (-3 * y * y * z / R5 + w * (plain + y * y * bent)) / pi2,
                -3 * z * z * z / R5 / pi2,
                (-3 * x * y * z / R5 + w * x * y * bent) / pi2,
                -3 * x * z * z / R5 / pi2,
                -3 * y * z * z / R5 / pi2};
    }
    if (along == 1) {
        const Tensor t = point_force(0, y, x, z, nu);
        return {t[1], t[0], t[2], t[3], t[5], t[4]};
    }
    const double first = 1 / (R * s * s), second = 1 / (R3 * s * s), third = 2 / (R2 * s * s * s);
    return {
        (-3 * x * x * x / R5 + w * (x / R3 - 3 * x * first + x * x * x * (second + third))) / pi2,
        (-3 * x * y * y / R5 + w * (x / R3 - x * first + x * y * y * (second + third))) / pi2,
        -3 * x * z * z / R5 / pi2,
        (-3 * x * x * y / R5 + w * (-y * first + x * x * y * (second + third))) / pi2,
        -3 * x * x * z / R5 / pi2,
        -3 * x * y * z / R5 / pi2};
}

// Under the tractions (qx, qy, p) on the rectangle |x| < a, |y| < b, by the midpoint rule with n
// points along each side: an error of second order.
inline Tensor rectangle(double x, double y, double z, double a, double b, double nu,
                        std::array<double, 3> traction, int n) {
    Tensor sum{};
    for (const int i : indices(n))
        for (const int j : indices(n))
            for (const int along : indices(3)) {
                const Tensor t = point_force(along, x + a - 2 * a * (i + 0.5) / n,
                                             y + b - 2 * b * (j + 0.5) / n, z, nu);
                for (std::size_t c = 0; c < 6; ++c)
                    sum[c] += traction[along] * t[c] * 4 * a * b / n / n;
            }
    return sum;
}

}  // namespace truth
