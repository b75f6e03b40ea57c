// Written by input/trust/resolution.py from its study of grids four times finer; do not edit.
#pragma once

#include "contact/grid_bodies.hpp"

namespace rsc {

// Expected relative error of a quantity of boundary elements: the root of the sum of the squares of
// factor border_share^power contacts^-averaging and of_runs border_runs. Near full contact of two
// flats border_share is that of the gaps, and the error of an area is relative to theirs.
struct ResolutionError {
    std::string_view quantity;
    double factor, power, averaging, of_runs;
    ClassFactors factors;
    bool area = false;
};
inline constexpr ResolutionError kResolutionErrors[] = {
    {"force", 0.0278, 2, 0.25, 0, {2, 2.46, 2.55}},
    {"contact_area", 0.106, 1.5, 0.25, 0.426, {1, 1, 1}, true},
    {"area_fraction", 0.106, 1.5, 0.25, 0.426, {1, 1, 1}, true},
    {"contact_area_pixels", 0.139, 1.5, 0, 0.554, {1, 1, 1}, true},
    {"stiffness", 0.0232, 2, 0.25, 0.0927, {2, 1.46, 1.54}},
    {"conductance_length", 0.0232, 2, 0.25, 0.0927, {2, 1.46, 1.54}},
    {"conductance_per_area", 0.0232, 2, 0.25, 0.0927, {2, 1.46, 1.54}},
    {"resistance", 0.0232, 2, 0.25, 0.0927, {2, 1.46, 1.54}},
    {"energy", 0.0101, 2, 0, 0.0101, {4, 6.08, 6.62}},
    {"pressure_max", 0.0582, 1.5, 0, 0.233, {1.5, 14.5, 0}},
    {"wear_depth_max", 0.0582, 1.5, 0, 0.233, {1.5, 14.5, 0}},
    {"gap_mean", 0.0013, 1.5, 0, 0, {1.5, 1, 3.65}},
};

}  // namespace rsc
