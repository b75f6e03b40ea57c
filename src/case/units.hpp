// Units as UDUNITS-2 spells and knows them. May be called by several threads.
#pragma once

#include <string>

namespace rsc {

enum class Quantity { length, force };

// What is wrong with `text` as the unit of a quantity; empty when it is one. '1' and '' (pure numbers, for calculations without
// dimensions) are taken for any quantity. Units whose zero lies elsewhere ("m @ 5") are refused.
std::string unit_problem(const std::string& text, Quantity quantity);

// A length of 1 `from` in `to`: 0.001 for "um" and "mm". Texts in UTF-8 or Latin-1 ("µm", "Å"), blanks around them ignored. Equal
// texts give 1 exactly. Throws Error(bad_input) saying which of the two is no unit of length; it names no file: the caller does.
double length_factor(const std::string& from, const std::string& to);

}  // namespace rsc
