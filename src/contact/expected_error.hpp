// How far N and A of asperities may be from the truth, that is from elements: bounds that were kept in nine of ten cases on surfaces of many
// kinds (input/trust, which fits and checks them).
#pragma once

#include "contact/indentation.hpp"
#include "contact/level.hpp"
#include "rough/asperities.hpp"

namespace rsc {

// A bound on N above this makes a level out_of_validity.
inline constexpr double kMuchError = 0.1;

// LevelValues::error_cause in words; empty for 0.
const char* error_cause(std::int32_t cause);

// Fills force_error_expected, area_error_expected and error_cause of a level whose contacts and counts are there. Nothing where nothing touches,
// or where the bounds were not calibrated: without interaction, with selection = 'paper', and where mean spacing or rms slope are not known.
void expect_error(Level& level, const Asperities& asperities, const Indenter& indenter, const SolverOptions& options);

}  // namespace rsc
