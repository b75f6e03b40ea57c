// Written by input/trust/trust.py from its study of asperities against elements; do not edit.
// 528 surfaces.
// hertz: 289 levels fitted; of 196 others N is within the bound at 92 %, A at 94 %.
// elliptic: 287 levels fitted; of 196 others N is within the bound at 95 %, A at 96 %.
// fourth_order: 278 levels fitted; of 189 others N is within the bound at 97 %, A at 96 %.
#pragma once

namespace rsc {

// Fewest points in the shortest wave.
inline constexpr double kFewestPointsPerWave = 2.667;
// Upper ends of the bins of the mean contact radius over the mean spacing of summits.
inline constexpr double kRadii[] = {0.169, 0.219, 0.335};
// Relative errors of N and A, by bin, of the laws that were compared; factors of heights from a
// file or not isotropic and Gaussian, and of yielding contacts.
struct LawError {
    const char* law;
    double errors[2][3], of_files[2], of_yielding[2];
};
inline constexpr LawError kLawErrors[] = {
    {"hertz", {{0.247, 0.232, 0.314}, {0.289, 0.352, 0.61}}, {5, 2.87}, {1, 1}},
    {"elliptic", {{0.113, 0.171, 0.266}, {0.298, 0.466, 0.807}}, {1.1, 1.22}, {1.02, 1}},
    {"fourth_order", {{0.0801, 0.0607, 0.102}, {0.148, 0.141, 0.259}}, {2.15, 1.66}, {1.49, 1}},
};

}  // namespace rsc
