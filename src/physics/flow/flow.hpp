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

// A seal of the length `length` along x and the width `width`, between pressures at its inlet and
// its outlet; the gas is ideal and isothermal.
struct Leak {
    std::array<double, 2> pressures = {};  // [force/length^2]
    double length = 0, width = 0;          // 0: no leak is asked for
    double viscosity = 0;                  // [force time/length^2]
    bool gas = false;
    bool asked() const { return length > 0; }
};

// Compute the quantities of the gap, those of its flow, and the volume that leaks per unit of time,
// of a gas at the outlet's pressure (LevelQuantity::compute).
const char* compute_gap(LevelSource& source);
const char* compute_permeability(LevelSource& source);
const char* compute_leak(LevelSource& source);

// Expected relative errors of K and S along x and y, of the hydraulic gaps and of the shear flow
// factors: from the same gap on every second point (LevelQuantity::own_error).
double permeability_error(const LevelValues& level, std::size_t component);
double hydraulic_gap_error(const LevelValues& level, std::size_t component);
double shear_flow_error(const LevelValues& level, std::size_t component);
double shear_factor_error(const LevelValues& level, std::size_t component);

}  // namespace rsc
