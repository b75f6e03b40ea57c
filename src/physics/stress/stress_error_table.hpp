// Written by input/trust/resolution.py from its study of grids four times finer; do not edit.
#pragma once

#include "contact/grid_bodies.hpp"

namespace rsc {

// Expected relative errors of the largest stresses at a depth of d pixels: factor
// border_share^power (1 + 2 d)^-deeper; of the tension, which may vanish, relative to the von Mises
// stress. The tension behind the edge of a sliding contact rises like the root of the distance, and
// so does its own error.
struct StressError {
    double factor, power, deeper;
    ClassFactors factors;
};
inline constexpr StressError kMisesError = {0.185, 1, 1, {1.5, 4.73, 2.48}};
inline constexpr StressError kShearError = {0.133, 1, 0.75, {2, 5.49, 3.52}};
inline constexpr StressError kTensionError = {0.114, 1, 1.5, {1, 1, 1.15}};
inline constexpr StressError kSlidingEdgeError = {0.466, 0.5, 1, {1, 1, 1}};

}  // namespace rsc
