// The flow through the gap of two flats: memory, and the screen.
#pragma once

#include "observe/record.hpp"
#include "run/job.hpp"

namespace rsc {

// True if levels of the case have a gap: two flats by elements.
bool has_gap(const Case& settings);

// Throws Error(bad_input) if the memory of the machine does not bear output%flow on this map,
// telling the size that it bears.
void require_flow_memory(const Case& settings, double points);

// Says up to which levels the gap is open across the cell, and how a leak follows from K.
void print_gap(std::ostream& out, std::span<const LevelValues> levels, const Job& job);

}  // namespace rsc
