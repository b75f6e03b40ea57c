// Units in the syntax of UDUNITS-2. Thread-safe.
#pragma once

#include "base/std.hpp"

namespace rsc {

enum class Quantity { length, force, time };

// An error message if `text` is no unit of the quantity, otherwise empty. '1' and '' (pure numbers,
// for calculations without dimensions) are accepted for any quantity. Units with another zero ("m @
// 5") are refused.
std::string unit_problem(const std::string& text, Quantity quantity);

// 1 `from` in `to`^power, `to` being a unit of length: 0.001 for "um" and "mm", 1000 for "um-1",
// "mm" and -1. Texts in UTF-8 or Latin-1 ("µm", "Å"), blanks around them ignored. Equal texts
// (power 1) and pure numbers on both sides give 1. Throws Error(bad_input) that names the wrong
// unit; the caller adds the file name.
double length_factor(const std::string& from, const std::string& to, int power = 1);

// 1 `from` in `to`; 0 if they measure different quantities.
double unit_factor(const std::string& from, const std::string& to);

// A unit in the spelling of UDUNITS: powers of a length and a force unit, unit_of("mm", -2, "N", 1)
// is "N mm-2"; "1" if both powers are 0. A unit that is more than a plain name is put in
// parentheses.
std::string unit_of(const std::string& length_unit, int length_power,
                    const std::string& force_unit = "", int force_power = 0);

}  // namespace rsc
