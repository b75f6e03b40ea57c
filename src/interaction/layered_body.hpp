// A layered elastic body.
#pragma once

#include "base/std.hpp"

namespace rsc {

// Layers of body 1, from the top, bonded to each other and to a half-space of E, nu
// (interaction/layers.hpp).
inline constexpr int kMostLayers = 8;
struct Layer {
    double thickness = 0, E = 0,
           nu = 0;  // [length], Young's modulus [force/length^2], Poisson's ratio
    friend bool operator==(const Layer&, const Layer&) = default;
};
struct LayeredBody {
    std::int64_t count = 0;  // 0: a homogeneous half-space
    std::array<Layer, kMostLayers> layer{};
    double E = 0, nu = 0;  // E = Infinity: rigid
    friend bool operator==(const LayeredBody&, const LayeredBody&) = default;
};

}  // namespace rsc
