// Doubts about a level, and what follows from them: its status, expected errors and `doubts`.
#pragma once

#include "contact/level.hpp"

namespace rsc {

// What limits a level. Cause k is bit 1 << k of LevelValues::doubts.
enum class Cause {
    border,
    filled_points,
    grid,
    slope_ratio,
    beyond_law,
    few_points,
    layer,
    range,  // of an attraction
    outside_calibration,
    missed_contact,
    model_error,
    sliding_steps,
    steep_indenter
};
inline constexpr std::array kCauseNames = {
    "border",      "filled_points", "grid",           "slope_ratio",         "beyond_law",
    "few_points",  "layer",         "adhesion_range", "outside_calibration", "missed_contact",
    "model_error", "sliding_steps", "steep_indenter"};
constexpr std::int32_t bit(Cause cause) { return std::int32_t{1} << int(cause); }

// Explanation for the screen, without the remedy. `elements`: the level was solved by elements.
std::string sentence(Cause cause, bool elements);

// The words of the doubts of a level: "border, layer".
std::string words_of_doubts(std::int32_t doubts);

// One doubt, with the relative errors of N and A at the separation of the level that it may cause:
// NaN if they are not known. An error of the `separation` under a prescribed force [length] that is
// none of N is stated by itself.
struct Doubt {
    Cause cause;
    double force = kNotComputed, area = kNotComputed;
    bool serious = true;  // raises the status
    double separation = 0;
};

// Sets status, doubts and expected errors of a level: the errors are the sums over all doubts, and
// missing if one of them is not known. Under a prescribed force the error of N is one of the
// separation, for which the level's stiffness must be known, and adds to that of the area, relative
// to the force `pressed` of all points under pressure; NaN: N.
void conclude(LevelValues& level, std::span<const Doubt> doubts, bool by_force,
              double pressed = kNotComputed);

}  // namespace rsc
