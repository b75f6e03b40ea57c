// Written by input/trust/trust.py from its study of asperities against elements; do not edit.
#pragma once

namespace rsc {

// ln of the bound = sum of coefficient times predictor, the first one 1: slope, beyond, overlap, elongation, crowding, few, coarse, plastic, flats.
inline constexpr int kErrorPredictors = 9;
inline constexpr double kLeastError = 0.003, kMostError = 1000.0;
inline constexpr double kErrorTable[3][2][kErrorPredictors + 1] = {
    // hertz, elliptic, fourth_order; N, A
    {{-1.718, 0.181, 0, 0.4246, 0.2348, 0.5502, 1.586, 0.2266, 2.423, 0.3745},
     {-0.4716, 0.1528, 0, 0.4731, 0.06739, 1.158, 2.376, 0, 0, 0.4852}},
    {{-2.252, 0, 0, 0.3243, 0.1018, 0.3012, 0.2716, 0.7765, 0.7929, 0.1843}, {-1.455, 0, 0, 0.5518, 0.07157, 0.1718, 0.1453, 0.7252, 0, 0}},
    {{-3.562, 0.06362, 1.684, 0, 0.3457, 0.2428, 1.032, 0.3277, 0.9652, 0.6779},
     {-2.85, 0.03789, 1.382, 0.4093, 0.427, 0.1385, 1.047, 0.5849, 0.03298, 0.06789}},
};

}  // namespace rsc
