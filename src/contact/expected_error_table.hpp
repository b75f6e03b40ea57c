// Written by input/trust/trust.py from its study of asperities against elements; do not edit.
#pragma once

namespace rsc {

// ln of the bound = sum of coefficient times predictor, the first one 1: slope, pressed, overlap, elongation, crowding, few, coarse, plastic, flats.
inline constexpr int kErrorPredictors = 9;
inline constexpr double kLeastError = 0.003, kMostError = 1000.0;
inline constexpr double kErrorTable[3][2][kErrorPredictors + 1] = {
    // hertz, elliptic, fourth_order; N, A
    {{-1.843, 0.186, 0, 0.3964, 0.2301, 0.5269, 1.753, 0.2423, 2.585, 0.4524},
     {-0.1284, 0.1283, 0, 0.3356, 0.06325, 1.199, 2.217, 0, 0.1009, 0.3234}},
    {{-0.9487, 0.07021, 0.9738, 0.06472, 0.04854, 0.992, 0.08505, 0, 2.225, 0.4184},
     {-0.007244, 0.07474, 1.094, 0, 0.1019, 1.271, 1.18, 0, 0, 0.2342}},
    {{-3.865, 0.07884, 1.068, 0.09005, 0.3578, 0.4215, 0.5942, 0.8599, 5.323, 0.6346},
     {-3.168, 0.09803, 1.732, 0.3173, 0.1848, 0.3575, 1.064, 0.8366, 3.289, 0.2476}},
};

}  // namespace rsc
