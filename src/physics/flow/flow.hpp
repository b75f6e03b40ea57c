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

// A level's K and S along x and y are extrapolated, from those of its gap on the points and on
// every second point (K_c, S_c): K (K/K_c)^kPermeabilityPower, and S alike. Links between two
// points are too narrow, so that K is nearly always too small (input/trust/permeability.py). Not
// for odd numbers of points or where every second point leaves no way through.
inline constexpr double kPermeabilityPower = 0.52, kShearPower = 0.35;

// Expected relative errors of K and S along x and y, kPermeabilityPart |ln(K/K_c)| of the K before
// extrapolation and S alike; of the hydraulic gaps and of the shear flow factors
// (LevelQuantity::own_error).
inline constexpr double kPermeabilityPart = 0.32, kShearPart = 0.17;
double permeability_error(const LevelValues& level, std::size_t component);
double hydraulic_gap_error(const LevelValues& level, std::size_t component);
double shear_flow_error(const LevelValues& level, std::size_t component);
double shear_factor_error(const LevelValues& level, std::size_t component);

}  // namespace rsc
