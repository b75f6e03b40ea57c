// Expected errors of N and A of the asperity model, relative to boundary elements: bounds that hold
// in nine of ten cases on surfaces of many kinds (fitted and checked in input/trust).
#pragma once

#include "contact/indentation.hpp"
#include "contact/level.hpp"
#include "surface/asperities.hpp"
#include "trust/expected_error_table.hpp"

namespace rsc {

// A level with a larger bound on the error of N is out_of_validity.
inline constexpr double kMuchError = 0.1;

// The error_cause of a level in which the edge of the indenter may carry load.
inline constexpr std::int32_t kEdgeCause = kErrorPredictors + 3;
// ... and of one in which the curvature of the indenter at the contacts matters, which a list of
// asperities leaves out.
inline constexpr std::int32_t kCurvedCause = kErrorPredictors + 4;
// ... and of one in which the border of the surface touches where no summit represents it.
inline constexpr std::int32_t kBorderCause = kErrorPredictors + 5;

// Description of LevelValues::error_cause; empty for 0.
const char* error_cause(std::int32_t cause);

// Sets force_error_expected, area_error_expected and error_cause of a level that has its contacts
// and counts. They are not set without contact, or where the bounds were not calibrated: without
// interaction, with selection = 'paper', or if the mean spacing is unknown.
struct ContactTraits {
    // all contacts are most loaded ellipses (law/ellipse_law.hpp), whose forces are nearer to those
    // of elements
    bool ellipses = false;
    // Contacts of a level with ellipses that have none, or are beyond their last one: along a lay
    // their spots grow together with those of higher summits.
    std::vector<std::size_t> outside = {};
    // Area of ellipses far larger than their force would make on a summit: a hardly loaded one may
    // lie over several summits.
    double doubtful_area = 0;
    double twice = 0;  // share of the area of the spots that lies in more than one
    // difference of the indenter from the paraboloid within the contacts, mean weighted by the
    // forces
    double bent = 0;
    // share of N that contacts lose which are taken on the summits of the surface, not on their
    // flanks
    double flanks = 0;
    // Contacts that have yielded, and the forces and areas of all asperities that have, each at its
    // deepest accepted level: in unloading their errors remain.
    std::int32_t yielded = 0;
    double yielded_force = 0, yielded_area = 0;
};
void expect_error(Level& level, const Asperities& asperities, const Indenter& indenter,
                  const SolverOptions& options, const ContactTraits& traits = {});

}  // namespace rsc
