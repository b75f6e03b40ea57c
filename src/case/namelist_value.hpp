// Conversion of namelist values from and to text, independent of the locale and exact for doubles.
#pragma once

#include "std.hpp"

namespace rsc::namelist {

// Empty if gfortran would reject the text for a variable of that type.
std::optional<std::int64_t> to_integer(std::string_view word);  // empty also beyond 64 bits
std::optional<double> to_real(std::string_view word);           // 1.5, .5, 5., 1e3, 1d3, 1q3, 1.5+3, Inf, Infinity, NaN, NaN(...)
std::optional<bool> to_logical(std::string_view word);          // any text that begins with t, f, .t or .f

// Shortest spelling that reads back to the same bits and is a Fortran real: 0.01, 3.0, 1e-06, Infinity.
std::string from_real(double value);
std::string from_logical(bool value);
std::string from_string(std::string_view value);  // in single quotes, with quotes inside doubled

}  // namespace rsc::namelist
