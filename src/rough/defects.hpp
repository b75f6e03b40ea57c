// Defects of measured maps: missing points and rounded heights.
#pragma once

#include "rough/detection.hpp"
#include "rough/surface.hpp"

namespace rsc {

// Number of points whose height is NaN.
long count_missing(const HeightMap& map);

// Gives every missing point the height at which it is the mean of its four neighbours, weighted by 1/dx^2 and 1/dy^2 (beyond an
// edge there is no neighbour): the harmonic function with the heights around as its values at the border, by conjugate gradients to
// 1e-12. Returns the points filled, 1 at j*nx + i, or nothing if none was missing. Throws Error(bad_input) if all are missing.
std::vector<std::uint8_t> fill_missing(HeightMap& map);

// Removes the asperities closer than `distance` to a filled point, whose curvatures depend on the filling, and corrects the count and its
// means.
void drop_near_filled(Asperities& asperities, SummitCount& count, const HeightMap& map, const std::vector<std::uint8_t>& filled,
                      double distance);

// The step of which all differences of neighbouring heights are multiples, if many neighbours are equal; otherwise
// 0. Missing points (NaN) are left out. Call it before a form is subtracted.
double height_step(const HeightMap& map);

// Takes the rounding out of a map whose heights are rounded to multiples of `step` (Wiener's filter on its cosine series): rounding adds a power of
// step^2/12 spread evenly over all waves; waves that have little more are damped, and those shorter than the first that has no more are dropped.
void smooth_rounded(HeightMap& map, double step);

}  // namespace rsc
