// Written by input/trust/trust.py from its study of asperities against elements; do not edit.
// 528 surfaces.
// hertz: 289 levels fitted; of 196 others N is within the bound at 90 %, A at 93 %.
// elliptic: 287 levels fitted; of 196 others N is within the bound at 95 %, A at 95 %.
// fourth_order: 278 levels fitted; of 189 others N is within the bound at 96 %, A at 96 %.
#pragma once

namespace rsc {

// Fewest points in the shortest wave.
inline constexpr double kFewestPointsPerWave = 2.667;
// Upper ends of the bins of the mean contact radius over the mean spacing of summits.
inline constexpr double kRadii[] = {0.169, 0.219, 0.335};
// Relative errors by law (hertz, elliptic, fourth_order), of N and A, by bin.
inline constexpr double kErrors[3][2][3] = {{{0.247, 0.232, 0.314}, {0.289, 0.352, 0.61}},
                                            {{0.113, 0.171, 0.266}, {0.298, 0.466, 0.807}},
                                            {{0.0801, 0.0607, 0.102}, {0.148, 0.141, 0.259}}};
// Factors of heights from a file or not isotropic and Gaussian, and of yielding contacts.
inline constexpr double kOfFiles[3][2] = {{1.36, 1.3}, {1, 1}, {1.11, 1.51}};
inline constexpr double kOfYielding[3][2] = {{1, 1}, {1.02, 1}, {1.49, 1}};

}  // namespace rsc
