// Written by input/trust/trust.py from its study of asperities against elements; do not edit.
#pragma once

namespace rsc {

// ln of the bound = sum of coefficient times predictor, the first one 1: slope, pressed, overlap, elongation, crowding, few, coarse, plastic, flats.
inline constexpr int kErrorPredictors = 9;
inline constexpr double kLeastError = 0.003, kMostError = 1000.0;
inline constexpr double kErrorTable[3][2][kErrorPredictors + 1] = {
    // hertz, elliptic, fourth_order; N, A
    {{-1.902, 0.1859, 0, 0.3917, 0.2407, 0.5283, 1.755, 0.2953, 2.595, 0.4657},
     {-0.1284, 0.1283, 0, 0.3356, 0.06325, 1.199, 2.217, 0, 0.1009, 0.3234}},
    {{-1.068, 0.04496, 1.172, 0.02305, 0.06634, 0.9883, 0.1742, 0, 2.313, 0.4339},
     {-0.1197, 0.02712, 1.115, 0, 0.1019, 1.271, 1.644, 0, 0, 0.2938}},
    {{-3.58, 0.03158, 0.8847, 0.1564, 0.3745, 0.5008, 0.8152, 0.6652, 5.326, 0.5767},
     {-3.561, 0.07363, 1.402, 1.023, 0.1895, 0.1738, 1.372, 0.8828, 3.929, 0.2901}},
};
// Factor of the bound for heights read from a file: N, A.
inline constexpr double kErrorOfFiles[3][2] = {
    {1, 1},
    {1.77, 1},
    {2.9, 1.6},
};

}  // namespace rsc
