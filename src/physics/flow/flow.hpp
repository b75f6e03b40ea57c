// What is read off the gap between two flats at a level: its means, whether it percolates, and with
// output%flow its permeability.
#pragma once

#include "contact/quantities.hpp"
#include "physics/flow/permeability.hpp"

namespace rsc {

// Sets gap_mean, gap_mean_open and percolates.
void add_gap(LevelValues& level, const GapMap& map);

// The open points of the gap in `bins` bins of this width.
GapCounts count_gaps(const GapMap& map, int bins, double width);

// The gap of a level of two flats by elements at the points of its map; computed once.
GapMap gap_of(LevelSource& source);

// Compute the quantities of the gap, and its permeability (LevelQuantity::compute).
const char* compute_gap(LevelSource& source);
const char* compute_permeability(LevelSource& source);

// Expected relative errors of K_xx and K_yy, and of the hydraulic gaps along x and y: from the same
// gap on every second point (LevelQuantity::own_error).
double permeability_error(const LevelValues& level, std::size_t component);
double hydraulic_gap_error(const LevelValues& level, std::size_t component);

}  // namespace rsc
