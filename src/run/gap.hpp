// The gap of a level of two flats by elements, and what fluid does in it.
#pragma once

#include "contact/path.hpp"
#include "observe/record.hpp"
#include "run/job.hpp"

namespace rsc {

// True if levels of the case have a gap: two flats by elements.
bool has_gap(const Case& settings);

// Throws Error(bad_input) if the memory of the machine does not bear output%flow on this map,
// telling the size that it bears.
void require_flow_memory(const Case& settings, double points);

// Sets gap_mean, gap_mean_open and percolates of the last level of a contact with this map, the
// counts of its gaps if the bins have a range of gaps, and its permeability if `with_flow`; `flow`
// as in permeability().
void measure_gap(const HeightMap& map, const Path& contact, Level& level, const PdfBins& bins,
                 bool with_flow, std::vector<double>* flow = nullptr);

// Says up to which levels the gap is open across the cell, and how a leak follows from K.
void print_gap(std::ostream& out, std::span<const LevelValues> levels, const Job& job);

}  // namespace rsc
