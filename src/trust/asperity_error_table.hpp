// Written by input/trust/trust.py from its study of asperities against elements; do not edit.
#pragma once

namespace rsc {

// Fewest points in the shortest wave.
inline constexpr double kFewestPointsPerWave = 2.667;
// Upper ends of the bins of the mean contact radius over the mean spacing of summits.
inline constexpr double kRadii[] = {0.175, 0.225, 0.377};
// Relative errors by law (hertz, elliptic, fourth_order), of N and A, by bin.
inline constexpr double kErrors[3][2][3] = {{{0.244, 0.246, 0.307}, {0.289, 0.402, 0.632}},
                                            {{0.114, 0.172, 0.248}, {0.307, 0.463, 0.777}},
                                            {{0.0807, 0.054, 0.0994}, {0.181, 0.142, 0.269}}};
// Factors of heights from a file or not isotropic and Gaussian, and of yielding contacts.
inline constexpr double kOfFiles[3][2] = {{1.08, 1.4}, {1, 1.28}, {1, 1.13}};
inline constexpr double kOfYielding[3][2] = {{1, 1}, {1.06, 1}, {1.6, 1}};

}  // namespace rsc
