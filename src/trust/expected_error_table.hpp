// Written by input/trust/trust.py from its study of asperities against elements; do not edit.
#pragma once

namespace rsc {

// ln of the bound = sum of coefficient times predictor, the first one 1: slope, pressed, overlap,
// elongation, crowding, few, coarse, plastic, flats.
inline constexpr int kErrorPredictors = 9;
inline constexpr double kLeastError = 0.003, kMostError = 1000.0;
inline constexpr double kErrorTable[3][2][kErrorPredictors + 1] = {
    // hertz, elliptic, fourth_order; N, A
    {{-1.902, 0.1859, 0, 0.3917, 0.2407, 0.5283, 1.755, 0.2953, 0.5, 0.4657},
     {-0.1284, 0.1283, 0, 0.3356, 0.06325, 1.199, 2.217, 0, 0.1009, 0.3234}},
    {{-1.051, 0.05486, 1.123, 0.02489, 0.06236, 0.9857, 0.1451, 0, 0.7, 0.4446},
     {-0.4135, 0.04459, 1.633, 0, 0.07103, 1.132, 1.517, 0, 0, 0.283}},
    {{-3.602, 0.0637, 0.8011, 0.2509, 0.5175, 0.6945, 1.087, 0.8649, 0.6, 0.5419},
     {-3.482, 0.08995, 1.403, 0.7325, 0.2273, 0.3006, 1.484, 0.9689, 0.6, 0.2608}},
};
// Factor of the bound for heights read from a file: N, A.
inline constexpr double kErrorOfFiles[3][2] = {
    {1, 1},
    {1.9, 1},
    {2.52, 1.55},
};

}  // namespace rsc
