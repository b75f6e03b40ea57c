// Sets of pixels that are connected by sides: contact spots.
#pragma once

#include "elements/pixel_products.hpp"

namespace rsc {

// Finds sets of pixels connected by sides, for pixels sorted by row (y, then x). label[k] is the
// set of pixel k, numbered from 0 in the order of their first pixels. Returns the number of sets.
// With a period (columns, rows; 0: none) sets are joined across the edges.
int connected_sets(const std::vector<Pixel>& pixels, std::vector<int>& label, int period_x = 0,
                   int period_y = 0);

// Number of sides of each pixel without a neighbour, for pixels and a period as above.
std::vector<int> open_sides(const std::vector<Pixel>& pixels, int period_x, int period_y);

// The sum of the squares of the lengths of the straight parts of their borders, in sides.
double squares_of_straight_parts(const std::vector<Pixel>& pixels, int period_x, int period_y);

}  // namespace rsc
