// Written by input/trust/trust.py from its study of asperities against elements; do not edit.
#pragma once

namespace rsc {

// ln of the bound = sum of coefficient times predictor, the first one 1: slope, pressed, overlap, elongation, crowding, few, coarse, plastic, flats.
inline constexpr int kErrorPredictors = 9;
inline constexpr double kLeastError = 0.003, kMostError = 1000.0;
inline constexpr double kErrorTable[3][2][kErrorPredictors + 1] = {
    // hertz, elliptic, fourth_order; N, A
    {{-1.901, 0.1864, 0, 0.3905, 0.2406, 0.5286, 1.752, 0.2964, 2.592, 0.4653},
     {-0.1284, 0.1283, 0, 0.3356, 0.06325, 1.199, 2.217, 0, 0.1009, 0.3234}},
    {{-1.027, 0.07108, 1.022, 0.01297, 0.05958, 0.9789, 0.1224, 0, 2.279, 0.4387},
     {-0.1197, 0.02712, 1.115, 0, 0.1019, 1.271, 1.644, 0, 0, 0.2938}},
    {{-3.632, 0.05233, 0.9495, 0.09238, 0.3162, 0.4287, 0.6336, 0.7747, 5.482, 0.5407},
     {-3.24, 0.1283, 1.557, 0.2839, 0.1715, 0.2132, 1.106, 0.6437, 3.853, 0.2624}},
};

}  // namespace rsc
