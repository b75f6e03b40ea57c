// Order of elimination of points on a periodic grid: nested dissection (George, SIAM J. Numer.
// Anal. 10, 1973).
#pragma once

#include "base/std.hpp"

namespace rsc {

// The points with used[row * nx + column] != 0 in the order in which they are to be eliminated:
// lines of few such points cut the cell, then its parts, into halves, and follow the halves. The
// order depends on nothing but the arguments (METIS draws random numbers from a generator that all
// threads share). On open and on rough gaps the factor has about as many numbers as with METIS,
// and the order takes a tenth of its time.
std::vector<std::uint32_t> dissection(int nx, int ny, const std::vector<std::uint8_t>& used);

}  // namespace rsc
