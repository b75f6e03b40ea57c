// What is read off the gap between two flats at a level: its means, whether it percolates, and with
// output%flow its permeability.
#pragma once

#include "contact/level.hpp"
#include "physics/flow/permeability.hpp"

namespace rsc {

// Sets gap_mean, gap_mean_open and percolates.
void add_gap(LevelValues& level, const GapMap& map);

// The open points of the gap in `bins` bins of this width.
GapCounts count_gaps(const GapMap& map, int bins, double width);

// Sets permeability and hydraulic_gap; `flow` as in permeability().
void add_permeability(LevelValues& level, const GapMap& map, std::vector<double>* flow = nullptr);

}  // namespace rsc
