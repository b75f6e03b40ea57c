// Written by input/trust/trust.py from its study of asperities against elements; do not edit.
#pragma once

namespace rsc {

// ln of the bound = sum of coefficient times predictor, the first one 1: slope, beyond, overlap, elongation, crowding, few, coarse, plastic, flats.
inline constexpr int kErrorPredictors = 9;
inline constexpr double kLeastError = 0.003, kMostError = 1000.0;
inline constexpr double kErrorTable[3][2][kErrorPredictors + 1] = {
    // hertz, elliptic, fourth_order; N, A
    {{-1.843, 0.186, 0, 0.3964, 0.2301, 0.5269, 1.753, 0.2423, 2.585, 0.4524},
     {-0.1284, 0.1283, 0, 0.3356, 0.06325, 1.199, 2.217, 0, 0.1009, 0.3234}},
    {{-2.026, 0, 0, 0.3103, 0.09822, 0.3067, 0.5821, 0.3031, 0.7287, 0.3373}, {-1.366, 0, 0, 0.6262, 0.1146, 0.1535, 0.2573, 0.508, 0, 0}},
    {{-3.389, 0.06129, 1.559, 0, 0.2939, 0.2392, 1.127, 0.1998, 1.012, 0.6701},
     {-3.04, 0.06963, 1.297, 0.2234, 0.3243, 0.1522, 1.244, 0.9445, 0, 0.207}},
};

}  // namespace rsc
