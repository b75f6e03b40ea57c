// What a level is judged by that the contact itself does not know: the map it came from.
#pragma once

#include "contact/level.hpp"
#include "rough/measured.hpp"
#include "run/prepare.hpp"

namespace rsc {

// More of the contact area than this on points that were missing makes a level out_of_validity.
inline constexpr double kMuchFilled = 0.01;

// Fills filled_share of a level on a map with filled points, and raises its status where that is too much. Elements: the pixels under
// pressure; asperities: the points within their spots.
void judge_filled(Level& level, const Measured& map, const Domain& domain);

}  // namespace rsc
