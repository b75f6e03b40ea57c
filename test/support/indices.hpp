// Numbers to count with: for (const int i : up_to(n)), for (const auto k : indices(values)).
#pragma once

#include <ranges>

#include "base/std.hpp"

// 0, 1, ... below n.
template <class Integer>
auto up_to(Integer n) {
    return std::views::iota(Integer{}, std::max(Integer{}, n));
}
using rsc::indices;
