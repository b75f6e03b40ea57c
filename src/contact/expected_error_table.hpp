#pragma once
namespace rsc {
inline constexpr int kErrorPredictors = 9;
inline constexpr double kLeastError = 0.003, kMostError = 10.0;
inline constexpr double kErrorTable[3][2][kErrorPredictors + 1] = {{{-3}, {-3}}, {{-3}, {-3}}, {{-3}, {-3}}};
}  // namespace rsc
