// Written by input/trust/trust.py from its study of asperities against elements; do not edit.
#pragma once

namespace rsc {

// Fewest points in the shortest wave.
inline constexpr double kFewestPointsPerWave = 2.667;
// Upper ends of the bins of the mean contact radius over the mean spacing of summits.
inline constexpr double kRadii[] = {0.17, 0.22, 0.363};
// Relative errors by law (hertz, elliptic, fourth_order), of N and A, by bin.
inline constexpr double kErrors[3][2][3] = {{{0.246, 0.246, 0.306}, {0.288, 0.375, 0.623}},
                                            {{0.113, 0.171, 0.255}, {0.295, 0.429, 0.773}},
                                            {{0.08, 0.0636, 0.102}, {0.147, 0.158, 0.241}}};
// Factors of heights from a file or not isotropic and Gaussian, and of yielding contacts.
inline constexpr double kOfFiles[3][2] = {{1.36, 1.21}, {1, 1.04}, {1.07, 1.44}};
inline constexpr double kOfYielding[3][2] = {{1, 1}, {1.06, 1}, {1.43, 1}};

}  // namespace rsc
