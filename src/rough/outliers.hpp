// Outliers of a measured map: single points, or small groups, far from all around them, as dust and lost light make them.
#pragma once

#include "rough/surface.hpp"

namespace rsc {

struct Outliers {
    long count = 0;
    double threshold = 0;  // [length]
};

// Makes the height of every outlier NaN. An outlier is farther from the median of the 5 x 5 points around it than `times` the standard
// deviation of these distances, which is taken from their median (1.4826 of it, as for Gaussian ones), so that the outliers have no part in it.
// Points that are missing are left out, neighbours too.
Outliers remove_outliers(HeightMap& map, double times);

}  // namespace rsc
