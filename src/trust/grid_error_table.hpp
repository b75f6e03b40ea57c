// Written by input/trust/resolution.py from its study of grids four times finer; do not edit.
#pragma once

#include "contact/grid_bodies.hpp"

namespace rsc {

// Expected relative error of a quantity of boundary elements: the root of the sum of the squares of
// factor border_share^power contacts^-averaging and of_runs border_runs.
struct ResolutionError {
    std::string_view quantity;
    double factor, power, averaging, of_runs;
    ClassFactors factors;
};
inline constexpr ResolutionError kResolutionErrors[] = {
    {"force", 0.0312, 2, 0.5, 0, {1, 2.19, 3.12}},
    {"contact_area", 0.106, 1.5, 0.25, 0.426, {1, 1, 1}},
    {"area_fraction", 0.106, 1.5, 0.25, 0.426, {1, 1, 1}},
    {"contact_area_pixels", 0.138, 1.5, 0, 0.551, {1, 1, 1}},
    {"stiffness", 0.0213, 2, 0, 0.0851, {2, 1.59, 1.63}},
    {"conductance_length", 0.0213, 2, 0, 0.0851, {2, 1.59, 1.63}},
    {"conductance_per_area", 0.0213, 2, 0, 0.0851, {2, 1.59, 1.63}},
    {"resistance", 0.0213, 2, 0, 0.0851, {2, 1.59, 1.63}},
    {"energy", 0.0102, 2, 0.25, 0.0102, {1.5, 6.03, 6.57}},
    {"pressure_max", 0.0582, 1.5, 0, 0.233, {1.5, 14.5, 1}},
    {"gap_mean", 0.0013, 1.5, 0, 0, {1.5, 1, 3.65}},
};

}  // namespace rsc
